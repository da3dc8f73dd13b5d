"""Numbers that are off come back where the replay of the whole rig agrees with what was measured."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run
from slipwise.comparison.refinement import refine
from slipwise.errors import InputError, SettingError, UnknownNameError
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.model import base_model, use
from slipwise.motion import load_motion
from slipwise.record import Record
from slipwise.rig import load_specimen
from slipwise.signals.filters import LowPass, lowpass
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import DT

LOGGER = LowPass(100.0)
CHANNELS = (
    "table_ax",
    "table_az",
    "girder_ax",
    "girder_az",
    "slip_x",
    *(f"pad_{p}_{k}" for p in "ABCD" for k in ("N", "Fx")),
)


@pytest.fixture(scope="module")
def fitted() -> BaseFit:
    """A girder whose pads run in, measured under two motions, the second of them held out; all numbers right."""
    rng = np.random.default_rng(1)
    model, memory, runs = base_model("bridge1").adding(use("run_in", rise=0.3, distance=0.2)), None, []
    for name, role, text in (
        ("sine", "fit", "sine:2Hz,0.3g,cycles=9,vertical=5Hz,0.2g"),
        ("slower", "holdout", "sine:1.5Hz,0.25g,cycles=9,vertical=5Hz,0.2g"),
    ):
        answer = replay(model, load_motion(text), output_dt=DT, start=memory)
        memory = answer.memory
        seen = {c: lowpass(answer.record[c], DT, LOGGER)[::4] for c in CHANNELS}
        seen = {c: v + 0.005 * np.std(v) * rng.standard_normal(len(v)) for c, v in seen.items()}
        runs.append(Run(name, role, Record(answer.record.time[::4], seen), 0.0, None, name, name))
    campaign = Campaign("planted", "bridge1", model.specimen, Logger(LOGGER, known=True), tuple(runs), Path())
    base = fit_base(campaign, model)
    truth = {f.key: f.start for f in base.free if not f.key.startswith(("rig.late", "rig.pitch"))}
    return replace(
        base, solution=replace(base.solution, values={**base.solution.values, **truth, "rig.stick_length": 0.0})
    )


def off(base: BaseFit, **shares: float) -> BaseFit:
    values = {**base.solution.values, **{k: base.solution.values[k] * s for k, s in shares.items()}}
    return replace(base, solution=replace(base.solution, values=values))


@pytest.mark.slow
def test_numbers_some_percent_off_are_recovered_from_the_replay(fitted: BaseFit) -> None:
    wrong = off(fitted, **{"run_in.rise": 0.85, "rig.buffer_stiffness": 1.06})
    found = refine(wrong, ("run_in.rise", "rig.buffer_stiffness"))
    values = {e.key: e.value for e in found.entries}
    assert values["run_in.rise"] == pytest.approx(0.3, rel=0.03)
    assert values["rig.buffer_stiffness"] == pytest.approx(sum(fitted.model.specimen.buffer_stiffness), rel=5e-3)
    assert found.after < 0.5 * found.before
    assert found.held_out is not None
    assert found.held_out[1] < 0.5 * found.held_out[0]
    assert found.model["run_in"].values["rise"] == values["run_in.rise"]


def test_a_number_of_the_specimen_may_differ_from_copy_to_copy(fitted: BaseFit) -> None:
    found = refine(off(fitted, **{"rig.mass": 1.04}), ("rig.mass",), rounds=4)
    assert found.entries[0].value == pytest.approx(1e4, rel=2e-3)


@pytest.mark.parametrize(
    ("keys", "error", "words"),
    [
        ((), SettingError, "nothing to refine"),
        (("rig.late_force",), SettingError, "belongs to the measurement"),
        (("run_in.ris",), UnknownNameError, "run_in.rise"),
    ],
)
def test_what_a_replay_does_not_have_is_refused_with_what_it_has(
    fitted: BaseFit, keys: tuple[str, ...], error: type[Exception], words: str
) -> None:
    with pytest.raises(error, match=words):
        refine(fitted, keys)


def test_a_rig_whose_slip_is_prescribed_cannot_be_replayed(fitted: BaseFit) -> None:
    prescribed = replace(fitted, model=replace(fitted.model, specimen=load_specimen("pad")))
    with pytest.raises(InputError, match="slip prescribed"):
        refine(prescribed, ("run_in.rise",))
