"""What `diagnose` and `demo` print: JSON stays alone, and nothing is called found or finished that is not."""

from types import SimpleNamespace
from typing import Any

import pytest

from slipwise.cli.diagnose import _record, diagnose
from slipwise.diagnosis.ladder import left_over
from slipwise.errors import InputError


def test_a_recording_that_cannot_be_made_is_told_beside_the_output_that_a_program_reads(capsys, tmp_path):
    def refuse():
        raise InputError("the table was not measured")

    found: Any = SimpleNamespace(replays=refuse)
    assert _record(found, tmp_path) == []
    said = capsys.readouterr()
    assert said.out == "" and "no recording: the table was not measured" in said.err


def test_who_listens_to_the_first_lines_only_finds_all_files(monkeypatch, tmp_path):
    """`slipwise diagnose campaign | head -3`: what took half a minute is not lost."""

    def left(found):
        raise BrokenPipeError

    found = SimpleNamespace(as_json=lambda: {"verdict": "named"}, ladder=lambda: None)
    monkeypatch.setattr(
        "slipwise.campaign.load_campaign", lambda _: SimpleNamespace(specimen=SimpleNamespace(free=True))
    )
    monkeypatch.setattr("slipwise.diagnosis.diagnose.diagnose", lambda *_, **__: found)
    monkeypatch.setattr("slipwise.view.diagnosis_page.diagnosis_page", lambda *_: "the page")
    monkeypatch.setattr("slipwise.cli.diagnose._record", lambda _, folder: [folder / "before_and_after.rrd"])
    monkeypatch.setattr("slipwise.cli.diagnose._tell", left)
    with pytest.raises(BrokenPipeError):
        diagnose(tmp_path, out=tmp_path / "out")
    assert sorted(f.name for f in (tmp_path / "out").iterdir()) == ["diagnosis.json", "report.html"]


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
    assert left_over(found) == words
