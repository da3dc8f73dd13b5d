"""Plan a test: what gauges show whatever the motion, and how likely planned motions name each effect."""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, load_campaign
from slipwise.channels import channel, channels_like, channels_of
from slipwise.effects import Effect, catalogue
from slipwise.errors import InputError, SettingError, SlipwiseError
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model, base_model
from slipwise.model.file import as_model
from slipwise.motion import TableMotion
from slipwise.motion.load import as_motion
from slipwise.planning.balance_equations import BalanceEquations, keep_laws_of_pads, list_equations
from slipwise.planning.chances import Chance, RankedMotion, compute_chances, rank_motions
from slipwise.planning.gauge_kits import Kit, Remedy, choose_set, keep_judged, list_kits, list_remedies, list_sets
from slipwise.planning.planned_columns import PlannedColumns, compute_planned_columns, find_allowed
from slipwise.planning.planned_runs import PlannedRuns, list_recorded_motions, replay_planned
from slipwise.planning.result import GaugeSet, PlannedTest
from slipwise.planning.sensors import Sensors, make_sensors
from slipwise.planning.structure import Structure, compute_structure, list_faults
from slipwise.rig import Specimen, load_specimen, storey_names

#: Sets of gauges beside the planned one in which chances are shown.
_MOST_ADDED = 3
#: What a replay of a run is driven by: limits of materiality are those of the motions as planned.
_DRIVING = ("table_ax", "table_az")
#: What changes how every relation is judged once it is recorded: chances are given with it only where it is planned.
_APART = frozenset({"yaw", "slip_y", "girder_ay", "table_ay"})


