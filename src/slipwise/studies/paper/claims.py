"""The conclusion, sentence by sentence: what is claimed, within which range it holds, and what breaks it."""

from dataclasses import replace
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.model import Model, use
from slipwise.record import Record
from slipwise.studies.paper.finding import FAILS, HOLDS, LIMITS, UNCHECKED, Finding, Study
from slipwise.studies.paper.hysteresis import steady_loops
from slipwise.studies.paper.law import leftover, mu, vertical_loss
from slipwise.studies.paper.settings import PaperSettings, paper_model

#: Sines for swings of load: below the resonance of each bridge.
SINES = {"bridge1": "sine:2Hz,0.3g,cycles=16", "bridge2": "sine:1.6Hz,0.25g,cycles=16"}
#: A motion that lifts pads of a girder as slender as this.
UPLIFT_SINE, UPLIFT_SLENDERNESS = "sine:4.5Hz,1.2g,cycles=20,vertical=3Hz,0.5g", 0.366


def swing_per_g(model: Model, spec: str) -> float:
    """Return the swing of pad A's load over its load at rest per g of girder acceleration [1]."""
    record = steady_loops(model, spec)[2]
    specimen = model.built_specimen()
    load, acceleration = np.ptp(record["pad_A_N"]), np.ptp(record["girder_ax"])
    return float(load / (specimen.weight / len(specimen.pads)) / (acceleration / specimen.gravity))


def uncancelled(model: Model, spec: str) -> tuple[float, float]:
    """Return what does not cancel in the sum: its slope over the pads' slopes added, and the yaw it causes [rad]."""
    pads, total, record = steady_loops(model, spec)
    added = sum(abs(shape.edge_slope) for shape in pads.values())
    return abs(total.edge_slope) / added, float(np.abs(record["yaw"]).max())


def breaks(settings: PaperSettings) -> list[dict[str, Any]]:
    """Break the conditions of cancellation one after another."""
    base = paper_model("bridge1", settings)
    half = 0.5 * base.specimen.weight / len(base.specimen.pads) / base.specimen.pad_stiffness
    cases = {
        "equal pads": base,
        "diagonal A, D carries three times B, C": base.adding(use("uneven_seating", warp=half)),
        "mass 0.3 m off, along": base.adding(use("mass_eccentricity", along=0.3, across=0.0)),
        "mass 0.1 m off, across": base.adding(use("mass_eccentricity", along=0.0, across=0.1)),
        "pads of one side with 20 % more friction": base.adding(use("pad_spread", along=0.1)),
    }
    rows = []
    for name, model in cases.items():
        share, yaw = uncancelled(model, SINES["bridge1"])
        rows.append({"condition": name, "uncancelled": share, "yaw": yaw})
    return rows


def loss_by_uplift(settings: PaperSettings) -> tuple[float, float]:
    """Lift pads and measure what the sum of friction loses against equal loads.

    Returns:
        Mean loss while sliding fast [1], and the time with a pad off [s].
    """
    model = paper_model("bridge1", settings)
    specimen = model.specimen
    model = replace(
        model, specimen=replace(specimen, centre_height=UPLIFT_SLENDERNESS * 2.0 * specimen.half_spacing[0])
    )
    record = steady_loops(model, UPLIFT_SINE)[2]
    return lost(record, model), float(np.count_nonzero(record.stacked("pad_{}_N").min(axis=1) <= 0.0) * record.dt)


def lost(record: Record, model: Model) -> float:
    """Return the mean loss of the sum of friction against four pads that share the same total load equally [1]."""
    area = model.built_specimen().pad_area
    fast = np.abs(record["slip_vx"]) > 0.05
    total = record.stacked("pad_{}_N").sum(axis=1)
    carried = fast & (total > 0.2 * model.built_specimen().weight)
    speed, load = np.abs(record["slip_vx"][carried]), total[carried] / 4.0
    equal = 4.0 * mu(model, load / area, speed) * load
    force = np.abs(record.stacked("pad_{}_Fx").sum(axis=1)[carried])
    return float(1.0 - force.sum() / equal.sum())


