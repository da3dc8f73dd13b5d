"""Figs. 5 and 6: the input as the paper made it, from the ground through the pier to the table."""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.motion import TableMotion, load_motion
from slipwise.rig import LENGTH_SCALE
from slipwise.simulation.pier import BridgeResponse, bridge_response, table_motion
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import Replay
from slipwise.studies.paper.finding import LIMITS, UNCHECKED, Finding, Study
from slipwise.studies.paper.settings import PaperSettings, paper_model

GRAVITY = 9.80665


@dataclass(frozen=True)
class TwoWays:
    """The same earthquake in the bridge model and, through the pier's top, on the table.

    Attributes:
        bridge: the bridge model's answer.
        rig: the replay of the pier-top motion.
        time: in the model's time [s].
        rig_slip: the replay's slip at the bridge's instants, in the prototype's size [m].
        slip_error: rms difference over rms of the slip [1].
        peak_ratio: largest slip of the rig over that of the bridge [1].
        acceleration_error: rms difference over rms of girder and superstructure acceleration [1].
    """

    bridge: BridgeResponse
    rig: Replay
    time: Array
    rig_slip: Array
    slip_error: float
    peak_ratio: float
    acceleration_error: float


def two_ways(ground: TableMotion, bridge: str, settings: PaperSettings, *, similar_law: bool) -> TwoWays:
    """Shake the bridge, then the rig with what the bridge's pier top did.

    Args:
        ground: in the prototype's time.
        bridge: "bridge1" or "bridge2".
        settings: the assumptions.
        similar_law: whether the bridge's friction law sees the model's speeds, as full similarity would need.
    """
    model, chosen = paper_model(bridge, settings), settings.bridge(similar_law=similar_law)
    response = bridge_response(ground, bridge, chosen, model)
    table = table_motion(ground, bridge, response)
    answer = replay(model, table)
    record = answer.record
    # Accelerations of the bridge are means over a step: they stand half a step later than the table's samples.
    time = np.arange(len(response.slip), dtype=np.float64) * table.dt
    slip = np.interp(time + table.dt, record.time, record["slip_x"]) * LENGTH_SCALE[bridge]
    acceleration = np.interp(time, record.time, record["girder_ax"])
    return TwoWays(
        response,
        answer,
        time,
        slip,
        float(np.std(slip - response.slip) / np.std(response.slip)),
        float(np.abs(slip).max() / np.abs(response.slip).max()),
        float(np.std(acceleration - response.deck_ax) / np.std(response.deck_ax)),
    )


def study(settings: PaperSettings, ground: TableMotion | None = None) -> Study:
    """Make the table's input and check it from both sides.

    Args:
        settings: the assumptions.
        ground: a recorded ground motion in the prototype's time; the assumed one when not given.
    """
    ground = ground or load_motion(settings.ground)
    similar = {b: two_ways(ground, b, settings, similar_law=True) for b in LENGTH_SCALE}
    real = {b: two_ways(ground, b, settings, similar_law=False) for b in LENGTH_SCALE}
    peaks = {b: (_peak(w.bridge.pier_ax), _peak(w.bridge.pier_az)) for b, w in real.items()}
    findings = (
        Finding(
            "Figs. 5, 6",
            "The acceleration at the top of a pier of the whole bridge, EW and UD, drove the table.",
            f"{peaks['bridge1'][0]:.2f} g along, {peaks['bridge1'][1]:.2f} g up, assumed",
            "; ".join(f"{b}: pier top {x:.2f} g along, {z:.2f} g up" for b, (x, z) in peaks.items())
            + f", from a ground motion of {_peak(ground.acceleration[:, 0]):.2f} and "
            f"{_peak(ground.acceleration[:, 2]):.2f} g.",
            UNCHECKED,
            "Neither the earthquake, its peaks, nor the bridge model's numbers are in the text. Ours is a small "
            "plane model "
            "with one assumed pier; give a recorded motion with --ground.",
            ("ground", "pier_stiffness", "pier_mass", "pier_damping", "pier_vertical_frequency"),
            {"pier_top_peaks_g": peaks, "ground": ground.title},
        ),
        Finding(
            "Fig. 5",
            "A table driven by the pier top stands for the superstructure on the bridge.",
            f"slip {similar['bridge1'].slip_error:.1%} off if n scaled, {real['bridge1'].slip_error:.0%} as it is",
            "If n scaled too, the rig's slip would follow the bridge's within "
            + " and ".join(f"{w.slip_error:.1%}" for w in similar.values())
            + " rms. With the real n it differs by "
            + " and ".join(f"{w.slip_error:.0%}" for w in real.values())
            + ", its largest slip by "
            + " and ".join(f"{w.peak_ratio - 1.0:+.0%}" for w in real.values())
            + " (bridges 1 and 2).",
            LIMITS if max(w.slip_error for w in similar.values()) < 0.1 else UNCHECKED,
            "The procedure itself is sound. What breaks it is the speed term: the model slides 3.3 times slower than "
            "the "
            "bridge, with less friction.",
            ("ground", "pier_stiffness", "pier_mass"),
            {
                name: {b: {"slip_error": w.slip_error, "peak_ratio": w.peak_ratio} for b, w in ways.items()}
                for name, ways in (("n_scaled", similar), ("real_n", real))
            },
        ),
    )  # fmt: skip
    one = real["bridge1"]
    curves = {
        "time": one.time,
        "ground": one.bridge.ground_ax,
        "pier": one.bridge.pier_ax,
        "vertical": one.bridge.pier_az,
        "deck_slip": one.bridge.slip,
        "rig_slip": one.rig_slip,
        "similar_slip": (similar["bridge1"].bridge.slip, similar["bridge1"].rig_slip),
        "records": {b: w.rig.record for b, w in real.items()},
    }
    return Study("input", "The input, as the paper made it (Figs. 5, 6)", findings, {}, curves)


def _peak(values: Array) -> float:
    """Largest absolute value in units of gravity."""
    return float(np.abs(values).max() / GRAVITY)
