"""Numbers of the base model that a campaign does not tell: known badly, made up for by another, or on a bound.

How badly they are identified is asked beside whatever effects were found: a law that lacks something leaves a residual
that blurs every number. Why is looked for in what the laws were fed with: a law of pressure needs a load that changes.
"""

import inspect
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import compute_intervals
from slipwise.relations.parameters import Free
from slipwise.units import convert

#: Numbers of the rig that mean something to a user; the others are nuisances.
_OF_RIG = ("rig.mass", "rig.centre_height", "rig.buffer_stiffness", "rig.shear_strength")
#: A number is known badly when its standard error is this share of it [1].
_BADLY = 0.2
#: Numbers with this correlation are one, unless each is known within this share of it all the same [1].
_TIED, _WELL = 0.98, 0.02
#: A correlation that is the reason why a number is known badly [1].
_STRONG_CORRELATION = 0.9
#: Shares of a column below this are rounding [1].
_ROUNDING = 1e-6
#: Loads that scatter by a smaller share hardly change; all of a girder's together do not without vertical motion [1].
_STEADY, _LEVEL = 0.05, 0.01
#: Speeds within this ratio are one speed [1].
_ONE_SPEED = 2.0
_LOADS, _SPEEDS = {"load", "pressure", "true_pressure"}, {"speed", "velocity_x"}


@dataclass(frozen=True)
class Identified:
    """How well a campaign tells a number inside its bounds.

    Attributes:
        error: standard error [SI].
        partner: key of the number that best makes up for it; "" for none.
        correlation: with that number [1].
    """

    error: float
    partner: str
    correlation: float


def list_unidentified(final: BaseFit, base: BaseFit) -> list[tuple[str, str]]:
    """Return the base model's numbers that a campaign does not tell, each with the reason.

    Args:
        final: the fit that is reported.
        base: the base fit; only its numbers are looked at.
    """
    solution, keys = final.solution, {f.key for f in base.free}
    identified = describe_identification(_inside(final))
    out: list[tuple[str, str]] = []
    tied: set[str] = set()
    for free in (f for f in solution.free if f.key in keys):
        number, value = _named(base, free), solution.values[free.key]
        if number is None:
            continue
        if free.key in solution.at_bounds:
            if free.start not in (free.low, free.high) and not number.may_be_absent:
                end = "lower" if value - free.low < free.high - value else "upper"
                message = f"the fit ended on its {end} bound, {number.amount(value)}"
                out.append((number.title, f"{message}: the data want another law, or do not show it"))
        elif free.key not in identified:
            out.append((number.title, "nothing that was measured here depends on it"))
        else:
            one = identified[free.key]
            share = one.error / max(abs(value), number.usual)
            if share > _BADLY:
                message = f"{number.amount(value)} with a standard error of {number.amount(one.error)}"
                why = _why(base, number.effect, one)
                out.append((number.title, f"{message}: {why}" if why else message))
            elif abs(one.correlation) > _TIED and share > _WELL and free.key not in tied:
                tied.add(one.partner)
                reason = f"one makes up for the other (correlation {one.correlation:.3f})"
                out.append((f"{number.title} against {one.partner}", reason))
    return out


def _inside(final: BaseFit) -> BaseFit:
    """Return a fit of the numbers inside their bounds, bounds away: what a strength is at most would take a profile."""
    solution = final.solution
    kept = [f for f in solution.free if f.key not in solution.at_bounds]
    free = tuple(replace(f, low=-np.inf, high=np.inf) for f in kept)
    return replace(final, solution=replace(solution, free=free, jacobian=solution.inside))


def describe_identification(fit: BaseFit) -> dict[str, Identified]:
    """Say of every number of a fit on which a residual depends how well it is identified."""
    found = compute_intervals(fit)
    scale = {f.key: f.scale for f in fit.solution.free}
    inside = [j for j, f in enumerate(fit.solution.free) if f.key in found.keys]
    own, tie = separate_each(fit.solution.normal[np.ix_(inside, inside)])
    np.fill_diagonal(tie, 0.0)
    errors = np.sqrt(np.maximum(np.diag(found.covariance), 0.0))
    out = {}
    for i, key in enumerate(found.keys):
        # a pseudo-inverse leaves out what is not identified at all, as if it were known
        error = max(float(errors[i]), scale[key] / float(own[i]))
        j = int(np.argmax(np.abs(tie[i])))
        out[key] = Identified(error, found.keys[j] if tie[i, j] else "", float(tie[i, j]))
    return out