def study(settings: PaperSettings, numbers: dict[str, list[dict[str, Any]]]) -> Study:
    """Test the conclusion.

    Args:
        settings: the assumptions.
        numbers: of the ensemble, by group.
    """
    models = {bridge: paper_model(bridge, settings) for bridge in SINES}
    swings = {bridge: swing_per_g(model, SINES[bridge]) for bridge, model in models.items()}
    high = {
        b: replace(m, specimen=m.specimen.changed(buffer_height=m.specimen.centre_height)) for b, m in models.items()
    }
    swings_high = {bridge: swing_per_g(model, SINES[bridge]) for bridge, model in high.items()}
    alone = [n for n in numbers["without"] if "failed" not in n]
    slip = np.array([n["slip_max"] / n["one_dof_slip_max"] for n in alone])
    energy = np.array([n["energy"] / n["one_dof_energy"] for n in alone])
    left = leftover(models["bridge1"], np.array([0.2, 10e6 / models["bridge1"].specimen.rated_pressure, 1.0]))
    rows = breaks(settings)
    bad = [r for r in rows[1:] if r["uncancelled"] > 0.01]
    lost_mean, off = loss_by_uplift(settings)
    vertical = vertical_loss(models["bridge1"], np.array([0.05, 0.1, 0.2]) * 9.80665)
    tests = _pairs(numbers["with"], numbers["without"])
    extreme = _pairs(numbers["extreme"], numbers["without"])
    lifted = float(np.mean([a["uplift"] > 0 for a, _ in extreme]))
    lifted_tests = float(np.mean([a["uplift"] > 0 for a, _ in tests]))
    slip_tests = np.array([a["slip_max"] / b["slip_max"] for a, b in tests])
    slip_extreme = np.array([a["slip_max"] / b["slip_max"] for a, b in extreme])
    slip_single = np.array([a["one_dof_slip_max"] / b["one_dof_slip_max"] for a, b in extreme])
    ratio, ratio_high = (s["bridge2"] / s["bridge1"] for s in (swings, swings_high))
    findings = (
        Finding(
            "Conclusion 1",
            "The higher the centre of gravity, the more the normal force varies.",
            f"{ratio:.2f} times per g",
            f"Per g of girder acceleration Bridge 2 swings {ratio:.2f} times as much as Bridge 1, whose h/b is half.",
            HOLDS if ratio > 1.5 else FAILS,
            f"Until a pad lifts, at 2 (a/g) h/b = 1. If the buffers pushed at the centre of gravity the ratio would be "
            f"{ratio_high:.2f} and the swings {swings_high['bridge1'] / swings['bridge1']:.0%} and "
            f"{swings_high['bridge2'] / swings['bridge2']:.0%} of these.",
            ("buffer_height", "pads_on"),
            {"swing_per_g": swings, "swing_per_g_buffers_at_centre": swings_high},
        ),
        Finding(
            "Conclusion 2",
            "Rocking makes each isolator behave in a complicated way but hardly touches the response of the girder, "
            "as it "
            "cancels in the sum.",
            f"largest slip {_change(slip)}",
            f"Largest slip of the rig over that without rocking: {_spread(slip)}; energy: {_spread(energy)} "
            f"({len(alone)} motions without vertical part).",
            LIMITS if abs(np.median(slip) - 1.0) < 0.05 else FAILS,
            f"The sum loses {left[0]:.1%} at ±20 % swing of load, {left[1]:.1%} at ±10 MPa, {left[2]:.0%} at uplift; "
            "in a motion "
            f"that lifts pads {lost_mean:.0%} on average. It needs equal pads and a centred mass:"
            + ";".join(f" {r['condition']}, {r['uncancelled']:.0%} of the slopes stays" for r in bad)
            + ".",
            ("equal friction of all pads", "rigid girder"),
            {"slip_ratio": _numbers(slip), "energy_ratio": _numbers(energy), "leftover": left.tolist(), "breaks": rows,
             "loss_with_uplift": lost_mean, "uplift_s": off},
        ),
        Finding(
            "Influence of vertical motion",
            "At the level of the tests vertical motion makes no significant difference; much damping remains.",
            f"largest slip {_change(slip_tests)}",
            f"Largest slip with over without: {_spread(slip_tests)} over {len(tests)} motions. Friction loses "
            + ", ".join(f"{-v:.2%}" for v in vertical)
            + " on average at rms vertical accelerations of 0.05, 0.1 and 0.2 g.",
            HOLDS if abs(np.median(slip_tests) - 1.0) < 0.02 else FAILS,
            f"The mean effect is second order, small and negative; a pad lifts in {lifted_tests:.0%} of these motions.",
            ("vertical_share",),
            {"slip_ratio": _numbers(slip_tests), "mean_loss": vertical.tolist()},
        ),
        Finding(
            "Conclusion 3",
            "The model predicts the friction force under varying pressure and speed.",
            "no measured data in the text",
            "Eq. (7) can be identified from such data, all four parameters with intervals; see Fig. 13.",
            UNCHECKED,
            "No measured data are in the text. The authors' next paper says that the steady law misses the fall of "
            "friction just after sliding starts: see the last section.",
        ),
        Finding(
            "Conclusion 4",
            "Even extremely large vertical motion has no substantial influence on the horizontal response.",
            f"largest slip {_change(slip_extreme)}",
            f"Largest slip with 500 % over without: {_spread(slip_extreme)} ({len(extreme)} motions). One degree of "
            "freedom, "
            f"the paper's analysis, would say {_spread(slip_single)}.",
            LIMITS if abs(np.median(slip_extreme) - 1.0) < 0.1 else FAILS,
            "True of the typical motion. Not of every one: the scatter is many times that at the level of the "
            "tests, and the girder lands hard on its pads.",
            ("vertical_share",),
            {"slip_ratio": _numbers(slip_extreme), "one_dof_slip_ratio": _numbers(slip_single)},
        ),
        Finding(
            "Conclusion 5",
            "The loss of normal load on each isolator deserves attention.",
            f"a pad lifts in {lifted:.0%} of the motions",
            f"With 500 % of the vertical motion a pad lifts in {lifted:.0%} of the motions, at the level of the "
            "tests in "
            f"{lifted_tests:.0%}.",
            HOLDS if lifted > 0.5 else LIMITS,
            "A pad lifts when 2 (a/g) h/b - a_z/g = 1: Bridge 1 at 4.10 g, Bridge 2 at 2.05 g without vertical "
            "motion; all "
            "pads at a_z = -1 g.",
            ("vertical_share",),
            {"lifted_extreme": lifted, "lifted_tests": lifted_tests},
        ),
    )  # fmt: skip
    tables = {
        "What breaks the cancellation": [
            {
                "condition": r["condition"],
                "slopes that stay in the sum": f"{r['uncancelled']:.1%}",
                "yaw [mrad]": f"{r['yaw'] * 1e3:.2f}",
            }
            for r in rows
        ]
    }
    return Study(
        "claims",
        "The conclusion, sentence by sentence",
        findings,
        tables,
        {"slip": slip, "slip_tests": slip_tests, "slip_extreme": slip_extreme},
    )


def _pairs(one: list[dict[str, Any]], other: list[dict[str, Any]]) -> list[tuple[dict[str, Any], dict[str, Any]]]:
    """Return the pairs that did not diverge; the shorter group decides."""
    return [(a, b) for a, b in zip(one, other, strict=False) if "failed" not in a and "failed" not in b]


def _numbers(values: Array) -> dict[str, float]:
    low, middle, high = np.percentile(values, [2.5, 50.0, 97.5])
    return {"low": float(low), "median": float(middle), "high": float(high)}


def _change(values: Array) -> str:
    """Say how much a ratio differs from 1."""
    v = _numbers(values)
    return f"{v['median'] - 1:+.1%} (95 % within {v['low'] - 1:+.1%} to {v['high'] - 1:+.1%})"


def _spread(values: Array) -> str:
    v = _numbers(values)
    return f"{v['median']:.3f} (95 % within {v['low']:.3f} to {v['high']:.3f})"
