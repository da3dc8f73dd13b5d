"""The catalogue: one small file per physical or instrument effect."""
