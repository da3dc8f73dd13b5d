"""Figs. 9 and 10: trapezoids per pad, a rectangle of the sum, and what the pair of energies can say."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import PADS
from slipwise.model import Model
from slipwise.motion import load_motion
from slipwise.record import Record
from slipwise.signals.hysteresis_loop import LoopShape, loop_shape
from slipwise.simulation.replay import replay
from slipwise.studies.paper.finding import FAILS, HOLDS, LIMITS, Finding, Study
from slipwise.studies.paper.law import edge_slope
from slipwise.studies.paper.plan import ENERGY_WITH, ENERGY_WITHOUT, middle
from slipwise.studies.paper.settings import PaperSettings, paper_model

#: A sine below the resonance of Bridge 1, so that friction can bound it: f/f_n = 0.68.
SINE = "sine:2Hz,0.3g,cycles=20"
_PERCENTILES = (5, 25, 50, 75, 95)


def steady_loops(model: Model, spec: str = SINE) -> tuple[dict[str, LoopShape], LoopShape, Record]:
    """Shake with a sine and measure every pad's loop and that of the sum over the last four full cycles.

    Returns:
        Pad -> shape, the sum's shape, and the record of these cycles.
    """
    motion = load_motion(spec)
    steady = motion.steady
    record = replay(model, motion).record
    if steady is not None:
        record = record.between(steady.end - 4.0 * steady.period, steady.end)
    slip = record["slip_x"]
    pads = {pad: loop_shape(slip, record[f"pad_{pad}_Fx"]) for pad in PADS}
    return pads, loop_shape(slip, record.stacked("pad_{}_Fx").sum(axis=1)), record


def band(record: Record) -> float:
    """Return the width of the sum's loop: rms of |sum F| about its mean over its mean while sliding fast [1]."""
    force = np.abs(record.stacked("pad_{}_Fx").sum(axis=1))
    fast = np.abs(record["slip_vx"]) > 0.3 * np.abs(record["slip_vx"]).max()
    return float(force[fast].std() / force[fast].mean())


def spread(values: Sequence[float] | Array) -> dict[str, float]:
    """Return percentiles 5, 25, 50, 75, 95 by name."""
    return {f"p{p}": float(np.percentile(values, p)) for p in _PERCENTILES}


