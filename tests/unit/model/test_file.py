"""model.toml: read by people, edited by hand and by commands, never losing a comment."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from slipwise.effects import catalogue
from slipwise.errors import InputError, SettingError, UnitError, UnknownNameError
from slipwise.model import EffectUse, base_model, use
from slipwise.model.file import load_model, save_model
from slipwise.rig import load_specimen

BY_HAND = """# our rig after the repair of May
rig = "bridge1"     # with the new pads

[specimen]
mass = "10.02 t"    # weighed

# the paper's law
[[effect]]
name = "contact_area"
saturation = "0.102 1/MPa"

[[effect]]
name = "shear_rate"   # fitted by Emi
strength = "1379 kPa"
rate = "0.197 s/cm"   # s/cm, not s/mm!

[[effect]]
name = "channel_gain"
target = "pad_B_N"
gain = "3 %"          # cell was dropped
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    file = tmp_path / "model.toml"
    file.write_text(BY_HAND)
    return file


def comments(text: str) -> list[str]:
    return [line.partition("#")[2].strip() for line in text.splitlines() if "#" in line]


def test_a_hand_written_file_means_what_it_says(path: Path) -> None:
    model = load_model(path)
    assert model.specimen.mass == pytest.approx(10020.0) and model.specimen.sources["mass"] == "model.toml"
    assert [u.label for u in model.uses] == ["contact_area", "shear_rate", "channel_gain[pad_B_N]"]
    assert model["shear_rate"].values == pytest.approx({"strength": 1.379e6, "rate": 19.7, "slow": 0.046})
    assert model["channel_gain"].values["gain"] == 0.03


def test_a_new_file_of_the_base_model_is_that_model_to_the_last_bit(tmp_path: Path) -> None:
    for rig in ("bridge1", "bridge2", "block", "pad"):
        save_model(base_model(rig), tmp_path / f"{rig}.toml")
        assert load_model(tmp_path / f"{rig}.toml") == base_model(rig)


@pytest.mark.parametrize("end", ["", "\n", "\n\n\n"])
def test_one_blank_line_stands_before_each_effect_however_the_file_ended(end: str, tmp_path: Path) -> None:
    path, model = tmp_path / "model.toml", base_model("bridge1")
    save_model(model, path)
    new = path.read_text(encoding="utf-8")
    assert new.count("\n\n[[effect]]\n") == new.count("[[effect]]") and "\n\n\n" not in new
    commented = new.rstrip().replace("[[effect]]", "# as it was bought\n[[effect]]", 1)
    path.write_text(commented + end, encoding="utf-8")
    save_model(model.adding(use("heating"), use("buffer_damping")), path)
    text = path.read_text(encoding="utf-8")
    assert text.count("\n\n[[effect]]\n") == text.count("[[effect]]") - 1 and "\n\n\n" not in text
    assert "# as it was bought\n[[effect]]\n" in text and not text.endswith("\n\n")


def test_a_rig_of_ones_own_that_has_the_name_of_one_of_the_package_is_written_as_ones_own(tmp_path: Path) -> None:
    own = shutil.copy(load_specimen("building").path, tmp_path / "building.xml")
    model = base_model(own, ())
    assert model.specimen.name == "building"
    save_model(model, tmp_path / "model.toml")
    assert load_model(tmp_path / "model.toml").specimen.path == own


def test_a_rig_that_is_named_from_elsewhere_is_written_as_seen_from_the_model(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "march").mkdir()
    shutil.copy(load_specimen("building").path, tmp_path / "march" / "tower.xml")
    monkeypatch.chdir(tmp_path)
    model = base_model("march/tower.xml", ())
    for _ in range(2):  # a new file, and one that is there
        save_model(model, "march/model.toml")
    assert 'rig = "tower.xml"' in (tmp_path / "march" / "model.toml").read_text()
    assert load_model("march/model.toml").specimen.pads == model.specimen.pads


def test_adding_and_removing_an_effect_leaves_the_file_as_it_was(path: Path) -> None:
    model = load_model(path).adding(use("run_in", rise=0.25, distance="150 mm"))
    save_model(model, path)
    assert model["run_in"].values["distance"] == 0.15 and load_model(path) == model
    assert comments(path.read_text())[:7] == comments(BY_HAND)
    assert "r: of a new pad over a settled one; -0.8 to 2" in path.read_text(), "what is written says what it means"
    save_model(model.without("run_in"), path)
    assert path.read_text().strip() == BY_HAND.strip()


def test_every_effect_can_be_added_read_back_and_taken_out(path: Path) -> None:
    plain = load_model(path)
    for effect in catalogue().values():
        if effect.name not in ("contact_area", "shear_rate"):
            save_model(plain.adding(use(effect, "pad_A_N" if effect.target else "")), path)
            assert load_model(path) == plain.adding(use(effect, "pad_A_N" if effect.target else ""))
            save_model(plain, path)
    assert path.read_text().strip() == BY_HAND.strip()


