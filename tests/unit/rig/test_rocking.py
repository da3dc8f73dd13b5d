"""Pitch and roll of a girder on uneven pads, against an integration of the two equations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import StateSpace, lsim

from slipwise.rig import Specimen, load_specimen
from slipwise.rig.rocking import coupled, rocking_modes, rolls
from slipwise.signals.pitch import pass_through_pitch

SIX = load_specimen("six_pads")


def uneven() -> Specimen:
    moved = zip(SIX.places, (0.3, 0.1, 0.0, 0.0, -0.2, 0.0), (0.0, 0.2, 0.0, 0.1, 0.0, 0.0), strict=True)
    return replace(SIX, places=tuple(replace(p, x=p.x + dx, y=p.y + dy) for p, dx, dy in moved))


@pytest.mark.parametrize("rig", ["bridge1", "three_pads", "six_pads", "pendulum"])
def test_pads_that_are_each_others_mirror_image_keep_pitch_and_roll_apart(rig):
    specimen = load_specimen(rig)
    roll, pitch = rocking_modes(specimen)
    assert not coupled(specimen) and not rolls(specimen)
    assert pitch.drive.tolist() == pitch.shown.tolist() == [0.0, 1.0] and pitch.ratio == 1.0
    assert roll.drive.tolist() == [1.0, 0.0]
    assert rolls(specimen.changed(centre_y=specimen.centre_y + 0.05))


def test_a_moment_of_pitch_shows_in_both_loads_as_an_integration_says():
    specimen, dt = uneven(), 1e-4
    assert coupled(specimen) and rolls(specimen)
    time = np.arange(20_000) * dt
    moment = 1e3 * np.exp(-(((time - 1.0) / 0.01) ** 2)) * np.sin(300.0 * time)
    arms = (np.array(specimen.pad_places) - specimen.middle)[:, ::-1]
    stiffness = (arms * np.array(specimen.springs)[:, None]).T @ arms
    inertia, slow = np.diag(specimen.inertia[:2]), specimen.pad_damping / specimen.pad_stiffness
    inverse, zero = np.linalg.inv(inertia), np.zeros((2, 2))
    a = np.block([[zero, np.eye(2)], [-inverse @ stiffness, -slow * inverse @ stiffness]])
    b = np.concatenate([np.zeros(2), inverse[:, 1]])[:, None]
    c = np.hstack([stiffness, slow * stiffness])
    own = lsim(StateSpace(a, b, c, np.zeros((2, 1))), moment, time)[1]
    squares = np.linalg.eigvals(inverse @ stiffness).real
    modes = rocking_modes(specimen)
    pitch = next(w for w in np.sqrt(squares) if np.isclose(np.sqrt(squares), modes[0].ratio * w).any())
    found = np.zeros_like(own)
    for mode in modes:
        frequency, damping = mode.ratio * pitch / (2.0 * np.pi), 0.5 * slow * mode.ratio * pitch
        found += mode.shown * pass_through_pitch(mode.drive[1] * moment, dt, frequency, damping)[:, None]
    assert np.abs(own[:, 0]).max() > 0.05 * np.abs(own[:, 1]).max()
    assert found == pytest.approx(own, abs=2e-3 * np.abs(own).max())
