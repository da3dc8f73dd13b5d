"""The vertical accelerometer of a girder on curved sliders: it rises with its slip, and no gauge is wrong."""

import numpy as np

from physics.test_pendulum import pulse
from shaking import FAST, coulomb, shaken
from slipwise.relations.rigid_balances import list_rigid_balances
from slipwise.rig.curved_faces import rise_rate, risen


def test_the_upright_relation_knows_the_rise_on_a_sphere() -> None:
    model = coulomb("pendulum", FAST)
    record = shaken(model, pulse(6.0, 0.8, 3.0)).record
    upright = next(r for r in list_rigid_balances(record, model.specimen)[0] if r.name == "upright")
    assert {"slip_x", "slip_y"} <= upright.looks_at(record)
    columns = [term(record, model.specimen) for term in upright.terms.values()]
    known = upright.known(record, model.specimen)
    inner = slice(50, -50)
    matrix = np.stack(columns, axis=1)[inner]
    scale = np.abs(matrix).max(axis=0)
    left = known[inner] - matrix / scale @ np.linalg.lstsq(matrix / scale, known[inner], rcond=None)[0]
    size = np.abs(record["girder_az"]).max()
    assert size > 0.3 and np.sqrt(np.mean(left**2)) < 0.02 * size


def test_the_rise_is_that_of_the_replay_and_its_rate_is_the_slope_times_the_speed() -> None:
    model = coulomb("pendulum", FAST)
    record = shaken(model, pulse(6.0, 0.8, 3.0)).record
    slip, velocity = (np.stack([record[f"slip_{v}{a}"] for a in "xy"], axis=1) for v in ("", "v"))
    loads = record.stacked("pad_{}_N", model.specimen.pads).sum(axis=1)
    rise = risen(slip, model.specimen)
    assert np.abs(record["heave"] + loads / sum(model.specimen.springs) - rise).max() < 2e-5
    rate = rise_rate(slip, velocity, model.specimen)
    assert np.abs(rate - np.gradient(rise, record.dt))[2:-2].max() < 0.01 * np.abs(rate).max()
