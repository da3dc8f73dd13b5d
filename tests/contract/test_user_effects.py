"""One file is all that an effect needs, wherever it lies; a file that breaks the contract is told how to mend it."""

import inspect
import json
import shutil
import subprocess
import sys
import textwrap
import warnings
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest

from shaking import shaken, sine
from slipwise.effects import Effect, catalogue, find_effect, load_effect
from slipwise.errors import InputError, SettingError, SlipwiseWarning, UnknownNameError
from slipwise.model import base_model, use
from slipwise.model.file import load_model, save_model
from slipwise.simulation.kernel import engine_for
from slipwise.simulation.predict import predictor
from slipwise.simulation.windows import Windows, simulate_windows
from slipwise.testing.driven import motion
from slipwise.view.words.effects import effect_rows

MINE = '''
"""Washboard: friction that goes up and down along the plate.

    mu *= 1 + c sin(2 pi x / l)

Valid: machined plates.
Source: assumed.
"""

from math import pi, sin

from slipwise.effects import RESPONSE, Effect, ForDiagnosis
from slipwise.params import Parameter


def shear(shear, slip_x, height, length):
    """Scale the shear strength."""
    return shear * (1.0 + height * sin(2.0 * pi * slip_x / length))


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("height", "1", 0.2, -0.5, 0.5, 0.0, "assumed", "c"),
        Parameter("length", "m", 0.01, 1e-3, 0.1, None, "assumed", "l", "mm"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= 1 + c sin(2 pi x/l)",
        moves=RESPONSE,
        signature="odd, periodic in slip",
        confused_with={"position_patch": "a patch is there once"},
    ),
)
'''


def written(folder: Path, text: str = MINE, name: str = "washboard.py") -> Path:
    path = folder / name
    path.write_text(textwrap.dedent(text).lstrip())
    return path


def test_a_file_dropped_into_a_folder_predicts_replays_and_is_listed(tmp_path: Path) -> None:
    effect = load_effect(written(tmp_path))
    model = base_model("bridge1").adding(use(effect))
    moving = motion()
    states = [moving[key] for key in ("time", "load", "velocity", "slip")]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert engine_for([effect]) == "compiled"
    ours, base = predictor(model).pads(*states).bound, predictor(base_model("bridge1")).pads(*states).bound
    carrying = moving["load"] > 0.0
    factor = 1.0 + 0.2 * np.sin(2 * np.pi * moving["slip"][:, :, 0] / 0.01)
    np.testing.assert_allclose((ours / np.where(carrying, base, 1.0))[carrying], factor[carrying], rtol=1e-12)
    np.testing.assert_allclose(predictor(model, engine="python").pads(*states).bound, ours, rtol=1e-12)
    shake = sine(2.0, 3.0, 0.5)
    moved = shaken(model, shake).record["slip_x"]
    assert not np.array_equal(moved, shaken(base_model("bridge1"), shake).record["slip_x"])
    assert [row["name"] for row in effect_rows([effect])] == ["washboard"]
    assert "washboard" not in catalogue(), "files touched to add one effect: one, and none of Slipwise's"


def test_a_copy_of_any_shipped_effect_works_from_outside(tmp_path: Path) -> None:
    """The catalogue has no privilege: the same text under another name gives the same answer."""
    model, again = base_model("bridge1"), base_model("bridge1")
    for name in ("heating", "key_clearance"):
        path = tmp_path / f"my_{name}.py"
        shutil.copy(find_effect(name).path, path)
        model, again = model.adding(use(name)), again.adding(use(load_effect(path)))
    moving = motion()
    states = [moving[key] for key in ("time", "load", "velocity", "slip")]
    ours, theirs = (predictor(m, engine="python").pads(*states).force for m in (model, again))
    assert np.array_equal(ours, theirs)


def test_model_toml_takes_a_file_of_ones_own(tmp_path: Path) -> None:
    path = tmp_path / "model.toml"
    model = base_model("bridge1").adding(use(str(written(tmp_path)), length="20 mm"))
    save_model(model, path)
    assert 'file = "washboard.py"' in path.read_text()
    assert model["washboard"].values["length"] == load_model(path, trust=True)["washboard"].values["length"] == 0.02


NOT_COMPILABLE = MINE.replace("return shear *", "return shear * {'one': 1.0, 2: 'two'}['one'] *")


