"""What a rig's file may hold is read rightly: the rig that is replayed is the body that MuJoCo sees in the file."""

import mujoco
import numpy as np
import pytest

from changed_rigs import INERTIA, changed
from slipwise.errors import InputError
from slipwise.model import base_model
from slipwise.motion import load_motion
from slipwise.rig import RIGS, Specimen, build, load_specimen
from slipwise.rig.mjcf.file import read_mjcf
from slipwise.rig.rest_check import check_rest, loads_at_rest
from slipwise.simulation.replay import replay

SITES = (
    ('<site name="girder_centre" pos="0 0 0" ', '<site name="girder_centre" pos="0.2 -0.1 0.05" '),
    ('<site name="girder_edge_1" pos="1.5 0 0" ', '<site name="girder_edge_1" pos="1.7 -0.1 0" '),
    ('<site name="girder_edge_2" pos="-1.5 0 0" ', '<site name="girder_edge_2" pos="-1.3 -0.1 0" '),
)
SECOND = ('name="buffer_2_x" stiffness="1730589.336"', 'name="buffer_2_y" stiffness="1730589.336"')
FULL = INERTIA.replace("diag", "full").replace('28333.3333"', '28333.3333 0 0 0"')
BALLAST = '<body name="ballast"><inertial pos="0 0 0" mass="5000" diaginertia="9 9 9"/></body>'

ROLL, YAW = 'coef="0.366', '<joint joint="girder_yaw" coef='
#: Pads 2 m from the middle along x instead of 1.5 m: their places, and their arms about the vertical.
WIDE = (
    *((f'pos="{side}1.5 {y} -', f'pos="{side}2 {y} -') for side in ("", "-") for y in ("2.5", "-2.5")),
    *((f'{ROLL}"/>{YAW}"{side}1.5"', f'{ROLL}"/>{YAW}"{side}2"') for side in ("", "-")),
)
#: Buffers that push 0.1 m above the sliding plane; only their arms along x end in 1.5, those along y stand alone.
RAISED = (
    *((f'"-0.366"/>{YAW}"{side}1.5"', f'"-0.266"/>{YAW}"{side}1.5"') for side in ("", "-")),
    (f'{ROLL}"/></fixed>', 'coef="0.266"/></fixed>'),
)

