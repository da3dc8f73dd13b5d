"""Any rigid girder on sliding pads: statics, modes, energy and friction of rigs with other pads than the paper's."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.errors import InputError, SettingError, UnitError, UnknownNameError
from slipwise.model import EffectUse, base_model, use
from slipwise.rig import Buffer, Place, Specimen, Storey, build, load_specimen, new_rig, write_mjcf
from slipwise.rig.load_basis import basis_of, end_pairs, load_basis
from slipwise.rig.load_modes import load_modes, pad_loads
from slipwise.rig.mjcf.writer import mjcf_text
from slipwise.rig.rest_check import loads_at_rest
from slipwise.rig.statics import at_rest
from slipwise.simulation.predict import predictor
from slipwise.simulation.replay import replay

QUAKE = "quake:seed=1,peak=0.7g,f=4Hz,strong=2s,vertical=0.3g"
TEN_LINES = """\
mass = "12 t"
box = ["4 m", "3 m", "0.5 m"]
centre_height = "0.4 m"
pad = { radius = "25 mm", stiffness = "200 kN/mm" }
pads.A = { x = "1.8 m", y = "1.3 m" }
pads.B = { x = "-1.8 m", y = "1.3 m" }
pads.C = { x = "1.8 m", y = "-1.3 m" }
pads.west = { x = "-1.8 m", y = "-1.3 m", radius = "30 mm", stiffness = "150 kN/mm" }
buffers.1 = { x = "0 m", y = "0.5 m", stiffness_x = "1.5 kN/mm", stiffness_y = "1 kN/mm", gap = "2 mm" }
storeys = [{ mass = "1 t", z = "1.5 m", stiffness = "2 kN/mm", damping_y = "1 kN s/m" }]
"""


def irregular() -> Specimen:
    """Five unlike pads off any grid, an offset centre of gravity, and three unlike buffers."""
    pads = (("P1", 1.6, 1.1), ("P2", -1.2, 1.4), ("P3", -1.7, -0.9), ("P4", 0.3, -1.3), ("P5", 1.9, -0.4))
    places = tuple(Place(n, x, y, 0.0, 0.02 + 0.001 * i, 150e6 + 2e7 * i, 5e4) for i, (n, x, y) in enumerate(pads))
    buffers = (Buffer("1", 1.0, 0.2, 0.05, 1e6, 5e5), Buffer("2", -1.0, 0.4, 0.0, 8e5, 8e5, 3e-3))
    third = Buffer("end", -0.2, -1.0, 0.1, 6e5, 2e5)
    return replace(
        load_specimen("six_pads"),
        name="irregular",
        places=places,
        buffers=(*buffers, third),
        centre_x=0.1,
        centre_y=-0.05,
    )


RIGS = {"three_pads": load_specimen("three_pads"), "six_pads": load_specimen("six_pads"), "irregular": irregular()}
RIGS |= {name: load_specimen(name) for name in ("pendulum", "building")}


@pytest.fixture(scope="module", params=RIGS)
def shaken(request):
    specimen = RIGS[request.param]
    return specimen, replay(base_model(specimen), QUAKE)


def test_at_rest_the_loads_sum_to_the_weight_and_balance_about_the_centre_of_gravity(shaken):
    specimen, answer = shaken
    loads = answer.record.stacked("pad_{}_N", specimen.pads)[0]
    assert loads.sum() == pytest.approx(specimen.weight, rel=1e-6)
    centre = loads @ np.array(specimen.pad_places) / specimen.weight
    assert centre == pytest.approx([specimen.centre_x, specimen.centre_y], abs=1e-3)
    assert loads_at_rest(build(specimen, 2e-4, 0)).sum() == pytest.approx(specimen.weight, rel=1e-6)


def test_the_energy_balance_closes(shaken):
    _, answer = shaken
    assert abs(answer.energy_error) < 1e-4


def test_friction_stays_within_its_circle_and_opposes_the_slip(shaken):
    """Coulomb without the paper's law: |F| = mu N in sliding, whatever the direction, and never more."""
    specimen, _ = shaken
    record = replay(base_model(specimen, effects=()), QUAKE).record
    mu = specimen.shear_strength / specimen.plastic_pressure
    speed = np.hypot(record["slip_vx"], record["slip_vy"])
    for pad in specimen.pads:
        force, load = on_the_face(record, pad, specimen.places[0].curvature)
        turning = 0.01 if specimen.places[0].curvature else 1e-6  # the sense of friction is that of the step before
        assert np.all(force <= mu * load * (1.0 + turning) + 1e-6)
        fast = speed > 0.1
        assert np.median(force[fast] / load[fast]) == pytest.approx(mu, rel=1e-3)
        if not specimen.places[0].curvature:
            assert np.all(record[f"pad_{pad}_Fx"][record["slip_vx"] > 0.1] > 0.0)


