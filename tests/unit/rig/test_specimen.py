"""The rated values, as the MJCF files hold them, are the paper's."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from slipwise.errors import SettingError, UnknownNameError
from slipwise.rig import RIGS, Readings, build, largest_step, load_specimen, pad_frequencies, read_paper, similarity
from slipwise.rig.files import find_rig


@pytest.mark.parametrize("rig", ["bridge1", "bridge2"])
def test_the_girder_weighs_ten_tons_and_presses_its_pads_with_16_9_megapascal(rig):
    specimen = load_specimen(rig)
    assert specimen.mass == 10_000.0
    assert specimen.pad_radius == pytest.approx(0.043 / 2)
    assert specimen.rated_pressure / 1e6 == pytest.approx(16.9, abs=0.05)


@pytest.mark.parametrize(
    ("rig", "stiffness", "frequency", "ratio"), [("bridge1", 3.46, 2.96, 0.122), ("bridge2", 2.25, 2.39, 0.244)]
)
def test_buffers_frequency_and_height_are_the_papers(rig, stiffness, frequency, ratio):
    specimen = load_specimen(rig)
    assert sum(specimen.buffer_stiffness) / 1e6 == pytest.approx(stiffness, abs=0.005)
    assert specimen.frequency == pytest.approx(frequency, abs=0.005)
    assert specimen.slenderness == pytest.approx(ratio, abs=1e-9)


@pytest.mark.parametrize("rig", RIGS)
def test_every_rated_value_names_its_source_or_says_assumed(rig):
    specimen = load_specimen(rig)
    needed = {
        "mass",
        "centre_height",
        "inertia",
        "pad_radius",
        "pad_stiffness",
        "pad_damping",
        "plastic_pressure",
        "shear_strength",
    }
    if specimen.buffer_stiffness:
        needed |= {"buffer_stiffness", "buffer_place", "buffer_height"}
    assert needed <= set(specimen.sources)
    assert all(text.startswith(("paper", "assumed", "1/k")) for text in specimen.sources.values())


@pytest.mark.parametrize("rig", RIGS)
def test_the_file_runs_in_a_plain_viewer_without_slipwise(rig):
    model = mujoco.MjModel.from_xml_path(str(find_rig(rig)))
    data = mujoco.MjData(model)
    for _ in range(2000):
        mujoco.mj_step(model, data)
    assert np.abs(data.qpos).max() < 1e-3
    assert data.ncon == len(load_specimen(rig).pads)
    assert all(w.number == 0 for w in data.warning)


@pytest.mark.parametrize("rig", ["bridge1", "bridge2", "block"])
def test_pads_are_springs_of_the_stated_stiffness_and_damping(rig):
    specimen = load_specimen(rig).changed(pad_stiffness=150e6, pad_damping=2 * 0.03 * np.sqrt(150e6 * 2500.0))
    rig_model = build(specimen, 1e-4, 1)
    assert rig_model.sag == pytest.approx(1e4 * 9.80665 / 4 / 150e6, rel=1e-12)
    data = mujoco.MjData(rig_model.model)
    data.joint("girder_z").qpos[0] = -rig_model.sag + 1e-5
    above = []
    for _ in range(6000):
        mujoco.mj_step(rig_model.model, data)
        above.append(data.joint("girder_z").qpos[0] + rig_model.sag)
    above = np.array(above)
    crossings = np.flatnonzero((above[:-1] < 0) & (above[1:] >= 0))
    exact = crossings + above[crossings] / (above[crossings] - above[crossings + 1])
    frequency = 1.0 / (np.diff(exact[:8]).mean() * 1e-4)
    assert frequency == pytest.approx(pad_frequencies(specimen)["heave"] * np.sqrt(1 - 0.03**2), rel=0.002)
    peaks = [above[i] for i in range(1, 5999) if above[i] > above[i - 1] and above[i] >= above[i + 1]][:8]
    decrement = np.log(peaks[0] / peaks[6]) / 6
    assert decrement / np.sqrt(4 * np.pi**2 + decrement**2) == pytest.approx(0.03, rel=0.01)


def test_a_step_too_large_for_the_pads_is_refused_with_the_largest_allowed():
    specimen = load_specimen("bridge1")
    with pytest.raises(SettingError, match=r"at most \d\.\d+ ms"):
        build(specimen, 0.002, 1)
    build(specimen, largest_step(specimen) * 0.999, 1)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"buffer_stiffness": (1e6,) * 4}, "4 values of buffer_stiffness and 2 buffers"),
        ({"seating": (0.0,)}, "1 values of seating"),
        ({"pad_places": ((np.nan, 0.0),) * 4}, "pad_places = nan m cannot be"),
        ({"inertia": (1.0, -1.0, 1.0)}, "inertia = -1 kg m\\^2 cannot be"),
    ],
)
def test_values_that_do_not_belong_together_are_refused(values, words):
    with pytest.raises(SettingError, match=words):
        load_specimen("bridge1").changed(**values)


def test_pads_too_soft_to_carry_the_girder_are_refused():
    with pytest.raises(SettingError, match="would sink 24.5166 mm into its pads"):
        build(load_specimen("bridge1").changed(pad_stiffness=1e6), 5e-4, 0)


def test_an_unknown_rig_is_answered_with_the_nearest():
    with pytest.raises(UnknownNameError, match="bridge1"):
        load_specimen("bridg1")


def test_the_default_reading_of_the_paper_is_what_the_files_hold():
    for rig in ("bridge1", "bridge2"):
        read, file = read_paper(rig), load_specimen(rig)
        assert read.buffer_stiffness == pytest.approx(file.buffer_stiffness, rel=1e-9)
        assert read.changed(buffer_stiffness=file.buffer_stiffness) == file


def test_other_readings_change_what_they_say():
    assert read_paper("bridge1", Readings(shake_axis="length")).centre_height == pytest.approx(0.61)
    assert read_paper("bridge2", Readings(shake_axis="length")).centre_height == pytest.approx(1.22)
    assert read_paper("bridge1", Readings(b_means="width", shake_axis="length")).centre_height == pytest.approx(0.366)
    assert read_paper("bridge1", Readings(pad_spacing_x=2.0)).slenderness == pytest.approx(0.122)
    half = read_paper("bridge1", Readings(stiffness_means="total"))
    assert 1 / half.frequency == pytest.approx(0.4776, abs=5e-5)
    assert 1 / read_paper("bridge1", Readings(stiffness_of="model")).frequency == pytest.approx(0.103, abs=5e-4)
    with pytest.raises(UnknownNameError, match="each"):
        Readings(stiffness_means="every")
    with pytest.raises(SettingError, match="bridge2"):
        read_paper("pad")


def test_similarity_gives_the_scales_of_both_prototypes():
    one, two = similarity(10.69), similarity(12.17)
    assert (one.time, one.mass, one.stiffness, one.energy) == pytest.approx((3.2696, 114.28, 10.69, 1221.6), rel=5e-5)
    assert (two.velocity, two.force, two.length, two.energy) == pytest.approx((3.4886, 148.11, 12.17, 1802.5), rel=5e-5)
    assert one.acceleration == one.pressure == 1.0
    assert load_specimen("bridge1").mass * one.mass == pytest.approx(1143e3, rel=1e-3)
    assert 2 * load_specimen("bridge2").pad_radius * two.length == pytest.approx(0.523, abs=5e-4)


def test_a_girder_that_bends_pitches_and_rolls_as_a_rigid_one():
    """The first vertical mode is even about the middle, pitch is odd: by symmetry they share no inertia."""
    rigid = load_specimen("bridge1")
    bending = replace(rigid, bending_mass=0.3 * rigid.mass)
    turning = []
    for specimen in (rigid, bending):
        rig = build(specimen, 5e-4, 0)
        data = mujoco.MjData(rig.model)
        mujoco.mj_forward(rig.model, data)
        whole = np.zeros((rig.model.nv, rig.model.nv))
        mujoco.mj_fullM(rig.model, data, whole)
        at = [int(rig.model.joint(f"girder_{name}").dofadr[0]) for name in ("roll", "pitch", "yaw")]
        turning.append(np.diag(whole)[at])
    assert turning[1] == pytest.approx(turning[0], rel=1e-6)
    assert turning[0] == pytest.approx(rigid.inertia, rel=1e-6)
