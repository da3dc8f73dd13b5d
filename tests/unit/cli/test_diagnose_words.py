"""What `diagnose` and `demo` print: JSON stays alone, and nothing is called found or finished that is not."""

from dataclasses import replace

import pytest

from hypotheses import base, decided, diagnosed, left_by, searched
from slipwise.campaign import Campaign
from slipwise.cli.diagnose import _tell, diagnose
from slipwise.cli.diagnosis_files import _record
from slipwise.cli.model_edit import tell_change
from slipwise.diagnosis.unknown_surface import leftover
from slipwise.record import Record
from slipwise.session.model_change import ModelChange


def without_table(campaign: Campaign) -> Campaign:
    """The campaign as if nobody had measured the table."""

    def left(record: Record) -> Record:
        return Record(record.time, {n: v for n, v in record.channels.items() if not n.startswith("table")})

    return replace(campaign, runs=tuple(replace(run, record=left(run.record)) for run in campaign.runs))


def test_a_recording_that_cannot_be_made_is_reported_beside_the_output_that_a_program_reads(capsys, tmp_path):
    found = diagnosed(searched(base()))
    found = replace(found, final=replace(found.final, campaign=without_table(found.final.campaign)))
    assert _record(found, tmp_path) == []
    printed = capsys.readouterr()
    assert printed.out == "" and "no recording: " in printed.err and "table" in printed.err


def test_who_listens_to_the_first_lines_only_finds_all_files(monkeypatch, tmp_path):
    """`slipwise diagnose campaign | head -3`: what took half a minute is not lost."""

    def left(found):
        raise BrokenPipeError

    found = diagnosed(searched(base()))
    monkeypatch.setattr("slipwise.campaign.load_campaign", lambda _: found.final.campaign)
    monkeypatch.setattr("slipwise.discovery.discover.diagnose_with_law", lambda *_, **__: found)
    monkeypatch.setattr("slipwise.view.pages.diagnosis_page.diagnosis_page", lambda *_: "the page")
    monkeypatch.setattr("slipwise.cli.diagnosis_files._record", lambda _, folder: [folder / "before_and_after.rrd"])
    monkeypatch.setattr("slipwise.cli.diagnose._tell", left)
    with pytest.raises(BrokenPipeError):
        diagnose([tmp_path], out=tmp_path / "out")
    assert sorted(f.name for f in (tmp_path / "out").iterdir()) == ["diagnosis.json", "report.html"]


def test_the_demo_says_what_is_left():
    of = base(pads=20.0)
    quiet = diagnosed(searched(of, left_by("heating", of=of)))
    assert quiet.left_over == "nothing is missing any more"
    little = left_by("heating", of=of, pads=1.3, over=lambda run: run.velocity)
    state = searched(of, little)
    shaped = replace(decided(state), leftover="unknown", surface=leftover(little))
    assert diagnosed(state, shaped).left_over.startswith("what is left: pads: depends on the slip velocity")
    loud = diagnosed(searched(of, left_by("heating", of=of, pads=2.3**2)))
    assert loud.left_over == "still above the noise, in floors: pad friction 2.30"


def test_the_terminal_says_what_each_effect_changes_and_whether_it_is_confirmed(capsys):
    of = base(pads=20.0, girder=3.0)
    found = diagnosed(searched(of, left_by("heating", "table_pitch", of=of)), None, [0.99], {"table_pitch": 0.5})
    _tell(found)
    printed = " ".join(capsys.readouterr().out.split())
    assert "Confirmed on runs that no fit has seen: sine_holdout_2." in printed
    assert "heating +5.0 % -5.0 % pad_A_Fx 10 % material" in printed and "0.5 % -0.5 % pad_A_Fx 1 % minor" in printed
    assert "Hypotheses; held-out error before and after, in noise floors" in printed
    assert "99.0 %" in printed and "nan" not in printed


@pytest.mark.parametrize(("held_out", "title"), [(True, "Held-out error"), (False, "Error of the runs that were fit")])
def test_an_edited_model_says_which_error_it_is_told_by(held_out: bool, title: str, capsys):
    changed = ModelChange("heating added", base().model, {"pads": 4.0}, {"pads": 1.0})
    tell_change(changed, held_out=held_out)
    assert capsys.readouterr().out.startswith(title)
