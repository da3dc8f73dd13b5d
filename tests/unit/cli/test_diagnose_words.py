"""What `diagnose` and `demo` print: JSON stays alone, and nothing is called found or finished that is not."""

from types import SimpleNamespace
from typing import Any

import pytest

from slipwise.cli.demo import _left
from slipwise.cli.diagnose import _record
from slipwise.errors import InputError


def test_a_recording_that_cannot_be_made_is_told_beside_the_output_that_a_program_reads(monkeypatch, capsys, tmp_path):
    def refuse(found):
        raise InputError("the table was not measured")

    monkeypatch.setattr("slipwise.diagnose.replays.replays", refuse)
    assert _record(SimpleNamespace(), tmp_path) == []
    said = capsys.readouterr()
    assert said.out == "" and "no recording: the table was not measured" in said.err


@pytest.mark.parametrize(
    ("after", "leftover", "words"),
    [
        (1.02, "none", "nothing is missing any more"),
        (2.3, "none", "still above the noise, in floors: pad friction 2.30"),
        (1.02, "unknown", "what is left: a force that goes with slip"),
    ],
)
def test_the_demo_says_what_is_left(after, leftover, words):
    verdict = SimpleNamespace(leftover=leftover, surface=SimpleNamespace(words="a force that goes with slip"))
    found: Any = SimpleNamespace(relations={"pads": (3.8, after), "girder": (1.0, 1.0)}, verdict=verdict)
    assert _left(found) == words
