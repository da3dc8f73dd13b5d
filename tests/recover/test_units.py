"""The same slider in other units of time, length and force: the same names, as sure, and sizes that scale with them."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise.units import powers_of
from unit.campaign.slider import HEADER, RUNS

pytestmark = pytest.mark.long

#: Times, lengths and forces over those of the first campaign.
SYSTEMS = [(1e3, 1.0, 1e3), (1.0, 1e-3, 1.0), (1e-3, 1e2, 0.1)]


def damped_bristle(seed: int, frequency: float) -> np.ndarray:
    """Give time [s], slip [mm], load [kN] and friction [kN] that reverses over 2 mm and falls with speed, (n, 4)."""
    rng = np.random.default_rng(seed)
    fine = np.arange(0.0, 6.0, 1e-4)
    slip = 15.0 * np.sin(2.0 * np.pi * frequency * fine)
    bound = 1.2 + 0.3 * np.exp(-np.abs(np.gradient(slip, fine)) / 5.0)
    share = np.zeros(len(fine))
    for i, step in enumerate(np.diff(slip), start=1):
        share[i] = np.sign(step) + (share[i - 1] - np.sign(step)) * np.exp(-abs(step) / 2.0)
    every = slice(None, None, 50)
    noise = rng.standard_normal((3, len(fine[every])))
    load, force = 10.0 + 0.02 * noise[0], (bound * share)[every] + 0.005 * noise[1]
    return np.stack([fine[every], slip[every] + 0.005 * noise[2], load, force], axis=1)


@cache
def found_in(folder: Path, time: float, length: float, force: float) -> Diagnosis:
    radius = 0.01 * length  # a rig may be no larger than 10 m, and no smaller than 10 um
    specimen = f'[specimen]\npad_radius = "{radius:.12g} m"\n'
    folder.mkdir()
    (folder / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{specimen}{RUNS}')
    for name, seed, frequency in (("one", 1, 0.5), ("two", 2, 0.7)):
        rows = damped_bristle(seed, frequency) * [time, length, force, force]
        np.savetxt(folder / f"{name}.csv", rows, fmt="%.12g", delimiter=",", header=HEADER, comments="")
    return diagnose(load_campaign(folder))


@pytest.mark.parametrize(("time", "length", "force"), SYSTEMS)
def test_an_answer_does_not_depend_on_the_units_of_a_test(tmp_path_factory, time, length, force):
    home = tmp_path_factory.getbasetemp()
    first = found_in(home / "units_first", 1.0, 1.0, 1.0)
    other = found_in(home / f"units_{time:g}_{length:g}_{force:g}", time, length, force)
    assert set(other.verdict.effects) == set(first.verdict.effects) and other.verdict.kind == first.verdict.kind
    assert other.verdict.minor == first.verdict.minor
    assert other.verdict.probability == pytest.approx(first.verdict.probability, abs=0.01)
    assert other.base_error == pytest.approx(first.base_error, rel=0.01)
    scales = {"meter": length, "second": time, "newton": force, "pascal": force / length**2}
    for key, before in first.candidates[0].parameters.items():
        after = other.candidates[0].parameters[key]
        factor = np.prod([scales.get(name, 1.0) ** power for name, power in powers_of(before.unit).items()])
        if np.isfinite(before.low) and before.low < before.value < before.high:
            assert after.value == pytest.approx(factor * before.value, abs=factor * 0.02 * (before.high - before.low))
