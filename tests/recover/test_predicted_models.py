"""Models by which an office predicted a campaign are read back from their runs, and told what they lack."""

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.prediction.judge import judge_prediction
from slipwise_benchmarks.campaign import draw_motions
from slipwise_benchmarks.gauges import USUAL, Logger, measure
from slipwise_benchmarks.motions import NATURAL
from slipwise_benchmarks.rig_ode import simulate
from slipwise_benchmarks.settings import GRAVITY, PAD_AREA, random_rig
from slipwise_benchmarks.write import write_campaign, write_csv

ROLES = (("sine_hv", "fit"), ("quake_hv", "fit"), ("quake2_hv", "holdout"))
WRITTEN = ("time", *(name for name in USUAL if not name.startswith("table")))
RNG = np.random.default_rng(4)
RIG = random_rig("bridge1", RNG).changed(clearance=1.0e-3)
_PRESSURE = RIG.mass * GRAVITY / 4.0 / PAD_AREA
#: What speed adds to the coefficient of friction at the pressure at rest.
_ADDED = RIG.s1 * (1.0 - np.exp(-RIG.k * _PRESSURE)) / _PRESSURE
#: Model -> its rig, the law that it has, what it lacks and which of its numbers are off.
MODELS = {
    "coulomb": (
        RIG.changed(s1=1.0, alpha=RIG.alpha + 0.8 * _ADDED), "coulomb",
        {"speed dependence", "pressure dependence"}, set(),
    ),
    "rate dependent": (RIG.changed(k=1e-9, s1=_ADDED / 1e-9), "speed", {"pressure dependence"}, set()),
    "constant load": (
        RIG.changed(k=1e-4, s1=(_ADDED + RIG.alpha) * _PRESSURE, alpha=0.0), "speed at constant load",
        {"friction that follows the load"}, {"friction"},
    ),
    "wrong gap": (RIG.changed(clearance=2.0e-3), "speed and pressure", set(), {"key_clearance.clearance"}),
    "wrong mass": (RIG.changed(mass=1.1 * RIG.mass), "speed and pressure", set(), {"rig.mass"}),
    "right": (RIG, "speed and pressure", set(), set()),
}  # fmt: skip


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    """The campaign, its diagnosis, and the folder in which each model's predictions lie."""
    drawn = draw_motions(NATURAL["bridge1"], RIG, RNG, False)
    motions = {name: drawn[name] for name, _ in ROLES}
    folder = tmp_path_factory.mktemp("models")
    recorded = {n: measure(simulate(RIG, m), USUAL, Logger(), [], RNG, i) for i, (n, m) in enumerate(motions.items())}
    write_campaign(folder / "measured", "bridge1", Logger(), recorded, ROLES)
    for model, (rig, *_) in MODELS.items():
        (folder / model).mkdir()
        for name, motion in motions.items():
            true = simulate(rig, motion)
            write_csv(folder / model / f"{name}.csv", {key: true[key][::10] for key in WRITTEN})
    measured = load_campaign(folder / "measured")
    return measured, diagnose(measured), folder


@pytest.mark.long
@pytest.mark.parametrize("model", MODELS)
def test_a_model_is_read_back_and_what_it_lacks_is_named(campaign, model):
    measured, found, folder = campaign
    _, law, lacks, off = MODELS[model]
    judged = judge_prediction(measured, folder / model, found=found)
    assert judged.law.family.name == law
    assert judged.effects == ("key_clearance",)
    assert set(judged.lacks) == lacks
    assert set(judged.off) >= off and (off or not judged.off or lacks)
    worst = list(judged.worst.values())
    assert worst[-1] < 1.15 and (worst[0] > 2.0 if lacks or off else worst[0] < 1.15)
