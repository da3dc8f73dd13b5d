"""`import slipwise as sw` in a notebook: every name, how results show themselves, and what wrong arguments are told."""

import builtins
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from slipwise.design.result import Proposal
from slipwise.diagnosis.ladder import LadderStep
from slipwise.errors import InputError, SettingError, UnitError
from slipwise.instruments.report import Balance

RECORD = sw.Record(np.arange(5) * 0.01, {"slip_x": np.linspace(0.0, 0.02, 5), "table_ax": np.ones(5)})
MOTION = sw.load_motion("sine:2Hz,0.3g,cycles=9")
REPORT = sw.AuditReport("march", (), (Balance("girder", 2.0, 1.4, 1.1, 900),), (), {}, None, (), ())
STEPS = (
    LadderStep((), 3.1, 3.0, np.nan, 1.0, {"pads": 3.0}),
    LadderStep(("heating",), 1.2, 1.1, np.nan, 1.0, {"pads": 1.1}),
)
NEXT = sw.NextTest((("heating",), ()), (0.8, 0.2), (Proposal("sine:1Hz,0.1g", 2.5, "pads", 0.9, ""),), "")


DEMO = Path(sw.rig.__file__ or "").parents[1] / "demo_data"


RESULTS = {
    "Record": RECORD,
    "TableMotion": MOTION,
    "Effect": sw.effects.find_effect("heating"),
    "EffectUse": sw.use("heating"),
    "Model": sw.base_model("bridge1"),
    "Campaign": sw.load_campaign(DEMO),
    "AuditReport": REPORT,
    "Checks": sw.Checks("Yes: 1 balance agrees.", REPORT, 0.1),
    "Ladder": sw.Ladder("march", STEPS, (40, 3), "nothing above the noise floor is left", (), 1.0),
    "ModelChange": sw.ModelChange("heating added", sw.base_model("pad"), {"pads": 3.0}, {"pads": 1.1}),
    "NextTest": NEXT,
}
PICTURES = [name for name in RESULTS if name not in ("EffectUse", "Model")]


@pytest.mark.parametrize("name", sw.__all__)
def test_every_name_is_there(name):
    assert getattr(sw, name) is not None
    assert name in dir(sw)


def test_an_installation_that_states_no_pictures_says_how_to_get_them(monkeypatch):
    monkeypatch.setattr("slipwise.display.entry_points", lambda group: ())
    with pytest.raises(InputError, match="install it again"):
        RECORD.plot()


def test_the_version_is_that_of_the_package():
    assert sw.__version__ == version("slipwise")


def test_a_name_that_is_not_there_is_told_with_those_that_are():
    with pytest.raises(AttributeError, match="diagnose"):
        sw.diagnosed  # noqa: B018


def test_effects_is_the_catalogue():
    assert "heating" in sw.effects.catalogue()


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_shows_itself_in_one_line_and_as_a_table(name):
    words = repr(RESULTS[name])
    assert words.startswith(f"<{name}: ") and "\n" not in words and len(words) < 300
    assert "<p>" in RESULTS[name]._repr_html_()


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_becomes_a_frame(name):
    pytest.importorskip("pandas", reason="pandas is not installed")
    empty = name in ("AuditReport", "Checks")  # of gauges that nothing is said against
    assert (len(RESULTS[name].to_pandas()) == 0) == empty


def test_a_record_becomes_a_frame_of_its_channels():
    pytest.importorskip("pandas", reason="pandas is not installed")
    found = RECORD.to_pandas()
    assert list(found.columns) == ["time", "slip_x", "table_ax"]
    assert np.array_equal(found["slip_x"], RECORD["slip_x"])


def test_without_pandas_the_extra_is_named(monkeypatch):
    real = builtins.__import__

    def absent(name, *rest):
        if name == "pandas":
            raise ModuleNotFoundError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", absent)
    with pytest.raises(sw.SlipwiseError, match=r"slipwise\[notebook\]"):
        RECORD.to_pandas()


@pytest.mark.parametrize("name", PICTURES)
def test_a_result_draws_itself(name):
    from matplotlib.figure import Figure

    picture = RESULTS[name].plot()
    assert isinstance(picture, Figure) and picture.axes


def test_a_replay_takes_the_names_that_a_command_takes():
    found = sw.replay("pad", "sine:2Hz,0.3g,cycles=9", output_dt=0.01)
    same = sw.replay(sw.base_model("pad"), MOTION, output_dt=0.01)
    assert all(np.array_equal(found.record[name], same.record[name]) for name in same.record.channels)
    assert repr(found).startswith("<Replay: pad")
    assert found.plot().axes


def test_a_value_may_have_its_unit():
    assert sw.use("breakaway", rise="5 %").values["rise"] == 0.05
    assert sw.use("breakaway", decay="20 mm/s").values["decay"] == 0.02
    assert sw.base_model("bridge1").setting("shear_rate", rate="0.197 s/cm")["shear_rate"].values["rate"] == 19.7


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ({"decay": "5 %"}, UnitError, r"breakaway.decay.*m/s.*0.0005 to 0.1 m/s"),
        ({"decay": "fast"}, UnitError, r"breakaway.decay.*0.0005 to 0.1 m/s"),
        ({"decay": "20"}, UnitError, r"no unit.*0.0005 to 0.1 m/s"),
        ({"rise": "50 %"}, SettingError, r"breakaway.rise.*0 to 0.2"),
        ({"rise": [0.1]}, SettingError, r"breakaway.rise.*number in SI or a text with its unit.*got list"),
    ],
)
def test_a_wrong_value_is_told_what_is_right(given, error, words):
    with pytest.raises(error, match=words):
        sw.use("breakaway", **given)


@pytest.mark.parametrize("verb", ["audit", "compare", "diagnose", "ladder"])
def test_a_campaign_of_the_wrong_kind_is_told_what_is_right(verb):
    with pytest.raises(InputError, match="a campaign is a folder .* got int"):
        getattr(sw, verb)(3)


def test_models_effects_and_motions_of_the_wrong_kind_are_told_what_is_right():
    with pytest.raises(SettingError, match="a model is .* got int"):
        sw.replay(3, MOTION)  # type: ignore[arg-type]
    with pytest.raises(SettingError, match="a motion is .* got float"):
        sw.replay("pad", 0.3)  # type: ignore[arg-type]
    with pytest.raises(SettingError, match="an effect is .* got int"):
        sw.use(3)  # type: ignore[arg-type]
    with pytest.raises(SettingError, match="a model is .* got int"):
        sw.diagnose(RESULTS["Campaign"], 3)  # type: ignore[arg-type]
