"""What may be missing: every effect of the catalogue that this campaign could show, instruments on equal terms."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from fnmatch import fnmatchcase
from itertools import combinations

import numpy as np

from slipwise.effects import FRICTION_PORTS, Effect, catalogue, for_pads, scaled, scaled_to_gauge
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.objective import Objective
from slipwise.preparation.gauge_groups import find_places_of_gauges
from slipwise.relations.parameters import Term
from slipwise.rig.load_basis import WARPS, has_corners
from slipwise.selection.initial_grid import is_lag

#: Loads are steady in each run when they differ between runs by this many times more than within one [1].
_STEADY = 3.0
#: A load that changes by less never changes [1].
_STEADY_LOAD = 0.005
#: Channels beside the pads' that the relations of a fit look at: what lies across, and the table's vertical motion, are
#: held against others by the audit alone.
_LOOKED_AT = ("slip_x", "girder_ax", "girder_az", "table_ax")
#: Why effects of friction are no candidates where there is none.
NOTHING_SLIDES = 'the pads do not slide: the specimen says friction = "none"'
#: A direction in which a smaller share of the sliding goes is not tried [1].
_RARELY = 0.05
#: Speeds of runs that differ by less count as the same [1].
_SAME_SPEED = 0.15


def list_candidates(base: BaseFit, own: Iterable[Effect] = ()) -> tuple[list[Term], dict[str, str]]:
    """Return the candidates, and the effects that this campaign cannot test with the reason.

    Args:
        base: the base fit.
        own: effects beside those of the catalogue.
    """
    objective, model = base.objective, base.model
    terms: list[Term] = []
    cannot: dict[str, str] = {}
    scales = objective.scales
    for name, as_rated in (catalogue() | {e.name: e for e in own}).items():
        effect = scaled(as_rated, scales.of, scales.room)
        effect = for_pads(effect, objective.specimen.pads, corners=has_corners(objective.specimen))
        if effect.base == "springs" or (name in model and not effect.target):
            continue
        if effect.in_samples:
            if not objective.specimen.free:
                cannot[name] = effect.in_samples
            continue
        reason = _untestable(effect, objective)
        if reason:
            cannot[name] = reason
            continue
        if effect.replaces:
            if all(u.effect.replaces != effect.replaces for u in model.uses):
                terms.append(Term(effect))
        elif effect.target:
            aimed = list(_aimed(effect, objective))
            terms += aimed
            if not aimed:
                cannot[name] = _unaimed(effect, objective)
        else:
            terms.append(Term(effect))
            terms += _on_single_pads(effect, objective)
    return terms, cannot | _confounded(objective)


def _confounded(objective: Objective) -> dict[str, str]:
    """Say where no two fitted runs of unlike load have like speeds, so that what looks like one may be the other."""
    runs = [r for r in objective.fitted_runs if r.sliding.any()]
    loads = np.array([float(np.mean(r.load[r.sliding])) for r in runs])
    within = np.array([float(np.std(r.load[r.sliding])) for r in runs])
    speeds = np.array([float(np.sqrt(np.mean(r.velocity[r.sliding] ** 2))) for r in runs])
    apart = _STEADY * float(within.max(initial=0.0))
    unlike = [(i, j) for i, j in combinations(range(len(runs)), 2) if abs(loads[i] - loads[j]) > apart]
    if not unlike or any(_alike(speeds[i], speeds[j]) for i, j in unlike):
        return {}
    span = f"{speeds.min():.3g} to {speeds.max():.3g} m/s"
    reason = f"load changes only from run to run, and speed differs between these runs too ({span})"
    return {"load against speed": reason}


def _alike(one: float, other: float) -> bool:
    return max(one, other) < (1.0 + _SAME_SPEED) * min(one, other)


def _untestable(effect: Effect, objective: Objective) -> str:
    """Say what an effect needs first that this campaign has not; "" where it can be tested."""
    if effect.port in FRICTION_PORTS and not objective.specimen.slides:
        return NOTHING_SLIDES
    return next((effect.without(need) for need in effect.all_needs if not HAS[need](objective)), "")


def _sees_buffers(objective: Objective) -> bool:
    return bool(objective.specimen.buffer_stiffness) and not {"girder", "pitch"}.isdisjoint(objective.relations)


def _one_way(objective: Objective) -> bool:
    """Return whether all runs that are fitted slide the same way: one there and one back are both directions."""
    forth = np.concatenate([r.velocity[r.sliding] > 0.0 for r in objective.fitted_runs])
    return bool(forth.size) and min(float(np.mean(forth)), 1.0 - float(np.mean(forth))) < _RARELY


def _load_varies(objective: Objective) -> bool:
    """Return whether the load changes within a run that is fitted, or from one of them to another.

    Where only what all pads carry together is known, rocking changes nothing: it is the sum of the loads that counts.
    """
    loads = [run.load if objective.forces_measured else run.load.sum(axis=1) for run in objective.fitted_runs]
    means = np.array([float(np.mean(load)) for load in loads])
    within = any(float(np.std(load)) > _STEADY_LOAD * mean for load, mean in zip(loads, means, strict=True))
    return within or float(np.ptp(means)) > _STEADY_LOAD * float(means.max())


#: What effects need -> whether a campaign has it.
HAS: dict[str, Callable[[Objective], bool]] = {
    "command": lambda objective: False,  # every fit is driven by the motion that was measured
    "buffers": _sees_buffers,
    "balances": lambda objective: objective.balanced,
    "heave": lambda objective: "heave" in objective.relations,
    "across": lambda objective: not {"across", "girder_y"}.isdisjoint(objective.relations),
    "prescribed slip": lambda objective: not objective.specimen.free,
    "storeys": lambda objective: "storeys" in objective.relations,
    "loads": lambda objective: objective.loads_measured,
    "several pads": lambda objective: len(objective.pads) > 1 and objective.forces_measured,
    "both directions": lambda objective: not _one_way(objective),
    "changing load": _load_varies,
}


def _aimed(effect: Effect, objective: Objective) -> Iterator[Term]:
    """Yield a gauge's fault on every channel or card on which it means something to the relations of a fit.

    One slider's gauges have spans as its record asks for: their faults in spans go with its scales.
    """
    places = find_places_of_gauges(effect, objective.run(0).record)
    for place in sorted(places, key=lambda name: "*" not in name):
        targets = places[place]
        if any(name not in _LOOKED_AT and not name.startswith("pad_") or name.endswith("_Fy") for name in targets):
            continue
        if effect.gauges.sits == "pads":
            if len(targets) == len(objective.pads):
                yield Term(effect, targets, "pad_*")
        elif objective.balanced or ((place.startswith("pad_") or place == "slip_x") and _alone(effect, targets)):
            slider = not objective.specimen.free
            own = scaled_to_gauge(effect, targets[0], objective.scales.of) if slider else effect
            if slider and is_lag(own) and place.endswith("_N") and not _load_varies(objective):
                continue  # a lag of what never changes moves noise only
            yield Term(own, targets, place)


def _unaimed(effect: Effect, objective: Objective) -> str:
    """Say why a gauge's fault is looked for on none: none that it could sit on, or none beside the law of friction."""
    if any(place.startswith(("pad_", "slip")) for place in find_places_of_gauges(effect, objective.run(0).record)):
        return "without a girder's balances it is one with the numbers of the friction law"
    return "no gauge was recorded on which it would show"


