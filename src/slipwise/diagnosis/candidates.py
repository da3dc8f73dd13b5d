"""What may be missing: every effect of the catalogue that this campaign could show, instruments on equal terms."""

from collections.abc import Iterable, Iterator

import numpy as np

from slipwise.effects import Effect, catalogue
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.parameters import Term
from slipwise.estimation.problem import Problem

#: Part of the base fit, never missing by themselves.
BASE_PARTS: frozenset[str] = frozenset({"pad_compliance"})
#: Faults of samples rather than of signals: found by looking at the samples, see `samples.py`.
SAMPLE_FAULTS: frozenset[str] = frozenset({"channel_sign", "channel_clipping", "dropped_samples"})
#: One thing to a rig that measures neither yaw nor pitch: one acts at the buffers, the other on the whole girder.
ONE_THING: tuple[frozenset[str], ...] = (frozenset({"buffer_damping", "guide_drag"}),)
#: Laws of the table's command: the fit is driven by the motion that was measured.
_COMMAND: dict[str, str] = {
    "table_gain": "the model is driven by the measured table motion; only the command could show it",
    "table_cross_axis": "the model is driven by the measured table motion; only the command could show it",
}
#: Why these are not looked for where the slip is prescribed, see `samples.py`.
_OF_A_SLIDER: dict[str, str] = {
    "channel_sign": "one slider has no balance that says which way a gauge is wired",
    "channel_clipping": "an actuator may rest at its ends, which looks like a rail",
    "dropped_samples": "an actuator may rest, and samples then repeat by themselves",
}

#: Loads are steady in each run when they differ between runs by this many times more than within one [1].
_STEADY = 3.0
#: A load that changes by less never changes [1].
_STEADY_LOAD = 0.005
#: Speeds of runs that differ by less count as the same [1].
_SAME_SPEED = 0.15

_EVEN = ("slide_tilt", "slide_curvature", "direction_asymmetry", "channel_offset", "load_crosstalk")


def candidates(base: BaseFit, own: Iterable[Effect] = ()) -> tuple[list[Term], dict[str, str]]:
    """Give the candidates, and the effects that this campaign cannot test with the reason.

    Args:
        base: the base fit.
        own: effects beside those of the catalogue.
    """
    problem, model = base.problem, base.model
    terms: list[Term] = []
    cannot: dict[str, str] = {}
    for name, effect in (catalogue() | {e.name: e for e in own}).items():
        if name in BASE_PARTS or (name in model and not effect.target):
            continue
        if name in SAMPLE_FAULTS:
            if not problem.specimen.free:
                cannot[name] = _OF_A_SLIDER[name]
            continue
        reason = _COMMAND.get(name) or _untestable(effect, problem)
        if reason:
            cannot[name] = reason
            continue
        if effect.replaces:
            if all(u.effect.replaces != effect.replaces for u in model.uses):
                terms.append(Term(effect))
        elif effect.target:
            aimed = list(_aimed(effect, problem))
            terms += aimed
            if not aimed:
                cannot[name] = "no gauge was recorded on which it would show"
        else:
            terms.append(Term(effect))
    return terms, cannot | _confounded(problem)


def parts_twins(problem: Problem) -> bool:
    """Tell whether a campaign measured what parts the effects of `ONE_THING`: yaw, or the girder's pitch."""
    return problem.runs[0].states.has_yaw or "pitch" in problem.relations


def _confounded(problem: Problem) -> dict[str, str]:
    """Say where a run of one load was also a run of one speed, so that what looks like one may be the other."""
    runs = [r for r in problem.runs if r.sliding.any()]
    loads = np.array([float(np.mean(r.load[r.sliding])) for r in runs])
    within = np.array([float(np.std(r.load[r.sliding])) for r in runs])
    speeds = np.array([float(np.sqrt(np.mean(r.velocity[r.sliding] ** 2))) for r in runs])
    steady = len(runs) > 1 and float(np.ptp(loads)) > _STEADY * float(within.max())
    if not steady or speeds.max() < (1.0 + _SAME_SPEED) * speeds.min():
        return {}
    span = f"{speeds.min():.3g} to {speeds.max():.3g} m/s"
    reason = f"load changes only from run to run, and speed differs between these runs too ({span})"
    return {"load against speed": reason}


