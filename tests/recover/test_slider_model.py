"""A model that was fitted to one slider is written, read and fitted again, whatever the slider's size."""

import numpy as np
import pytest

from slipwise.model.file import load_model, save_model
from slipwise.session.model_change import add, remove
from unit.campaign.slider import HEADER, RUNS

pytestmark = pytest.mark.slow


def test_a_slow_and_small_slider_keeps_its_model(tmp_path):
    """A millimetre in minutes under a few newtons: no number is within the bounds of the reference rig."""
    rng = np.random.default_rng(11)
    (tmp_path / "campaign.toml").write_text(f'name = "creep"\nrig = "pad"\n[specimen]\npad_radius = "2 mm"\n{RUNS}')
    for name, seconds in (("one", 200.0), ("two", 300.0)):
        time = np.arange(0.0, 4.0 * seconds, seconds / 400.0)
        slip = 0.5 * np.sin(2.0 * np.pi * time / seconds)
        rate = np.gradient(slip, time)
        load = 2e-3 + 1e-5 * rng.standard_normal(len(time))
        force = load * 0.3 * np.tanh(rate / 1e-4) * (1.0 + 0.2 * np.exp(-np.abs(rate) / 4e-3))
        force += 2e-6 * rng.standard_normal(len(time))
        rows = np.stack([time, slip + 1e-4 * rng.standard_normal(len(time)), load, force], axis=1)
        np.savetxt(tmp_path / f"{name}.csv", rows, fmt="%.9g", delimiter=",", header=HEADER, comments="")
    added = add("breakaway", tmp_path)
    save_model(added.model, tmp_path / "model.toml")
    again = load_model(tmp_path / "model.toml")
    for use, other in zip(added.model.uses, again.uses, strict=True):
        assert other.values == pytest.approx(dict(use.values), rel=1e-9)
    removed = remove("breakaway", tmp_path, again)
    assert removed.before["pads"] == pytest.approx(added.after["pads"], rel=0.05)
    assert removed.after["pads"] == pytest.approx(added.before["pads"], rel=0.01)  # and back to where it was
