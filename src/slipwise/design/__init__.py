"""Experiment: which table motion to try next."""