def on_the_face(record, pad, curvature):
    """Friction along a pad's face and the force normal to it (n,) [N], from what its load cell reads."""
    slip = np.stack([record["slip_x"], record["slip_y"]])
    slope = curvature * slip / np.sqrt(1.0 - curvature**2 * (slip**2).sum(axis=0))
    load = record[f"pad_{pad}_N"]
    pushed = np.stack([record[f"pad_{pad}_F{a}"] for a in "xy"]) - load * slope
    steep = 1.0 + (slope**2).sum(axis=0)
    along = pushed - slope * (slope * pushed).sum(axis=0) / steep
    climb = (along * slope).sum(axis=0)
    return np.sqrt((along**2).sum(axis=0) + climb**2), (load + climb) * np.sqrt(steep)


def test_the_girder_balance_holds_with_all_pads_and_buffers(shaken):
    """m a_x + sum F + sum F_b = 0: nothing acts that is not recorded."""
    specimen, answer = shaken
    r = answer.record
    for axis in "xy":
        force = sum(r[f"pad_{p}_F{axis}"] for p in specimen.pads)
        force = force + sum(r[f"buffer_{b.name}_F{axis}"] for b in specimen.buffers)
        force = force + sum(s.mass * r[f"storey_{i}_a{axis}"] for i, s in enumerate(specimen.storeys, 1))
        left = specimen.mass * r[f"girder_a{axis}"] + force
        scale = max(np.abs(specimen.mass * r["girder_ax"]).max(), 1.0)
        assert np.abs(left).max() < 5e-3 * scale, axis  # a tilting girder's pads push sideways too


@pytest.mark.parametrize("shaken", ["irregular"], indirect=True)  # the one whose buffers have a gap
def test_a_buffer_is_silent_within_its_gap_and_as_stiff_as_it_says_beyond(shaken):
    specimen, answer = shaken
    assert specimen.buffers[1].gap > 0.0
    r, buffer = answer.record, specimen.buffers[1]
    h = specimen.buffer_heights[1]
    at = r["slip_x"] + h * r["pitch"] - buffer.y * r["yaw"]
    beyond = np.sign(at) * np.maximum(np.abs(at) - buffer.gap, 0.0)
    assert np.abs(r["buffer_2_Fx"] - buffer.stiffness_x * beyond).max() < 1e-6 * buffer.stiffness_x
    assert np.any(beyond) and np.any(r["buffer_2_Fx"] == 0.0)


def test_loads_are_projected_on_one_x_and_y_and_warp_is_what_is_left():
    for specimen, warps in ((RIGS["three_pads"], 0), (load_specimen("bridge1"), 1), (RIGS["six_pads"], 3)):
        basis = basis_of(specimen)
        loads = np.random.default_rng(1).normal(25e3, 3e3, (20, len(specimen.pads)))
        modes = load_modes(loads, basis)
        assert modes.warp.shape == (20, warps)
        np.testing.assert_allclose(pad_loads(modes, basis), loads, rtol=1e-12)
        x, y = (np.array(specimen.pad_places) - specimen.middle).T
        np.testing.assert_allclose(modes.heave, loads.sum(axis=1))
        np.testing.assert_allclose(modes.pitch, loads @ x / basis.half[0])
        np.testing.assert_allclose(modes.roll, loads @ y / basis.half[1])