@one_thread_algebra()
def plan(
    test: Campaign | Path | str,
    motions: Sequence[str | Path | TableMotion] = (),
    gauges: Sequence[str] = (),
    *,
    budget: int | None = None,
    model: Model | Path | str | None = None,
    own: Iterable[Effect] = (),
    rate: float | None = None,
    corner: float | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> PlannedTest:
    """Say before a test what its gauges and motions would show.

    Args:
        test: a rig, by name or file; or a campaign or its folder, whose rig, gauges, noise and motions are taken where
            none are given.
        motions: of the table, as `load_motion` takes them.
        gauges: channels or patterns such as "pad_*_N"; the usual ones of the rig if not given, or the best set within
            the budget.
        budget: of channels: the best set within it is given too.
        model: that is replayed; the paper's law on the rig if not given.
        own: effects beside those of the catalogue.
        rate: of the samples [Hz]; that of the campaign, or 500 Hz, if not given.
        corner: of the low-pass filter [Hz]; the filter of the campaign, or 100 Hz, if not given.
        progress: called with what is being done and the share done.

    Raises:
        UnknownNameError: no such rig or channel.
        InputError: no balance of the rig uses any of the gauges, the budget is too small, or a motion cannot be read.
    """
    began, tell = time.perf_counter(), progress or (lambda words, share: None)
    campaign = _as_campaign(test)
    start = _as_model(test, campaign, model)
    specimen = start.specimen
    asked = _name_motions(motions, campaign)
    equations, kits = list_equations(specimen), list_kits(specimen)
    present = {use.effect.name for use in start.uses}
    effects = [e for e in (*catalogue().values(), *own) if _may_be_missing(e, present)]
    given = _expand(gauges, specimen) or _recorded(campaign)
    every = tuple(dict.fromkeys([*given, *(c for kit in kits for c in kit.channels)]))
    faults, untestable = list_faults(equations, every, effects)

    def judge(channels: Sequence[str]) -> Structure:
        judged = keep_judged(specimen, channels)
        own = equations if len(judged) == len(channels) else keep_laws_of_pads(equations)
        return replace(compute_structure(own, faults, judged), channels=tuple(channels))

    tell("balances", 0.0)
    notes: list[str] = []
    best = None if budget is None else _best_within(budget, specimen, kits, judge, notes)
    usual = tuple(c for kit in kits[: 5 if specimen.free else 3] for c in kit.channels)
    channels = given or (best.channels if best is not None else usual)
    unused = tuple(c for c in channels if not equations.measured_by(c))
    used = _refuse_useless([c for c in channels if c not in unused], channels, equations)
    planned = judge(used)
    judged = keep_judged(specimen, used)
    if unjudged := [c for c in used if c not in judged]:
        notes.append(
            f"{', '.join(unjudged)}: nothing is made of them, for no balance of the girder can be made where the load "
            "or the friction is measured on some pads only; measure it on all of them, or on none."
        )
    remedies = list_remedies(planned, kits, judge)
    structures = _list_structures(planned, remedies, best, judge, specimen, kits)
    sets = [GaugeSet(words, structure) for words, structure in structures.items()]
    ranked: tuple[RankedMotion, ...] = ()
    made: PlannedRuns | None = None
    if not asked:
        notes.append(
            "No motion is planned, so this is what the gauges could show at best, whatever the motion; motions say how "
            "likely each effect is named."
        )
    elif not specimen.free:
        notes.append(
            f"The slip of {specimen.name} is prescribed by an actuator, of which no replay knows the load: the gauges "
            "are judged by the balances alone."
        )
    else:
        chain = make_sensors(campaign, rate, corner)
        if "table_az" not in used and any(np.any(motion.acceleration[:, 2]) for motion in asked.values()):
            notes.append(
                "The motions shake vertically, and table_az is not planned: without it a diagnosis replays a table "
                "that stays level, and takes what needs vertical motion for small."
            )
        made, sets, ranked = _with_chances(start, asked, sets, used, chain, campaign, untestable, tell)
    tell("done", 1.0)
    return PlannedTest(
        specimen.name,
        tuple(sets),
        unused,
        tuple(remedies),
        ranked,
        {} if made is None else made.failed,
        () if made is None else made.hardly,
        untestable,
        budget,
        tuple(notes),
        time.perf_counter() - began,
    )


def _as_campaign(test: Campaign | Path | str) -> Campaign | None:
    if isinstance(test, Campaign):
        return test
    return load_campaign(test) if (Path(test) / "campaign.toml").is_file() else None


def _as_model(test: Campaign | Path | str, campaign: Campaign | None, model: Model | Path | str | None) -> Model:
    if model is not None:
        return as_model(model)
    if campaign is not None:
        return base_model(campaign.specimen)
    return base_model(load_specimen(str(test)))


def _may_be_missing(effect: Effect, present: Iterable[str]) -> bool:
    """Return whether an effect may be asked for: springs never miss, and some faults are found in samples alone."""
    return effect.base != "springs" and not effect.in_samples and (bool(effect.target) or effect.name not in present)


def _name_motions(
    motions: Sequence[str | Path | TableMotion], campaign: Campaign | None
) -> dict[str, TableMotion]:  # fmt: skip
    """Return the motions by name: those given, else those of the campaign's runs.

    Raises:
        InputError: one cannot be read, or is given twice.
    """
    if not motions:
        return {} if campaign is None or not campaign.specimen.free else list_recorded_motions(campaign)
    out: dict[str, TableMotion] = {}
    for given in motions:
        name = given.title if isinstance(given, TableMotion) else str(given)
        if name in out:
            raise InputError(f"motion {name} is planned twice; give each once: a repeat tells wear, and no plan of it")
        out[name] = as_motion(given)
    return out


def _expand(gauges: Sequence[str], specimen: Specimen) -> tuple[str, ...]:
    """Return the channels that names and patterns mean.

    Raises:
        UnknownNameError: no rig has such a channel.
        SettingError: a pattern means none of this rig.
    """
    known = channels_of(specimen.pads, [b.name for b in specimen.buffers])
    floors = [f"{storey}_a{axis}" for storey in storey_names(specimen.storeys) for axis in "xy"]
    out: dict[str, None] = {}
    for name in (part.strip() for text in gauges for part in text.split(",") if part.strip()):
        if "*" in name or "?" in name:
            found = [c for c in channels_like(name, [*known, *floors]) if c != "time"]
            if not found:
                raise SettingError(f"no channel of {specimen.name} is like {name}; `slipwise channels` lists them")
            out |= dict.fromkeys(found)
        else:
            out[channel(name).name] = None
    return tuple(out)


def _recorded(campaign: Campaign | None) -> tuple[str, ...]:
    if campaign is None:
        return ()
    return tuple(c for c in campaign.runs[0].record.channels if all(c in run.record for run in campaign.runs))


def _refuse_useless(used: Sequence[str], given: Sequence[str], equations: BalanceEquations) -> tuple[str, ...]:
    if not used:
        raise InputError(
            f"no balance of {equations.specimen.name} uses any of {', '.join(given)}; it could use "
            f"{', '.join(c for c in equations.quantities if equations.measured_by(c))}"
        )
    return tuple(used)


def _best_within(
    budget: int, specimen: Specimen, kits: Sequence[Kit], judge: Callable[[Sequence[str]], Structure], notes: list[str]
) -> Structure:
    most = len({c for kit in kits for c in kit.channels} - {"girder_az"})
    if budget > most:
        notes.append(f"The balances of {specimen.name} use {most} channels at most, fewer than the budget of {budget}.")
    return choose_set(list_sets(specimen, kits, budget), judge)


def _list_structures(
    planned: Structure,
    remedies: Sequence[Remedy],
    best: Structure | None,
    judge: Callable[[Sequence[str]], Structure],
    specimen: Specimen,
    kits: Sequence[Kit],
) -> dict[str, Structure]:
    """Return the sets that are shown, by what they are: planned, with more, the best of the budget, the cheapest."""
    out = {"planned": planned}
    added: dict[tuple[str, ...], str] = {}
    for remedy in (r for r in remedies if r.kits):
        added.setdefault(remedy.channels, f"with {' and '.join(kit.words for kit in remedy.kits)}")
    for channels, words in sorted(added.items(), key=lambda a: len(a[0]))[:_MOST_ADDED]:
        out[words] = judge(tuple(dict.fromkeys([*planned.channels, *channels])))
    if best is not None and set(best.channels) != set(planned.channels):
        out["the best within the budget"] = best
    every = [judge(channels) for channels in list_sets(specimen, kits, len({c for k in kits for c in k.channels}))]
    most = max(s.score[0] for s in every)
    cheapest = min((s for s in every if s.score[0] == most), key=lambda s: (len(s.channels), -s.score[1], -s.score[2]))
    if all(set(cheapest.channels) != set(s.channels) for s in out.values()):
        out["the fewest that tell most apart"] = cheapest
    return out


def _with_chances(
    model: Model,
    motions: Mapping[str, TableMotion],
    sets: Sequence[GaugeSet],
    used: Sequence[str],
    sensors: Sensors,
    pattern: Campaign | None,
    untestable: dict[str, str],
    tell: Callable[[str, float], None],
) -> tuple[PlannedRuns, list[GaugeSet], tuple[RankedMotion, ...]]:
    """Return the runs that were replayed, the sets with their chances, and the motions ranked by the first that has."""
    wanted = {c for one in sets for c in one.channels}
    channels = [c for c in dict.fromkeys([*used, *sorted(wanted), *_DRIVING]) if c in used or not _is_apart(c)]
    tell("replaying the motions", 0.02)
    made = replay_planned(model, motions, channels, sensors, pattern)
    try:
        planned = compute_planned_columns(made.campaign, model, lambda words, share: tell(words, 0.1 + 0.8 * share))
    except SlipwiseError as error:
        return made, [GaugeSet(s.words, s.structure, (), str(error)) for s in sets], ()
    untestable |= {name: why for name, why in planned.untestable.items() if name not in untestable}
    tell("drawing campaigns like this one", 0.9)
    runs, out = range(len(made.motions)), list[GaugeSet]()
    ranked: tuple[RankedMotion, ...] = ()
    for one in sets:
        chances, reason = _chances_of(planned, runs, one)
        out.append(GaugeSet(one.words, one.structure, chances, reason))
        if chances and not ranked:
            ranked = rank_motions(planned, made.slips, find_allowed(planned, one.channels))
    return made, out, ranked


def _chances_of(planned: PlannedColumns, runs: Sequence[int], one: GaugeSet) -> tuple[tuple[Chance, ...], str]:
    try:
        return compute_chances(planned, runs, find_allowed(planned, one.channels)), ""
    except SlipwiseError as error:
        return (), str(error)


def _is_apart(name: str) -> bool:
    return name in _APART or name.endswith("_Fy")