@pytest.mark.long
def test_an_effect_that_cannot_be_compiled_runs_on_the_python_engine_and_says_so(tmp_path: Path) -> None:
    effect = load_effect(written(tmp_path, NOT_COMPILABLE, "dictionary.py"))
    same = load_effect(written(tmp_path, MINE, "compilable.py"))
    model, compiled = (base_model("bridge1").adding(use(e)) for e in (effect, same))
    moving = motion()
    states = [moving[key][:50] for key in ("time", "load", "velocity", "slip")]
    with pytest.warns(SlipwiseWarning, match=r"dictionary\.py runs on the Python engine"):
        ours = predictor(model).pads(*states).force
    np.testing.assert_allclose(ours, predictor(compiled).pads(*states).force, rtol=1e-12)
    shake = sine(2.0, 3.0, 0.1)
    replayed = shaken(model, shake)
    assert replayed.engine == "python"
    np.testing.assert_allclose(replayed.record["slip_x"], shaken(compiled, shake).record["slip_x"], atol=1e-9)
    windows = Windows(np.stack([sine(2.0, 4.0, 0.05)] * 2), np.zeros((2, 2)), np.full((2, 2), 0.1), None, np.zeros(2))
    for slow, fast in zip(simulate_windows(model, windows), simulate_windows(compiled, windows), strict=True):
        for name in ("slip_x", "slip_y", "pad_A_N", "pad_D_Fx"):
            np.testing.assert_allclose(slow[name], fast[name], rtol=1e-7, atol=1e-7)


