"""The replay as a user meets it: settings, provenance, summary, and what it refuses."""

import json
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from slipwise.errors import SettingError
from slipwise.model import base_model, use
from slipwise.motion import load_motion
from slipwise.record import read_record, write_record
from slipwise.simulation.kernel import installed, kernel
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import SimulationDiverged, simulate


def test_a_record_says_what_it_was_made_from(tmp_path):
    motion = load_motion("sine:2Hz,0.3g,cycles=9")
    answer = replay(base_model("bridge1"), motion)
    write_record(answer.record, tmp_path / "record.parquet")
    back = read_record(tmp_path / "record.parquet")
    assert back.provenance["rig"] == "bridge1"
    assert back.provenance["model"]["shear_rate"]["slow"] == 0.046
    assert back.provenance["motion"]["treatment"]
    assert back.provenance["mujoco"] == mujoco.__version__
    assert set(back.channels) == set(answer.record.channels)
    assert np.array_equal(back["pad_C_N"], answer.record["pad_C_N"])


def test_a_file_names_unit_sign_and_place_of_every_channel(tmp_path):
    import pyarrow.parquet as pq

    answer = replay(base_model("bridge1"), load_motion("sine:2Hz,0.1g,cycles=9"))
    write_record(answer.record, tmp_path / "record.parquet")
    for field in pq.read_schema(tmp_path / "record.parquet"):
        assert {b"unit", b"sign", b"place"} <= set(field.metadata)


def test_the_summary_reads_a_sine_over_its_last_four_full_cycles():
    motion = load_motion("sine:2Hz,0.3g,cycles=40")
    answer = replay(base_model("bridge1"), motion)
    numbers = answer.summary(motion)
    assert numbers["slip_x_half_range_mm"] == pytest.approx(14.4045, rel=0.005)
    assert numbers["energy_kN_cm"] == pytest.approx(sum(p["energy_kN_cm"] for p in numbers["pads"].values()))
    assert numbers["uplift_s"] == 0.0
    assert abs(numbers["energy_balance_error"]) < 0.002
    json.dumps(numbers, allow_nan=False)


def test_a_motion_of_another_step_is_fitted_to_the_simulations():
    coarse = load_motion("sine:2Hz,0.3g,cycles=12")
    usual = replay(base_model("bridge1"), coarse)
    answer = replay(base_model("bridge1"), coarse, dt=2.5e-4, output_dt=1e-3)
    assert answer.record.dt == pytest.approx(1e-3)
    assert np.ptp(answer.record["slip_x"]) == pytest.approx(np.ptp(usual.record["slip_x"]), rel=0.005)


def test_memory_goes_on_from_one_run_to_the_next_and_a_rest_acts_on_it():
    model = base_model("bridge1").adding(use("run_in"), use("heating"))
    motion = load_motion("sine:2Hz,0.3g,cycles=12")
    first = replay(model, motion)
    again = replay(model, motion, start=first.memory)
    rested = replay(model, motion, start=first.memory, rest=3600.0)
    energy = [sum(r.pad_energy.values()) for r in (first, again, rested)]
    assert len({round(e, 3) for e in energy}) == 3
    fresh = replay(model, motion)
    assert sum(fresh.pad_energy.values()) == energy[0]


def test_a_simulation_that_runs_away_is_stopped_and_keeps_its_record():
    shaking = np.zeros((20000, 3))
    shaking[4000:, 0] = 400.0
    with pytest.raises(SimulationDiverged, match=r"stopped at \d\.\d+ s.*beyond 5 m.*smaller") as caught:
        simulate(base_model("block"), shaking)
    kept = caught.value.replay.record
    assert 900 < len(kept) < 5000
    assert np.all(np.isfinite(kept["slip_x"]))


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"dt": 5e-3, "output_dt": 5e-3}, "at most"),
        ({"output_dt": 7e-4}, "multiple"),
        ({"engine": "fortran"}, "compiled, python"),
    ],
)
def test_settings_that_cannot_be_are_refused_with_what_can(settings, words):
    with pytest.raises(SettingError, match=words):
        simulate(base_model("bridge1"), np.zeros((100, 3)), **settings)


def test_callbacks_are_gone_after_a_run_and_are_never_nested():
    law = kernel()
    with installed(law), pytest.raises(SettingError, match="running in this process"), installed(law):
        pass
    assert mujoco.get_mjcb_control() is None
    assert mujoco.get_mjcb_sensor() is None
    with pytest.raises(SettingError):
        simulate(base_model("bridge1"), np.zeros((10, 3)), dt=1.0, output_dt=1.0)
    assert mujoco.get_mjcb_control() is None


def test_progress_goes_from_nothing_to_all():
    seen = []
    simulate(base_model("bridge1"), np.zeros((7000, 3)), progress=seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    assert len(seen) > 2


def test_buffers_too_stiff_for_any_step_end_the_replay_with_a_reason():
    specimen = base_model("bridge1").specimen.changed(buffer_stiffness=1e15)  # 1e9 kN/mm
    with pytest.raises(SimulationDiverged, match="MuJoCo warned that .* grew beyond all bounds"):
        replay(replace(base_model("bridge1"), specimen=specimen), load_motion("sine:2Hz,0.3g,cycles=9"))
