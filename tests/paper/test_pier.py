"""The bridge between the ground and the table."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from slipwise.errors import InputError, SettingError, SlipwiseWarning
from slipwise.model import base_model
from slipwise.motion import TableMotion, load_motion
from slipwise.rig import LENGTH_SCALE
from slipwise.simulation.pier import BridgeSettings, Pier, bridge_response, pier_top
from slipwise.studies.paper import PaperSettings
from slipwise.studies.paper.one_dof import one_dof
from slipwise.studies.paper.table_input import two_ways

GROUND = load_motion("quake:seed=2,peak=0.45g,f=1.2Hz,strong=6s,vertical=0.2g,2.4Hz")
#: So heavy that no friction moves it, and so stiff that it follows the ground.
RIGID = BridgeSettings((Pier(stiffness=1e14, mass=1e9, damping=0.3),), vertical_frequency=60.0)


def stuck(bridge="bridge1"):
    """A bridge whose superstructure cannot slide."""
    model = base_model(bridge, ())
    return replace(model, specimen=replace(model.specimen, shear_strength=1e12))


def test_the_top_of_a_rigid_pier_is_the_ground():
    response = bridge_response(GROUND, "bridge1", RIGID)
    assert np.abs(response.pier_ax - response.ground_ax).max() < 0.02 * np.abs(response.ground_ax).max()


def test_on_a_rigid_pier_the_bridge_is_the_papers_one_degree_of_freedom_at_full_scale():
    settings = replace(RIGID, similar_law=True)
    response, table = bridge_response(GROUND, "bridge1", settings), pier_top(GROUND, "bridge1", settings)
    single = one_dof(base_model("bridge1"), table)
    slip = single.slip[: len(response.slip)] * LENGTH_SCALE["bridge1"]
    assert np.std(slip - response.slip[: len(slip)]) < 0.03 * np.std(response.slip)


def test_stuck_to_its_pier_the_bridge_swings_at_the_frequency_of_all_its_mass():
    pier = Pier(stiffness=250e6, mass=300e3, damping=0.0)
    values = np.zeros((12000, 3))
    values[:4, 0] = 5.0
    motion = TableMotion(0.002, values, "a tap", ("tap", "", ""))
    response = bridge_response(motion, "bridge1", BridgeSettings((pier,)), stuck())
    mass = 1e4 * LENGTH_SCALE["bridge1"] ** 2 + pier.mass
    expected = np.sqrt(pier.stiffness / mass) / (2 * np.pi)
    tail = response.pier_ax[200:]
    power = np.abs(np.fft.rfft(tail * np.hanning(len(tail)), 2**18))
    found = np.argmax(power) / (2**18 * response.dt)
    assert found == pytest.approx(expected, rel=2e-3)
    assert np.abs(response.slip).max() < 1e-9


def test_vertically_the_pier_is_an_oscillator():
    # Steady state of a base-driven oscillator: absolute acceleration over the ground's, closed form.
    frequency, own, damping = 2.0, 3.0, 0.05
    time = np.arange(16000) * 0.002
    values = np.zeros((len(time), 3))
    values[:, 0], values[:, 2] = 0.01 * np.sin(time), np.sin(2 * np.pi * frequency * time)
    settings = BridgeSettings(vertical_frequency=own, vertical_damping=damping)
    response = bridge_response(TableMotion(0.002, values, "sine", ("", "", "")), "bridge1", settings)
    ratio = frequency / own
    expected = np.sqrt((1 + (2 * damping * ratio) ** 2) / ((1 - ratio**2) ** 2 + (2 * damping * ratio) ** 2))
    assert np.abs(response.pier_az[-2000:]).max() == pytest.approx(expected, rel=2e-3)


def test_forces_balance_on_the_superstructure_at_every_instant():
    response = bridge_response(GROUND, "bridge1")
    scale, specimen = LENGTH_SCALE["bridge1"], base_model("bridge1").specimen
    mass, stiffness = specimen.mass * scale**2, sum(specimen.buffer_stiffness) * scale
    middle = 0.5 * (response.slip + np.concatenate([[0.0], response.slip[:-1]]))
    left = mass * response.deck_ax + stiffness * middle + response.friction
    assert np.abs(left).max() < 1e-6 * mass * np.abs(response.deck_ax).max()


def test_two_equal_piers_are_one():
    one = bridge_response(GROUND, "bridge2", BridgeSettings((Pier(),)))
    two = bridge_response(GROUND, "bridge2", BridgeSettings((Pier(), Pier())))
    assert np.abs(two.slip - one.slip).max() < 1e-3 * np.abs(one.slip).max()


def test_the_softer_of_two_piers_sways_more():
    soft, stiff = Pier(stiffness=80e6), Pier(stiffness=500e6)
    settings = BridgeSettings((soft, stiff))
    tops = [bridge_response(GROUND, "bridge1", replace(settings, top=i)) for i in (0, 1)]
    assert np.ptp(tops[0].slip) != pytest.approx(np.ptp(tops[1].slip), rel=0.05)
    assert np.allclose(tops[0].deck_ax, tops[1].deck_ax)


def test_the_rig_repeats_the_bridge_if_n_scales_and_differs_if_it_does_not():
    settings = PaperSettings()
    similar = two_ways(GROUND, "bridge1", settings, similar_law=True)
    real = two_ways(GROUND, "bridge1", settings, similar_law=False)
    assert similar.slip_error < 0.02
    assert similar.peak_ratio == pytest.approx(1.0, abs=0.02)
    assert real.slip_error > 3 * similar.slip_error
    assert np.ptp(real.rig_slip) > np.ptp(real.bridge.slip)


def test_the_table_gets_the_models_time_and_words_about_what_was_done():
    top = pier_top(GROUND, "bridge2")
    assert top.dt == pytest.approx(0.0005, rel=1e-9)
    assert top.duration == pytest.approx(GROUND.duration / LENGTH_SCALE["bridge2"] ** 0.5, rel=1e-3)
    assert any("pier" in words for words in top.treatment)
    assert not top.acceleration[:, 1].any()


def test_a_component_across_is_left_out_with_a_warning():
    with pytest.warns(SlipwiseWarning, match="y is left out"):
        top = pier_top(load_motion("quake:seed=1,peak=0.3g,f=1.2Hz,strong=4s,across=0.2g"), "bridge1")
    assert any("y left out" in words for words in top.treatment)


def test_impossible_bridges_are_refused():
    with pytest.raises(SettingError, match="bridge1, bridge2"):
        pier_top(GROUND, "bridge3")
    with pytest.raises(SettingError, match="piers 0 to 0"):
        BridgeSettings(top=1)
    with pytest.raises(SettingError, match="stiffness"):
        Pier(stiffness=0.0)
    with pytest.raises(SettingError, match="can be followed"):
        pier_top(GROUND, "bridge1", BridgeSettings((Pier(mass=100.0),)))
    still = TableMotion(0.01, np.zeros((100, 3)), "nothing", ("", "", ""))
    with warnings.catch_warnings(), pytest.raises(InputError, match="nothing moves in x"):
        pier_top(still, "bridge1")
