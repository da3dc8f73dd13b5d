"""The loops of a campaign as they were measured: every bearing of every run, and how each run is cut into cycles."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.bearings.cycles import CyclesOfRun, find_cycles
from slipwise.bearings.loops import SUM, Loop
from slipwise.campaign import Campaign, Run
from slipwise.campaign.states import States, measured_states
from slipwise.short_repr import short_repr

#: Slip that moves by less than so many standard deviations of its gauge's noise is none.
_SLIDES = 10.0


@short_repr
@dataclass(frozen=True)
class RunLoops:
    """One run that slides.

    Attributes:
        run: name.
        role: "fit", "repeat" or "holdout".
        time: (n,) [s].
        cut: its cycles.
        loops: of each pad whose friction was measured, and of all together where that is every pad of several.
        bridged: name of a bearing -> samples (n,) at which its force is no measurement.
    """

    run: str
    role: str
    time: Array
    cut: CyclesOfRun
    loops: tuple[Loop, ...]
    bridged: Mapping[str, Mask]

    @property
    def pads(self) -> tuple[str, ...]:
        """Names of the pads whose friction was measured."""
        return tuple(loop.bearing for loop in self.loops if loop.bearing != SUM)


def has_loop(run: Run, campaign: Campaign) -> str:
    """Return what a run lacks to show a loop, in words; nothing where it has one."""
    if "slip_x" not in run.record:
        return "slip was not measured (slip_x), and a loop is force against slip"
    if not any(f"pad_{pad}_Fx" in run.record for pad in campaign.specimen.pads):
        return "no friction force of a pad was measured (pad_*_Fx)"
    return ""


def measure_loops(run: Run, campaign: Campaign, bad: Mapping[str, Mask]) -> RunLoops | None:
    """Return the loops of a run that has slip and forces; None where it never slides.

    Args:
        run: of the prepared campaign.
        campaign: with its logger.
        bad: channel -> samples (n,) of the run at which it is no measurement.
    """
    states = measured_states(run, campaign)
    slip = states.slip[:, 0]
    gauge = campaign.gauges.get("slip_x")
    if float(np.ptp(slip)) <= _SLIDES * (gauge.level if gauge else 0.0) or states.stuck.all():
        return None
    cut = find_cycles(slip)
    pads = [p for p in states.pads if f"pad_{p}_Fx" in states.record]
    loops = [_loop_of(states, pad, cut.zero) for pad in pads]
    if len(pads) == len(states.specimen.pads) > 1:
        loops.append(make_sum(loops, slip, states.velocity))
    bridged = {pad: _on_axis(states, run, bad.get(f"pad_{pad}_Fx")) for pad in pads}
    if loops[-1].bearing == SUM:
        bridged[SUM] = np.any(list(bridged.values()), axis=0)
    return RunLoops(run.name, run.role, states.time, cut, tuple(loops), bridged)


def make_sum(loops: list[Loop], slip: Array, velocity: Array) -> Loop:
    """Return the loop of all pads together over the slip (n,) [m] and velocity (n, 2) [m/s] of the girder."""
    load = np.sum([loop.load for loop in loops], axis=0)
    force = np.sum([loop.force for loop in loops], axis=0)
    return Loop(SUM, loops[0].zero, slip, velocity, load, sum(loop.area for loop in loops), force)


def _loop_of(states: States, pad: str, zero: float) -> Loop:
    place, specimen = states.pads.index(pad), states.specimen
    return Loop(
        bearing=pad,
        zero=zero,
        slip=states.pad_slip[:, place, 0],
        velocity=states.pad_velocity[:, place],
        load=states.load[:, place],
        area=specimen.pad_areas[specimen.pads.index(pad)],
        force=states.force[:, place, :1],
    )


def _on_axis(states: States, run: Run, bad: Mask | None) -> Mask:
    if bad is None:
        return np.zeros(len(states.time), dtype=bool)
    return np.interp(states.time, run.record.time, bad.astype(float)) > 0.0
