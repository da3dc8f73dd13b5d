"""Statistics that every part shares: least squares, effective samples, prediction intervals."""
