"""What stays while the numbers of a fit change: the measured runs, and the noise with which they are weighed."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from slipwise.arrays import Array
from slipwise.relations.girder import BALANCES, list_available_balances
from slipwise.relations.motions import group_by_motion
from slipwise.relations.run_data import FitRun
from slipwise.rig import Specimen, pad_frequencies
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes
from slipwise.short_repr import short_repr
from slipwise.signals.ends import in_frequency

#: Above this frequency, over that at which the girder pitches on its pads, what is left of the pitch load is noise [1].
_PITCHING = 1.56


@short_repr
@dataclass(frozen=True, eq=False)
class Measurements:
    """A campaign's runs as every evaluation finds them, with what follows from them alone.

    Attributes:
        runs: in the order in which they were made; memory goes on from one to the next.
        specimen: rated values.
    """

    runs: tuple[FitRun, ...]
    specimen: Specimen

    @cached_property
    def relations(self) -> tuple[str, ...]:
        """Names of the relations that every run allows, in the order in which their residuals are stacked."""
        balances = (r for r in BALANCES if all(r in list_available_balances(x, self.specimen) for x in self.runs))
        across = ("across",) if all(r.across.size for r in self.runs) else ()
        girder_across = ("girder_y",) if all("girder_y" in r.judged for r in self.runs) else ()
        return (*(("pads",) if self.forces_measured else ()), *balances, *across, *girder_across)

    @property
    def balanced(self) -> bool:
        """Whether the balances of a girder are there."""
        return bool({*self.relations} - {"pads", "across", "girder_y"})

    @property
    def forces_measured(self) -> bool:
        """Whether the pads' friction was measured in every run."""
        return all(run.forces_measured for run in self.runs)

    @property
    def loads_measured(self) -> bool:
        """Whether the pads' loads were measured in every run."""
        return all(run.loads_measured for run in self.runs)

    @property
    def yaw_is_computable(self) -> bool:
        """Whether all pads' forces were measured, and yaw was not."""
        return self.balanced and self.forces_measured and not self.runs[0].states.has_yaw

    @cached_property
    def fitted(self) -> list[int]:
        """Places of the runs that may be fitted."""
        return [i for i, r in enumerate(self.runs) if r.role != "holdout"]

    @cached_property
    def held_out(self) -> list[int]:
        """Places of the runs that are never fitted."""
        return [i for i, r in enumerate(self.runs) if r.role == "holdout"]

    @cached_property
    def motions(self) -> list[list[int]]:
        """Places of the fitted runs by motion, see `group_by_motion`."""
        return group_by_motion(self.runs, self.fitted)

    @cached_property
    def motion_of(self) -> dict[int, int]:
        """Number of the motion of the run at each place; a held-out run is a motion of its own."""
        groups = [*self.motions, *([i] for i in self.held_out)]
        return {i: number for number, group in enumerate(groups) for i in group}

    @cached_property
    def pitch_rates(self) -> list[Array]:
        """Rate of the pitch load of every run (n,) [N/s], by which the sliding plane moves against the gauge."""
        return [_pitch_rate(run) for run in self.runs]

    @cached_property
    def pads_here(self) -> list[int]:
        """Places of the measured pads among the rig's."""
        return [self.specimen.pads.index(p) for p in self.runs[0].pads]

    @property
    def samples(self) -> int:
        """Samples of all runs together."""
        return sum(len(run.time) for run in self.runs)

    def refined(self, fine: int) -> "Measurements":
        """Return the runs with the laws evaluated at so many instants per sample; the same if they are so already."""
        if self.runs[0].fine >= fine:
            return self
        return replace(self, runs=tuple(replace(run, fine=fine) for run in self.runs))

    def with_held_out(self, place: int) -> "Measurements":
        """Return the runs with one more that is never fitted."""
        runs = (replace(run, role="holdout") if i == place else run for i, run in enumerate(self.runs))
        return replace(self, runs=tuple(runs))


@short_repr
@dataclass(frozen=True, eq=False)
class Weighing:
    """The noise of every relation, and what the logger's filter took, as some numbers of a fit say.

    Attributes:
        sigmas: relation -> per run noise, broadcastable to the residual, in its unit; empty before it is known.
        ringing: relation -> per run spectrum (m,) of gauges' noise that rings in it [N^2].
        lost: per run (f, p) velocity that the logger's filter took at reversals [m/s]; empty before it is known.
        bounds: per run (n, p) friction of the pads whichever way they slide [N]; empty before it is known.
        slip_delay: by which the slip gauge lags behind the accelerometers [s].
        weighed_by: the numbers.
    """

    sigmas: Mapping[str, tuple[Array, ...]] = field(default_factory=dict[str, tuple[Array, ...]])
    ringing: Mapping[str, tuple[Array, ...]] = field(default_factory=dict[str, tuple[Array, ...]])
    lost: tuple[Array, ...] = ()
    bounds: tuple[Array, ...] = ()
    slip_delay: float = 0.0
    weighed_by: Mapping[str, float] = field(default_factory=dict[str, float])


def _pitch_rate(run: FitRun) -> Array:
    """Return rate of the pitch load (n,) [N/s]; zero where it is unknown."""
    loads, specimen = run.all_loads, run.states.specimen
    if loads is None or not specimen.free:
        return np.zeros(len(run.time))
    highest = _PITCHING * pad_frequencies(specimen)["pitch"]
    smooth = in_frequency(
        load_modes(loads, basis_of(specimen)).pitch, run.dt, lambda f: 1.0 / (1.0 + (f / highest) ** 8), 64
    )
    return np.gradient(smooth, run.dt)
