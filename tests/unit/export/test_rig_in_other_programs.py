"""What of a rig another program gets: buffers, radii, the script as a text, and what is said of the rest."""

import ast

import numpy as np
import pytest

import slipwise as sw
from slipwise.export.buffer_links import link_buffers
from slipwise.export.left_out import list_parts

SINE = "sine:2Hz,0.3g,cycles=9"


def links(*effects):
    """The first buffer of bridge1 with effects, along x, over a sine of 20 mm."""
    model = sw.base_model("bridge1").adding(*effects)
    time = np.arange(0.0, 2.0, 0.002)
    slip = 0.02 * np.sin(2.0 * np.pi * 2.0 * time)
    return link_buffers(model, sw.Record(time, {"slip_x": slip}, {}))[0][0]


def test_a_rated_buffer_is_a_spring_and_nothing_else():
    link = links()
    assert link.stiffness == pytest.approx(18.5e6 / 10.69, rel=1e-6)
    assert (len(link.backbone), link.damping, link.loop_force) == (0, 0.0, 0.0) and link.error < 1e-9


def test_a_dashpot_is_found_with_its_damping():
    assert links(sw.use("buffer_damping", damping=7450.0)).damping == pytest.approx(7450.0, rel=1e-3)


def test_a_loop_is_found_with_its_height_and_length_and_how_it_turns():
    round_one = links(sw.use("buffer_hysteresis", strength=1000.0, length=3e-3))
    assert (round_one.loop_force, round_one.loop_length) == pytest.approx((1000.0, 3e-3), rel=1e-3)
    assert round_one.rounded and round_one.error < 1e-3
    sharp = links(sw.use("buffer_hysteresis", strength=1000.0, length=3e-3, exponent=0.0))
    assert (sharp.loop_force, sharp.loop_length) == pytest.approx((1000.0, 3e-3), rel=2e-3) and not sharp.rounded


def test_a_buffer_with_play_has_no_force_within_it():
    link = links(sw.use("key_clearance", clearance=1e-3))
    inside = np.abs(link.backbone[:, 0]) < 0.99e-3
    assert inside.any() and not np.any(link.backbone[inside, 1])


def test_what_a_program_cannot_say_is_named_and_gauges_are_no_part_of_the_rig():
    effects = (sw.use("heating"), sw.use("presliding"), sw.use("key_friction"), sw.use("channel_gain", "pad_A_N"))
    states = {p.effect: p.state for p in list_parts(sw.base_model("bridge1").adding(*effects))}
    assert states["contact_area"] == states["shear_rate"] == "written"
    assert states["heating"] == "as its mean"
    assert states["presliding"] == states["key_friction"] == "left out"
    assert states["channel_gain[pad_A_N]"] == "not of the rig"


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    model = sw.base_model("bridge1").adding(sw.use("presliding"))
    return sw.export_opensees(model, SINE, tmp_path_factory.mktemp("export") / "rig.py", run=False)


def test_the_script_is_python_that_needs_nothing_but_opensees(written):
    tree = ast.parse(written.script.read_text())
    modules = {a.name for n in ast.walk(tree) if isinstance(n, ast.Import) for a in n.names}
    modules |= {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
    assert modules == {"sys", "pathlib", "openseespy.opensees"}
    rows = [line for line in written.data.read_text().splitlines() if not line.startswith("#")]
    assert len(rows) == len(sw.load_motion(SINE)) and len(rows[0].split()) == 3


def test_what_the_script_lacks_stands_in_its_head_with_what_it_costs(written):
    assert "presliding: how friction turns round" in ast.get_docstring(ast.parse(written.script.read_text()))
    (part,) = (p for p in written.parts if p.effect == "presliding")
    without = sw.replay(sw.base_model("bridge1"), SINE)
    assert part.peak_slip == pytest.approx(max(map(abs, without.slip_range)), rel=1e-6)
    assert written.peak_slip != pytest.approx(part.peak_slip, rel=1e-3)


def test_a_pendulum_gets_its_radius_and_a_pad_with_a_curved_face_the_radius_of_both(tmp_path):
    links = sw.export_sap2000("pendulum", motion=SINE)
    assert {s.radius for s in links.sliders} == {1.0}
    curved = sw.export_sap2000(sw.base_model("pendulum").adding(sw.use("slide_curvature", curvature=0.25)), motion=SINE)
    assert {s.radius for s in curved.sliders} == {0.8}


@pytest.mark.parametrize("rig", ["pad", "building"])
def test_a_rig_that_cannot_be_written_is_refused_and_nothing_is_left(rig, tmp_path):
    with pytest.raises(sw.SlipwiseError, match="give a rig"):
        sw.export_opensees(rig, SINE, tmp_path / "rig.py")
    assert not list(tmp_path.iterdir())