#: What is changed -> the changes, and the values of the specimen that differ from the shipped rig's.
CASES: dict[str, tuple[tuple[tuple[str, str], ...], dict]] = {
    "another mass": ((('mass="10000"', 'mass="8000"'),), {"mass": 8000.0}),
    "an offset inertia": (
        ((INERTIA, INERTIA.replace('pos="0 0 0"', 'pos="0.2 -0.1 0.05"')), *SITES),
        {"centre_x": 0.2, "centre_y": -0.1, "centre_height": 0.416},
    ),
    "a full inertia": (((INERTIA, FULL),), {}),
    "mass and inertia of geoms": (
        ((INERTIA, '<geom type="box" size="1.5 2.5 0.25" class="visual" mass="9000"/>'),),
        {"mass": 9000.0, "inertia": (18937.5, 6937.5, 25500.0)},
    ),
    "a child body that is fused": (
        (("custom", '</custom><compiler fusestatic="true"/><custom>'), ("girder", BALLAST)),
        {"mass": 15000.0, "inertia": (21050.6667, 7717.3333, 28342.3333)},
    ),
    "one pad's height": (
        (('pos="-1.5 2.5 -0.0215"', 'pos="-1.5 2.5 -0.02145"'),),
        {"seating": (0.0, 5e-5, 0.0, 0.0)},
    ),
    "other pads": ((('-0.0215"/>', '-0.03" size="0.03"/>'),), {"pad_radius": 0.03}),
    "pads farther apart": (WIDE, {"pad_places": ((2.0, 2.5), (-2.0, 2.5), (2.0, -2.5), (-2.0, -2.5))}),
    "a higher girder": (
        (('<body name="girder" pos="0 0 0.366"', '<body name="girder" pos="0 0 0.5"'), ('-0.356"', '-0.49"'),
         ('"-0.366"', '"-0.5"'), ('"0.366"', '"0.5"')),
        {"centre_height": 0.5},
    ),
    "buffers of two kinds": (
        tuple((old, old.replace("1730589.336", "9e5")) for old in SECOND),
        {"buffer_stiffness": (1730589.336, 9e5)},
    ),
    "raised buffers": (RAISED, {"buffer_height": 0.1}),
    "gauges nearer to the middle": (
        (('edge_1" pos="1.5', 'edge_1" pos="1.2'), ('edge_2" pos="-1.5', 'edge_2" pos="-1.2')),
        {"edge_distance": 1.2},
    ),
    "less gravity": (
        (("custom", '</custom><option gravity="0 0 -1.62"/><custom>'),),
        {"gravity": 1.62},
    ),
    "numbers and words": (
        (("custom", '<numeric name="bending_mass" data="3000"/><numeric name="bending_frequency" data="9"/>'
                    '<numeric name="bending_damping" data="0.03"/><text name="pads_on" data="girder"/>'
                    '<text name="stick_capacity" data="full"/>'),),
        {"bending_mass": 3000.0, "bending_frequency": 9.0, "bending_damping": 0.03, "pads_on": "girder",
         "stick_capacity": "full"},
    ),
    "degrees, frames and defaults": (
        (("custom", '</custom><compiler angle="degree"/><custom>'),
         ('<geom name="pad_B" class="pad" contype="2" pos="-1.5 2.5 -0.0215"/>',
          '<frame pos="-1.5 0 0" euler="0 0 90">'
          '<geom name="pad_B" class="pad" contype="2" pos="2.5 0 -0.0215"/></frame>')),
        {},
    ),
    "what only shows or measures": (
        (("girder", '<geom name="parapet" type="box" size="1 0.1 0.5" class="visual"/><camera name="eye" pos="3 0 1"/>'
                    '<light pos="0 0 3"/><site name="mark"/>'
                    '<body name="flag"><geom size="0.1" class="visual"/></body>'),
         ("table", '<geom type="box" size="1 1 1" contype="0" conaffinity="0" rgba="1 0 0 1"/><!-- a remark -->'),
         ("custom", '<text name="source paint" data="red"/>'),
         ("file", '<sensor><accelerometer name="acc" site="mark"/><jointpos joint="girder_x"/></sensor>'
                  '<keyframe><key name="moved" qpos="0 0 0 0 0.1 0 0 0 0 0"/></keyframe><statistic extent="9"/>'
                  '<visual><map znear="0.1"/></visual><size nuserdata="3"/>'),
         ('size="1.75 2.75 0.1"', 'size="3 3 0.1"'), ('class="visual" mass="1"', 'class="visual" mass="500"')),
        {},
    ),
}  # fmt: skip


def read(tmp_path, case) -> tuple[Specimen, mujoco.MjModel, dict]:
    changes, values = CASES[case]
    path = changed(tmp_path, *changes)
    return load_specimen(path), mujoco.MjModel.from_xml_path(str(path)), values


@pytest.mark.parametrize("case", CASES)
def test_the_specimen_is_the_shipped_one_with_what_was_changed(case, tmp_path):
    specimen, _, values = read(tmp_path, case)
    shipped = load_specimen("bridge1")
    told = (
        "pads",
        "pad_places",
        "pad_radius",
        "seating",
        "springs",
        "pad_damping",
        "buffer_stiffness",
        "buffer_places",
    )
    parts = ("places", "buffers")
    own = [n for n in Specimen.__dataclass_fields__ if n not in ("name", "path", "sources", *parts)]
    for name in (*own, *told, "buffer_places", "buffer_height"):
        expected, given = values.get(name, getattr(shipped, name)), getattr(specimen, name)
        if isinstance(expected, str | bool) or name == "pads":
            assert given == expected, name
        else:
            assert np.ravel(given) == pytest.approx(np.ravel(expected), rel=1e-9, abs=1e-12), name


