"""One law, written once: compiled into MuJoCo's callbacks, run as Python, and driven over whole records."""

from slipwise.simulation.kernel.callbacks import installed
from slipwise.simulation.kernel.engine import ENGINES, Kernel, engine_for, kernel
from slipwise.simulation.kernel.layout import Layout, apply_rest, begin_memory, fill, set_values

__all__ = [
    "ENGINES",
    "Kernel",
    "Layout",
    "apply_rest",
    "begin_memory",
    "engine_for",
    "fill",
    "installed",
    "kernel",
    "set_values",
]
