"""Motion of girder and table, known to laws of the pads: the same in a simulation and from what was measured."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run, States, measured_states
from slipwise.campaign.rig_motion import rig_motion
from slipwise.effects import RIG_MOTION, load_effect
from slipwise.model import EffectUse, base_model
from slipwise.motion import load_motion
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.simulation.predict import predictor
from slipwise.simulation.replay import replay

FILE = '''
"""A force that shows what a law is told of the rig.

    F_x += a omega + b v + c a

Valid: a test.
Source: assumed.
"""

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def pad(rocking_rate, table_velocity, table_acceleration, of_rocking_rate, of_table_velocity, of_table_acceleration):
    """Push along x [N]."""
    force = of_rocking_rate * rocking_rate + of_table_velocity * table_velocity
    return force + of_table_acceleration * table_acceleration, 0.0


EFFECT = Effect(
    contract=1,
    port="pad",
    parameters=(
        Parameter("of_rocking_rate", "N s", 0.0, -1e6, 1e6, 0.0, "assumed", "a"),
        Parameter("of_table_velocity", "N s/m", 0.0, -1e6, 1e6, 0.0, "assumed", "b"),
        Parameter("of_table_acceleration", "kg", 0.0, -1e6, 1e6, 0.0, "assumed", "c"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="F_x += a omega + b v + c a",
        moves=RESPONSE,
        signature="even",
        confused_with={},
    ),
)
'''
#: State -> a force per unit of it that hardly changes the motion.
SIZES = {"rocking_rate": 2e5, "table_velocity": 200.0, "table_acceleration": 20.0}
#: What may differ: a girder rocks at tens of hertz, of which a rate made from loads keeps less.
DIFFERS = {"rocking_rate": 0.25, "table_velocity": 0.1, "table_acceleration": 0.1}


def states_of(record: Record, specimen: Specimen) -> States:
    run = Run("one", "fit", record, None, None, "", "")
    return measured_states(run, Campaign("made", "own", specimen, Logger(), (run,), Path()))


@pytest.mark.parametrize("name", RIG_MOTION)
def test_a_law_is_told_in_a_simulation_what_its_record_tells(tmp_path: Path, name: str) -> None:
    path = tmp_path / "of_the_rig.py"
    path.write_text(FILE, encoding="utf-8")
    effect = load_effect(path)
    model = base_model("bridge2").adding(EffectUse(effect, {**effect.typical(), f"of_{name}": SIZES[name]}))
    motion = load_motion("sine:4Hz,1.2g,cycles=9,vertical=6Hz,0.3g")
    seen = replay(model, motion, dt=1e-3, output_dt=1e-3, engine="python").record
    states = states_of(seen, model.specimen)
    moved = rig_motion(states)
    place = list(RIG_MOTION).index(name)
    here = (states.time, states.load, states.pad_velocity, states.pad_slip)
    told = predictor(model, engine="python").pads(*here, motion=moved).force
    plain = predictor(base_model("bridge2"), engine="python").pads(*here).force
    np.testing.assert_allclose((told - plain)[:, 0, 0], SIZES[name] * moved[:, place], atol=1e-6 * SIZES[name])
    fast = (np.abs(states.velocity[:, 0]) > 0.1) & (states.time > 0.3)
    felt = (np.stack([seen[f"pad_{p}_Fx"] for p in "ABCD"], axis=1) - plain[:, :, 0]).mean(axis=1)[fast] / SIZES[name]
    error = np.std(felt - moved[fast, place]) / np.std(moved[fast, place])
    assert error < DIFFERS[name], f"{error:.3f} of what varies"


def test_the_law_of_a_prescribed_slider_is_told_that_nothing_moves() -> None:
    time = np.arange(200) * 0.01
    record = Record(time, {"slip_x": 0.01 * np.sin(time), "pad_A_N": np.full(200, 1e4), "pad_A_Fx": np.cos(time)})
    assert not rig_motion(states_of(record, base_model("pad").specimen)).any()