def _on_single_pads(effect: Effect, objective: Objective) -> Iterator[Term]:
    """Yield an effect on each pad alone, where loads tell which: those of three or four pads warp one way or not."""
    if effect.single and WARPS[1] in objective.relations:
        for pad in objective.specimen.pads:
            yield Term(effect, (f"pad_{pad}_N",), f"pad_{pad}_N")


def _alone(effect: Effect, targets: Iterable[str]) -> bool:
    """Return whether a fault shows without the balances of a girder: a gain of one slider's gauges is its friction."""
    return not any(fnmatchcase(t, pattern) for t in targets for pattern in effect.gauges.balance_only)


def at_odds(a: Term, b: Term) -> bool:
    """Return whether two terms exclude each other: two sticks, two laws in one place, or one on a channel twice."""
    if a.effect.replaces and a.effect.replaces == b.effect.replaces:
        return True
    if a.effect.reverses and b.effect.reverses and ("stick" in a.effect.hooks or "stick" in b.effect.hooks):
        return True
    return a.effect.name == b.effect.name and bool(set(a.targets) & set(b.targets))


def list_exclusions(terms: Sequence[Term]) -> set[tuple[str, str]]:
    """Return the labels of every two terms that cannot be in one hypothesis, in both orders."""
    return {(a.label, b.label) for a in terms for b in terms if a is not b and at_odds(a, b)}
