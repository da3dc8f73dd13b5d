"""The planned test on the computer: motions replayed on the rig as the model has it, and measured by planned gauges."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, Run
from slipwise.campaign.states import measured_states
from slipwise.comparison.measured_replay import choose_simulation_step, get_measured_motion
from slipwise.errors import InputError, SlipwiseError
from slipwise.jobs.parallel import on_every_core
from slipwise.model import Model
from slipwise.motion.load import as_motion
from slipwise.motion.resample import resample
from slipwise.motion.table_motion import TableMotion
from slipwise.planning.sensors import Sensors
from slipwise.record import Record
from slipwise.simulation.simulator import simulate

#: Rest before each motion, from which a gauge's noise is read [s].
_REST = 1.0
#: Slip of a motion under which a specimen hardly slides: it says little of friction [m].
_HARDLY = 1e-3


@dataclass(frozen=True)
class PlannedRuns:
    """A planned test.

    Attributes:
        campaign: as it would be recorded, every run to be fitted.
        slips: largest slip of every run [m].
        failed: motion -> why it could not be replayed.
    """

    campaign: Campaign
    slips: tuple[float, ...]
    failed: Mapping[str, str]

    @property
    def motions(self) -> tuple[str, ...]:
        """Names of the motions that were replayed."""
        return tuple(run.name for run in self.campaign.runs)

    @property
    def hardly(self) -> tuple[str, ...]:
        """Motions in which the specimen hardly slides."""
        return tuple(name for name, slip in zip(self.motions, self.slips, strict=True) if slip < _HARDLY)


def list_recorded_motions(campaign: Campaign) -> dict[str, TableMotion]:
    """Return the motions of the table that a campaign's runs have, by the run; repeats once.

    Raises:
        InputError: table_ax was not recorded.
    """
    return {run.name: get_measured_motion(measured_states(run, campaign)) for run in campaign.with_role("fit")}


def replay_planned(
    model: Model,
    motions: Mapping[str, TableMotion | str],
    channels: Sequence[str],
    sensors: Sensors,
    pattern: Campaign | None = None,
) -> PlannedRuns:
    """Replay motions on a model and measure them; the specimen is as new before each.

    Args:
        model: of the rig.
        motions: name -> the motion, or what `load_motion` makes one of.
        channels: of the gauges.
        sensors: how they are read.
        pattern: a campaign whose limits of materiality count; the usual ones if not given.

    Raises:
        InputError: no motion could be replayed.
    """
    dt, specimen = choose_simulation_step(sensors.step, model.built_specimen()), model.specimen
    names = list(motions)

    def shake(k: int) -> tuple[Record, float] | str:
        try:
            acceleration = resample(as_motion(motions[names[k]]), dt).acceleration
            rest = np.zeros((round(_REST / dt), acceleration.shape[1]))
            answer = simulate(model, np.concatenate([rest, acceleration]), dt=dt, output_dt=dt)
        except SlipwiseError as error:
            return str(error)
        rng = np.random.default_rng([1, k])
        return sensors.read(answer.record, channels, rng), answer.largest_slip

    answers = dict(zip(names, on_every_core(shake, len(names)), strict=True))
    failed = {name: found for name, found in answers.items() if isinstance(found, str)}
    made = {name: found for name, found in answers.items() if not isinstance(found, str)}
    if not made:
        raise InputError(f"no motion could be replayed; {names[0]}: {failed[names[0]]}")
    runs = tuple(Run(name, "fit", record, None, None, name, "") for name, (record, _) in made.items())
    limits = {} if pattern is None else {"materiality": pattern.materiality, "known": pattern.known}
    campaign = Campaign(specimen.name, specimen.name, specimen, sensors.logger, runs, Path(), **limits)
    return PlannedRuns(campaign, tuple(slip for _, slip in made.values()), failed)
