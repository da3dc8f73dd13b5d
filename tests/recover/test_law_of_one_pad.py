"""Pads whose law differs: a pad's own values replay, predict as they replay, and are found again by a fit."""

from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from measured import fit_base
from recover.own_replay import campaign_of
from shaking import shaken
from slipwise.estimation.intervals import compute_intervals
from slipwise.model import Model, base_model
from slipwise.simulation.predict import predictor

#: Pad C of bridge1 has the friction of an old batch, 12 % less.
WEAK = 0.88


def of_another_batch(rig: str = "bridge1", pad: str = "C") -> Model:
    model = base_model(rig)
    return model.setting("shear_rate", **{f"strength[{pad}]": WEAK * model["shear_rate"].values["strength"]})


@pytest.mark.parametrize("engine", ["compiled", "python"])
def test_the_law_driven_by_what_a_replay_measures_answers_as_the_replay(engine: str) -> None:
    model = of_another_batch("six_pads", "E")
    pads = model.specimen.pads
    table = np.zeros((600 if engine == "python" else 2000, 3))
    table[:, 0] = 6.0 * np.sin(2 * np.pi * 4.0 * 5e-4 * np.arange(len(table)))
    record = shaken(model, table, engine=engine).record
    load = record.stacked("pad_{}_N", pads)
    places = np.array(model.specimen.pad_places)
    yaw, turning = record["yaw"], np.gradient(record["yaw"], record.dt)
    slip = np.stack([record["slip_x"][:, None] - places[:, 1] * yaw[:, None],
                     record["slip_y"][:, None] + places[:, 0] * yaw[:, None]], axis=2)  # fmt: skip
    rate = np.stack([record["slip_vx"][:, None] - places[:, 1] * turning[:, None],
                     record["slip_vy"][:, None] + places[:, 0] * turning[:, None]], axis=2)  # fmt: skip
    answer = predictor(model, engine=engine).pads(record.time, load, rate, slip)
    slides = np.abs(record["slip_vx"]) > 0.05
    assert slides.sum() > 100
    force = record.stacked("pad_{}_Fx", pads)
    assert np.abs(answer.force[:, :, 0] - force)[slides].max() < 1e-3 * np.abs(force).max()
    alike = predictor(base_model("six_pads"), engine=engine).pads(record.time, load, rate, slip)
    less = answer.bound[slides] / alike.bound[slides]
    assert np.all(less[:, pads.index("E")] < 0.95) and np.all(np.delete(less, pads.index("E"), axis=1) == 1.0)


@pytest.mark.slow
def test_a_fit_finds_the_law_of_one_pad_and_says_how_sure_it_is(tmp_path: Path) -> None:
    true = of_another_batch()
    campaign = sw.load_campaign(campaign_of(tmp_path / "own", "bridge1", 100.0, model=true))
    rated = base_model(campaign.specimen)
    begun = rated.setting("shear_rate", **{"strength[C]": rated["shear_rate"].values["strength"]})
    fit = fit_base(campaign, begun)
    found = {entry.key: entry for entry in compute_intervals(fit).entries}
    strength, own = found["shear_rate.strength"], found["shear_rate.strength[C]"]
    assert own.value / strength.value == pytest.approx(WEAK, rel=0.01)
    assert not own.bound and own.low < WEAK * strength.value < own.high and own.high < 0.95 * strength.low
    plain = fit_base(campaign, rated)
    assert fit.solution.cost < 0.5 * plain.solution.cost, "one law for all pads leaves much"
    saved = fit.objective.model(fit.solution.values)
    assert saved["shear_rate"].own["C"]["strength"] == own.value


def test_a_value_for_all_pads_that_no_pad_takes_is_not_fitted(tmp_path: Path) -> None:
    campaign = sw.load_campaign(campaign_of(tmp_path / "own", "three_pads", 100.0, runs=1))
    rated = base_model(campaign.specimen)
    strength = rated["shear_rate"].values["strength"]
    every = rated.setting("shear_rate", **{f"strength[{pad}]": strength for pad in "ABC"})
    fit = fit_base(campaign, every)
    keys = [f.key for f in fit.solution.free]
    assert "shear_rate.strength" not in keys and all(f"shear_rate.strength[{pad}]" in keys for pad in "ABC")
    found = fit.objective.model(fit.solution.values)["shear_rate"]
    assert found.values["strength"] == strength
    assert [found.own[pad]["strength"] / strength for pad in "ABC"] == pytest.approx([1.0] * 3, abs=0.02)
