"""One slider whose logger nobody knows: its pre-sliding is named, and its error falls on a run that no fit has seen."""

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.diagnosis.diagnose import diagnose
from unit.campaign.slider import HEADER, RUNS, text

pytestmark = pytest.mark.slow

LENGTH = 2.0  # mm


def bristle(seed: int, frequency: float) -> np.ndarray:
    """Give time [s], slip [mm], load [kN] and Dahl's friction [kN], dF/dx = (1 - F sgn v / F_b) F_b / u, (n, 4)."""
    rng = np.random.default_rng(seed)
    fine = np.arange(0.0, 6.0, 1e-4)
    slip = 15.0 * np.sin(2.0 * np.pi * frequency * fine)
    share = np.zeros(len(fine))
    for i, step in enumerate(np.diff(slip), start=1):
        share[i] = np.sign(step) + (share[i - 1] - np.sign(step)) * np.exp(-abs(step) / LENGTH)
    every = slice(None, None, 50)
    noise = rng.standard_normal((3, len(fine[every])))
    load, force = 10.0 + 0.02 * noise[0], 1.2 * share[every] + 0.005 * noise[1]
    return np.stack([fine[every], slip[every] + 0.005 * noise[2], load, force], axis=1)


def test_the_presliding_of_a_slider_is_named(tmp_path):
    (tmp_path / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{RUNS}')
    (tmp_path / "one.csv").write_text(text(bristle(1, 0.5), HEADER))
    (tmp_path / "two.csv").write_text(text(bristle(2, 0.7), HEADER))
    found = diagnose(load_campaign(tmp_path))
    assert found.verdict.effects == ("presliding",)
    values = {key.rpartition(".")[2]: i.value for key, i in found.candidates[0].parameters.items()}
    length = values["length"] * (1200.0 / values["rated"]) ** values["growth"]  # one load does not tell the two apart
    assert length == pytest.approx(1e-3 * LENGTH, rel=0.03)
    assert found.final_error < 0.3 * found.base_error


def test_a_slider_is_followed_from_a_record_that_begins_under_friction(tmp_path):
    """Full of friction one way, then the other: nothing before the record is known, but its first force is."""
    (tmp_path / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{RUNS}')
    for name, seed, frequency, begin in (("one", 1, 0.5, 0.9), ("two", 2, 0.7, 1.7)):
        rows = bristle(seed, frequency)
        (tmp_path / f"{name}.csv").write_text(text(rows[rows[:, 0] >= begin], HEADER))
    found = diagnose(load_campaign(tmp_path))
    assert found.verdict.effects == ("presliding",)
    for run, left in zip(found.final.objective.runs, found.final.solution.residuals.pad_forces, strict=True):
        off = np.abs(run.force - left)[:, 0]
        assert abs(run.force[0, 0]) > 1000.0
        assert off[: len(off) // 20].max() < 60.0


@pytest.mark.parametrize(("share", "named"), [(0.03, False), (0.15, True)])
def test_the_zero_of_a_sliders_gauge_is_nobodys_effect_unless_it_is_far_off(tmp_path, share, named):
    """A twentieth of its friction is what an actuator's cell may be off by; more is an offset or an asymmetry."""
    (tmp_path / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{RUNS}')
    for name, seed, frequency in (("one", 1, 0.5), ("two", 2, 0.7)):
        rows = bristle(seed, frequency)
        rows[:, 3] += 1.2 * share
        (tmp_path / f"{name}.csv").write_text(text(rows, HEADER))
    found = diagnose(load_campaign(tmp_path))
    assert found.verdict.effects[0] == "presliding"
    assert bool({"channel_offset", "direction_asymmetry"} & set(found.verdict.effects)) == named
    zero = found.final.solution.values.get("rig.zero_force", 0.0)
    assert zero == (0.0 if named else pytest.approx(1200.0 * share, rel=0.1))
    assert any("gauge's zero" in reason for reason in found.cannot_tell) != named
    off = [
        float(np.std(r.force - f))
        for r, f in zip(found.final.objective.runs, found.final.solution.residuals.pad_forces, strict=True)
    ]
    assert max(off) < 30.0
