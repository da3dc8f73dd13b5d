"""Are the instruments telling the truth? The balances of a rigid girder say so, without any law of friction."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign
from slipwise.campaign.wild_samples_of_runs import sentences as wild_samples
from slipwise.campaign.zero_state import ShiftedZero
from slipwise.channels import channel
from slipwise.effects import Effect, catalogue
from slipwise.effects._gauges import span
from slipwise.instruments.balances_case import KNOWN_MASS, RATED_MASS, Case
from slipwise.instruments.claims import Claim, list_claims, list_physics
from slipwise.instruments.delay_or_filter import passed
from slipwise.instruments.displacement_checks import check_displacements
from slipwise.instruments.fault_columns import shows_only_noise
from slipwise.instruments.fault_posterior import compute_fault_posterior, fit_base
from slipwise.instruments.level_checks import contradicted_levels, silent_levels, storey_answers
from slipwise.instruments.report import AuditFinding, AuditReport, Balance
from slipwise.instruments.sentences import as_sentence, confusable, how_to_settle, sentence
from slipwise.instruments.size_fit import SizeFit
from slipwise.instruments.suspects import effect_of
from slipwise.preparation.level_faults import read_levels
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared
from slipwise.preparation.rounding import is_coarse
from slipwise.preparation.sample_fault import RAILS, SampleFault
from slipwise.preparation.wrong_units import WrongUnit
from slipwise.relations.balance_rows import (
    draw_run_noise,
    list_constants,
    prepare_runs,
    stack_rows,
)
from slipwise.relations.rigid_balances import list_rigid_balances
from slipwise.signals.noise import quantum, white_level

#: Nobody is surer than this.
_SUREST = 0.99
#: A rounding step above this many standard deviations of noise is worth a word [1].
_COARSE = 2.0
#: Samples of a coarsely rounded channel differ by fewer steps of its rounding than this.
_FEW_STEPS = 20.0
#: What cannot be tested where a campaign has no channel at all.
NOTHING_MAPPED = (
    "no column of the files is a channel; name them in [columns] of campaign.toml, as `slipwise init` does "
    "(`slipwise channels` lists the names)"
)


def audit(campaign: Campaign | Path | str | Prepared, own: Iterable[Effect] = ()) -> AuditReport:
    """Compare every run's channels with each other; nothing is corrected.

    Args:
        campaign: or its folder; one that is prepared is not prepared again.
        own: effects beside those of the catalogue: faults of gauges (`fault`) and physical explanations (`disturb`).
    """
    prepared = prepare(campaign)
    campaign = prepared.recorded
    if not any(run.record.channels for run in campaign.runs):
        return AuditReport(campaign.name, (), (), (), {}, None, (NOTHING_MAPPED,))
    clean, rig = prepared.balances.campaign, prepared.campaign.specimen
    runs, band = prepare_runs(clean, prepared.balances.left_out)
    allowed, cannot = list_rigid_balances(runs[0].record, rig)
    step = float(np.median([run.record.dt for run in clean.runs]))
    mass_error = KNOWN_MASS if "mass" in campaign.known else RATED_MASS
    logger = prepared.logger
    findings = [_of_samples(fault) for fault in prepared.faults]
    notes = [*wild_samples(campaign.runs), *_rounded(campaign)]
    notes += [one.words for one in prepared.corrections if one.kind == "wrong_rig"]
    levels = read_levels(clean)
    contradicted = {one.run for one in levels if one.contradicts}
    displacements = check_displacements([run for run in clean.runs if run.name not in contradicted], rig)
    notes += displacements.notes
    cannot += silent_levels(levels)
    plain = AuditReport(
        campaign.name,
        tuple(findings),
        balances=(),
        physics=(),
        constants={},
        logger=logger,
        cannot=tuple(cannot),
        notes=tuple(notes),
        contradictions=(*contradicted_levels(levels), *displacements.contradictions),
        levels=storey_answers(levels),
    )
    # a column that holds something else than said is held against nothing more
    allowed = [relation for relation in allowed if not set(relation.needs) & set(displacements.elsewhere)]
    runs = [run for run in runs if run.name not in contradicted]
    if not runs or not any(relation.accuses and relation.rows in ("moving", "inner") for relation in allowed):
        return plain
    if not stack_rows(runs, allowed, rig, dict.fromkeys(list_constants(allowed), 0.0)).residual:
        why = "balances: no run has a sample at which they hold; the runs are too short, or the rig is at rest in them"
        return replace(plain, cannot=(*plain.cannot, why))
    noise = draw_run_noise(runs, clean.gauges, step, band)
    likeliest = campaign.logger if logger is None else logger.likeliest
    highest = passed(likeliest.every if likeliest else None, clean.runs[0].record.dt)
    effects = {**catalogue(), **{e.name: e for e in own}}
    case = Case(runs, allowed, rig, noise, mass_error, highest, tuple(effects.values()))
    silent = [name for name in runs[0].record.channels if shows_only_noise(case, [name])]
    if silent:
        cannot.append(f"gain of {', '.join(silent)}: in these runs there is more noise than signal in it")
    found = compute_fault_posterior(case, fit_base(case))
    claims = list_claims(found)
    findings = _join_zeros(findings, [_of_claim(claim) for claim in claims if not claim.doubt])
    notes += [claim.note for claim in claims if claim.doubt]
    return replace(
        plain,
        findings=tuple(sorted(findings, key=lambda finding: -finding.probability)),
        balances=_balances(found.first, found.last),
        physics=tuple(list_physics(found)),
        constants=found.last.point.constants,
        cannot=tuple(cannot),
        notes=tuple(notes),
    )


def _of_claim(claim: Claim) -> AuditFinding:
    """Turn a fault that is named into a finding."""
    suspect = claim.suspect
    return AuditFinding(
        effect=suspect.effect,
        channel=suspect.target if suspect.target != "all" else "pad_*",
        size=claim.size,
        low=claim.low,
        high=claim.high,
        unit=suspect.unit,
        probability=min(_SUREST, claim.probability),
        mistaken_for=tuple(dict.fromkeys([*claim.rivals, *confusable(suspect.effect)])),
        settle_by=how_to_settle(suspect.effect, claim.rivals),
        words=as_sentence(suspect, claim.size),
        target=suspect.target,
        values=suspect.values(claim.size),
    )


def _of_samples(fault: SampleFault) -> AuditFinding:
    """Turn bad samples, a wrong sign or a zero that is far off into a finding."""
    effect = effect_of(fault.kind)
    place = _place(fault.channels)
    unit = channel(fault.channels[0]).unit if fault.kind in (*RAILS, "shifted") else "1"
    unit = "s" if fault.kind == "late" else unit
    size = fault.size - 1.0 if fault.kind == "scaled" else fault.size  # a gain is what is too much
    words = {
        "wild": f"{place} is faulty: {fault.size:.1%} of its samples are wild",
        "scaled": WrongUnit(fault.channels, fault.size).words(place) if fault.kind == "scaled" else "",
        "dead": f"{place} is dead in {', '.join(fault.runs)}",
        "lost": f"{place} has lost samples: what follows them came early, and the end repeats one value",
        "shifted": ShiftedZero(fault.channels, fault.size).words,
        "late": _late_words(fault),
        "gap": f"the logger has lost {fault.size:.2%} of all samples",
    }.get(fault.kind, sentence(effect, place, size, unit))
    if fault.kind in RAILS:
        upper = fault.kind == RAILS[0]
        place_of_rail = effect.parameters[0 if upper else 1].name
        values = {place_of_rail: (1.0 if upper else -1.0) * fault.size / span(fault.channels[0])}
    elif fault.kind == "shifted":
        values = _values_of_zero(ShiftedZero(fault.channels, fault.size))
    else:
        values = {effect.parameters[0].name: size}
    return AuditFinding(
        effect=effect,
        channel=place,
        size=size,
        low=size,
        high=size,
        unit=unit,
        probability=_SUREST,
        mistaken_for=confusable(effect),
        settle_by=how_to_settle(effect, ()),
        words=words,
        target=fault.channels[0] if len(fault.channels) == 1 else place,
        values=values,
        runs=fault.runs,
        of_samples=fault,
    )


def _late_words(fault: SampleFault) -> str:
    if len(fault.channels) == 1:
        return sentence(effect_of("late"), fault.channels[0], fault.size, "s")
    if all(name.startswith("pad_") for name in fault.channels):
        return f"the cells of the pads come {fault.size:.3f} s late: their logger was started later"
    return f"{', '.join(fault.channels)} come {fault.size:.3f} s late: their logger was started later"


def _place(channels: tuple[str, ...]) -> str:
    """Write several channels as one pattern where they are one card."""
    kinds = {name.split("_")[-1] for name in channels}
    if len(channels) > 1 and all(name.startswith("pad_") for name in channels) and len(kinds) == 1:
        return f"pad_*_{kinds.pop()}"
    return channels[0] if len(channels) == 1 else "all"


def _balances(first: SizeFit, last: SizeFit) -> tuple[Balance, ...]:
    rows, names = first.linear.statistics.rows, first.linear.relations
    return tuple(
        Balance(name, first.linear.floor[name], float(before), float(after), int(count))
        for name, before, after, count in zip(names, first.left, last.left, rows, strict=True)
    )


def _rounded(campaign: Campaign) -> list[str]:
    """Name channels that are rounded by more than their noise; what was computed from others has no own steps."""
    found, record = [], campaign.runs[0].record
    computed = record.provenance.get("computed", ())
    for name in record.channels:
        values = record[name]
        if np.ptp(values) == 0.0 or name in computed:
            continue
        step, noise = quantum(values), white_level(values)
        if step > _COARSE * noise > 0.0:
            found.append(f"{name} is rounded to steps of {step:.3g} {channel(name).unit}, more than its noise")
        moves = np.abs(np.diff(values))
        if is_coarse(values) and step > 0.0 and float(np.median(moves[moves > 0.0])) < _FEW_STEPS * step:
            found.append(f"{name} is rounded so coarsely that repeated samples cannot be told")
        elif is_coarse(values):
            found.append(f"{name} has no noise, or moves evenly: repeated samples cannot be told from its motion")
    return found


def _values_of_zero(zero: ShiftedZero) -> dict[str, float]:
    """Return the parameters of the effect that a shifted zero is."""
    return {effect_of("shifted").parameters[0].name: zero.size / span(zero.channels[0])}


def _join_zeros(shifted: Iterable[AuditFinding], refined: Iterable[AuditFinding]) -> list[AuditFinding]:
    """Join what the weight says of a cell's zero with what the balances add to it: one cell has one zero.

    Args:
        shifted: findings of zeros that are far off, among others.
        refined: what the balances found once those were put right.
    """
    found, offset = list(shifted), effect_of("shifted").name
    for more in refined:
        at = next((i for i, first in enumerate(found) if first.name == more.name and more.what == offset), None)
        if at is None:
            found.append(more)
            continue
        first = found[at]
        zero = ShiftedZero((first.channel,), first.size + more.size)
        ends = {"low": first.size + more.low, "high": first.size + more.high}
        found[at] = replace(first, size=zero.size, words=zero.words, values=_values_of_zero(zero), **ends)
    return found