def study(settings: PaperSettings, numbers: dict[str, list[dict[str, Any]]]) -> Study:
    """Draw the loops and weigh the energies.

    Args:
        settings: the assumptions.
        numbers: of the ensemble, by group.
    """
    model = paper_model("bridge1", settings)
    figure = numbers["figure"][0]
    scaled = middle(settings)
    factor = figure["factor"]
    scaled = replace(scaled, peak=scaled.peak * factor, vertical=scaled.vertical * factor)
    shaken = {True: replay(model, scaled.motion()), False: replay(model, replace(scaled, vertical=0.0).motion())}
    records = {vertical: answer.record for vertical, answer in shaken.items()}
    pads, total, sine = steady_loops(model)
    slopes = {pad: shape.edge_slope for pad, shape in pads.items()}
    flat = float(np.mean([shape.flatness for shape in pads.values()]))
    expected = edge_slope(model, p_delta=model.specimen.pads_on == "table")
    pad_slope = float(np.mean([abs(v) for v in slopes.values()]))
    stays = abs(total.edge_slope) / pad_slope / len(PADS)
    opposed = all(np.sign(slopes[a]) == -np.sign(slopes[b]) for a, b in (("A", "B"), ("C", "D")))
    bands = {vertical: band(record) for vertical, record in records.items()}
    pairs = np.array([(a["energy"], b["energy"]) for a, b in _finished(numbers["with"], numbers["without"])])
    ratio = pairs[:, 0] / pairs[:, 1]
    slips = np.array([a["slip_max"] / b["slip_max"] for a, b in _finished(numbers["with"], numbers["without"])])
    reached = [n for n in numbers["reach"] if "failed" not in n]
    reach_ratio = np.array([n["energy"] / n["energy_without"] for n in reached])
    stated = ENERGY_WITH / ENERGY_WITHOUT
    closer = float(np.mean(np.abs(ratio - 1.0) <= stated - 1.0))
    half = 0.5 * float(np.percentile(ratio, 97.5) - np.percentile(ratio, 2.5))
    findings = (
        Finding(
            "Fig. 9",
            "Each isolator's loop is a trapezoid, because rocking moves its load.",
            f"edges {pad_slope / 1e6:.4f} kN/mm, statics {expected / 1e6:.4f}",
            f"Under a sine the edges of the pads' loops slope by {pad_slope / 1e6:.4f} kN/mm, opposite on opposite "
            "sides; "
            f"dF/dN (h/b) k/2 with the weight's shift says {expected / 1e6:.4f}.",
            HOLDS if opposed and abs(pad_slope / expected - 1.0) < 0.1 else FAILS,
            "While sliding is fast. The trapezoid needs the buffers' force well below the centre of gravity; with it "
            "at "
            "h, offset rectangles would be seen.",
            ("buffer_height", "pads_on"),
            {"pad_slope": pad_slope, "expected": expected, "pad_flatness": flat},
        ),
        Finding(
            "Fig. 10, left",
            "The sum of the four loops is a rectangle: rocking cancels.",
            f"edges level within {1 - total.flatness:.1%}, pads {1 - flat:.1%}",
            f"Its edges deviate from level by {1 - total.flatness:.1%} rms, those of the pads by {1 - flat:.1%}; its "
            "slope is "
            f"{stays:.1%} of what the pads' slopes would add up to.",
            HOLDS if 1 - total.flatness < 0.5 * (1 - flat) and stays < 0.05 else FAILS,
            "For equal pads and small swings of load; the claims below give the limits. What is left is the speed "
            "term.",
            (),
            {"sum_slope": total.edge_slope, "sum_flatness": total.flatness, "pad_flatness": flat},
        ),
        Finding(
            "Fig. 10",
            "Without vertical motion the loop's band is narrower.",
            f"{bands[True]:.1%} with, {bands[False]:.1%} without",
            f"|sum F| varies by {bands[True]:.1%} rms with and {bands[False]:.1%} without vertical motion while "
            "sliding fast.",
            HOLDS if bands[True] > bands[False] else FAILS,
            "What is left without vertical motion is the speed term.",
            ("vertical_share",),
            {"band_with": bands[True], "band_without": bands[False]},
        ),
        Finding(
            "Fig. 10, energies",
            "532 kN cm with and 531 without vertical motion: almost the same.",
            f"ratio {np.median(ratio):.3f}, 95 % within {np.percentile(ratio, 2.5):.3f} to "
            f"{np.percentile(ratio, 97.5):.3f}",
            f"Motions of {settings.peak_low / 9.80665:.2g} to {settings.peak_high / 9.80665:.2g} g give "
            f"{np.percentile(pairs[:, 0], 5) / 10:.0f} to {np.percentile(pairs[:, 0], 95) / 10:.0f} kN cm (median "
            f"{np.median(pairs[:, 0]) / 10:.0f}). Over {len(pairs)} motions the ratio with/without is "
            f"{np.median(ratio):.3f} (95 % within {np.percentile(ratio, 2.5):.3f} to "
            f"{np.percentile(ratio, 97.5):.3f}); "
            f"{closer:.0%} of them come as close to 1 as the paper's pair. {len(reached)} motions scaled to 532 "
            f"kN cm give {np.median(reach_ratio):.3f} ({reach_ratio.min():.3f} to {reach_ratio.max():.3f}).",
            LIMITS if abs(np.median(ratio) - 1.0) < 0.02 else FAILS,
            f"No difference is the typical answer, but one pair says little: a single motion scatters by ±{half:.0%}. "
            "0.2 % is chance and confirms nothing of the pressure law.",
            ("peak_low", "peak_high", "frequency_low", "frequency_high", "strong_low", "strong_high", "vertical_share"),
            {
                "energy_with_kN_cm": {k: v / 10 for k, v in spread(pairs[:, 0]).items()},
                "energy_without_kN_cm": {k: v / 10 for k, v in spread(pairs[:, 1]).items()},
                "energy_ratio": spread(ratio),
                "slip_ratio": spread(slips),
                "as_close_as_paper": closer,
                "reach_ratio": spread(reach_ratio),
                "pairs": len(pairs),
                "figure_energy_kN_cm": [sum(shaken[v].pad_energy.values()) / 10 for v in (True, False)],
                "figure_peak_g": scaled.peak / 9.80665,
            },
        ),
    )  # fmt: skip
    curves = {
        "records": records,
        "sine": sine,
        "pairs": pairs,
        "ratio": ratio,
        "reach_ratio": reach_ratio,
        "slips": slips,
    }
    return Study("loops", "Hysteresis loops and energies (Figs. 9, 10)", findings, {}, curves)


def _finished(one: list[dict[str, Any]], other: list[dict[str, Any]]) -> list[tuple[dict[str, Any], dict[str, Any]]]:
    """Return the pairs in which neither simulation diverged."""
    return [(a, b) for a, b in zip(one, other, strict=True) if "failed" not in a and "failed" not in b]
