"""From an unknown effect to a law."""
