"""friction = "none": pads carry the weight, buffers are the isolators, and nothing that rubs acts."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from four_pads import describe_four_pads
from slipwise.errors import InputError, SettingError, UnknownNameError
from slipwise.model import base_model, use
from slipwise.model.file import load_model, save_model
from slipwise.rig import Specimen, load_specimen
from slipwise.rig.mjcf.writer import mjcf_text
from slipwise.rig.places import Buffer
from slipwise.simulation.replay import replay
from slipwise.view.figures.loop_pictures import loops_figure

TEXT = f"""{describe_four_pads(more='friction = "none"')}
[buffers]
1 = {{ x = "1.8 m", y = "0 m", stiffness = "60 N/mm" }}
2 = {{ x = "-1.8 m", y = "0 m", stiffness = "60 N/mm" }}
"""
QUAKE = "quake:seed=2,peak=0.3g,f=1Hz,strong=4s"


def read(folder: Path, text: str = TEXT) -> Specimen:
    path = folder / "specimen.toml"
    path.write_text(text)
    return load_specimen(path)


def test_rubber_bearings_are_read_and_go_through_mjcf(tmp_path: Path) -> None:
    specimen = read(tmp_path)
    assert not specimen.slides
    (tmp_path / "rubber.xml").write_text(mjcf_text(specimen))
    assert not load_specimen(tmp_path / "rubber.xml").slides
    assert load_specimen("bridge1").slides


def test_what_cannot_be_without_friction_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises((InputError, UnknownNameError), match="rubber"):
        read(tmp_path, TEXT.replace('"none"', '"rubber"'))
    with pytest.raises(InputError, match=r"nothing holds the girder; give the isolators as \[buffers\]"):
        read(tmp_path, TEXT.partition("[buffers]")[0])
    with pytest.raises(SettingError, match="slip is prescribed shows nothing but its friction"):
        replace(load_specimen("pad"), friction="none")


def test_a_law_of_friction_is_refused_and_damped_springs_are_the_base_model(tmp_path: Path) -> None:
    specimen = read(tmp_path)
    with pytest.raises(SettingError, match=r"presliding is friction of the pads.*do not slide"):
        base_model(specimen, ["presliding"])
    model = base_model(specimen)
    assert [entry.effect.name for entry in model.uses] == ["buffer_damping"]
    assert model.uses[0].values["exponent"] == 1.0
    assert set(model.uses[0].unused(specimen.pads)) == {"exponent", "relaxation"}
    save_model(model, tmp_path / "model.toml")
    assert load_model(tmp_path / "model.toml").uses[0].held == model.uses[0].held


def test_a_replay_has_no_friction_and_swings_as_a_spring_and_a_dashpot_do(tmp_path: Path) -> None:
    """Against the linear oscillator: relative displacement of a mass that is shaken at its base."""
    specimen = read(tmp_path)
    damping = 4e3
    found = replay(base_model(specimen, [use("buffer_damping", damping=damping)]), QUAKE).record
    for pad in specimen.pads:
        assert np.abs(found[f"pad_{pad}_Fx"]).max() < 1e-3
    mass, stiffness, dashpot = specimen.carried_mass, sum(specimen.buffer_stiffness), 2.0 * damping
    inertia = mass * found["girder_ax"]
    rate = np.gradient(found["slip_x"], found.dt)
    left = inertia + stiffness * found["slip_x"] + dashpot * rate
    # slip is that of the sliding plane: the girder's pitch on its pads is what is left
    assert np.std(left[50:]) < 0.02 * np.std(inertia)
    assert np.abs(found["slip_x"]).max() > 0.02


def test_loops_of_rubber_are_those_of_its_buffers_alone(tmp_path: Path) -> None:
    specimen = read(tmp_path)
    rubber = base_model(specimen, [use("buffer_hysteresis", strength=500.0, length=2e-3)])
    found = replay(rubber, QUAKE)
    forces = -specimen.mass * found.record["girder_ax"]
    taken = float(np.trapezoid(forces, found.record["slip_x"]))
    assert sum(found.pad_energy.values()) == pytest.approx(0.0, abs=1e-3)
    assert taken > 0.5 * 2.0 * 500.0 * np.sum(np.abs(np.diff(found.record["slip_x"])))


def test_one_buffer_is_enough_to_hold_a_girder() -> None:
    bridge = load_specimen("bridge1")
    held = bridge.changed(friction="none", buffers=(Buffer("1", 0.0, 0.0, 0.0, 1e5, 1e5),))
    assert base_model(held).specimen.frequency == pytest.approx(np.sqrt(1e5 / bridge.mass) / (2.0 * np.pi))


def test_the_picture_of_the_loops_is_that_of_the_buffers(tmp_path: Path) -> None:
    specimen = read(tmp_path)
    found = replay(base_model(specimen), QUAKE).record
    assert [axes.get_ylabel() for axes in loops_figure(found).axes] == ["ΣF of the buffers along x [kN]"]
    sliding = replay("bridge1", "sine:2Hz,0.3g,cycles=9").record
    assert len(loops_figure(sliding).axes) == 5
