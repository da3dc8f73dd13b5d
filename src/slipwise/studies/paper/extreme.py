"""Figs. 14 and 15: no vertical motion and 500 % of it, one degree of freedom beside the full rig."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.simulation.replay import replay
from slipwise.studies.paper.finding import FAILS, HOLDS, LIMITS, Finding, Study
from slipwise.studies.paper.hysteresis import spread
from slipwise.studies.paper.member import Member
from slipwise.studies.paper.one_dof import one_dof
from slipwise.studies.paper.plan import EXTREME, Plan, middle
from slipwise.studies.paper.settings import PaperSettings

#: One degree of freedom is called enough while its slip errs less than this, rms over the range of slip [1].
ENOUGH = 0.02


def slip_map(members: Sequence[Member], numbers: Sequence[dict[str, Any]]) -> dict[str, Array]:
    """Put the map's replays on their grid.

    Returns:
        `scale` (m,) times the tests' vertical motion, `slenderness` (n,), and (m, n) means over the motions of `error`,
        rms error of the slip of one degree of freedom over its range; `peak`, its largest slip over the rig's; `energy`
        likewise; `uplift`, time with a pad off [s]; `load`, largest load of a pad over that at rest. NaN where a
        simulation diverged.
    """
    rows = list(zip(members, numbers, strict=True))
    scales = [
        round(m.vertical / (m.peak * m.settings.vertical_share), 2) if m.settings.vertical_share else 0.0
        for m in members
    ]
    heights = [m.slenderness for m in members]
    axes = np.unique(scales), np.unique(heights)
    out = {
        name: np.full((len(axes[0]), len(axes[1])), np.nan) for name in ("error", "peak", "energy", "uplift", "load")
    }
    for i, scale in enumerate(axes[0]):
        for j, height in enumerate(axes[1]):
            cell = [n for (m, n), s in zip(rows, scales, strict=True) if s == scale and m.slenderness == height]
            if any("failed" in n for n in cell):
                continue
            out["error"][i, j] = np.mean([n["one_dof_slip_error"] for n in cell])
            out["peak"][i, j] = np.mean([n["one_dof_slip_max"] / n["slip_max"] for n in cell])
            out["energy"][i, j] = np.mean([n["one_dof_energy"] / n["energy"] for n in cell])
            out["uplift"][i, j] = np.mean([n["uplift"] for n in cell])
            out["load"][i, j] = np.mean([4.0 * n["load_high"] for n in cell]) / rows[0][0].model().specimen.weight
    return {"scale": axes[0], "slenderness": axes[1], **out}


def study(settings: PaperSettings, chosen: Plan, numbers: dict[str, list[dict[str, Any]]]) -> Study:
    """Compare both analyses.

    Args:
        settings: the assumptions.
        chosen: the plan of the ensemble.
        numbers: of the ensemble, by group.
    """
    factor = numbers["figure"][0]["factor"]
    base = middle(settings)
    base = replace(base, peak=base.peak * factor, vertical=base.vertical * factor)
    cases = {}
    for name, scale in (("none", 0.0), ("extreme", EXTREME)):
        member = replace(base, vertical=base.vertical * scale)
        cases[name] = (replay(member.model(), member.motion()), one_dof(member.model(), member.motion()))
    grid = slip_map(chosen.groups["map"], numbers["map"])
    pairs = [
        (a, b)
        for a, b in zip(numbers["extreme"], numbers["without"], strict=False)
        if not ("failed" in a or "failed" in b)
    ]
    ratios = {
        name: np.array([a[name] / b[name] for a, b in pairs])
        for name in ("energy", "slip_max", "one_dof_energy", "one_dof_slip_max")
    }
    error = np.array([a["one_dof_slip_error"] for a, _ in pairs])
    lifted = np.array([a["uplift"] for a, _ in pairs])
    impact = np.array([4.0 * a["load_high"] for a, _ in pairs]) / base.model().specimen.weight
    vertical_g = base.vertical * EXTREME / 9.80665
    wide = float(np.nanmax(grid["error"]))
    enough = np.nan_to_num(grid["error"], nan=1.0) < ENOUGH
    own = int(np.argmin(np.abs(grid["slenderness"] - 0.122)))
    findings = (
        Finding(
            "Figs. 14, 15",
            "In a one-degree-of-freedom analysis of Bridge 1 the loop dissipates well even with 500 % of the "
            "vertical motion.",
            f"largest slip {np.median(ratios['one_dof_slip_max']) - 1:+.0%} in the median",
            f"500 % is {vertical_g:.2f} g here. Energy changes by {_range(ratios['one_dof_energy'])} and the largest "
            "slip by "
            f"{_range(ratios['one_dof_slip_max'])} (one degree of freedom, {len(pairs)} motions).",
            LIMITS if abs(np.median(ratios["one_dof_slip_max"]) - 1.0) < 0.1 else FAILS,
            "In the middle the response hardly changes; a single motion may slide much more or less.",
            ("vertical_share", "peak_low", "peak_high"),
            {name: spread(values) for name, values in ratios.items()},
        ),
        Finding(
            "Fig. 15",
            "The normal force of the isolators is lost at times.",
            f"a pad off for {lifted.mean():.1f} s, landing at {np.median(impact):.0f} times its load",
            f"In the full rig a pad is off for {lifted.mean():.2f} s on average (at least one in "
            f"{np.mean(lifted > 0):.0%} of the motions) and lands with up to {np.median(impact):.1f} times its load "
            "at rest "
            f"(median; at most {impact.max():.1f}).",
            HOLDS if np.mean(lifted > 0) > 0.5 else LIMITS,
            "The landing is outside the paper's analysis, which has no springs under the girder. Its size follows "
            "the pads' "
            "stiffness and damping, which are assumed.",
            ("vertical_share", "pad stiffness and damping of the rig"),
            {
                "uplift_mean_s": float(lifted.mean()),
                "impact_median": float(np.median(impact)),
                "impact_max": float(impact.max()),
            },
        ),
        Finding(
            "One degree of freedom",
            "One degree of freedom is enough, because rocking cancels.",
            f"slip within {wide:.1%} of its range all over the map",
            f"Its slip errs by {grid['error'][0, own]:.2%} of the range for Bridge 1 without vertical motion and by "
            "at most "
            f"{wide:.1%} over h/b up to {grid['slenderness'][-1]:.2f} and {grid['scale'][-1]:.0f} times the vertical "
            "motion; "
            f"below {ENOUGH:.0%} in {enough.mean():.0%} of the map. Over {len(pairs)} motions of Bridge 1 with 500 % "
            "it errs by "
            f"{np.median(error):.1%} (median), at most {error.max():.0%}.",
            HOLDS if enough.all() else LIMITS,
            _edge(grid, enough),
            ("vertical_share", "peak_low", "peak_high"),
            {k: np.where(np.isfinite(v), v, -1.0).tolist() for k, v in grid.items()},
        ),
    )  # fmt: skip
    curves = {"cases": cases, "map": grid, "ratios": ratios}
    return Study("extreme", "Extremely large vertical motion (Figs. 14, 15)", findings, {}, curves)


def _range(ratio: Array) -> str:
    """Say how far a ratio is from 1: median and the range over the motions."""
    return f"{np.median(ratio) - 1:+.1%} (median; {ratio.min() - 1:+.0%} to {ratio.max() - 1:+.0%})"


def _edge(grid: dict[str, Array], enough: NDArray[np.bool_]) -> str:
    """Say from which h/b on each vertical motion needs the full rig."""
    words = []
    for scale, row in zip(grid["scale"], enough, strict=True):
        beyond = grid["slenderness"][~row]
        words.append(f"{scale:.0f}x: " + (f"to h/b {beyond[0]:.2f}, not there" if len(beyond) else "all"))
    return (
        "Enough by vertical motion, "
        + "; ".join(words)
        + ". It is uplift and landing, not rocking itself, that end it."
    )
