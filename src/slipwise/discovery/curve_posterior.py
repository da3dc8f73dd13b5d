"""Which curve is missing beside what of the catalogue: the evidence of each, everything else free at the same time.

Each curve is weighed beside the effects of the catalogue that are likeliest with it, best first on the same statistics
with the same prior as `evidence.posterior`; what is left of every relation is estimated for each anew.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve

from slipwise.arrays import Array
from slipwise.discovery.curve_columns import CurveColumns
from slipwise.discovery.curve_system import (
    CurveProducts,
    CurveSystem,
    Solved,
    choose_root,
    level_of,
    solve_system,
)
from slipwise.evidence.prior import OF_MODEL, Prior
from slipwise.residual_map.curve import ResidualCurve
from slipwise.short_repr import short_repr

#: Moves of the search for what stands beside a curve, estimates of what is left before each at most, and change of
#: its logarithm at which they end [1].
_MOVES, _LEVELS, _SETTLED = 8, 10, 0.05
#: A move must be worth so much [nats].
_WORTH = 0.5
#: A candidate that stands for this share of a curve is told [1]; a size over which none is held.
_ALIKE, _ANY_SIZE = 0.3, 50.0


@short_repr
@dataclass(frozen=True)
class Weighed:
    """A model of the catalogue's effects and at most one curve.

    Attributes:
        evidence: with the prior of what is in it [nats].
        active: form -> number of its width, of the effects that matter.
        level: (r,) what is left of every relation [noise variance].
        solved: everything else integrated out.
        root: of the covariance of the curve's heights; None without one.
    """

    evidence: float
    active: Mapping[int, int]
    level: Array
    solved: Solved
    root: Array | None = None


def weigh(
    system: CurveSystem, curve: CurveProducts | None, active: Mapping[int, int], level: Array, *, moves: int = _MOVES
) -> Weighed:
    """Return a model with a curve, or without one, and what of the catalogue is likeliest beside it.

    Args:
        system: the products.
        curve: that is in it.
        active: where the search begins.
        level: the same.
        moves: of the search at most.
    """
    for number in range(moves + 1):
        variance, root = variance_of(system, active), None
        for _ in range(_LEVELS):
            if curve is not None:
                root, _ = choose_root(system, solve_system(system, variance, level), level, curve)
            solved = solve_system(system, variance, level, curve, root)
            before, level = level, level_of(system, solved.left)
            if np.all(np.abs(np.log(level / before)) < _SETTLED):
                break
        move = _best_move(system, solved, active) if number < moves else None
        if move is None:
            break
        active = move
    solved = solve_system(system, variance, level, curve, root)
    return Weighed(solved.evidence + _prior(system, active), active, level, solved, root)


def as_fitted(system: CurveSystem) -> dict[int, int]:
    """Return the effects of the model, active at the middle width."""
    own = np.flatnonzero(system.groups.number == OF_MODEL)
    return {int(f): len(Prior().large) // 2 for f in own}


def add_curve(system: CurveSystem, beside: Weighed, curve: CurveProducts) -> float:
    """Return what a curve adds to the evidence of a model that stays as it is [nats]."""
    return choose_root(system, beside.solved, beside.level, curve)[1]


def variance_of(system: CurveSystem, active: Mapping[int, int]) -> Array:
    """Return the variance (K,) of every candidate's column: of dirt, and of its width where it matters."""
    out = system.trifles.copy()
    for form, width in active.items():
        out[_members(system, form)] += Prior().large[width] ** 2
    return out


def curve_by_blocks(
    system: CurveSystem, beside: Weighed, curve: CurveProducts, made: CurveColumns
) -> tuple[ResidualCurve, float]:
    """Return a curve's normal equations by block, everything else projected out, and the excess that it may explain.

    Args:
        system: the products.
        beside: the curve with what stands beside it.
        curve: its products.
        made: its columns.
    """
    variance, level = variance_of(system, beside.active), beside.level
    bare = solve_system(system, variance, level)
    weights = system.weights(level) / system.weights(level)[curve.relation]
    known = bare.scales[:, None] * cho_solve(bare.factor, bare.scales[:, None] * curve.summed[0])
    known *= system.weights(level)[curve.relation]
    normal, drive, whole = [], [], []
    for t in range(system.products.shape[1]):
        products = np.tensordot(weights, system.products[:, t], 1)
        pulls, squares = weights @ system.pulls[:, t], float(weights @ system.squares[:, t])
        crossed = curve.cross[t].T @ known
        normal.append(curve.own[t] - crossed - crossed.T + known.T @ products @ known)
        drive.append(known.T @ (pulls + products @ bare.means) - curve.pull[t] - curve.cross[t].T @ bare.means)
        whole.append(squares + float(2.0 * pulls @ bare.means + bare.means @ products @ bare.means))
    independent = float(weights @ (system.counts * level))  # what would be left if the curve were all that lacks
    scatter = np.full(len(made.count), level[curve.relation] * system.spread[curve.relation])
    found = ResidualCurve(made.splines, np.stack(normal), np.stack(drive), np.array(whole), made.count, scatter)
    return found, max(float(np.sum(whole)) - independent, 1e-9)


