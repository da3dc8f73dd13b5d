"""System-level refinement: numbers of a fit brought to where the replay, not the law alone, agrees with the runs.

    min over the numbers of  sum over runs, channels, samples of [(simulated - measured) / spread]^2

A component-level fit drives each law with measured states; what the girder makes of the forces is not asked. Here the
whole rig is replayed in windows that restart from what was measured, and slopes are differences of replays: the model
as it stands and one copy for each number are stepped side by side. A channel's spread is its error before refinement,
or its noise if that is larger, so that every channel counts alike.

Source: windows restarted from measured states, Ljung, System Identification (1999); intervals, see `intervals`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import channel
from slipwise.comparison.measured_replay import SystemRun, replay_models
from slipwise.comparison.system_level import replayed_model
from slipwise.errors import InputError, SettingError, unknown_name
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import BLOCK, Interval, of_fit
from slipwise.model import Model
from slipwise.regression.least_squares import Bounds, Move, gauss_newton, shortened_step
from slipwise.relations.parameters import Free, fitted_model

Array = NDArray[np.float64]
#: Numbers of the rig that a replay has; all others belong to the measurement, or to the springs that are fitted apart.
_REPLAYED = ("rig.mass", "rig.centre_height", "rig.buffer_stiffness", "rig.shear_strength")
#: Difference over a number's scale: large enough that reversals move by more than a step's chance.
_STEP = 0.02
#: A step is tried in full and in these parts.
_PARTS = (1.0, 0.5, 0.2)
#: A channel on which nothing happens is spread by this share of the largest of its unit, not by its own chance [1].
_LEAST = 0.01
#: A round that lowers the squared error by less than this share is the last [1].
_ENOUGH = 1e-3


@dataclass(frozen=True)
class Refined:
    """What a refinement found.

    Attributes:
        model: as the replay has it, with the refined numbers.
        entries: of every number that was refined: value, 95 % interval, and where it began.
        before: root of the mean squared error in units of the channels' spread, of the runs that may be fitted [1].
        after: the same with the refined numbers.
        held_out: both on runs that were not fitted; None where there are none.
        rounds: of slopes that were taken.
    """

    model: Model
    entries: tuple[Interval, ...]
    before: float
    after: float
    held_out: tuple[float, float] | None
    rounds: int


@dataclass(frozen=True)
class _Point:
    values: Array
    answer: list[SystemRun]
    residual: Array


def refine(base: BaseFit, keys: Sequence[str], *, rounds: int = 12, threads: int = 2) -> Refined:
    """Refine numbers of a component-level fit against the replay.

    Args:
        base: the fit; a hypothesis is made one by `diagnose.run.as_fit`.
        keys: which of its numbers, e.g. "run_in.rise", "rig.buffer_stiffness"; the others stay.
        rounds: of slopes at most.
        threads: to step on.

    Raises:
        InputError: a channel that a replay needs was not recorded, or the rig does not slide by itself.
        SettingError: no key, or a number that a replay does not have.
        UnknownNameError: no such number.
    """
    free = _chosen(base, keys)
    if not base.model.specimen.free:
        raise InputError(
            f"rig {base.model.specimen.name!r} has its slip prescribed, so there is nothing to replay; its component "
            "level fit is all that can be known"
        )
    replayed, _ = replayed_model(base)
    fitted, held = base.objective.fitted, base.objective.held_out
    bounds = Bounds(*(np.array([getattr(f, end) for f in free]) for end in ("low", "high", "scale")))
    first = np.array([base.solution.values[f.key] for f in free])
    begun = _replay(base, [_model(base, replayed, free, first)], threads)[0]
    spread = _spread(base, begun)

    def evaluate(tried: Sequence[Array]) -> list[tuple[_Point, Array]]:
        answers = _replay(base, [_model(base, replayed, free, v) for v in tried], threads)
        points = [_Point(v, a, _left(base, a, fitted, spread)) for v, a in zip(tried, answers, strict=True)]
        return [(point, point.residual) for point in points]

    def linearise(point: _Point) -> Array:
        nonlocal done
        done += 1
        steps = _STEP * bounds.scale * np.where(point.values + _STEP * bounds.scale <= bounds.high, 1.0, -1.0)
        moved = evaluate([point.values + step for step in np.diag(steps)])
        columns = [
            (r - point.residual) * (s / step) for (_, r), s, step in zip(moved, bounds.scale, steps, strict=True)
        ]
        return np.stack(columns, axis=1)

    def move(point: _Point, slopes: Array) -> Move[_Point]:
        end, gained = shortened_step(bounds, point.values, point.residual, slopes, evaluate, _PARTS)
        left = float(end.residual @ end.residual)
        return Move(end, finished=gained < _ENOUGH * left) if gained > 0.0 else Move(None)

    done = 0
    end, slopes = gauss_newton(_Point(first, begun, _left(base, begun, fitted, spread)), linearise, move, most=rounds)
    now, values = end.answer, {f.key: float(v) for f, v in zip(free, end.values, strict=True)}
    left = end.residual
    found = of_fit(free, values, slopes, left, _blocks(now, fitted))

    def error(answer: Sequence[SystemRun], which: Sequence[int]) -> float:
        squared = _left(base, answer, which, spread) ** 2
        return float(np.sqrt(np.sum(squared) / max(np.count_nonzero(squared), 1)))

    return Refined(
        _model(base, replayed, free, end.values), found.entries, error(begun, fitted), error(now, fitted),
        (error(begun, held), error(now, held)) if held else None, done,
    )  # fmt: skip


def _chosen(base: BaseFit, keys: Sequence[str]) -> list[Free]:
    known = {f.key: f for f in base.free}
    if not keys:
        raise SettingError(f"nothing to refine; possible: {', '.join(_possible(known))}")
    for key in keys:
        if key not in known:
            raise unknown_name("fitted number", key, _possible(known))
        if key not in _possible(known):
            raise SettingError(
                f"{key} belongs to the measurement, not to the rig that is replayed; possible: "
                f"{', '.join(_possible(known))}"
            )
    return [replace(known[key], start=base.solution.values[key]) for key in dict.fromkeys(keys)]


def _possible(known: Mapping[str, Free]) -> list[str]:
    return [key for key in known if key in _REPLAYED or not key.startswith("rig.")]


def _model(base: BaseFit, replayed: Model, free: Sequence[Free], numbers: Array) -> Model:
    """Return the replayed model with other numbers; its springs, inertia and stick stay as they were found."""
    values = {f.key: float(v) for f, v in zip(free, numbers, strict=True)}
    model = fitted_model(base.objective.specimen, base.objective.terms, {**base.solution.values, **values})
    kept = replayed.specimen
    specimen = model.specimen.changed(
        pad_stiffness=kept.pad_stiffness, pad_damping=kept.pad_damping, inertia=kept.inertia
    )
    return Model(specimen, (*model.uses, *replayed.uses[len(model.uses) :]))


def _replay(base: BaseFit, models: Sequence[Model], threads: int) -> list[list[SystemRun]]:
    """Replay all runs with all models; also those that are not fitted, for what pads remember goes on through them."""
    return replay_models(models, [(r.name, r.states, r.rest_before) for r in base.objective.runs], threads=threads)


def _judged(
    base: BaseFit, answer: Sequence[SystemRun], which: Sequence[int]
) -> list[tuple[str, Array, NDArray[np.bool_]]]:
    """Return channel, simulated minus measured (n,), and which samples count (n,), of every channel of these runs."""
    out = []
    for i in which:
        usable = base.objective.run(i).states.usable
        for name, simulated in answer[i].simulated.items():
            out.append((name, simulated - answer[i].measured[name], usable & np.isfinite(simulated)))
    return out


def _spread(base: BaseFit, answer: Sequence[SystemRun]) -> dict[str, float]:
    errors: dict[str, list[Array]] = {}
    for name, difference, here in _judged(base, answer, base.objective.fitted):
        errors.setdefault(name, []).append(difference[here])
    size: dict[str, float] = {}
    for i in base.objective.fitted:
        for name, values in answer[i].measured.items():
            unit = channel(name).unit
            size[unit] = max(size.get(unit, 0.0), float(np.std(values)))
    noise = {n: max(r.noise.get(n, 0.0) for r in base.objective.runs) for n in errors}
    rms = {n: float(np.sqrt(np.mean(np.concatenate(e) ** 2))) for n, e in errors.items()}
    return {n: max(noise[n], rms[n], _LEAST * size[channel(n).unit]) for n in errors}


def _left(base: BaseFit, answer: Sequence[SystemRun], which: Sequence[int], spread: Mapping[str, float]) -> Array:
    judged = _judged(base, answer, which)
    return np.concatenate([np.where(here, difference / spread[name], 0.0) for name, difference, here in judged])


def _blocks(answer: Sequence[SystemRun], which: Sequence[int]) -> NDArray[np.int64]:
    """Number the stretches of time that count as independent: all channels of half a second of a run."""
    parts: list[NDArray[np.int64]] = []
    first = 0
    for i in which:
        of_sample = ((answer[i].time - answer[i].time[0]) / BLOCK).astype(np.int64) + first
        parts += [of_sample] * len(answer[i].simulated)
        first = int(of_sample[-1]) + 1
    return np.concatenate(parts)
