"""`slipwise effects` says what the files say."""

import json
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from slipwise.cli.effects import effects
from slipwise.effects import catalogue, find_effect
from slipwise.errors import SettingError, UnknownNameError
from slipwise.view.words.effects import effect_rows


@pytest.fixture
def run():
    app = typer.Typer()
    app.command()(effects)

    def call(*words: str) -> str:
        result = CliRunner().invoke(app, list(words))
        if result.exception and not isinstance(result.exception, SystemExit):
            raise result.exception
        assert result.exit_code == 0, result.output
        return result.stdout

    return call


def test_the_list_and_one_effect_are_the_librarys_answers(run) -> None:
    assert json.loads(run("--json")) == effect_rows()
    assert json.loads(run("heating", "--json")) == effect_rows([catalogue()["heating"]])[0]
    assert run("run_in", "--source") == find_effect("run_in").path.read_text()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("buffer_mismatch", ("(yaw): yes", "Needs buffers; not tested otherwise: no buffers")),
        (
            "load_crosstalk",
            (
                "(yaw): no",
                "Needs changing load",
                "one with an offset of the friction gauge",
                "Needs pad_*_N as well on a pad_*_Fx",
            ),
        ),
        ("restrainer", ("Where limit ends on its low bound it is slide_curvature, and not named",)),
        ("position_patch", ("Where width ends on its high bound it is one with the base law, and not named",)),
        ("heating", ("(yaw): no", "Needs nothing beside what every fit needs")),
    ],
)
def test_one_effect_says_whether_it_turns_the_girder_and_what_it_needs(run, name: str, words: tuple[str, ...]) -> None:
    shown = run(name)
    assert all(text in shown for text in words), shown


def test_a_picture_is_written_where_it_was_asked_for(run, tmp_path: Path) -> None:
    run("breakaway", "--picture", str(tmp_path / "breakaway.png"))
    assert (tmp_path / "breakaway.png").read_bytes().startswith(b"\x89PNG")


def test_wrong_names_and_options_are_refused_with_what_is_possible(run, tmp_path: Path) -> None:
    with pytest.raises(UnknownNameError, match="did you mean heating"):
        run("heatin")
    with pytest.raises(SettingError, match="say which"):
        run("--source")
    with pytest.raises(SettingError, match="png"):
        run("heating", "--picture", str(tmp_path / "heating.svg"))
