"""Code beside a campaign is run only where the command says so; names from files cannot steer a terminal or a page."""

import py_compile
import re
import shutil
from importlib.util import cache_from_source
from pathlib import Path

import pytest

import slipwise as package
from slipwise.effects import find_effect
from slipwise.errors import InputError
from slipwise.model.file import load_model, save_model

DEMO = Path(package.__file__).parent / "demo_data"
RAN = 'from pathlib import Path\nPath(__file__).with_name("CODE_RAN").write_text("yes")\n'


@pytest.fixture
def folder(tmp_path):
    """The demo campaign with a model that names a file beside it, which leaves a mark when it is run."""
    here = tmp_path / "campaign"
    shutil.copytree(DEMO, here)
    source = Path(find_effect("run_in").path).read_text()
    docstring, _, rest = source.partition('"""\n\n')
    (here / "mine.py").write_text(f'{docstring}"""\n\n{rest}\n{RAN}')
    (here / "model.toml").write_text('rig = "bridge1"\n[[effect]]\nfile = "mine.py"\n')
    return here


@pytest.mark.parametrize(
    ("command", "entry"),
    [
        (("compare",), 'name = "mine.py"'),
        (("compare",), 'file = "./mine.py"'),
        *((command, 'file = "mine.py"') for command in [("diagnose",), ("ladder",), ("next",)]),
        (("remove", "run_in", "--campaign"), 'file = "mine.py"'),
    ],
)
def test_no_command_runs_a_file_that_only_the_model_names(slipwise, folder, tmp_path, command, entry):
    (folder / "model.toml").write_text(f'rig = "bridge1"\n[[effect]]\n{entry}\n[[effect]]\nname = "run_in"\n')
    out = () if command[0] == "remove" else ("--out", tmp_path / "out")
    code, _, err = slipwise(*command, folder, *out)
    assert code == 2 and "mine.py" in err and "less '" in err and "--trust" in err
    assert not (folder / "CODE_RAN").exists()


@pytest.mark.parametrize(
    "command",
    [
        ("compare", "CAMPAIGN", "--out", "OUT"),
        ("add", "run_in", "--campaign", "CAMPAIGN"),
        ("remove", "run_in", "--campaign", "CAMPAIGN"),
        ("export", "opensees", "bridge1", "--motion", "sine:2Hz,0.3g", "--out", "OUT"),
        ("export", "opensees", "MODEL", "--motion", "sine:2Hz,0.3g", "--out", "OUT"),
        ("consequence", "MODEL", "--out", "OUT"),
    ],
    ids=" ".join,
)
def test_a_file_to_run_that_the_model_does_not_name_is_refused(slipwise, folder, tmp_path, command):
    (folder / "model.toml").write_text('rig = "bridge1"\n[[effect]]\nname = "run_in"\n')
    places = {"CAMPAIGN": folder, "MODEL": folder / "model.toml", "OUT": tmp_path / "out"}
    code, _, err = slipwise(*(places.get(word, word) for word in command), "--effect", folder / "mine.py")
    assert code == 2 and "the model to start from does not name it" in err
    assert not (folder / "CODE_RAN").exists() and not (tmp_path / "out").exists()


@pytest.mark.long
def test_the_flags_that_the_refusal_names_let_it_run(slipwise, folder, tmp_path):
    plain = ("compare", folder, "--no-system", "--no-recording", "--out", tmp_path / "out")
    _, _, err = slipwise(*plain)
    named = re.search(r"--effect '(.+?)'", err)
    assert named and "--trust" in err
    code, _, _ = slipwise(*plain, "--effect", named[1])
    assert code == 0 and (folder / "CODE_RAN").exists()
    (folder / "CODE_RAN").unlink()
    with (folder / "model.toml").open("a") as stream:  # ends the command once the file before it has run
        stream.write('[[effect]]\nname = "no_such_effect"\n')
    code, _, err = slipwise(*plain, "--trust")
    assert code == 2 and "no_such_effect" in err and (folder / "CODE_RAN").exists()


def test_what_lies_in_a_pycache_beside_an_effect_file_is_not_run(folder):
    marked, plain = folder / "marked.py", folder / "mine.py"
    shutil.copy(plain, marked)
    plain.write_text(plain.read_text().removesuffix(f"\n{RAN}"))
    # Python's own import takes such a file without a look at the one that a person reads
    unchecked = py_compile.PycInvalidationMode.UNCHECKED_HASH
    py_compile.compile(str(marked), cache_from_source(plain), str(plain), invalidation_mode=unchecked)
    load_model(folder / "model.toml", trust=[plain])
    assert not (folder / "CODE_RAN").exists()
    load_model(folder / "model.toml", trust=[shutil.move(marked, plain)])
    assert (folder / "CODE_RAN").exists()


def test_trust_in_one_file_is_none_in_another(folder):
    shutil.copy(folder / "mine.py", folder / "other.py")
    with pytest.raises(InputError, match=r"mine\.py"):
        load_model(folder / "model.toml", trust=[folder / "other.py"])
    assert "mine" in load_model(folder / "model.toml", trust=[str(folder / "mine.py")])


def test_a_model_is_edited_without_running_what_it_no_longer_holds(tmp_path, folder):
    path = folder / "model.toml"
    save_model(load_model(path, trust=True).without("mine"), path)
    (folder / "CODE_RAN").unlink()
    assert "mine" not in path.read_text()
    save_model(load_model(path), path)
    assert not (folder / "CODE_RAN").exists()


def test_control_characters_of_a_file_are_shown_and_steer_nothing(slipwise, tmp_path):
    name = "a\x1b[31mred\x07.csv"
    (tmp_path / name).write_text("time [s],slip_x [mm],\x1b]0;title\x07 [kN]\n0,1,2\n0.01,2,3\n0.02,3,4\n0.03,2,3\n")
    (tmp_path / "campaign.toml").write_text(
        'rig = "pad"\nname = "x\\u001b[2J"\n[constants]\npad_A_N = "1 kN"\n'
        '[[run]]\nfile = "a\\u001b[31mred\\u0007.csv"\nrole = "fit"\n'
    )
    told = ""
    for words in (("audit", tmp_path), ("replay", tmp_path / name), ("compare", tmp_path, "--out", tmp_path / "o")):
        _, out, err = slipwise(*words)
        told += out + err
    assert "\x1b" not in told and "\x07" not in told
    assert "\\x1b[31mred\\x07" in told


def test_control_characters_are_shown_in_pages_and_notebooks():
    from slipwise.display import _cell
    from slipwise.view.pages.html import paragraph

    assert "\\x1b[0m&lt;b&gt;" in paragraph("\x1b[0m<b>").text
    assert _cell("\x9b\u202e<") == "\\x9b\\u202e&lt;"
