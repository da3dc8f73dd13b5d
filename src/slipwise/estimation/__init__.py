"""Estimation: the numbers of a model from measured runs, with their intervals."""
