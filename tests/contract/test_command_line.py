"""The command line leads on: commands by stage, as the README has them, and a last line that says what to do next."""

import inspect
import re
import sys
from pathlib import Path

import pytest

from slipwise.cli import STAGES, app, main

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
#: Stage of the README -> names of its commands.
TOLD = {
    stage: re.findall(r"^slipwise (\w+)", block, re.M)
    for stage, block in re.findall(r"^# (\w+)\n((?:slipwise .*\n)+)", README, re.M)
}


def printed(capsys, monkeypatch, *words: str) -> list[str]:
    monkeypatch.setattr(sys, "argv", ["slipwise", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 0
    return capsys.readouterr().out.rstrip().splitlines()


def test_the_help_groups_commands_by_stage_as_the_readme_does(capsys, monkeypatch):
    assert [*TOLD] == ["measure", "compare", "name", "decide", "simulate"]
    heads = [re.sub(r"[^\w ]", "", line).strip() for line in printed(capsys, monkeypatch, "--help") if "─ " in line]
    assert [head.lower() for head in heads if head.lower() in TOLD] == [*TOLD]


def test_a_command_stands_in_the_help_at_the_stage_where_the_readme_has_it():
    panels = {str(c.name or c.callback.__name__): str(c.rich_help_panel).lower() for c in app.registered_commands}
    for stage, names in TOLD.items():
        assert {name: panels[name] for name in names} == dict.fromkeys(names, stage)


@pytest.mark.parametrize("command", [c for commands in STAGES.values() for c in commands], ids=lambda c: c.__name__)
def test_every_command_can_say_what_to_do_next(command):
    assert "say_next(" in inspect.getsource(sys.modules[command.__module__])


@pytest.mark.parametrize("words", ["rigs", "rigs three_pads", "channels", "motions", "effects", "effects heating"])
def test_the_last_line_says_what_to_do_next(capsys, monkeypatch, words):
    assert printed(capsys, monkeypatch, *words.split())[-1].startswith("next: ")