def separate_each(normal: Array) -> tuple[Array, Array]:
    """Return the length (k,) of what no other slope could do of each, and the correlations (k, k).

    Args:
        normal: (k, k) product of the slopes with themselves.
    """
    length = np.sqrt(np.diag(normal))
    size, turn = np.linalg.eigh(normal / np.outer(length, length))
    inverse = (turn / np.maximum(size, _ROUNDING**2)) @ turn.T
    more = np.sqrt(np.diag(inverse))
    return length / more, inverse / np.outer(more, more)


@dataclass(frozen=True)
class _Number:
    """A number as people read it.

    Attributes:
        title: its key, with the letter that stands for it in its law.
        unit: SI unit.
        shown_in: unit in which people read it.
        usual: least size that its error is held against [SI].
        may_be_absent: whether it is a strength: that it is small is known then.
        effect: that it belongs to; None for the rig.
    """

    title: str
    unit: str
    shown_in: str
    usual: float
    may_be_absent: bool
    effect: Effect | None

    def amount(self, value: float) -> str:
        """Write a value [SI] with its unit."""
        return f"{convert(value, self.unit, self.shown_in):.3g} {self.shown_in}".removesuffix(" 1")


def _named(base: BaseFit, free: Free) -> _Number | None:
    """Return a number as people read it; None for one that only a fit needs."""
    began = abs(free.start) if free.low <= 0.0 else 0.0
    if free.key in _OF_RIG:
        return _Number(free.key, free.unit, free.unit, began, False, None)
    for use in base.model.uses:
        for p in use.parameters:
            if free.key == f"{use.label}.{p.name}":
                symbol, colon, _ = p.meaning.partition(":")
                title = f"{free.key} ({symbol})" if colon else free.key
                strength = p.neutral is not None
                usual = max(began, abs(p.typical)) if strength else began
                return _Number(title, p.unit, p.shown_in or p.unit, usual, strength, use.effect)
    return None


def _why(base: BaseFit, effect: Effect | None, identified: Identified) -> str:
    """Say why a number is known badly: what its law asks for hardly changes, or another makes up for it; or ""."""
    hooks = effect.hooks.values() if effect else ()
    asked = {name for hook in hooks for name in inspect.signature(hook).parameters}
    correlated = abs(identified.correlation) > _STRONG_CORRELATION
    found = [_steady(base)] if asked & _LOADS and correlated else []
    found += [_one_speed(base)] if asked & _SPEEDS else []
    tie = f"{identified.partner} makes up for it (correlation {identified.correlation:.3f})" if correlated else ""
    return " and ".join(r for r in found if r) or tie


def _steady(base: BaseFit) -> str:
    """Say that the load hardly changes, where it does not: within the runs that are fitted, and from one to another."""
    runs = base.objective.fitted_runs
    loads = np.concatenate([r.load[r.sliding] for r in runs])
    if not loads.size:
        return ""
    total = loads.sum(axis=1)
    spread, level = float(np.std(loads) / np.mean(loads)), float(np.std(total) / np.mean(total))
    still = "no run has vertical motion" if base.objective.specimen.free and level < _LEVEL else ""
    if spread < _STEADY:
        return f"the load hardly changes ({100.0 * spread:.2g} %{f', {still}' if still else ''})"
    return f"{still}, and rocking changes the loads by {spread:.0%} only" if still else ""


def _one_speed(base: BaseFit) -> str:
    """Say that all sliding is at about one speed, where it is."""
    runs = base.objective.fitted_runs
    speed = 1e3 * np.concatenate([np.abs(r.velocity[r.sliding]) for r in runs])
    low, high = np.quantile(speed, (0.1, 0.9)) if speed.size else (0.0, np.inf)
    return f"nearly all sliding is at {low:.2g} to {high:.2g} mm/s" if high < _ONE_SPEED * low else ""
