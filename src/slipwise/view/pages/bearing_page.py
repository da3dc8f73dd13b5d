"""The bearing report: what a laboratory hands in of a bearing, in the words of the standards."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from slipwise.bearings.result import CYCLE, MEAN, RUN, BearingReport, BearingRow
from slipwise.view.figures.bearing_figures import degradation_figure, drawn_runs, friction_figure, loops_figure
from slipwise.view.pages.html import Html, Section, bullets, callout, details, figure, page, paragraph, table, verdict
from slipwise.view.words.bearing_tables import FRICTION, LOOP, OF_RUN, BearingTables, name_of_total
from slipwise.view.words.numbers import counted

_ALSO_OF_RUN = ("mean_pressure", "way", "displacement_max", "displacement_min")
_OF_RUN_BY_LAW = ("friction_mean", "friction_breakaway", "friction_peak_speed", "energy")
_DEFINITIONS = (
    "A cycle runs from one zero crossing of slip to the next in the direction in which the run began. It counts as "
    "closed where it goes equally far to both sides, there and back, beside another of its stroke. Such are a series.",
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
    tables = BearingTables(found)
    sections = [
        Section("Loops", _loops(found)),
        Section("Cycles: energy, stiffness, damping, strength", _cycles(tables)),
        Section("Coefficient of friction", _friction(tables)),
        Section("Whole runs", _runs(tables)),
        Section("Degradation over cycles", _degradation(tables)),
        Section("Property modification factors and bounds", _standards(tables)),
        Section("What the standards ask and this test does not hold", _not_held(found)),
        Section("How the quantities are defined", [bullets(_DEFINITIONS)]),
        Section("What was done, and what could not be given", _about(found)),
    ]
    return page(f"{found.campaign}: bearing report", sections, _summary(tables))


def _summary(tables: BearingTables) -> list[Any]:
    found = tables.found
    first = [callout("Before anything was measured", f"{one.words}.", "warn") for one in found.corrections]
    name = name_of_total(found)
    name = name[0].upper() + name[1:]
    if not (series := found.of(MEAN, found.total)):
        runs = found.of(RUN, found.total)
        facts = {f"mean coefficient, {row.run}": row.values["friction_mean"].measured for row in runs[:4]}
        words = "No run is a cyclic motion, so that only energy and friction of whole runs can be given."
        return [verdict(f"{name}: no closed cycles", words, "warn", facts), *first]
    row = max(series, key=lambda one: (_count(found, one) > 1, one.values["displacement_max"].measured))
    called = {
        "friction_mean": "mean coefficient of friction",
        "characteristic_strength": "characteristic strength Q_d",
        "effective_stiffness": "effective stiffness K_eff",
        "equivalent_damping": "equivalent damping",
        "energy": "energy per cycle",
    }
    facts = {}
    for key, words in called.items():
        unit = tables.unit(key).replace("*", " ")
        facts[words if unit == "1" else f"{words} [{unit}]"] = tables.shown(key, row.values[key].measured)
    half = 0.5e3 * (_of(row, "displacement_max") - _of(row, "displacement_min"))
    words = (
        f"Mean of {counted(_count(found, row), 'closed cycle')} of {row.run} at an amplitude of {half:.3g} mm, a peak "
        f"speed of {1e3 * _of(row, 'peak_speed'):.3g} mm/s"
    )
    pressure = _of(row, "mean_pressure")
    words += f" and a mean pressure of {1e-6 * pressure:.3g} MPa." if np.isfinite(pressure) else "."
    return [verdict(f"{name}, largest cyclic motion", words, "plain", facts), *first]


def _of(row: BearingRow, key: str) -> float:
    return row.values[key].measured


def _count(found: BearingReport, mean: BearingRow) -> int:
    return sum((r.run, r.series) == (mean.run, mean.series) for r in found.of(CYCLE, mean.bearing))


def _loops(found: BearingReport) -> list[Any]:
    left = len(found.loops) - len(drawn_runs(found))
    caption = (
        "Friction force against slip. Dark: closed cycles, from which quantities of a cycle are taken; grey: the rest "
        "of the run; dashed: the fitted law at the same motion."
    )
    caption += f" {counted(left, 'more run')} not drawn." if left else ""
    alternative = "Loops of force against slip of every run"
    return [figure(loops_figure(found), caption, alternative, narrow=loops_figure(found, narrow=True))]


def _cycles(tables: BearingTables) -> list[Any]:
    return _both(tables, LOOP, "Mean of the closed cycles of each series, measured and by the fitted law.")


def _friction(tables: BearingTables) -> list[Any]:
    pieces: list[Any] = []
    rows = tables.found.rows
    if any(np.isfinite(_of(row, "friction_mean")) for row in rows):
        of = "closed cycle" if tables.found.of(CYCLE) else "run"
        caption = (
            f"Coefficient at peak speed over that speed and the pressure then, a dot for each {of}; bars: the law."
        )
        drawn = friction_figure(tables.found)
        pieces.append(figure(drawn, caption, "Coefficient of friction over speed and pressure"))
    return pieces + _both(tables, FRICTION, "Mean of the closed cycles of each series; mu: coefficient; p: pressure.")


def _both(tables: BearingTables, keys: Sequence[str], words: str) -> list[Any]:
    """Make the table of the series, and behind a click those of every pad and cycle."""
    found = tables.found
    total, pads = found.of(MEAN, found.total), [r for r in found.of(MEAN) if r.bearing != found.total]
    if not total:
        return [paragraph("No run has closed cycles; see the whole runs below.")]
    pieces: list[Any] = [paragraph(words), *_captioned(tables.by_series(total, keys))]
    if pads:
        pieces.append(details("Each pad", _captioned(tables.by_series(pads, keys))))
    pieces.append(details("Every cycle", [table(tables.short(found.of(CYCLE), keys))]))
    return pieces


def _captioned(named: Mapping[str, Sequence[Mapping[str, Any]]]) -> list[Html]:
    return [table(rows, caption=name) for name, rows in named.items()]


def _runs(tables: BearingTables) -> list[Any]:
    found = tables.found
    words = "Of any motion, earthquakes too. Breakaway is that of the first movement, where the record begins at rest."
    total, pads = found.of(RUN, found.total), [r for r in found.of(RUN) if r.bearing != found.total]
    pieces: list[Any] = [paragraph(words), table(tables.short(total, (*OF_RUN, *_ALSO_OF_RUN)))]
    if pads:
        pieces.append(details("Each pad", [table(tables.short(pads, (*OF_RUN, *_ALSO_OF_RUN)))]))
    pieces.append(
        details("Measured and by the fitted law", _captioned(tables.by_series(found.of(RUN), _OF_RUN_BY_LAW)))
    )
    return pieces


def _degradation(tables: BearingTables) -> list[Any]:
    if not tables.degradation(tables.found.total):
        return [paragraph("Degradation needs two or more closed cycles of one stroke; this campaign has none.")]
    caption = "Energy and characteristic strength of each cycle over those of the first cycle of the same stroke."
    pieces: list[Any] = [figure(degradation_figure(tables.found), caption, "Energy and strength over cycles")]
    pieces.append(details("Every cycle against the first and the third", [table(tables.degradation())]))
    return pieces


def _standards(tables: BearingTables) -> list[Any]:
    if not (rows := tables.standards()):
        return [paragraph("No factor can be given without closed cycles or a first movement from rest.")]
    words = (
        "Nominal is the mean of the first three cycles of the cyclic motion that slides furthest. Factors are what "
        "this test has measured, and no more: those of ageing, contamination and temperature come on top."
    )
    pieces: list[Any] = [paragraph(words)]
    return [*pieces, *(table(own, caption=standard) for standard, own in rows.items())]


def _not_held(found: BearingReport) -> list[Any]:
    return [bullets([f"{one.standard}: {one.words}." for one in found.not_held])]


def _about(found: BearingReport) -> list[Html]:
    law = f"Law that was fitted: {found.law}." if found.law else "No law was fitted."
    pieces = [paragraph(f"Rig {found.rig}. {law} Made in {found.seconds:.0f} s.")]
    if found.cannot:
        pieces.append(bullets([f"{words[0].upper()}{words[1:]}." for words in found.cannot]))
    return pieces
