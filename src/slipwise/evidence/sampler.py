"""The sampler of a posterior over which candidate takes which place, compiled; see `evidence.posterior`."""

from math import erf, log

import numpy as np

from slipwise.jobs.machine_code import kept


@kept()
def _log_normal_cdf(x):
    """Return the logarithm of the chance to lie below; what lies far on the wrong side must cost all that it gains."""
    if x > -6.0:
        return log(0.5 * (1.0 + erf(x * 0.7071067811865476)))
    return -0.5 * x * x - log(-x) - 0.9189385332046727


@kept()
def _inverse(A, act, d, n):
    Q = np.empty((n, n))
    for i in range(n):
        for j in range(n):
            Q[i, j] = A[act[i], act[j]]
        Q[i, i] += d[i]
    return np.linalg.inv(Q)


@kept()
def sample_places(A, b, columns, length, owner, excludes, odds, widths, odds_of, one_sided, start, sweeps, seed):
    """Sample which candidate takes which place, all sizes integrated out; see the module's docstring.

    Args:
        A: (K, K) precision that the data give of the sizes of all columns.
        b: (K,) pull of the data.
        columns: (F, w) columns of each form.
        length: (F,) how many of them count.
        owner: (F,) term of each form.
        excludes: (T, T) whether two terms cannot be together; one never is with itself.
        odds: (F,) logarithm of the prior of the form against none.
        widths: (Z,) standard deviations of what is large.
        odds_of: (Z,) logarithm of the prior of each width.
        one_sided: (K,) whether a size is at least zero.
        start: (p,) form of each place to begin with, -1 for none.
        sweeps: rounds over all places.
        seed: of the random numbers.

    Returns:
        form of every place (sweeps, p), -1 for none, number of its width (sweeps, p), and the logarithm of the
        posterior of each round, up to a constant (sweeps,).
    """
    np.random.seed(seed)  # noqa: NPY002  the generator that compiled code knows
    F, w = columns.shape
    Z = len(widths)
    places = len(start)
    taken = start.copy()
    width = np.zeros(places, np.int64)
    act = np.empty(places * w, np.int64)
    d = np.empty(places * w)
    forms = np.full((sweeps, places), -1)
    of_width = np.zeros((sweeps, places), np.int64)
    worth = np.zeros(sweeps)
    weight = np.empty(F * Z + 1)
    B = np.empty((w, places * w))
    a = np.empty((w, w))
    h = np.empty(w)
    for sweep in range(sweeps):
        for place in np.random.permutation(places):  # noqa: NPY002
            n = 0
            for other in range(places):
                if other != place and taken[other] >= 0:
                    for i in range(length[taken[other]]):
                        act[n] = columns[taken[other], i]
                        d[n] = widths[width[other]] ** -2.0
                        n += 1
            M = _inverse(A, act, d, n)
            u = np.zeros(n)
            for i in range(n):
                for j in range(n):
                    u[i] += M[i, j] * b[act[j]]
            weight[:] = -1e300
            weight[F * Z] = 0.0
            for c in range(F):
                here = False
                for other in range(places):
                    if other != place and taken[other] >= 0 and excludes[owner[taken[other]], owner[c]]:
                        here = True
                if here:
                    continue
                m = length[c]
                for i in range(m):
                    j = columns[c, i]
                    s = b[j]
                    for k in range(n):
                        B[i, k] = A[j, act[k]]
                        s -= B[i, k] * u[k]
                    h[i] = s
                for i in range(m):
                    for j in range(i + 1):
                        s = A[columns[c, i], columns[c, j]]
                        for k in range(n):
                            for q in range(n):
                                s -= B[i, k] * M[k, q] * B[j, q]
                        a[i, j] = s
                        a[j, i] = s
                for z in range(Z):
                    precision = widths[z] ** -2.0
                    if m == 1:
                        S = max(a[0, 0], 0.0) + precision
                        value = 0.5 * h[0] * h[0] / S + 0.5 * np.log(precision / S)
                        if one_sided[columns[c, 0]]:
                            value += log(2.0) + _log_normal_cdf(h[0] / np.sqrt(S))
                    else:
                        Q = a[:m, :m].copy()
                        for i in range(m):
                            Q[i, i] = max(Q[i, i], 0.0) + precision
                        sign, determinant = np.linalg.slogdet(Q)
                        if sign <= 0.0:
                            continue
                        best = np.linalg.solve(Q, h[:m].copy())
                        value = 0.5 * np.dot(best, h[:m]) + 0.5 * m * np.log(precision) - 0.5 * determinant
                        for i in range(m):
                            if one_sided[columns[c, i]] and best[i] < 0.0:
                                value -= 0.5 * best[i] * best[i] * Q[i, i]
                    weight[c * Z + z] = value + odds[c] + odds_of[z]
            chance = np.exp(weight - weight.max())
            x = np.random.random() * chance.sum()  # noqa: NPY002
            pick = 0
            total = chance[0]
            while x > total and pick < F * Z:
                pick += 1
                total += chance[pick]
            taken[place] = pick // Z if pick < F * Z else -1
            width[place] = pick % Z if pick < F * Z else 0
        n = 0
        prior = 0.0
        for place in range(places):
            if taken[place] >= 0:
                prior += odds[taken[place]] + odds_of[width[place]]
                for i in range(length[taken[place]]):
                    act[n] = columns[taken[place], i]
                    d[n] = widths[width[place]] ** -2.0
                    n += 1
        if n:
            M = _inverse(A, act, d, n)
            sign, determinant = np.linalg.slogdet(M)
            prior += 0.5 * determinant
            for i in range(n):
                mean = 0.0
                for j in range(n):
                    mean += M[i, j] * b[act[j]]
                prior += 0.5 * mean * b[act[i]] + 0.5 * np.log(d[i])
                if one_sided[act[i]]:
                    prior += log(2.0) + _log_normal_cdf(mean / np.sqrt(max(M[i, i], 1e-300)))
        forms[sweep] = taken
        of_width[sweep] = width
        worth[sweep] = prior
    return forms, of_width, worth
