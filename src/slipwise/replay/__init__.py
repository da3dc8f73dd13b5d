"""System level: the replay of a table motion in MuJoCo."""

from slipwise.replay.run import DT, OUTPUT_DT, Memory, Replay, SimulationDiverged, simulate

__all__ = ["DT", "OUTPUT_DT", "Memory", "Replay", "SimulationDiverged", "simulate"]
