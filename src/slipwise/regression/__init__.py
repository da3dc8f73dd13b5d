"""Least squares, linear and not."""
