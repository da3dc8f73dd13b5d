"""What a person states of a specimen acts, or is refused."""

import pytest

import slipwise as sw
from four_pads import describe_four_pads
from slipwise.errors import SettingError


def stated(tmp_path, more: str):
    path = tmp_path / "specimen.toml"
    path.write_text(describe_four_pads(radius="25 mm", more=more))
    return path


@pytest.mark.parametrize(
    ("more", "why"),
    [
        ('shear_strength = "2 MPa"', "shear_rate stands in its place"),
        ('plastic_pressure = "9 MPa"', "contact_area stands in its place"),
        ('bending_frequency = "12 Hz"', "no bending_mass is given"),
    ],
)
def test_a_stated_value_that_the_papers_law_does_not_use_is_refused(tmp_path, more, why):
    with pytest.raises(SettingError, match=rf"specimen\.toml states {more.split()[0]}, .*: {why}"):
        sw.base_model(stated(tmp_path, more))


def test_a_stated_shear_strength_acts_under_coulombs_law(tmp_path):
    strong, weak = (sw.base_model(stated(tmp_path, f'shear_strength = "{mpa} MPa"'), ()) for mpa in (2, 1))
    slips = [sw.replay(model, "sine:2Hz,0.4g,cycles=9").largest_slip for model in (strong, weak)]
    assert slips[0] < 0.8 * slips[1]


def test_a_value_that_is_only_assumed_does_not_stand_in_the_way(tmp_path):
    assert sw.base_model(stated(tmp_path, "")).specimen.shear_strength > 0.0


def test_a_model_file_states_only_what_its_law_uses(tmp_path):
    path = tmp_path / "model.toml"
    path.write_text('rig = "block"\n[specimen]\nshear_strength = "2 MPa"\n')
    model = sw.load_model(path)
    assert model.specimen.shear_strength == 2e6
    sw.save_model(model.adding(sw.use("shear_rate")), path)
    assert "shear_strength" not in path.read_text()
    assert "shear_rate" in [u.label for u in sw.load_model(path).uses]
    path.write_text(path.read_text().replace("[specimen]", '[specimen]\nshear_strength = "2 MPa"'))
    with pytest.raises(SettingError, match=r"model\.toml states shear_strength"):
        sw.load_model(path)


def test_buffers_that_are_not_there_have_no_stiffness(tmp_path):
    path = tmp_path / "model.toml"
    path.write_text('rig = "block"\n[specimen]\nbuffer_stiffness = "2 kN/mm"\n')
    with pytest.raises(SettingError, match="the rig has no buffers"):
        sw.load_model(path)
