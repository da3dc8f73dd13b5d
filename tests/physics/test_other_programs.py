"""The rig against answers of programs that are not ours; numbers from ../shared/reference."""

import gzip
from pathlib import Path

import numpy as np
import pytest

from shaking import coulomb, needs_shared, shaken
from slipwise.effects import load_effect
from slipwise.model import base_model, use

DT = 5e-4


def low_block(mu, gravity=9.81):
    """A block that neither rocks nor feels P-delta, as the other programs' one degree of freedom."""
    return coulomb("block", mu, centre_height=1e-3, pads_on="girder", gravity=gravity)


def between_samples(samples, dt, seconds):
    """Straight lines between samples, as the other program took them."""
    t = np.arange(round(seconds / DT)) * DT
    out = np.zeros((len(t), 3))
    for axis, values in samples.items():
        out[:, axis] = np.interp(t, np.arange(len(values)) * dt, values)
    return out


def reference(name):
    path = needs_shared("reference", name)
    opener = gzip.open if path.suffix == ".gz" else open
    with opener(path, "rt") as stream:
        return np.loadtxt(stream, delimiter=",", comments="#")


@pytest.mark.parametrize(("mu", "metres"), [(0.05, 0.4876), (0.10, 0.3245)])
def test_sylmar_on_a_coulomb_block_slides_as_far_as_opensees_says(mu, metres):
    motion = np.loadtxt(needs_shared("motions", "dat_two_column", "Northridge_Sylmar_County.dat"))
    answer = reference(f"sylmar_h_coulomb_mu{mu:.2f}.csv")
    assert np.abs(answer[:, 1]).max() == pytest.approx(metres, abs=1e-4)
    record = shaken(low_block(mu), between_samples({0: motion[:, 1]}, 0.02, motion[-1, 0])).record
    assert np.abs(record["slip_x"]).max() == pytest.approx(metres, rel=0.01)


def tcu065():
    folder = needs_shared("motions", "peer_ath_column")
    east, up = (np.loadtxt(Path(folder) / f"TCU065-{c}.ATH")[3000:12000] * 9.80665 for c in ("E", "V"))
    return between_samples({0: east, 2: up}, 0.005, 9000 * 0.005)


def test_tcu065_with_its_vertical_part_slides_a_coulomb_block_as_far():
    answer = reference("tcu065_EV_coulomb_mu0.10.csv.gz")
    record = shaken(low_block(0.10), tcu065()).record
    assert np.abs(record["slip_x"]).max() == pytest.approx(np.abs(answer[:, 1]).max(), rel=0.03)


VEL_PRESSURE_DEP = '''"""Another program's law: mu = fast - (fast - slow) exp(-rate v), fast = fast0 - drop tanh(eps P).

Valid: as a reference case only.
Source: the first line of the reference file.
"""
from math import exp, tanh
from slipwise.effects import Effect, ForDiagnosis, Rare
from slipwise.params import Parameter

def shear(load, real_area, pressure, speed, slow):
    fast = 0.12 - 0.05 * tanh(0.05e-6 * pressure)
    return (fast - (fast - slow) * exp(-20.0 * speed)) * load / real_area

EFFECT = Effect(port="shear", contract=1,
    parameters=(Parameter("slow", "1", 0.05, 0.0, 1.0, None, "the reference file", "friction at zero speed"),),
    diagnosis=ForDiagnosis("pad friction", "mu(P, v)", moves=("*",), signature="another program's", confused_with={}),
    rare=Rare(replaces="constant shear strength"))
'''


@pytest.mark.long
def test_tcu065_with_a_law_of_speed_and_pressure_slides_as_far(tmp_path):
    answer = reference("tcu065_EV_velpressuredep.csv.gz")
    path = tmp_path / "vel_pressure_dep.py"
    path.write_text(VEL_PRESSURE_DEP)
    block = low_block(0.1).specimen
    block = block.changed(pad_radius=float(np.sqrt(5.8088e-3 / 4 / np.pi)))
    record = shaken(base_model(block, (use(load_effect(path)),)), tcu065()).record
    assert np.abs(record["slip_x"]).max() == pytest.approx(np.abs(answer[:, 1]).max(), rel=0.03)