def mechanics(model: mujoco.MjModel) -> dict:
    """What MuJoCo says of the girder, its pads and buffers, in the frame of the table."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    girder = model.body("girder").id
    axes = data.ximat[girder].reshape(3, 3)
    found = {
        "weight": model.body_subtreemass[girder] * model.opt.gravity,
        "centre": data.subtree_com[girder],
        "inertia": axes @ np.diag(model.body_inertia[girder]) @ axes.T,
        "pads": [data.geom(f"pad_{pad}").xpos + [0.0, 0.0, model.geom(f"pad_{pad}").size[0]] for pad in "ABCD"],
        "plates": [data.geom(f"plate_{pad}").xpos[2] - model.geom(f"plate_{pad}").size[2] for pad in "ABCD"],
        "stiffness": [model.tendon_stiffness[model.tendon(f"buffer_{i}_{axis}").id] for i in "12" for axis in "xy"],
    }
    if np.any(model.body("girder").ipos):
        return found  # its joints turn about another point
    for joint in ("x", "y", "roll", "pitch", "yaw"):
        data.qvel[:] = 0.0
        data.qvel[model.joint(f"girder_{joint}").dofadr[0]] = 1.0
        mujoco.mj_forward(model, data)
        found[f"slip by {joint}"] = [
            data.tendon(f"{p}_{a}").velocity[0] for p in ("pad_A", "pad_D", "buffer_1") for a in "xy"
        ]
    return found


@pytest.mark.parametrize("case", CASES)
def test_the_rig_that_is_replayed_is_the_one_that_mujoco_sees_in_the_file(case, tmp_path):
    specimen, file, _ = read(tmp_path, case)
    expected = mechanics(file)
    replayed = mechanics(build(specimen.changed(pads_on="table", bending_mass=0.0), 2e-4, 0).model)
    for key, value in expected.items():
        assert np.ravel(replayed[key]) == pytest.approx(np.ravel(value), rel=1e-6, abs=1e-9), key


def test_a_girder_off_the_middle_loads_its_pads_by_the_lever(tmp_path):
    """Moments about the middle: the loads of the replay balance the weight at its offset."""
    specimen = load_specimen(changed(tmp_path, *CASES["an offset inertia"][0]))
    record = replay(base_model(specimen), load_motion(["sine:2Hz,0.05g,cycles=9"])).record
    loads = np.array([record[f"pad_{pad}_N"][0] for pad in specimen.pads])
    assert loads.sum() == pytest.approx(specimen.weight, rel=1e-6)
    assert loads @ np.array(specimen.pad_places) / specimen.weight == pytest.approx([0.2, -0.1], rel=1e-3)


def test_a_raised_pad_carries_more_from_the_start_of_a_replay(tmp_path):
    """Warp alone: raised by s, a pad and its diagonal neighbour gain k s / 4, the others lose it."""
    specimen = load_specimen(changed(tmp_path, *CASES["one pad's height"][0]))
    record = replay(base_model(specimen), load_motion(["sine:2Hz,0.05g,cycles=9"])).record
    loads = np.array([record[f"pad_{pad}_N"][0] for pad in specimen.pads])
    share = specimen.pad_stiffness * 5e-5 / 4.0
    assert loads - specimen.weight / 4.0 == pytest.approx(share * np.array([-1.0, 1.0, 1.0, -1.0]), rel=1e-3)


def test_a_file_that_only_copies_the_shipped_rig_gives_the_same_replay(tmp_path):
    motion = load_motion(["sine:2Hz,0.3g,cycles=9"])
    ours, shipped = (replay(rig, motion).record for rig in (changed(tmp_path), "bridge1"))
    assert all(np.array_equal(ours[name], shipped[name]) for name in shipped.channels)


def test_a_file_may_have_any_name(tmp_path):
    path = tmp_path / "R&D <2>.xml"
    path.write_text(changed(tmp_path).read_text())
    assert load_specimen(path).name == "R&D <2>"


def test_one_buffer_is_enough(tmp_path):
    text = changed(tmp_path).read_text()
    lines = [line for line in text.splitlines() if "buffer_2" not in line]
    (tmp_path / "one.xml").write_text("\n".join(lines))
    specimen = load_specimen(tmp_path / "one.xml")
    assert (len(specimen.buffer_stiffness), specimen.buffer_places) == (1, ((0.0, 1.5),))
    record = replay(base_model(specimen), load_motion(["sine:2Hz,0.2g,cycles=9"])).record
    assert "buffer_1_Fx" in record and "buffer_2_Fx" not in record
    assert np.abs(record["yaw"]).max() > 1e-5  # one buffer off the middle turns the girder


@pytest.mark.parametrize("rig", RIGS)
def test_the_pads_of_a_shipped_rig_carry_its_weight(rig):
    specimen = load_specimen(rig)
    loads = loads_at_rest(build(specimen, 5e-4, 0))
    assert loads.sum() == pytest.approx(specimen.weight, rel=1e-9)


@pytest.mark.parametrize("values", [{"centre_x": 1.0, "centre_y": -1.0}, {"pads_on": "girder", "centre_x": 0.4}])
def test_the_pads_carry_the_weight_of_a_girder_that_leans(values):
    specimen = load_specimen("bridge1").changed(**values)
    loads = loads_at_rest(build(specimen, 5e-4, 0))
    assert loads.sum() == pytest.approx(specimen.weight, rel=1e-7)
    centre = loads @ np.array(specimen.pad_places) / specimen.weight
    assert centre == pytest.approx([specimen.centre_x, specimen.centre_y], abs=1e-3)


def test_a_rig_whose_pads_do_not_carry_what_the_file_weighs_is_refused(tmp_path):
    """The last guard, whatever a file may hold: masses of the file against loads of the replay."""
    file = read_mjcf(changed(tmp_path, ("girder", BALLAST)))
    with pytest.raises(InputError, match=r"mine.xml, line 46: at rest the pads carry 98.0665 kN, .* weigh 147.0998 kN"):
        check_rest(file, load_specimen("bridge1"))


def test_a_prescribed_rig_takes_another_mass_and_refuses_another_pad(tmp_path):
    assert load_specimen(changed(tmp_path, ('mass="2500"', 'mass="2000"'), rig="pad")).mass == 2000.0
    second = '<geom name="pad_B" class="pad" contype="2" pos="1 0 -0.0215"/><geom name="disc_A"'
    with pytest.raises(InputError, match="pads A, B; a girder whose slip is prescribed has one pad"):
        load_specimen(changed(tmp_path, ('<geom name="disc_A"', second), rig="pad"))


def test_a_body_that_is_fixed_to_the_girder_is_weighed_with_it(tmp_path):
    """Steiner: 5 t at 1 m above the centre of 10 t move the centre by 1/3 m and add 5 (2/3)^2 + 10 (1/3)^2 t m^2."""
    ballast = BALLAST.replace('<body name="ballast">', '<body name="ballast" pos="0 0 1">')
    sites = tuple((f'name="{n}" pos="{x} 0 0"', f'name="{n}" pos="{x} 0 {1 / 3!r}"') for n, x in
                  (("girder_centre", "0"), ("girder_edge_1", "1.5"), ("girder_edge_2", "-1.5")))  # fmt: skip
    specimen = load_specimen(changed(tmp_path, ("girder", ballast), *sites))
    assert specimen.mass == 15000.0 and specimen.centre_height == pytest.approx(0.366 + 1.0 / 3.0)
    more = 5e3 * (2.0 / 3.0) ** 2 + 10e3 / 9.0 + 9.0
    assert specimen.inertia == pytest.approx((21041.6667 + more, 7708.3333 + more, 28342.3333), rel=1e-6)
    loads = loads_at_rest(build(specimen, 2e-4, 0))
    assert loads.sum() == pytest.approx(15000.0 * specimen.gravity, rel=1e-6)


def test_each_pad_and_each_direction_of_a_buffer_has_its_own_values(tmp_path):
    changes = (
        ('<geom name="pad_B" class="pad" contype="2" pos="-1.5 2.5 -0.0215"',
         '<geom name="pad_B" class="pad" size="0.03" contype="2" pos="-1.5 2.5 -0.03"'),
        ('name="pad_stiffness" data="200e6"', 'name="pad_stiffness" data="200e6 150e6 200e6 250e6"'),
        ('name="buffer_1_y" stiffness="1730589.336"', 'name="buffer_1_y" springlength="-0.002 0.002" stiffness="9e5"'),
        ('name="buffer_1_x"', 'name="buffer_1_x" springlength="-0.002 0.002"'),
    )  # fmt: skip
    specimen = load_specimen(changed(tmp_path, *changes))
    assert [p.radius for p in specimen.places] == [0.0215, 0.03, 0.0215, 0.0215]
    assert specimen.springs == (200e6, 150e6, 200e6, 250e6)
    one = specimen.buffers[0]
    assert (one.stiffness_x, one.stiffness_y, one.gap) == (1730589.336, 9e5, 0.002)
    record = replay(base_model(specimen), load_motion(["sine:2Hz,0.2g,cycles=9"])).record
    np.testing.assert_allclose(record["pad_B_P"], record["pad_B_N"] / (np.pi * 0.03**2))


def test_pads_may_have_each_others_names(tmp_path):
    """Names are names: places are told by the geoms alone."""
    swapped = (
        ('"pad_A" class', '"pad_X" class'),
        ('"pad_B" class', '"pad_A" class'),
        ('"pad_X" class', '"pad_B" class'),
    )
    with pytest.raises(InputError, match="coefficient .* of the joint girder_yaw"):
        load_specimen(changed(tmp_path, *swapped, ('contype="1"', 'contype="16"'), ('contype="2"', 'contype="1"'),
                              ('contype="16"', 'contype="2"')))  # fmt: skip
