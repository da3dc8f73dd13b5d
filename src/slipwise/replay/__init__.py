"""System level: the replay of a table motion in MuJoCo."""

from slipwise.replay.front import replay
from slipwise.replay.run import DT, OUTPUT_DT, Memory, Replay, SimulationDiverged, simulate
from slipwise.replay.summary import slip_half_range, summary

__all__ = [
    "DT",
    "OUTPUT_DT",
    "Memory",
    "Replay",
    "SimulationDiverged",
    "replay",
    "simulate",
    "slip_half_range",
    "summary",
]
