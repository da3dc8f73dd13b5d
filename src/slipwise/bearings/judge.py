"""Judge a bearing by a campaign: quantities of every cycle and run, from the measured loops and from the fitted law."""

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.bearings.degradation import follow_degradation
from slipwise.bearings.factors import choose_reference, list_factors
from slipwise.bearings.law import LawForces, interval, predict_forces
from slipwise.bearings.loops import SUM, Loop
from slipwise.bearings.measured import RunLoops, has_loop, measure_loops
from slipwise.bearings.quantities import OF_MOTION, Values, measure_cycle, measure_run
from slipwise.bearings.requirements import list_not_held
from slipwise.bearings.result import CYCLE, MEAN, RUN, BearingReport, BearingRow, QuantityValue
from slipwise.campaign import Campaign, as_campaign
from slipwise.errors import InputError, SlipwiseError
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared, fit_prepared

#: A cycle of which more than this share of the samples of its force are no measurement is left out [1].
_BRIDGED = 0.05
#: Why ratios of a slope are not given.
_NO_SLOPE = (
    "modification factors of the post-sliding stiffness K_d: over the stroke it adds less than a tenth of Q_d, changes "
    "sign from cycle to cycle, or there is one cycle only"
)


@one_thread_algebra()
def judge_bearing(
    campaign: Campaign | Path | str,
    model: Model | Path | str | None = None,
    *,
    progress: Callable[[str, float], None] | None = None,
) -> BearingReport:
    """Return the quantities of a campaign's bearings that standards name.

    Args:
        campaign: or its folder.
        model: whose law is fitted, or its model.toml; the paper's law on the campaign's rig when not given.
        progress: called with what is being done and the fraction done.

    Raises:
        InputError: no run has slip and a friction force, or none slides.
    """
    began = time.perf_counter()
    tell = progress or (lambda words, done: None)
    tell("reading", 0.0)
    recorded, cannot = _with_loops(as_campaign(campaign))
    prepared = prepare(recorded)
    whole = replace(prepared.campaign, runs=prepared.uncut.runs)
    tell("measuring loops", 0.15)
    loops: list[RunLoops] = []
    for run in whole.runs:
        found = measure_loops(run, whole, prepared.unjudged.get(run.name, {}))
        if found is None:
            cannot.append(f"{run.name}: nothing slides in this run, so that it has no loop")
        else:
            loops.append(found)
    if not loops:
        raise InputError(
            f"campaign {recorded.name}: nothing slides in any run, so that no bearing quantity can be given; give a "
            "run in which slip goes beyond the noise of its gauge"
        )
    tell("fitting the law", 0.2)
    words, forces, without = _fit_law(prepared, model)
    tell("quantities of every cycle", 0.9)
    rows = tuple(row for one in loops for row in _rows_of(one, forces.get(one.run)))
    report = _report(prepared, loops, rows, [*cannot, *without, *_about_cycles(loops, rows), *_about_loads(loops)])
    tell("done", 1.0)
    return replace(report, law=words, forces=forces, seconds=time.perf_counter() - began)


def _with_loops(campaign: Campaign) -> tuple[Campaign, list[str]]:
    """Return the campaign with the runs that can show a loop, and why the others cannot."""
    lacking = {run.name: words for run in campaign.runs if (words := has_loop(run, campaign))}
    kept = tuple(run for run in campaign.runs if run.name not in lacking)
    if not kept:
        raise InputError(
            f"campaign {campaign.name}: {'; '.join(dict.fromkeys(lacking.values()))}; a bearing quantity needs both "
            "slip and a friction force"
        )
    return replace(campaign, runs=kept), [f"{name}: {words}" for name, words in lacking.items()]


