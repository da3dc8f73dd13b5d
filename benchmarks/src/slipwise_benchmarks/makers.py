"""Who shakes the rigs of the bench: the second simulator, or the library's own replay."""

from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.rig_ode import Array, Memory, Shaker, simulate
from slipwise_benchmarks.settings import Settings


def _replayed(settings: Settings, motion: Motion, memory: Memory, step: float, every: int) -> dict[str, Array]:
    """Shake the rig with the library, which needs to be installed for nothing else."""
    from slipwise_benchmarks.library_replay import replayed

    return replayed(settings, motion, memory, step, every)


#: name -> what makes true channels of a specimen, a motion and its memory.
MAKERS: dict[str, Shaker] = {"ode": simulate, "replay": _replayed}
