"""Data files of laboratories and agencies: what their headers state, and their tables of numbers."""