def list_alike(system: CurveSystem, found: Weighed, curve: CurveProducts) -> dict[str, float]:
    """Return effect -> share of a curve that it could explain alone, the largest first, base numbers free [1]."""
    base, groups = system.base, system.groups
    weights = system.weights(found.level)
    cross, own, _ = curve.summed
    heights = found.solved.heights
    along = weights[curve.relation] * cross @ heights
    size = weights[curve.relation] * float(heights @ own @ heights)
    whole = np.tensordot(weights, system.summed[0], 1)
    rig = whole[:base, :base] + np.diag(1e-6 * np.diag(whole)[:base] + 1e-9)
    swallowed = np.linalg.solve(rig, np.column_stack([whole[:base, base:], along[:base]]))
    left = whole[base:, base:] - whole[base:, :base] @ swallowed[:, :-1]
    pull = along[base:] - whole[base:, :base] @ swallowed[:, -1]
    size -= float(along[:base] @ swallowed[:, -1])
    out: dict[str, float] = {}
    for form, owner in enumerate(groups.owner):
        at = _members(system, form)
        part = left[np.ix_(at, at)] + np.eye(len(at)) / _ANY_SIZE**2
        share = float(pull[at] @ np.linalg.solve(part, pull[at])) / max(size, 1e-12)
        name = groups.effects[owner]
        out[name] = max(out.get(name, 0.0), min(share, 1.0))
    return {name: share for name, share in sorted(out.items(), key=lambda one: -one[1]) if share > _ALIKE}


def sizes_of(system: CurveSystem, found: Weighed) -> dict[int, float]:
    """Return form -> size of every effect that is active [limits]."""
    means = found.solved.means[system.base :]
    return {form: float(np.linalg.norm(means[_members(system, form)])) for form in found.active}


def _members(system: CurveSystem, form: int) -> NDArray[np.int64]:
    groups = system.groups
    return groups.columns[form, : groups.length[form]]


def _prior(system: CurveSystem, active: Mapping[int, int]) -> float:
    widths = np.log(Prior().widths)
    return float(sum(system.odds[form] + widths[width] for form, width in active.items()))


def _best_move(system: CurveSystem, solved: Solved, active: Mapping[int, int]) -> dict[int, int] | None:
    """Return the effects with one more, one less, or one at another width, where that is worth most; else None."""
    prior, groups = Prior(), system.groups
    inverse, means = solved.covariance()[system.base :, system.base :], solved.means[system.base :]
    now = variance_of(system, active)
    taken = {groups.owner[f] for f in active}
    barred = {label for one, label in system.apart for f in active if groups.labels[groups.owner[f]] == one}
    standing = _prior(system, active)
    best: tuple[float, dict[int, int]] | None = None
    for form, owner in enumerate(groups.owner):
        here = active.get(form)
        if here is None and (owner in taken or groups.labels[owner] in barred or len(active) >= prior.places):
            continue
        at = _members(system, form)
        spread = inverse[np.ix_(at, at)]
        precision = np.linalg.inv(spread)
        own, pull = precision - np.diag(1.0 / now[at]), precision @ means[at]
        widths = [w for w in (None, *range(len(prior.large))) if w != here]
        large = np.array([0.0 if w is None else prior.large[w] ** 2 for w in widths])
        worth, sizes = _answers_at(own, pull, np.vstack([now[at], system.trifles[at] + large[:, None]]))
        one_sided = np.array([not system.columns[j].two_sided for j in at])
        without = {f: w for f, w in active.items() if f != form}
        for width, gain, size in zip(widths, worth[1:] - worth[0], sizes[1:], strict=True):
            if width is not None and np.any(size[one_sided] <= 0.0):
                continue
            chosen = without if width is None else {**without, form: width}
            gain += _prior(system, chosen) - standing
            if gain > _WORTH and (best is None or gain > best[0]):
                best = gain, chosen
    return best[1] if best else None


def _answers_at(own: Array, pull: Array, variances: Array) -> tuple[Array, Array]:
    """Return the evidence (w,) of n columns, up to a constant [nats], and their sizes (w, n) at prior variances (w, n).

    Of all variances in one call: there are thousands of small systems.
    """
    precision = own + np.eye(len(own)) / variances[:, None, :]
    sizes = np.linalg.solve(precision, np.broadcast_to(pull[:, None], (*variances.shape, 1)))[..., 0]
    volume = np.linalg.slogdet(precision)[1] + np.sum(np.log(variances), axis=1)
    worth = 0.5 * (sizes @ pull - volume)
    return np.asarray(worth, dtype=np.float64), np.asarray(sizes, dtype=np.float64)
