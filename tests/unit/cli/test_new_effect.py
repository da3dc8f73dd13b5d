"""`slipwise effects --new` writes a file that works, and says what to do with it."""

import re
import shlex
from pathlib import Path

import pytest
import typer

from slipwise.cli import app
from slipwise.effects import PORTS, load_effect, skeleton
from slipwise.testing.checks import check_rivals


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def commands(out: str) -> list[list[str]]:
    return [shlex.split(line, comments=True) for line in out.splitlines() if line.startswith("  slipwise ")]


def test_a_file_that_works_is_written_here_and_the_next_commands_exist(slipwise, here: Path) -> None:
    code, out, _ = slipwise("effects", "--new", "my_idea")
    assert code == 0 and out.startswith("wrote ./my_idea.py")
    assert load_effect(here / "my_idea.py").port == "shear"
    known = getattr(typer.main.get_command(app), "commands", {})
    following = commands(out)
    assert [words[1] for words in following] == ["effects", "replay", "add", "diagnose"]
    for words in following:
        assert "./my_idea.py" in words
        options = {option for p in known[words[1]].params for option in p.opts}
        assert {word for word in words if word.startswith("--")} <= options
    code, out, _ = slipwise(*following[0][1:])
    assert code == 0 and "Acts on port 'shear'" in out


@pytest.mark.parametrize("port", PORTS)
def test_every_port_can_be_begun_and_shown(slipwise, here: Path, port: str) -> None:
    code, out, _ = slipwise("effects", "--new", "mine", "--port", port, "--out", "my effects")
    assert code == 0 and out.startswith("wrote './my effects/mine.py'")
    code, out, _ = slipwise(*commands(out)[0][1:])
    assert code == 0 and f"Acts on port '{port}'" in out and skeleton("mine", port).title in out
    check_rivals(load_effect(here / "my effects" / "mine.py"))


def test_a_file_that_exists_is_left_alone(slipwise, here: Path) -> None:
    (here / "my_idea.py").write_text("mine")
    code, _, err = slipwise("effects", "--new", "my_idea")
    assert code == 2 and "exists already and is left as it is" in err
    assert (here / "my_idea.py").read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--new", "run_in"), "an effect called 'run_in' exists already; give yours another name"),
        (("--new", "my-idea"), "use letters a to z, digits and _"),
        (("--new", "os"), "'os' is the name of a module: in its folder os.py would be taken for it; give another name"),
        (("--new", "numpy"), "'numpy' is the name of a module"),
        (("--new", "sitecustomize"), "'sitecustomize' is the name of a module"),
        (("--new", "mine", "--port", "sheer"), "did you mean shear"),
        (("--new", "mine", "--json"), "--new writes a file"),
        (("heating", "--new", "mine"), "--new writes a file"),
        (("--port", "pad"), "belong to a new effect"),
        (("heating", "--out", "here"), "belong to a new effect"),
    ],
)
def test_what_cannot_be_written_is_refused_with_what_to_do(slipwise, here: Path, words: tuple, says: str) -> None:
    code, _, err = slipwise("effects", *words)
    assert code == 2 and re.search(re.escape(says), err) and err.count("\n") == 1
    assert not list(here.iterdir())


def test_who_breaks_the_file_is_told_in_one_sentence(slipwise, here: Path) -> None:
    slipwise("effects", "--new", "mine")
    path = here / "mine.py"
    path.write_text(path.read_text().replace("Valid:", "Holds:"))
    for command in (("effects", "./mine.py"), ("replay", "sine:2Hz,0.3g,cycles=12", "--effect", "./mine.py")):
        code, _, err = slipwise(*command)
        assert (code, err.count("\n")) == (2, 1)
        assert "mine.py: add a line to the docstring at the head of the file, such as 'Valid:" in err
