"""What a campaign cannot tell beside the effects that it cannot test: found in its runs, and in what was tried."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Run
from slipwise.channels import part_of
from slipwise.diagnosis.held_out_regime import find_untestable_reason
from slipwise.diagnosis.identifiability import list_unidentified
from slipwise.diagnosis.indistinguishable import list_known_effects
from slipwise.effects import FRICTION_PORTS, Effect
from slipwise.errors import SlipwiseError
from slipwise.estimation.base_fit import BaseFit
from slipwise.preparation.sample_fault import SampleFault
from slipwise.regression.projection import make_projector
from slipwise.relations.parameters import ZERO, Term
from slipwise.relations.sample_masks import is_rolling_only_at_rest
from slipwise.relations.untold_forces import list_untold_forces
from slipwise.rig.frame import storey_channels
from slipwise.rig.load_basis import buffers_off_centre
from slipwise.rig.rocking import coupled
from slipwise.selection.averaged_rows import AveragedRows, make_averaged_rows
from slipwise.selection.explained_alone import list_least_sizes
from slipwise.selection.initial_grid import shapes, strengths
from slipwise.selection.search_state import Search
from slipwise.selection.sensitivities import compute_change, compute_stacked_with, small
from slipwise.units import convert

#: Two effects look alike when their columns agree so well: one run gives 0.95, two after a long rest 0.8 at most [1].
_ALIKE = 0.85
#: A model that leaves less than this share of a floor shows that the floor is too high [1].
_CREDIBLE = 0.9
#: Springs whose middle lies off the centre by more than this share of the pads' half spacing turn the girder [1].
_OFF = 0.02
#: Faults of samples of which nothing is left that could be judged.
_SHOW_NOTHING = ("dead", "wild")
#: Runs that are named one by one.
_NAMED = 3
#: A column of which the base leaves a smaller share does what the base does [1].
_NOTHING_LEFT = 3e-5
#: What a buffer does counts as done by the friction of the pads where that leaves a smaller share of it [1].
_LIKE_FRICTION = 0.1
#: A shorter column counts as no response: noise alone is as long as the root of the number of samples [1].
_MIN_COLUMN_LENGTH = 0.1


def list_limitations(state: Search, final: BaseFit, faults: Sequence[SampleFault] = ()) -> list[tuple[str, str]]:
    """Return what this campaign cannot tell, each with the reason; effects that it cannot test are in `state.cannot`.

    Args:
        state: of the search.
        final: its best hypothesis as a fit.
        faults: of samples, found before any fit.
    """
    rows = make_averaged_rows(state.base.objective)
    project = make_projector(rows.average(state.base.solution.jacobian))
    lost = _balances_not_judged(state, faults)
    return [
        *list_unidentified(final, state.base),
        *list_untold_forces(state.base.objective.measurements),
        *_friction_or_buffers(state, rows, project),
        *list_hidden_in_the_sum(state).items(),
        *_alike(state, rows, project),
        *_rests_not_given(state),
        *_zero_not_shown(state, final),
        *_nothing_held_out(state),
        *_storeys_not_measured(state.base),
        *_turning_not_measured(state.base),
        *_friction_across_not_measured(state.base),
        *_beyond_what_was_fitted(state.base),
        *_floors_not_credible(state),
        *_gauges_not_tried(state),
        *([("balances", lost)] if lost else []),
        *_without_response(state, rows, project, lost),
    ]


def _alike(state: Search, rows: AveragedRows, project: Callable[[Array], Array]) -> Iterator[tuple[str, str]]:
    """Find pairs of which one fades in a pause and the other does not, and which look alike in these runs."""
    base = state.base
    effects = {t.effect.name: t.effect for t in state.terms if t.effect.memory and not t.effect.target}
    pairs = [(a, b) for a in effects.values() for b in effects.values() if _distinguished_by_a_rest(a, b)]
    for fading, lasting in pairs:
        one, other = (_traces(base, effect, rows, project) for effect in (fading, lasting))
        likeness = max((abs(float(a @ b)) for a in one for b in other), default=0.0)
        if likeness > _ALIKE:
            message = f"what they do in these runs is {likeness:.0%} alike"
            reason = ", and ".join([*_lacking(base.campaign.runs), message])
            apart = fading.confused_with[lasting.name]
            yield f"{fading.name} against {lasting.name}", f"{reason}; what tells them apart: {apart}"


def _friction_or_buffers(
    state: Search, rows: AveragedRows, project: Callable[[Array], Array]
) -> Iterator[tuple[str, str]]:
    """Find what buffers may do that the law of friction does as well, where no force tells pads from buffers."""
    base = state.base
    if base.objective.forces_measured or not base.objective.specimen.slides:
        return
    for term in (t for t in state.terms if t.effect.port == "buffer" and not t.effect.target):
        columns = [c for c in _columns(base, term, rows) if c is not None and _length(c) > _MIN_COLUMN_LENGTH]
        left = [_length(project(c)) / _length(c) for c in columns]
        if left and max(left) < _LIKE_FRICTION:
            share = 1.0 - max(left) ** 2
            yield (
                f"{term.effect.name} against the friction of the pads",
                f"no pad's friction was measured, and the law's own numbers do {share:.1%} of what it does here; loads "
                "that vary by vertical motion, other speeds, or pad_*_Fx tell them apart",
            )


def list_hidden_in_the_sum(state: Search) -> dict[str, str]:
    """Return the laws of friction that show in single pads and hardly in what all of them carry together -> why."""
    base = state.base
    if base.objective.forces_measured or not base.objective.specimen.slides:
        return {}
    hidden: dict[str, str] = {}
    laws = {t.effect.name: t.effect for t in state.terms if t.effect.port in FRICTION_PORTS}
    for name, (size, unit) in list_least_sizes(state.alone).items():
        strengths = (
            [p for p in laws[name].parameters if p.neutral is not None and p.unit == unit] if name in laws else []
        )
        usual = max((abs(p.typical - (p.neutral or 0.0)) for p in strengths), default=np.inf)
        if size > usual:
            p = strengths[0]
            shown = [
                f"{convert(x, unit, p.shown_in or unit):.2g} {p.shown_in or unit}".removesuffix(" 1")
                for x in (size, usual)
            ]
            reason = f"no pad's friction was measured, and in that of all together it shows from {shown[0]} on"
            hidden[name] = f"{reason}; its usual size is {shown[1]}"
    return hidden


def _beyond_what_was_fitted(base: BaseFit) -> Iterator[tuple[str, str]]:
    for place, reason in find_untestable_reason(base.objective).items():
        yield f"held-out run {base.objective.run(place).name}", f"not testable here, no fitted run covers it: {reason}"


def _storeys_not_measured(base: BaseFit) -> Iterator[tuple[str, str]]:
    """Name the accelerations without which nobody knows what the storeys push."""
    needed = storey_channels(base.campaign.specimen.storeys)
    if absent := [n for n in needed if not all(n in run.record for run in base.campaign.runs)]:
        reason = f"{', '.join(absent)} not measured: the storeys push the girder unknown, so these are left out"
        yield "girder and pitch balance", reason


def _turning_not_measured(base: BaseFit) -> Iterator[tuple[str, str]]:
    """Name the motion that springs off the middle bring with them and that no gauge shows."""
    rig = base.campaign.specimen
    along, across = buffers_off_centre(rig) if rig.free else (0.0, 0.0)
    off = (f"the buffers' middle lies {size:.2g} m off the centre of gravity" for size in (across, along))
    for name, size, half, words in zip(("yaw", "slip_y"), (across, along), rig.half_spacing[::-1], off, strict=True):
        if abs(size) > _OFF * half and not all(name in run.record for run in base.campaign.runs):
            moves = "turns" if name == "yaw" else "moves across"
            yield name, f"not measured, but {words}, so the girder {moves}: what is left may be that"


def _friction_across_not_measured(base: BaseFit) -> Iterator[tuple[str, str]]:
    """Say that roll is judged at rest only where the girder rolls with its pitch or moves across."""
    objective, specimen = base.objective, base.campaign.specimen
    if not objective.balanced or not is_rolling_only_at_rest(objective.run(0).states.has_y, specimen):
        return
    why = "pads that stand unevenly turn pitch into roll" if coupled(specimen) else "it moves across"
    judged = "judged before the motion only" if "roll" in base.objective.relations else "not judged"
    yield "roll balance", f"{why}, and what turns the girder then is not all measured: it is {judged}"


def _balances_not_judged(state: Search, faults: Sequence[SampleFault]) -> str:
    """Say which balances no fitted run shows for lack of channels that show nothing; "" where there are none."""
    dead = dict.fromkeys(name for fault in faults if fault.kind in _SHOW_NOTHING for name in fault.channels)
    left, fitted = state.base.solution.residuals, state.base.objective.fitted
    lost = [relation for relation in left.relations if not left.count(relation, fitted)]
    if not dead or not lost:
        return ""
    return f"{', '.join(dead)} shows nothing, and without it no fitted run shows the balance of {', '.join(lost)}"


def _floors_not_credible(state: Search) -> Iterator[tuple[str, str]]:
    """Find balances of which a model leaves less than their noise: it was taken for larger than it is."""
    final = state.final.summary
    for relation in final.fitted:
        left = float(np.sqrt(final.fitted_level(relation)))
        if final.counts[relation][0] and left < _CREDIBLE:  # what no sample judges leaves nothing, and says nothing
            yield f"floor of {relation}", f"floor not credible: the model leaves {left:.2f} of it on the fitted runs"


def _zero_not_shown(state: Search, fit: BaseFit) -> Iterator[tuple[str, str]]:
    for zero in (f for f in fit.solution.free if f.key == ZERO):
        reason = f"no record of a slider shows its gauge's zero, and up to {zero.high:.2g} N is taken for one"
        yield ", ".join(name for name, e in list_known_effects(state).items() if ZERO in e.stands_for), reason


def _distinguished_by_a_rest(fading: Effect, lasting: Effect) -> bool:
    confused = lasting.name in fading.confused_with and fading.name in lasting.confused_with
    return confused and "rest" in fading.hooks and "rest" not in lasting.hooks


def _traces(base: BaseFit, effect: Effect, rows: AveragedRows, project: Callable[[Array], Array]) -> list[Array]:
    """Return what an effect with a response does beside the base, of unit length, for a grid of its constants."""
    columns = [c for c in _columns(base, Term(effect), rows) if c is not None and _length(c) > _MIN_COLUMN_LENGTH]
    clean = [(project(c), _length(c)) for c in columns]
    return [c / _length(c) for c, whole in clean if _length(c) > _NOTHING_LEFT * whole]


def _columns(base: BaseFit, term: Term, rows: AveragedRows) -> list[Array | None]:
    """Return the averaged columns of a candidate near its typical size, for a grid of its constants."""
    off = compute_stacked_with(base, term, term.effect.neutral())
    points = [(p, small(term.effect, shape, p)) for shape in shapes(term.effect) for p in strengths(term.effect)]
    if off is None:
        return [None] * len(points)
    changes = (compute_change(lambda v: compute_stacked_with(base, term, v), term, p, v, off) for p, v in points)
    return [None if change is None else rows.average(change) for change in changes]


def _length(column: Array) -> float:
    return float(np.linalg.norm(column))


def _lacking(runs: Sequence[Run]) -> list[str]:
    """Say which kind of run is lacking to tell what fades in a pause from what lasts."""
    out = [] if any(r.role == "repeat" for r in runs) else ["no run has the role repeat"]
    return out if len(runs) == 1 or any(r.rest_before for r in runs[1:]) else [*out, "no rest between runs is given"]


def _rests_not_given(state: Search) -> Iterator[tuple[str, str]]:
    runs = state.base.campaign.runs
    unknown = [b.name for a, b in pairwise(runs) if b.rest_before is None and not _goes_on(a, b)]
    fading = {t.effect.name for t in (*state.base.objective.terms, *state.terms) if "rest" in t.effect.hooks}
    if unknown and fading:
        more = f" and {len(unknown) - _NAMED} more" if len(unknown) > _NAMED else ""
        named = f"{', '.join(unknown[:_NAMED])}{more}"
        yield ", ".join(sorted(fading)), f"the rest before {named} is not given and was taken as none"


def _goes_on(before: Run, after: Run) -> bool:
    """Return whether a run begins where the one before ends, in one file: then there was no rest."""
    if before.sha256 != after.sha256 or before.window is None or after.window is None:
        return False
    return abs(after.window[0] - before.window[1]) < 2.0 * after.record.dt


def _nothing_held_out(state: Search) -> Iterator[tuple[str, str]]:
    if not state.path[0].summary.judged_apart:
        yield (
            "verdict",
            "no run outside the fit can be judged, so what was found rests on the runs that were fitted",
        )


def _gauges_not_tried(state: Search) -> Iterator[tuple[str, str]]:
    """Name the channels that were recorded and on which no fault was a candidate; "_raw" ones only serve others."""
    terms = (*state.base.objective.terms, *state.terms)
    tried = {target for t in terms if t.effect.port == "gauge" for target in t.targets}
    recorded = dict.fromkeys(c for r in state.base.campaign.runs for c in r.record.channels)
    alike: dict[str, list[str]] = {}
    for c in recorded:
        if c not in tried and not c.endswith("_raw"):
            kind, place = part_of(c)
            alike.setdefault(c.replace(f"{kind}_{place}_", f"{kind}_*_", 1) if place else c, []).append(c)
    if alike:
        named = ", ".join(together if len(own) > 1 else own[0] for together, own in alike.items())
        but = ", but for rails and lost samples" if state.base.objective.specimen.free else ""
        yield f"faults of {named}", f"never tried{but}"


def _without_response(
    state: Search, rows: AveragedRows, project: Callable[[Array], Array], lost: str
) -> Iterator[tuple[str, str]]:
    """Say why nothing came of the candidates that change nothing here beside the base; a wrong sign is no reason.

    What changes nothing that was measured may show in balances that were lost, as `_balances_not_judged` says.
    """
    with_response = {s.term.effect.name for s in state.alone}
    reasons: dict[str, set[str]] = {}
    for term in (t for t in state.terms if t.effect.name not in with_response):
        reasons.setdefault(term.effect.name, set()).add(_reason(state.base, term, rows, project, lost))
    for name, found in reasons.items():
        if "" not in found:
            yield name, "; ".join(sorted(found))


def _reason(base: BaseFit, term: Term, rows: AveragedRows, project: Callable[[Array], Array], lost: str) -> str:
    """Say why a candidate could not be tested; "" where it could, and explained nothing."""
    columns = _columns(base, term, rows)
    with_response = [c for c in columns if c is not None and _length(c) > _MIN_COLUMN_LENGTH]
    if not columns or all(c is None for c in columns):
        return _failure(base, term)
    if not with_response:
        nothing = "at its usual size it changes nothing that was measured"
        return f"{nothing}; {lost}" if lost else nothing
    if all(_length(project(c)) < _NOTHING_LEFT * _length(c) for c in with_response):
        return "the base's own numbers do all that it does here"
    return ""


def _failure(base: BaseFit, term: Term) -> str:
    """Say what keeps a candidate from being evaluated at its typical size; "" where nothing does."""
    keyed = {f"{term.label}.{k}": v for k, v in term.effect.typical().items()}
    try:
        found = base.objective.adding(term).residuals({**base.solution.values, **keyed}, fitted_only=True)
    except SlipwiseError as error:
        return f"it could not be evaluated: {error}"
    stacked = found.stacked(base.objective.fitted)
    return "" if np.isfinite(stacked).all() else "what it says of these runs is no finite number"
