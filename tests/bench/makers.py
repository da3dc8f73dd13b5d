"""Who shakes the rigs of the bench: the second simulator, or the library's own replay."""

from bench.library_replay import replayed
from bench.rig_ode import Shaker, simulate

#: name -> what makes true channels of a specimen, a motion and its memory.
MAKERS: dict[str, Shaker] = {"ode": simulate, "replay": replayed}