def _untestable(effect: Effect, problem: Problem) -> str:
    relations, run = problem.relations, problem.runs[0]
    specimen = problem.specimen
    if effect.component == "buffer" and (not specimen.buffer_stiffness or not {"girder", "pitch"} & set(relations)):
        return "no buffers, or neither girder_ax nor all pads' loads and friction to see them by"
    if effect.component in ("girder", "table", "pad load") and not problem.balanced:
        return "needs the balances of a girder: load and friction of all four pads, and accelerations"
    if effect.name in ("girder_bending", "key_friction") and "heave" not in relations:
        return "needs girder_az and the loads of four pads"
    if effect.name == "anisotropy" and "across" not in relations:
        return "needs motion across, and friction of the pads along y"
    if effect.name == "pad_spread" and len(run.pads) < 2:
        return "one slider only"
    if effect.name in _EVEN and _one_way(problem):
        return "the slider moves one way only, so what is even in velocity is one with friction"
    if effect.name in ("slide_tilt", "slide_curvature", "load_crosstalk", "pressure_law") and not _load_varies(problem):
        return "the load never changes, so this is one with an offset, an asymmetry or the base law"
    return ""


def _one_way(problem: Problem) -> bool:
    forth = [float(np.mean(r.velocity[r.sliding] > 0.0)) for r in problem.runs if r.sliding.any()]
    return bool(forth) and all(min(f, 1.0 - f) < 0.05 for f in forth)


def _load_varies(problem: Problem) -> bool:
    """Tell whether the load changes within a run that is fitted, or from one of them to another."""
    loads = [problem.runs[i].load for i in problem.fitted]
    means = np.array([float(np.mean(load)) for load in loads])
    within = any(float(np.std(load)) > _STEADY_LOAD * mean for load, mean in zip(loads, means, strict=True))
    return within or float(np.ptp(means)) > _STEADY_LOAD * float(means.max())


def groups(problem: Problem) -> dict[str, tuple[str, ...]]:
    """Give the channels on which one fault may act together: a whole card, or one gauge."""
    run = problem.runs[0]
    out: dict[str, tuple[str, ...]] = {}
    for kind in ("Fx", "N"):
        names = tuple(f"pad_{p}_{kind}" for p in run.pads if f"pad_{p}_{kind}" in run.record)
        if len(names) > 1:
            out[f"pad_*_{kind}"] = names
        out.update({n: (n,) for n in names})
    singles = ("slip_x", "girder_ax", "girder_az", "table_ax")
    out.update({n: (n,) for n in singles if n in run.record})
    return out


def _aimed(effect: Effect, problem: Problem) -> Iterator[Term]:
    """Give a gauge's fault on every channel or card on which it means something."""
    free = problem.balanced
    for group, targets in groups(problem).items():
        cell = group.startswith("pad_")
        if effect.name == "load_crosstalk":
            crossing = [f"pad_{t[4]}_{'N' if t.endswith('Fx') else 'Fx'}" for t in targets] if cell else []
            if cell and problem.runs[0].record.has_all(*crossing) and (free or group.endswith("Fx")):
                yield Term(effect, targets, group)
        elif effect.name == "cell_inertia":
            if group in ("pad_*_N", "pad_A_N") and len(targets) == len(problem.runs[0].pads):
                yield Term(effect, targets, "pad_*")
        elif effect.name in ("channel_offset", "channel_drift") and len(targets) > 1:
            continue  # the zeros of several gauges do not move alike
        elif effect.name == "clock_skew" and len(targets) == 1 and group.startswith("pad_"):
            continue  # a clock belongs to a card
        elif free or cell or group == "slip_x":
            if effect.name == "channel_gain" and not free:
                continue  # a gain of one slider's gauges is its friction
            yield Term(effect, targets, group)
