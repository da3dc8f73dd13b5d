"""The bearing report: what a laboratory hands in of a bearing, in the words of the standards."""

from collections.abc import Sequence
from typing import Any

from slipwise.bearings.loops import SUM
from slipwise.bearings.result import CYCLE, MEAN, RUN, BearingReport, BearingRow
from slipwise.view.figures.bearing_figures import degradation_figure, drawn_runs, friction_figure, loops_figure
from slipwise.view.pages.html import Html, Section, bullets, callout, details, figure, page, paragraph, table, verdict
from slipwise.view.words.bearing_tables import (
    OF_CYCLE,
    OF_FRICTION,
    OF_RUN,
    degradation_rows,
    in_shown_unit,
    printed_rows,
    standard_rows,
)
from slipwise.view.words.numbers import counted

_DEFINITIONS = (
    "A cycle runs from one zero crossing of slip to the next in the direction in which the run began. It counts as "
    "closed where it goes equally far to both sides, there and back. Cycles of one stroke in a run are a series.",
    "Energy: the closed integral of force over slip.",
    "Mean coefficient of friction: energy over the integral of load over the way slid. At one instant: force without "
    "its restoring part, over load, mean of both directions of sliding.",
    "Breakaway: in a cycle the largest coefficient within 5 % of the stroke after friction has turned round, mean of "
    "both turns; in a run that of the first movement from rest.",
    "At peak speed: mean over the samples within 5 % of the largest speed. Speed and pressure beside belong to it.",
    "K_eff: difference of the forces at the largest slip to both sides, over the stroke; each force is that of sliding "
    "up to the turn.",
    "Equivalent damping: energy / (2 pi K_eff d²), d half the stroke. For friction without restoring force it is 2/pi.",
    "Q_d and K_d: half the distance of the two sliding branches at zero slip, and their mean slope, fitted over the "
    "middle half of the stroke.",
    "The law's interval holds what the fitted numbers leave open if the form of the law is right; where it and the "
    "measurement differ by more, the law lacks something: `slipwise diagnose` says what.",
)


def bearing_page(found: BearingReport) -> str:
    """Make the bearing report: the text of one HTML file that needs nothing else."""
    sections = [
        Section("Loops", _loops(found)),
        Section("Cycles: energy, stiffness, damping, strength", _cycles(found)),
        Section("Coefficient of friction", _friction(found)),
        Section("Whole runs", _runs(found)),
        Section("Degradation over cycles", _degradation(found)),
        Section("Property modification factors and bounds", _standards(found)),
        Section("What the standards ask and this test does not hold", _not_held(found)),
        Section("How the quantities are defined", [bullets(_DEFINITIONS)]),
        Section("What was done, and what could not be given", _about(found)),
    ]
    return page(f"{found.campaign}: bearing report", sections, _summary(found))


def _summary(found: BearingReport) -> list[Any]:
    series = found.of(MEAN, found.total)
    first = [callout("Before anything was measured", f"{one.words}.", "warn") for one in found.corrections]
    name = "Sum of the pads" if found.total == SUM else f"Pad {found.total}"
    if not series:
        runs = found.of(RUN, found.total)
        facts = {f"mean coefficient, {row.run}": row.values["friction_mean"].measured for row in runs[:4]}
        words = "No run is a cyclic motion, so that only energy and friction of whole runs can be given."
        return [verdict(f"{name}: no closed cycles", words, "warn", facts), *first]
    row = max(series, key=lambda one: (_count(found, one) > 1, one.values["displacement_max"].measured))
    facts = {
        "mean coefficient of friction": row.values["friction_mean"].measured,
        "characteristic strength Q_d [kN]": in_shown_unit(
            "characteristic_strength", _of(row, "characteristic_strength")
        ),
        "effective stiffness K_eff [kN/mm]": in_shown_unit("effective_stiffness", _of(row, "effective_stiffness")),
        "equivalent damping": _of(row, "equivalent_damping"),
        "energy per cycle [kN cm]": in_shown_unit("energy", _of(row, "energy")),
    }
    half = 0.5e3 * (_of(row, "displacement_max") - _of(row, "displacement_min"))
    words = (
        f"Mean of {counted(_count(found, row), 'closed cycle')} of {row.run} at an amplitude of {half:.3g} mm, a peak "
        f"speed of {1e3 * _of(row, 'peak_speed'):.3g} mm/s"
    )
    pressure = _of(row, "mean_pressure")
    words += f" and a mean pressure of {1e-6 * pressure:.3g} MPa." if pressure == pressure else "."
    return [verdict(f"{name}, largest cyclic motion", words, "plain", facts), *first]