def test_a_rigid_girder_on_unlike_springs_loads_no_warp():
    """N_i = k_i (a + b x_i + c y_i): whatever a, b and c, for pads of any stiffness at any place."""
    specimen = RIGS["irregular"]
    x, y = np.array(specimen.pad_places).T
    loads = np.array(specimen.springs) * (1e-4 + 3e-5 * x - 2e-5 * y)
    assert np.abs(basis_of(specimen).warp @ loads).max() < 1e-9 * loads.max()


def test_the_first_warp_of_four_pads_is_one_diagonal_against_the_other():
    square = load_basis([(1.0, 2.0), (-1.0, 2.0), (1.0, -2.0), (-1.0, -2.0)])
    assert np.array_equal(square.warp, [[1.0, -1.0, -1.0, 1.0]])


def test_pads_beside_each_other_are_paired_by_their_places():
    assert end_pairs(load_specimen("bridge1")) == (("A", "C"), ("B", "D"))
    assert end_pairs(RIGS["six_pads"]) == (("A", "D"), ("B", "E"), ("C", "F"))
    assert end_pairs(RIGS["three_pads"]) == (("B", "C"),)


def test_seating_warps_four_pads_and_more_but_never_three():
    for name, moved in (("three_pads", False), ("six_pads", True)):
        model = base_model(name).adding(use("uneven_seating", warp=2e-5))
        loads, level = at_rest(model.built_specimen()).load, at_rest(RIGS[name]).load
        assert bool(np.abs(loads - level).max() > 100.0) is moved


def test_a_pad_may_have_a_law_of_its_own():
    model = base_model("six_pads")
    law = model["shear_rate"]
    half = {"strength": 0.5 * law.values["strength"]}
    one = replace(model, uses=tuple(replace(u, own={"B": half}) if u is law else u for u in model.uses))
    states = np.arange(3) * 1e-3, np.full((3, 6), 25e3), np.full((3, 6, 2), 0.1), np.zeros((3, 6, 2))
    found, plain, weak = (predictor(m).pads(*states).bound for m in (one, model, model.setting("shear_rate", **half)))
    others = [0, 2, 3, 4, 5]
    assert np.array_equal(found[:, 1], weak[:, 1]) and np.array_equal(found[:, others], plain[:, others])
    assert weak[0, 1] < 0.8 * plain[0, 1]
    with pytest.raises(UnknownNameError, match="'Z'"):
        replace(model, uses=(replace(law, own={"Z": {"strength": 1.0e6}}),))
    with pytest.raises(SettingError, match="more than single pads"):
        EffectUse(use("guide_drag").effect, use("guide_drag").values, own={"B": {}})


@pytest.mark.parametrize("name", RIGS)
def test_a_written_mjcf_reads_back_as_the_same_specimen(name, tmp_path):
    path = tmp_path / f"{RIGS[name].name}.xml"
    path.write_text(mjcf_text(RIGS[name]))
    read = load_specimen(path)
    assert replace(read, path=RIGS[name].path, sources=RIGS[name].sources) == RIGS[name]


@pytest.mark.parametrize("name", ["three_pads", "six_pads", "pendulum", "building"])
def test_a_shipped_mjcf_is_what_is_written_of_its_specimen_toml(name):
    shipped = load_specimen(name).path
    assert shipped.read_text() == mjcf_text(load_specimen(shipped.with_suffix(".toml")))


def test_ten_lines_are_a_rig(tmp_path):
    (tmp_path / "specimen.toml").write_text(TEN_LINES)
    specimen = load_specimen(tmp_path)
    assert specimen.pads == ("A", "B", "C", "west") and specimen.places[3].radius == 0.03
    assert specimen.inertia == pytest.approx((9250.0, 16250.0, 25000.0))
    assert specimen.buffers == (Buffer("1", 0.0, 0.5, 0.0, 1.5e6, 1e6, 2e-3),)
    alone = 2.0 * 0.02 * np.sqrt(2e6 * 1e3)
    assert specimen.storeys == (Storey(1e3, 1.5, 2e6, 2e6, pytest.approx(alone), 1e3),)
    assert specimen.weight == pytest.approx(13e3 * specimen.gravity)
    critical = 2.0 * 0.05 * np.sqrt(sum(specimen.springs) * specimen.mass)
    assert sum(p.damping for p in specimen.places) == pytest.approx(critical)
    assert "pad_west_Fx" in replay(base_model(specimen), "sine:2Hz,0.2g,cycles=9").record