def test_saving_a_fitted_model_changes_numbers_and_nothing_else(path: Path) -> None:
    model = load_model(path).setting("shear_rate", strength=1.5e6, rate=19.7)
    model = replace(model, specimen=replace(model.specimen, centre_height=0.4)).adding(use("breakaway", rise=0.03))
    save_model(model, path)
    text = path.read_text()
    assert comments(text)[:7] == comments(BY_HAND)
    assert 'strength = "1.5 MPa"' in text and 'rate = "0.197 s/cm"   # s/cm, not s/mm!' in text
    assert 'mass = "10.02 t"    # weighed' in text, "a number that did not change keeps its unit"
    again = load_model(path)
    assert again["breakaway"].values["rise"] == 0.03 and again.specimen.centre_height == 0.4
    save_model(model.without("channel_gain"), path)
    assert [u.effect.name for u in load_model(path).uses] == ["contact_area", "shear_rate", "breakaway"]


def test_any_values_survive_a_round_trip(tmp_path: Path) -> None:
    file = tmp_path / "model.toml"
    for effect in catalogue().values():
        for share in (0.0, 0.1234567890123, 1.0):
            values = {p.name: p.low + share * (p.high - p.low) for p in effect.parameters}
            model = base_model("bridge1", [EffectUse(effect, values, "pad_*_Fx" if effect.target else "")])
            file.unlink(missing_ok=True)
            save_model(model, file)
            assert load_model(file).uses[0].values == pytest.approx(values, rel=1e-12)


