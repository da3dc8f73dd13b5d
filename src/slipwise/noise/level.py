"""When an error counts as being at the noise floor: one level for every command, page and script.

An error is the rms of a residual over the noise by which it is divided, so a perfect model errs by 1, as far as that
noise is known. It is known from samples at rest: the standard deviation of n of them about a line has itself a
relative standard deviation of 1/sqrt(2 (n - 2)). With the fewest that are taken for enough, 60, that is 9 %, and the
true noise is less than 15 % above the measured one in 95 of 100 cases. No error below 1.15 says that a model lacks
anything.

Source: Ahn, Fessler (2003), Standard errors of mean, variance, and standard deviation estimators.
"""

#: An error up to this level is at the noise floor [noise floors]: 1 + 1.645 / sqrt(2 (60 - 2)), see `gauges.ENOUGH`.
AT_FLOOR = 1.15


def is_at_floor(error: float) -> bool:
    """Return whether an error [noise floors] is at the noise floor; never where it is unknown (NaN)."""
    return error <= AT_FLOOR
