"""Scripts of `slipwise export`, run in OpenSees: its rigs slide as far as ours."""

import numpy as np
import pytest

import slipwise as sw

pytestmark = pytest.mark.slow
QUAKE = "quake:seed=1,peak=0.7g,strong=2s,vertical=0.2g"


def run(model, motion, folder):
    try:
        import openseespy.opensees as _  # noqa: F401  # pyright: ignore[reportMissingImports]
    except (ImportError, RuntimeError) as error:
        pytest.skip(f"needs OpenSeesPy (pip install openseespy; Debian: apt-get install libblas3): {error}")
    found = sw.export_opensees(model, motion, folder / "rig.py")
    assert not found.not_run
    return found


def share(found, name):
    return next(r.error for r in found.responses if r.name == name)


@pytest.mark.parametrize(
    ("rig", "law", "motion"),
    [
        ("block", (), "sine:2Hz,0.3g,cycles=9"),
        ("bridge1", (), QUAKE),
        ("bridge1", None, QUAKE),
        ("bridge2", None, "quake:seed=2,peak=0.6g,strong=2s,across=0.3g"),
        ("pendulum", None, "quake:seed=3,peak=0.5g,f=2Hz,strong=2s"),
    ],
)
def test_a_rig_slides_within_two_percent_as_far_and_loads_its_pads_alike(rig, law, motion, tmp_path):
    found = run(sw.base_model(rig, law), motion, tmp_path)
    assert abs(share(found, "peak slip x")) < 0.02
    assert abs(share(found, "largest load of a pad")) < 0.01


def test_uneven_pads_a_bending_girder_and_buffers_that_loop_and_damp_are_there_too(tmp_path):
    effects = ("uneven_seating", "girder_bending", "buffer_damping", "buffer_hysteresis", "key_clearance")
    found = run(sw.base_model("bridge1").adding(*(sw.use(name) for name in effects)), QUAKE, tmp_path)
    assert abs(share(found, "peak slip x")) < 0.02 and abs(share(found, "largest load of a pad")) < 0.02
    assert np.isfinite(found.difference) and found.difference < 0.05


def test_what_the_script_lacks_costs_what_our_replay_without_it_says(tmp_path):
    found = run(sw.base_model("bridge1").adding(sw.use("presliding", length=1e-3)), QUAKE, tmp_path)
    (part,) = (p for p in found.parts if p.effect == "presliding")
    cost = part.peak_slip / found.peak_slip - 1.0
    assert abs(cost) > 0.01
    assert share(found, "peak slip x") == pytest.approx(cost, abs=0.004)
