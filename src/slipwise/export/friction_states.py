"""States that pads pass through, and the coefficient of friction that a model has in each."""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign
from slipwise.campaign.rig_motion import rig_motion
from slipwise.campaign.states import measured_states
from slipwise.errors import InputError
from slipwise.model import Model
from slipwise.simulation.predict import predictor
from slipwise.simulation.simulator import Replay

#: A pad that stands counts with this share of its largest speed, so that friction at rest is not left to chance [1].
_AT_REST = 0.02


@dataclass(frozen=True)
class FrictionStates:
    """What one pad went through.

    Attributes:
        pad: its name.
        area: apparent area [m^2].
        pressure: (n,) [Pa].
        speed: (n,) [m/s].
        coefficient: (n,) of friction, as the model has it there [1].
        weight: (n,) what an error of the coefficient counts: load squared, by the way that is slid.
    """

    pad: str
    area: float
    pressure: Array
    speed: Array
    coefficient: Array
    weight: Array


def states_of_replay(model: Model, answer: Replay) -> list[FrictionStates]:
    """Return the states of every pad in a replay of the model.

    Args:
        model: without faults of gauges, which would be in the record.
        answer: its replay.
    """
    record, specimen = answer.record, model.built_specimen()
    places = np.array(specimen.pad_places)
    turning = np.gradient(record["yaw"], record.time)[:, None]
    slip = np.stack([record["slip_x"], record["slip_y"]], axis=1)[:, None, :] + np.zeros((1, len(places), 1))
    slip[:, :, 0] -= record["yaw"][:, None] * places[:, 1]
    slip[:, :, 1] += record["yaw"][:, None] * places[:, 0]
    velocity = np.stack([record["slip_vx"], record["slip_vy"]], axis=1)[:, None, :] + np.zeros((1, len(places), 1))
    velocity[:, :, 0] -= turning * places[:, 1]
    velocity[:, :, 1] += turning * places[:, 0]
    load = np.stack([record[f"pad_{pad}_N"] for pad in specimen.pads], axis=1)
    of_rig = (np.gradient(record["pitch"], record.time), np.gradient(record["table_dx"], record.time))
    motion = np.stack([*of_rig, record["table_ax"]], axis=1)
    return _states(model, specimen.pads, record.time, load, velocity, slip, motion)


def states_of_campaign(model: Model, campaign: Campaign) -> list[FrictionStates]:
    """Return the states of every pad in all runs of a campaign, prepared, one entry for each pad and run.

    Raises:
        InputError: no run has slip and loads.
    """
    found: list[FrictionStates] = []
    for run in campaign.runs:
        if "slip_x" not in run.record:
            continue
        states = measured_states(run, campaign)
        kinematics = (states.load, states.pad_velocity, states.pad_slip, rig_motion(states))
        found += _states(model, tuple(states.pads), states.time, *kinematics)
    if not found:
        raise InputError(
            f"campaign {campaign.name}: no run has slip (slip_x), without which no speed of a pad is known"
        )
    return found


def _states(
    model: Model, pads: tuple[str, ...], time: Array, load: Array, velocity: Array, slip: Array, motion: Array
) -> list[FrictionStates]:
    """Drive the model's laws by loads (n, k), slip rates and slips (n, k, 2); one entry for each pad."""
    law = predictor(model)
    bound = law.pads(time, load, velocity, slip, pads, motion if law.asks_for_motion else None).bound
    specimen = model.built_specimen()
    speed, found = np.hypot(*np.moveaxis(velocity, 2, 0)), []
    for column, pad in enumerate(pads):
        area = specimen.pad_areas[specimen.pads.index(pad)]
        of_pad, slid = load[:, column], speed[:, column]
        kept = np.isfinite(of_pad) & np.isfinite(bound[:, column]) & (of_pad > 0.0)
        of_pad, slid = of_pad[kept], slid[kept]
        weight = of_pad**2 * (slid + _AT_REST * slid.max(initial=0.0))
        found.append(FrictionStates(pad, area, of_pad / area, slid, bound[kept, column] / of_pad, weight))
    return found
