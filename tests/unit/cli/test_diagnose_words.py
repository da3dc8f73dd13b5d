"""What `diagnose` and `demo` print: JSON stays alone, and nothing is called found or finished that is not."""

from dataclasses import replace

import pytest

from hypotheses import base, decided, diagnosed, left_by, searched
from slipwise.campaign import Campaign
from slipwise.cli.console import OUT
from slipwise.cli.diagnose import _tell, _with_law, diagnose
from slipwise.cli.diagnosis_files import _record
from slipwise.cli.model_edit import tell_change
from slipwise.diagnosis.unknown_surface import leftover
from slipwise.errors import SettingError
from slipwise.model import use
from slipwise.record import Record
from slipwise.selection.power import EffectPower
from slipwise.selection.upper_limits import UpperLimit
from slipwise.session.model_change import ModelChange
from slipwise.view.words.limit_words import limit_rows, limit_sentence, power_rows, power_words


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


def test_a_law_that_cannot_be_looked_for_leaves_the_verdict(monkeypatch, capsys):
    def fails(*_: object) -> None:
        raise SettingError("channel_offset.offset is out of bounds")

    of = base(pads=20.0)
    state = searched(of, left_by("heating", of=of, pads=19.0))
    found = diagnosed(state, replace(decided(state), kind="unknown", effects=()))
    monkeypatch.setattr("slipwise.discovery.discover.add_law", fails)
    assert _with_law(found, OUT) is found
    assert "no law could be looked for: channel_offset.offset is out of bounds" in capsys.readouterr().out


def test_the_demo_says_what_is_left():
    of = base(pads=20.0)
    quiet = diagnosed(searched(of, left_by("heating", of=of)))
    assert quiet.left_over == "nothing is left above the noise"
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
    assert changed.remarks == ()
    highest = base().model.adding(use("heating", share=0.3, cooling=3600.0))
    risen, ended = replace(changed, model=highest, after={"pads": 5.0}).remarks
    assert "risen from 4 to 5" in risen and "heating.cooling ran to the high end" in ended
    tell_change(changed, held_out=held_out)
    assert capsys.readouterr().out.startswith(title)


def test_an_effect_that_is_none_is_refused_before_anything_is_read(slipwise, tmp_path):
    code, _, err = slipwise("diagnose", tmp_path / "nowhere", "--why-not", "heatin")
    assert code == 2 and "did you mean heating" in err


def test_questions_about_one_campaign_are_not_asked_of_several(slipwise, tmp_path):
    code, _, err = slipwise("diagnose", tmp_path / "a", tmp_path / "b", "--power")
    assert code == 2 and "--power and --why-not ask about one campaign" in err


def limit(name, size, *, measured=True):
    """The limit of an effect of the catalogue with the strength "share", 2 % of which is what matters."""
    moved = {"peak_slip": -1e-4 * size, "energy": 20.0 * size, "largest_load": 50.0 * size}
    return UpperLimit(name, name, size, "share", 0.02 * size, "1", moved, measured)


def test_complete_says_what_it_could_have_missed(capsys):
    found = diagnosed(searched(base()))
    assert found.verdict.kind == "complete"
    limits = {"girder_bending": limit("girder_bending", 4.0, measured=False), "heating": limit("heating", 0.5)}
    _tell(replace(found, limits=limits))
    assert "It could have missed, at a size that matters: girder_bending." in " ".join(capsys.readouterr().out.split())
    _tell(replace(found, limits={"heating": limit("heating", 0.5)}))
    said = " ".join(capsys.readouterr().out.split())
    assert "Each of the 1 other effects that were tested is below what matters (95 %)." in said


def test_a_limit_is_read_in_millimetres_kilonewton_centimetres_and_kilonewtons():
    found = replace(diagnosed(searched(base())), limits={"heating": limit("heating", 0.5)})
    [row] = limit_rows(found)
    assert row["peak slip [mm]"] == "0.05" and row["energy [kN cm]"] == "1" and row["largest load [kN]"] == "0.025"
    assert row["of what matters"] == "0.5" and row["at most"].startswith("share 0.01")
    assert limit_rows(found, brief=True) == []
    words = limit_sentence(None, found.limits["heating"].as_json())
    assert words.startswith("At most 0.5 times what matters (95 %): 0.05 mm of peak slip, 1 kN cm of energy")
    assert limit_sentence(None, limit("heating", 4.0, measured=False).as_json()) == "This campaign says nothing of it."


def test_power_is_told_in_a_sentence_and_a_table():
    power = {
        "run_in": EffectPower("run_in", 20, 19, 18, {}),
        "heating": EffectPower("heating", 20, 1, 1, {"run_in": 3}),
    }
    found = replace(diagnosed(searched(base())), power=power)
    assert "run_in would be seen nearly always; heating nearly never" in power_words(found)
    assert [row["seen"] for row in power_rows(found)] == ["95 %", "5 %"]
    assert power_rows(found)[1]["else taken for"] == "run_in (15 %)"