@pytest.mark.long
def test_the_command_line_replays_it_and_says_so(tmp_path: Path) -> None:
    path = written(tmp_path, NOT_COMPILABLE, "dictionary.py")
    asked = [
        "replay",
        "sine:10Hz,0.4g,cycles=9",
        "--end",
        "0.1 s",
        "--effect",
        str(path),
        "--out",
        str(tmp_path / "out"),
    ]
    done = subprocess.run(
        [sys.executable, "-c", "from slipwise.cli import main; main()", *asked, "--no-pictures", "--no-recording"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert "Python engine" in done.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["engine"] == "python"


@pytest.mark.parametrize("engine", ["compiled", "python"])
def test_a_single_instant_is_answered_on_either_engine(engine: str) -> None:
    moving = motion()
    states = [moving[key][200:201] for key in ("time", "load", "velocity", "slip")]
    law = predictor(base_model("bridge1"), engine=engine)
    bound = law.pads(*states).bound
    assert bound.shape == (1, 4)
    assert 0.0 < bound.min() <= bound.max() < states[1].max()


def read_anew() -> dict[str, Effect]:
    """Read the catalogue beside the one that is kept: else all laws of that one count as a user's from here on."""
    return catalogue.__wrapped__()


def test_an_effect_is_found_by_the_path_of_its_file_wherever_a_name_is_asked_for(tmp_path: Path) -> None:
    path = written(tmp_path)
    assert find_effect(str(path)).name == use(str(path)).effect.name == "washboard"
    with pytest.raises(InputError, match="no such effect file"):
        find_effect(str(tmp_path / "nowhere.py"))


def test_a_file_is_read_by_its_path_in_words_too(tmp_path: Path) -> None:
    assert load_effect(str(written(tmp_path))).path == load_effect(written(tmp_path)).path


def test_a_file_may_name_another_file_beside_it(tmp_path: Path) -> None:
    written(tmp_path, MINE.replace('"position_patch":', '"washboard":'), "ripple.py")
    with pytest.raises(UnknownNameError, match="washboard"):
        load_effect(tmp_path / "ripple.py")
    written(tmp_path)
    assert set(load_effect(tmp_path / "ripple.py").confused_with) == {"washboard"}


def test_the_catalogue_refuses_a_rival_that_does_not_exist(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written(tmp_path, MINE.replace('"position_patch":', '"position_pacht":'), "offered.py")
    monkeypatch.syspath_prepend(str(tmp_path))
    point = EntryPoint("offered", "offered", "slipwise.effects")
    monkeypatch.setattr("slipwise.effects._catalogue.entry_points", lambda group: [point])
    with pytest.raises(UnknownNameError, match=r"confused_with.*offered\.py.*did you mean position_patch"):
        read_anew()


def test_an_edited_file_is_not_answered_for_by_its_old_self(tmp_path: Path) -> None:
    moving = motion()
    states = [moving[key][:100] for key in ("time", "load", "velocity", "slip")]
    first = predictor(base_model("bridge1").adding(use(load_effect(written(tmp_path)))), engine="python")
    before = first.pads(*states).bound
    edited = load_effect(written(tmp_path, MINE.replace("1.0 + height * sin", "1.0 - height * sin")))
    after = predictor(base_model("bridge1").adding(use(edited)), engine="python").pads(*states).bound
    plain = predictor(base_model("bridge1"), engine="python").pads(*states).bound
    np.testing.assert_allclose(before + after, 2.0 * plain, rtol=1e-12)


def test_a_package_offers_an_effect_by_an_entry_point(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    point = EntryPoint("washboard", "washboard", "slipwise.effects")
    monkeypatch.setattr("slipwise.effects._catalogue.entry_points", lambda group: [point])
    assert read_anew()["washboard"].path == tmp_path / "washboard.py"


def beside(block: str) -> str:
    """The file with another block beside that of the diagnosis."""
    text = MINE.replace("    diagnosis=", f"    {block},\n    diagnosis=")
    return text.replace("Effect, ForDiagnosis", "Effect, ForDiagnosis, Gauges, Rare")


REFUSED = {
    "no block": (beside("gauges={}"), SettingError, r"write gauges=Gauges\(\.\.\.\) in EFFECT"),
    "a hook that went": (
        MINE.replace('"shear",', '"buffer",').replace("def shear(shear,", "def settle(force,"),
        SettingError,
        r"hook 'settle'.*let `spring` change memory",
    ),
    "no EFFECT": (MINE.replace("EFFECT =", "OTHER ="), SettingError, "defines no EFFECT"),
    "no range": (MINE.replace("Valid:", "Range:"), SettingError, "Valid:"),
    "no source": (MINE.replace("Source: assumed", "From: assumed"), SettingError, "Source:"),
    "no unit": (MINE.replace('"length", "m"', '"length", ""'), SettingError, "its unit is '' and must be a text"),
    "millimetres": (
        MINE.replace('"length", "m"', '"length", "mm"'),
        SettingError,
        "is in 'mm', and its numbers are SI",
    ),
    "contract as text": (MINE.replace("contract=1", 'contract="1"'), SettingError, "write contract=1, a number"),
    "empty bounds": (MINE.replace("1e-3, 0.1, None", "0.1, 1e-3, None"), SettingError, "bounds"),
    "typical outside": (MINE.replace("0.01, 1e-3, 0.1, None", "0.5, 1e-3, 0.1, None"), SettingError, "outside"),
    "unknown port": (MINE.replace('port="shear"', 'port="sheer"'), UnknownNameError, "did you mean shear"),
    "unknown component": (MINE.replace('"pad friction"', '"pads"'), UnknownNameError, "component"),
    "unknown input": (
        MINE.replace("slip_x, height", "slip_z, height").replace("* slip_x", "* slip_z"),
        SettingError,
        "slip_z",
    ),
    "wrong hook": (MINE.replace("def shear(shear,", "def area(shear,"), SettingError, "cannot have a hook 'area'"),
    "no hook": (MINE.replace("def shear(", "def _shear("), SettingError, "has no hook"),
    "never off": (MINE.replace("-0.5, 0.5, 0.0,", "-0.5, 0.5, None,"), SettingError, "could never be off"),
    "no channel": (MINE.replace("moves=RESPONSE", 'moves=("pad_*_Q",)'), SettingError, "no channel"),
    "same name twice": (MINE.replace('"length", "m"', '"height", "m"'), SettingError, "share a name"),
    "unknown need": (MINE.replace("moves=RESPONSE,", 'moves=RESPONSE, needs=("heaven",),'), UnknownNameError, "heave"),
    "unknown role": (beside('rare=Rare(base="laws")'), UnknownNameError, "law"),
    "no such lag": (beside('gauges=Gauges(lag="delay")'), UnknownNameError, "lag"),
    "plainer without lag": (
        beside('gauges=Gauges(plainer="channel_delay")'),
        SettingError,
        "lag",
    ),
    "unknown rival": (
        MINE.replace('"position_patch":', '"position_pacht":'),
        UnknownNameError,
        "did you mean position",
    ),
    "unknown equal": (
        beside('rare=Rare(same_unless={"runin": ("yaw",)})'),
        UnknownNameError,
        "same_unless.*did you mean run_in",
    ),
    "misspelt input": (MINE.replace("slip_x", "slip_xx"), SettingError, "did you mean slip_x.*Else add a Parameter"),
    "no memory": (
        MINE.replace("slip_x, height", "slip_x, memory, height"),
        SettingError,
        "EFFECT must name what it rem",
    ),
    "lag without time": (
        MINE.replace("slip_x", "lagged_load"),
        SettingError,
        r'it needs a Parameter\("time_constant", "s", .*\) in EFFECT',
    ),
    "parameter nobody asks for": (
        MINE.replace(", length)", ")").replace("/ length", "/ 0.01"),
        SettingError,
        "no hook asks for the parameter 'length': name it among a hook's arguments, or take it out",
    ),
    "neutral left out": (
        MINE.replace("0.5, 0.0, ", "0.5, "),
        InputError,
        "Parameter takes name, unit, typical, low, high, neutral, source and meaning; mend line 24",
    ),
    "neutral left out of a longer one": (
        MINE.replace("0.1, None, ", "0.1, "),
        SettingError,
        "'length': its neutral value is 'assumed' and must be a number; the order is name, unit, typical",
    ),
    "one parameter without a comma": (
        MINE.replace('"c"),', '"c")').replace(
            '        Parameter("length", "m", 0.01, 1e-3, 0.1, None, "assumed", "l", "mm"),\n', ""
        ),
        SettingError,
        "with a comma behind each, one alone too",
    ),
    "one channel without a comma": (
        MINE.replace("moves=RESPONSE", 'moves=("slip_x")'),
        SettingError,
        r'write moves=\("text",\) in EFFECT',
    ),
    "print": (
        MINE.replace("    return", "    print(slip_x)\n    return"),
        SettingError,
        r"shear\(\) prints.*take print out",
    ),
    "no return": (
        MINE.replace("    return shear", "    shear"),
        SettingError,
        "returns nothing; it must return one number",
    ),
    "two answers": (
        MINE.replace("/ length))", "/ length)), 0.0"),
        SettingError,
        "returns 2 values; it must return one",
    ),
    "an answer in words": (MINE.replace("return shear *", "return 'no' or"), SettingError, "returns a str"),
    "not imported": (
        MINE.replace("import pi, sin", "import pi"),
        SettingError,
        "'sin' is not defined; mend line 17, ask",
    ),
    "syntax": (MINE.replace("/ length))", "/ length)"), InputError, "was never closed in line 17: .* mend that line"),
    "does not import": (MINE.replace("from math import", "from maths import"), InputError, "cannot be imported"),
}


def test_a_file_whose_name_is_none_in_python_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "my-effect.py"
    file.write_text(MINE)
    with pytest.raises(SettingError, match="my-effect.py: the file's name is the effect's"):
        load_effect(file)


def test_a_pause_that_cannot_be_called_is_refused_when_the_file_is_read(tmp_path: Path) -> None:
    text = beside('memory=("age",)').replace("EFFECT =", "def rest(memory, seconds):\n    memry[0] = 0.0\n\n\nEFFECT =")
    with pytest.raises(SettingError, match=r"rest\(\) cannot be called.*memry"):
        load_effect(written(tmp_path, text))


@pytest.mark.parametrize("what", REFUSED)
def test_a_file_that_breaks_the_contract_is_refused_with_what_to_do(what: str, tmp_path: Path) -> None:
    text, error, words = REFUSED[what]
    with pytest.raises(error, match=words) as caught:
        load_effect(written(tmp_path, text))
    assert "washboard.py" in str(caught.value)


FORCE = {
    "one force": ("pad", "pad(load, height)", "return height * load", "returns a float; it must return two numbers"),
    "a rig lost": ("rig", "rig(specimen, height)", "specimen.mass", "returns nothing; it must return a Specimen"),
    "a table lost": ("table", "table(acceleration, height)", "pass", "returns nothing; it must return an array"),
    "no balance": (
        "girder",
        "balance(states, height)",
        "return 1.0",
        "returns a float; it must return a dictionary",
    ),
}


@pytest.mark.parametrize("what", FORCE)
def test_an_answer_of_another_kind_is_refused_where_it_is_given(what: str, tmp_path: Path) -> None:
    port, head, body, words = FORCE[what]
    text = MINE.replace('port="shear"', f'port="{port}"').replace("shear(shear, slip_x, height, length)", head)
    text = text.replace("return shear * (1.0 + height * sin(2.0 * pi * slip_x / length))", body)
    text = text.replace('        Parameter("length", "m", 0.01, 1e-3, 0.1, None, "assumed", "l", "mm"),\n', "")
    with pytest.raises(SettingError, match=words):
        effect = load_effect(written(tmp_path, text))
        asked = inspect.signature(effect.hooks[head.partition("(")[0]]).parameters
        effect.hooks[head.partition("(")[0]](**{n: base_model("bridge1").specimen for n in asked})


def test_a_law_that_this_state_is_not_made_for_is_no_error(tmp_path: Path) -> None:
    text = MINE.replace("return shear *", "return shear / (slip_x - 0.01) *")
    assert load_effect(written(tmp_path, text)).name == "washboard"


def test_a_name_that_exists_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SettingError, match="rename"):
        load_effect(written(tmp_path, MINE, "run_in.py"))


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such effect file"):
        load_effect(tmp_path / "nothing.py")