def _fit_law(prepared: Prepared, model: Model | Path | str | None) -> tuple[str, Mapping[str, LawForces], list[str]]:
    """Return the law's name, its forces in every run, and why there are none."""
    start = None if model is None else as_model(model)
    if not prepared.campaign.with_role("fit", "repeat"):
        return "", {}, ["quantities of a fitted law: every run is held out (role holdout), and none may be fitted"]
    try:
        base = fit_prepared(prepared, start, finely=True)
    except SlipwiseError as error:
        return "", {}, [f"quantities of a fitted law: {error}"]
    forces = predict_forces(base, prepared.uncut, prepared.unjudged)
    fitted = base.objective.model(base.solution.values)
    return ", ".join(use.label for use in fitted.uses) or "Coulomb friction alone", forces, []


def _rows_of(one: RunLoops, law: LawForces | None) -> list[BearingRow]:
    """Return the rows of a run: whole, by cycle, and the mean of each series of cycles, of every bearing."""
    out = []
    closed = [c for c in one.cut.cycles if one.cut.cyclic and c.closed]
    for loop in one.loops:
        said = _said(loop, one, law)
        out.append(_row(one, loop, (RUN, 0, 0), measure_run(loop), None if said is None else measure_run(said)))
        bad = one.bridged[loop.bearing].astype(float)
        kept = [c for c in closed if c.cut(bad).mean() <= _BRIDGED]
        for series in sorted({c.series for c in kept}):
            cycles = [c for c in kept if c.series == series]
            own = [measure_cycle(loop.of(c)) for c in cycles]
            other = [None if said is None else measure_cycle(said.of(c)) for c in cycles]
            numbered = enumerate(zip(own, other, strict=True), start=1)
            out += [_row(one, loop, (CYCLE, series, i), *both) for i, both in numbered]
            of_law = [values for values in other if values is not None]
            out.append(_row(one, loop, (MEAN, series, 0), _mean(own), _mean(of_law) if of_law else None))
    return out


def _said(loop: Loop, one: RunLoops, law: LawForces | None) -> Loop | None:
    """Return the loop as the law has it; None where the law says nothing of this bearing."""
    wanted = one.pads if loop.bearing == SUM else (loop.bearing,)
    if law is None or not set(wanted) <= set(law.pads):
        return None
    return loop.with_force(law.force[:, [law.pads.index(pad) for pad in wanted]].sum(axis=1))


def _mean(cycles: Sequence[Values]) -> Values:
    """Return the means over the cycles in which each quantity is known."""
    out = {}
    for key in cycles[0]:
        values = np.stack([cycle[key] for cycle in cycles])
        known = np.isfinite(values[:, 0])
        out[key] = values[known].mean(axis=0) if known.any() else values[0]
    return out


def _row(one: RunLoops, loop: Loop, place: tuple[str, int, int], own: Values, law: Values | None) -> BearingRow:
    values = {}
    for key, measured in own.items():
        value = QuantityValue(float(measured[0]))
        if law is not None and key not in OF_MOTION:
            value = QuantityValue(float(measured[0]), float(law[key][0]), *interval(law[key]))
        values[key] = value
    return BearingRow(one.run, one.role, loop.bearing, *place, values)


def _report(
    prepared: Prepared, loops: Sequence[RunLoops], rows: tuple[BearingRow, ...], cannot: Sequence[str]
) -> BearingReport:
    """Return the report of these rows, before anything is said of the law."""
    measured: dict[tuple[str, str, int], list[dict[str, float]]] = {}
    for row in rows:
        if row.part == CYCLE:
            cycle = {key: value.measured for key, value in row.values.items()}
            measured.setdefault((row.run, row.bearing, row.series), []).append(cycle)
    total = SUM if any(row.bearing == SUM for row in rows) else rows[0].bearing
    cyclic = {(run, n): cycles for (run, b, n), cycles in measured.items() if b == total}
    several = {place: cycles for place, cycles in cyclic.items() if len(cycles) > 1}
    named = {_name(place, cyclic): cycles for place, cycles in (several or cyclic).items()}
    reference = choose_reference(named) if named else ""
    pads = {b: c for (run, b, n), c in measured.items() if b != SUM and _name((run, n), cyclic) == reference}
    whole = [row for row in rows if row.part == RUN and row.bearing == total]
    way = sum(row.values["way"].measured for row in whole)
    first = {row.run: row.values["friction_breakaway"].measured for row in whole}
    standards = list_factors(named, pads, {run: mu for run, mu in first.items() if np.isfinite(mu)})
    flat = "" if not named or any("K_d" in one.quantity for one in standards) else _NO_SLOPE
    return BearingReport(
        campaign=prepared.campaign.name,
        rig=prepared.campaign.rig,
        law="",
        rows=rows,
        degradation=tuple(d for place, cycles in measured.items() for d in follow_degradation(*place, cycles)),
        standards=tuple(standards),
        not_held=tuple(list_not_held(prepared.campaign, named, way, _load_swing(loops, total))),
        cannot=(*cannot, *filter(None, [flat])),
        corrections=prepared.corrections,
        loops=tuple(loops),
        forces={},
        seconds=0.0,
    )