def _of(row: BearingRow, key: str) -> float:
    return row.values[key].measured


def _count(found: BearingReport, mean: BearingRow) -> int:
    return sum((r.run, r.series) == (mean.run, mean.series) for r in found.of(CYCLE, mean.bearing))


def _loops(found: BearingReport) -> list[Any]:
    left = len(found.loops) - len(drawn_runs(found))
    caption = (
        "Friction force against slip. Dark: closed cycles, of which the quantities of a cycle are taken; grey: the rest "
        "of the run; orange: the fitted law at the same motion."
    )
    caption += f" {counted(left, 'more run')} not drawn." if left else ""
    return [figure(loops_figure(found), caption, "Loops of force against slip of every run")]


def _cycles(found: BearingReport) -> list[Any]:
    return _both(found, OF_CYCLE, "Mean of the closed cycles of each series, measured and by the fitted law.")


def _friction(found: BearingReport) -> list[Any]:
    pieces: list[Any] = []
    if any(row.values["friction_mean"].measured == row.values["friction_mean"].measured for row in found.rows):
        of = "closed cycle" if found.of(CYCLE) else "run"
        caption = (
            f"Coefficient at peak speed over that speed and the pressure then, a dot for each {of}; bars: the law."
        )
        pieces.append(figure(friction_figure(found), caption, "Coefficient of friction over speed and pressure"))
    return pieces + _both(found, OF_FRICTION, "Mean of the closed cycles of each series; p: pressure; mu: coefficient.")


def _both(found: BearingReport, keys: Sequence[str], words: str) -> list[Any]:
    """Make the table of the series, and behind a click those of every cycle and pad."""
    total, pads = found.of(MEAN, found.total), [r for r in found.of(MEAN) if r.bearing != found.total]
    if not total:
        return [paragraph("No run has closed cycles; see the whole runs below.")]
    pieces: list[Any] = [paragraph(words), table(printed_rows(total, keys, law=True))]
    if pads:
        pieces.append(details("Each pad", [table(printed_rows(pads, keys, law=True))]))
    pieces.append(details("Every cycle", [table(printed_rows(found.of(CYCLE), keys))]))
    return pieces


def _runs(found: BearingReport) -> list[Any]:
    words = "Of any motion, earthquakes too. Breakaway is that of the first movement, where the record begins at rest."
    pieces: list[Any] = [paragraph(words), table(printed_rows(found.of(RUN, found.total), OF_RUN, law=True))]
    pads = [r for r in found.of(RUN) if r.bearing != found.total]
    if pads:
        pieces.append(details("Each pad", [table(printed_rows(pads, OF_RUN, law=True))]))
    return pieces


def _degradation(found: BearingReport) -> list[Any]:
    rows = degradation_rows(found, found.total)
    if not rows:
        return [paragraph("Degradation needs two or more closed cycles of one stroke; this campaign has none.")]
    caption = "Energy and characteristic strength of each cycle over those of the first cycle of the same stroke."
    pieces: list[Any] = [figure(degradation_figure(found), caption, "Energy and strength over cycles")]
    pieces.append(details("Every cycle against the first and the third", [table(degradation_rows(found))]))
    return pieces


def _standards(found: BearingReport) -> list[Any]:
    if not found.standards:
        return [paragraph("No factor can be given without closed cycles or a first movement from rest.")]
    words = (
        "Nominal is the mean of the first three cycles of the cyclic motion that slides furthest. Factors are what "
        "this test has measured, and no more: those of ageing, contamination and temperature have to be multiplied on top."
    )
    pieces: list[Any] = [paragraph(words)]
    rows = standard_rows(found)
    for standard in dict.fromkeys(row["standard"] for row in rows):
        pieces.append(table([{k: v for k, v in row.items() if k != "standard"} for row in rows
                             if row["standard"] == standard], caption=standard))  # fmt: skip
    return pieces


def _not_held(found: BearingReport) -> list[Any]:
    return [bullets([f"{one.standard}: {one.words}." for one in found.not_held])]


def _about(found: BearingReport) -> list[Html]:
    law = f"Law that was fitted: {found.law}." if found.law else "No law was fitted."
    pieces = [paragraph(f"Rig {found.rig}. {law} Made in {found.seconds:.0f} s.")]
    if found.cannot:
        pieces.append(bullets([f"{words[0].upper()}{words[1:]}." for words in found.cannot]))
    return pieces