REFUSED = {
    "no rig": ('rig = "bridge1"', 'rug = "bridge1"', UnknownNameError, "did you mean rig"),
    "unknown rig": ('"bridge1"', '"brigde1"', UnknownNameError, "did you mean bridge1"),
    "unknown effect": ('"shear_rate"', '"shear_rat"', UnknownNameError, "did you mean shear_rate"),
    "unknown parameter": ("strength =", "strenght =", UnknownNameError, "did you mean strength"),
    "no unit": ('"1379 kPa"', "1.379", UnitError, r"effect shear_rate, strength.*no unit.*1.379 Pa"),
    "wrong unit": ('"0.197 s/cm"', '"0.197 cm/s"', UnitError, "wrong dimension"),
    "out of bounds": ('"1379 kPa"', '"1379 MPa"', SettingError, r"strength = 1.379e\+09 Pa is out.*100000 to 1e\+07"),
    "unknown channel": ('"pad_B_N"', '"pad_E_N"', UnknownNameError, "no pad of bridge1 is called 'E': possible: A"),
    "no target": ('target = "pad_B_N"', "", SettingError, "must be told which channel"),
    "no name": ('name = "contact_area"', "", InputError, 'either name = "heating" or file'),
    "unknown specimen key": ("mass =", "masss =", UnknownNameError, "did you mean mass"),
    "not toml": ("[specimen]", "[specimen", InputError, "not valid TOML"),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_a_mistake_is_named_with_what_would_be_right(what: str, path: Path) -> None:
    old, new, error, words = REFUSED[what]
    assert old in BY_HAND
    path.write_text(BY_HAND.replace(old, new))
    with pytest.raises(error, match=words):
        load_model(path)


def test_single_brackets_are_told_apart_from_double_ones(path: Path) -> None:
    path.write_text('rig = "bridge1"\n[effect]\nname = "run_in"\n')
    with pytest.raises(InputError, match="double brackets"):
        load_model(path)


def test_a_model_without_any_effect_is_read_back(path: Path) -> None:
    bare = load_model(path).without("contact_area", "shear_rate", "channel_gain")
    save_model(bare, path)
    assert load_model(path) == bare


def test_a_model_of_another_rig_is_refused_and_leaves_the_file_untouched(path: Path) -> None:
    with pytest.raises(SettingError, match="is a model of 'bridge1', not of 'bridge2'"):
        save_model(base_model("bridge2"), path)
    assert path.read_text() == BY_HAND


def test_a_missing_file_says_how_to_get_one(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="slipwise add"):
        load_model(tmp_path / "model.toml")


OF_PADS = """rig = "six_pads"

[[effect]]
name = "contact_area"

[[effect]]
name = "shear_rate"
strength = "1.379 MPa"
[effect.pads]         # the two of the old batch
B = { strength = "1.1 MPa", rate = "0.1 s/cm" }
E = { strength = "1.2 MPa" }   # worn

[[effect]]
name = "run_in"
pads.C.rise = 0.3
"""


def test_single_pads_have_values_of_their_own_and_keep_them(tmp_path: Path) -> None:
    file = tmp_path / "model.toml"
    file.write_text(OF_PADS)
    model = load_model(file)
    own = model["shear_rate"].own
    assert own == {"B": {"strength": pytest.approx(1.1e6), "rate": pytest.approx(10.0)}, "E": {"strength": 1.2e6}}
    assert model["run_in"].of_pad("C")["rise"] == 0.3 and model["run_in"].of_pad("A") == model["run_in"].values
    save_model(model, file)
    assert file.read_text() == OF_PADS
    changed = model.setting("shear_rate", **{"strength[E]": "1.3 MPa"}).setting("run_in", **{"rise[D]": 0.1})
    save_model(changed, file)
    assert load_model(file) == changed and comments(file.read_text()) == comments(OF_PADS)
    assert 'B = { strength = "1.1 MPa", rate = "0.1 s/cm" }' in file.read_text()
    other = tmp_path / "other.toml"
    save_model(changed, other)
    assert load_model(other) == changed
    plain = replace(changed, uses=tuple(replace(u, own={}) for u in changed.uses))
    save_model(plain, file)
    assert load_model(file) == plain and "pads" not in file.read_text().replace("six_pads", "")


OTHER = {
    "guide_drag": ('"run_in"\npads.C.rise = 0.3', '"guide_drag"\npads.C.damping = "1 N*s/m"'),
    "presliding": ('"run_in"\npads.C.rise', '"presliding"\npads.C.exponent'),
}
REFUSED_OF_PADS = {
    "unknown pad": ("E = {", "G = {", UnknownNameError, "no pad of six_pads is called 'G'"),
    "unknown parameter": ("rate = ", "rat = ", UnknownNameError, "did you mean rate"),
    "out of bounds": ('"1.2 MPa"', '"12 MPa"', SettingError, r"shear_rate.strength\[E\] = 1.2e\+07 Pa is out"),
    "no unit": ('"1.2 MPa"', "1.2", UnitError, r"strength\[E\].*no unit"),
    "no pad law": (*OTHER["guide_drag"], SettingError, "guide_drag acts on more than single pads, so pad C can"),
    "how all stick": (*OTHER["presliding"], SettingError, "presliding acts on more than single pads"),
    "no table": ("pads.C.rise = 0.3", 'pads = "C"', InputError, r"written as \[effect.pads\] with A = "),
    "no values": ('E = { strength = "1.2 MPa" }', "E = 1.2", InputError, r"pads.E is 1.2"),
    "in brackets": ("pads.C.rise = 0.3", '"rise[C]" = 0.3', InputError, r"'rise\[C\]' is of one pad: write"),
}


@pytest.mark.parametrize("what", REFUSED_OF_PADS)
def test_what_no_single_pad_can_have_is_refused(what: str, tmp_path: Path) -> None:
    old, new, error, words = REFUSED_OF_PADS[what]
    assert old in OF_PADS
    file = tmp_path / "model.toml"
    file.write_text(OF_PADS.replace(old, new))
    with pytest.raises(error, match=words):
        load_model(file)


HELD = 'rate = "0.197 s/cm"   # s/cm, not s/mm!\nheld = ["slow", "rate"]   # of our tribometer'


def test_what_is_held_stays_held_with_its_comment_and_can_be_let_go(path: Path) -> None:
    path.write_text(BY_HAND.replace('rate = "0.197 s/cm"   # s/cm, not s/mm!', HELD))
    model = load_model(path)
    assert model["shear_rate"].held == ("slow", "rate")
    save_model(model.setting("shear_rate", strength="1.2 MPa"), path)
    assert "of our tribometer" in comments(path.read_text())
    assert load_model(path)["shear_rate"].held == ("slow", "rate")
    fewer = tuple(replace(u, held=("rate",)) if u.held else u for u in model.uses)
    save_model(replace(model, uses=fewer), path)
    assert load_model(path)["shear_rate"].held == ("rate",) and "of our tribometer" in comments(path.read_text())
    free = replace(model, uses=tuple(replace(u, held=()) for u in model.uses))
    save_model(free, path)
    assert "held" not in path.read_text() and load_model(path) == free


@pytest.mark.parametrize(
    ("held", "error", "words"),
    [
        ('"rate"', InputError, r'written as held = \["exponent"\]; held is \'rate\''),
        ("[3]", InputError, r"held is \[3\]"),
        ('["rat"]', UnknownNameError, "no parameter of shear_rate is called 'rat': did you mean rate"),
        ('["rate[A]"]', UnknownNameError, "no parameter of shear_rate is called 'rate"),
    ],
)
def test_what_cannot_be_held_is_refused(held: str, error: type[Exception], words: str, path: Path) -> None:
    path.write_text(BY_HAND.replace("rate = ", f"held = {held}\nrate = "))
    with pytest.raises(error, match=words):
        load_model(path)