def _load_swing(loops: Sequence[RunLoops], total: str) -> float:
    """Return the largest deviation of the load from its mean within closed cycles, over that mean [1]; 0 without."""
    swings = [0.0]
    for one in loops:
        for loop in one.loops:
            for cycle in one.cut.cycles:
                if loop.bearing == total and one.cut.cyclic and cycle.closed and np.isfinite(loop.load).all():
                    load = cycle.cut(loop.load)
                    swings.append(float(np.abs(load / load.mean() - 1.0).max()))
    return max(swings)


def _name(place: tuple[str, int], cyclic: Collection[tuple[str, int]]) -> str:
    """Return the name of a series of cycles: of its run, with its number where the run has several."""
    run, series = place
    return run if sum(other == run for other, _ in cyclic) == 1 else f"{run}, series {series}"


def _about_cycles(loops: Sequence[RunLoops], rows: Sequence[BearingRow]) -> list[str]:
    """Say which runs have no cycles, and where degradation cannot be given."""
    out, other = [], [one.run for one in loops if not one.cut.cyclic]
    if other:
        out.append(
            f"{', '.join(other)}: cycle quantities need a cyclic motion, most of it fully reversed cycles of one "
            "stroke; energy and friction of the whole run are given"
        )
    single = [one.run for one in loops if one.cut.cyclic and len(one.cut.longest_series) == 1]
    if single:
        out.append(f"{', '.join(single)}: there is one closed cycle of a stroke; degradation needs two or more")
    cycles = [row for row in rows if row.part == CYCLE]
    slow = _runs_without("characteristic_strength", cycles)
    if slow:
        out.append(
            f"{', '.join(slow)}: Q_d, K_d and breakaway of some cycles, where friction turns round over so much of the "
            "stroke that no part of it shows sliding alone"
        )
    loaded = [row for row in cycles if row.run not in slow and np.isfinite(row.values["friction_mean"].measured)]
    if stopped := _runs_without("friction_breakaway", loaded):
        out.append(
            f"{', '.join(stopped)}: breakaway of cycles that reach a rim or a stop, which pushes back at the turns"
        )
    for one in loops:
        left = sum(not c.closed for c in one.cut.cycles)
        if one.cut.cyclic and left:
            out.append(
                f"{one.run}: {left} of {len(one.cut.cycles)} cycles are not fully reversed or have no neighbour of "
                "their stroke, and are left out"
            )
    return out


def _runs_without(key: str, rows: Sequence[BearingRow]) -> list[str]:
    return list(dict.fromkeys(row.run for row in rows if np.isnan(row.values[key].measured)))


def _about_loads(loops: Sequence[RunLoops]) -> list[str]:
    lacking = dict.fromkeys(loop.bearing for one in loops for loop in one.loops if not np.isfinite(loop.load).all())
    pads = [name for name in lacking if name != SUM]
    return [f"coefficients of friction of {', '.join(pads)}: the load was not measured (pad_*_N)"] if pads else []