def test_a_new_rig_is_a_file_to_edit_and_its_mjcf(tmp_path):
    path, mjcf = new_rig("mine", tmp_path)
    assert replace(load_specimen(mjcf), path=path, sources={}) == replace(load_specimen(path.parent), sources={})
    with pytest.raises(InputError, match="is there already"):
        new_rig("mine", tmp_path)
    with pytest.raises(SettingError, match="cannot name a rig"):
        new_rig("../mine", tmp_path)
    with pytest.raises(InputError, match="is an MJCF already"):
        write_mjcf(load_specimen(mjcf))


@pytest.mark.parametrize(
    ("old", "new", "error", "words"),
    [
        ('"12 t"', '"0 t"', InputError, "mass = 0 kg cannot be"),
        ('"12 t"', '"inf t"', UnitError, "not a finite number"),
        ('"12 t"', '"12"', UnitError, "has no unit"),
        ('"200 kN/mm"', '"-200 kN/mm"', InputError, "pad A: pad_stiffness = -2e\\+08 N/m cannot be"),
        ('"1 kN/mm"', '"-1 kN/mm"', InputError, "buffer 1: buffer_stiffness = -1e\\+06 N/m cannot be"),
        ('"2 mm"', '"-2 mm"', InputError, "buffer_gap = -0.002 m cannot be"),
        ('x = "-1.8 m"', 'x = "1.8 m"', InputError, "all stand on one side"),
        ('y = "-1.3 m"', 'y = "1.3 m"', InputError, "all stand on one side"),
        ("pads.west", "pads.over_there", InputError, "give it a word of letters and digits"),
        ("box", "boxes", UnknownNameError, "boxes"),
        ('centre_height = "0.4 m"\n', "", InputError, "lacks centre_height"),
        ('stiffness_y = "1 kN/mm", ', "", InputError, "buffer 1 lacks stiffness_y"),
        ('radius = "25 mm", ', "", InputError, "pad A lacks radius"),
        ("pads.A", "pads.A.x", UnitError, "pad A, 'x'"),
        ('mass = "1 t"', 'mass = "0 t"', InputError, "storey 1: mass = 0 kg cannot be"),
        ('z = "1.5 m"', 'z = "-1.5 m"', InputError, "storey 1: it stands at -1.5 m, below"),
        ('stiffness = "2 kN/mm"', 'stiffness = "-2 kN/mm"', InputError, "storey 1: storey_stiffness"),
        ('z = "1.5 m", ', "", InputError, "storey 1 lacks z"),
        ('[{ mass = "1 t"', '[{ weight = "1 t"', UnknownNameError, "weight"),
        ('radius = "30 mm"', 'radius_of_curvature = "0 m"', InputError, "radius_of_curvature = 0 m cannot be"),
        ('radius = "30 mm"', 'radius_of_curvature = "1 mm"', InputError, "pad_curvature = 1000 1/m cannot be"),
    ],
)
def test_what_cannot_be_a_rig_is_refused_in_one_sentence(old, new, error, words, tmp_path):
    text = TEN_LINES.replace(old, new)
    assert text != TEN_LINES
    (tmp_path / "specimen.toml").write_text(text)
    with pytest.raises(error, match=words) as caught:
        load_specimen(tmp_path / "specimen.toml")
    assert "\n" not in str(caught.value)


def test_pads_on_one_line_cannot_carry():
    places = tuple(replace(p, y=0.0) for p in RIGS["three_pads"].places)
    with pytest.raises(SettingError, match="all stand on one line"):
        at_rest(replace(RIGS["three_pads"], places=places))


def test_too_few_pads_and_names_given_twice_are_refused():
    places = RIGS["three_pads"].places
    with pytest.raises(SettingError, match="it has 2 pads; a girder that is free stands on 3 to 31"):
        replace(RIGS["three_pads"], places=places[:2])
    with pytest.raises(SettingError, match="two pads are called 'A'"):
        replace(RIGS["three_pads"], places=(*places, places[0]))
