"""Runs that come in one after another are judged one after another, and a watch that was ended goes on."""

import json
import os
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from hypotheses import base, diagnosed, searched
from slipwise.design.result import NextTest, Proposal
from slipwise.diagnosis.verdict import Verdict
from slipwise.errors import InputError
from slipwise.monitoring import folder as folders
from slipwise.monitoring import watch as module
from slipwise.monitoring.step import load_steps
from slipwise.monitoring.watch import News, watch
from slipwise.view.pages.watch_page import watch_page
from slipwise.view.words.watch_words import news_words
from unit.campaign.slider import HEADER, slider, text

TOML = 'name = "slider"\nrig = "pad"\n'
FIRST = TOML + '[[run]]\nfile = "one.csv"\nrole = "fit"\n[[run]]\nfile = "two.csv"\nrole = "holdout"\n'


@pytest.fixture
def judged(monkeypatch) -> list[tuple[str, ...]]:
    """Let a stand-in diagnose: the runs of every diagnosis, in order. No file is waited for longer than needed."""
    seen: list[tuple[str, ...]] = []

    def diagnose(prepared, *_, **__):
        seen.append(tuple(run.name for run in prepared.recorded.runs))
        verdict = Verdict("complete", (), (), 0.9, "none", 1.0, None, (), ())
        return diagnosed(searched(base(pads=1.0)), verdict, [])

    def next_test(*_, progress, **__):
        progress("a motion", 0.5)
        best = Proposal("sine:1Hz,0.2g", 2.0, "pads", 0.95, "")
        return NextTest((("heating",), ()), (0.9, 0.1), (best,), "")

    monkeypatch.setattr(module, "diagnose", diagnose)
    monkeypatch.setattr(module, "compare", lambda *_, **__: SimpleNamespace(places=()))
    monkeypatch.setattr(module, "next_test", next_test)
    monkeypatch.setattr(module, "_EVERY", 0.0)
    monkeypatch.setattr(folders, "_SETTLED", 0.0)
    return seen


def write(path: Path, seed: int) -> None:
    path.write_text(text(slider(seed), HEADER))


def until(day: Iterator[News], about: str) -> News:
    """Go on until there is news of a kind."""
    return next(news for news in day if news.about == about)


def test_each_run_that_comes_in_is_a_step_and_the_next_motion_follows(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    day = watch(tmp_path, tmp_path / "out" / "watch.json")
    waiting = until(day, "waiting")
    assert [words for words in waiting.waiting if "two.csv" in words] == ["two.csv: no such file yet; it is waited for"]
    first = until(day, "next")
    assert first.steps[0].runs == ("one",) and "sine:1Hz,0.2g" in first.steps[0].next_words
    write(tmp_path / "two.csv", 2)
    second = until(day, "next")
    assert [step.runs for step in second.steps] == [("one",), ("two",)]
    assert judged == [("one",), ("one", "two")]


def test_a_file_that_is_cut_in_a_line_is_waited_for_in_one_sentence(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    whole = text(slider(1), HEADER)
    (tmp_path / "one.csv").write_text(whole[: len(whole) // 2].rpartition(",")[0])
    day = watch(tmp_path, tmp_path / "watch.json")
    (words,) = (words for words in until(day, "waiting").waiting if words.startswith("one.csv"))
    assert words == "one.csv ends in the middle of a line: it is half-written; it is waited for"
    (tmp_path / "one.csv").write_text(whole)
    assert until(day, "verdict").steps[-1].runs == ("one",)
    assert judged == [("one",)]


def test_a_run_in_several_files_is_taken_when_all_of_them_are_whole(tmp_path, judged):
    columns = ("run: time", "run: slip", "force: load", "force: friction")
    names = zip(columns, ("time", "slip_x", "pad_A_N", "pad_A_Fx"), ("s", "mm", "kN", "kN"), strict=True)
    lines = [f'"{c}" = {{ channel = "{name}", unit = "{unit}" }}' for c, name, unit in names]
    run = '[[run]]\nfile = "one"\nrole = "fit"\n'
    (tmp_path / "campaign.toml").write_text(TOML + "[columns]\n" + "\n".join(lines) + "\n" + run)
    table = slider(1)
    (tmp_path / "one").mkdir()
    (tmp_path / "one" / "run.csv").write_text(text(table[:, :2], "time,slip"))
    whole = text(table[:, 2:], "load,friction")
    (tmp_path / "one" / "force.csv").write_text(whole[:300].rpartition(",")[0])
    day = watch(tmp_path, tmp_path / "watch.json")
    assert any(words.startswith("one ends in the middle of a line") for words in until(day, "waiting").waiting)
    (tmp_path / "one" / "force.csv").write_text(whole)
    assert until(day, "verdict").steps[-1].runs == ("one",)


def test_a_run_that_cannot_be_read_is_told_and_the_others_are_judged(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    (tmp_path / "two.csv").write_text("time [s],slip_x\n0,1\n0.01,2\n")
    news = until(watch(tmp_path, tmp_path / "watch.json"), "runs")
    said = news_words(news, None)
    assert any(words.startswith("two.csv is left out: ") and "has no unit" in words for words in said)
    assert news.steps[-1].runs == ("one",)


def test_a_younger_file_is_a_run_that_campaign_toml_need_not_name_and_stays_one(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(TOML)
    write(tmp_path / "later.csv", 1)
    write(tmp_path / "earlier.csv", 2)
    os.utime(tmp_path / "earlier.csv", (1e9, 1e9))
    kept = tmp_path / "out" / "watch.json"
    day = watch(tmp_path, kept)
    assert until(day, "next").steps[-1].runs == ("later",)
    day.close()
    (tmp_path / "campaign.toml").write_text(TOML + '[[run]]\nfile = "earlier.csv"\nrole = "fit"\n')
    assert until(watch(tmp_path, kept), "runs").steps[-1].runs == ("earlier",)
    until(watch(tmp_path, kept), "verdict")
    assert set(judged[-1]) == {"earlier", "later"}


def test_a_younger_file_that_holds_no_samples_is_not_called_a_run(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    write(tmp_path / "more.csv", 2)
    (tmp_path / "readme.txt").write_text("What was tested, and by whom.\n")
    news = until(watch(tmp_path, tmp_path / "watch.json"), "next")
    assert [words.split()[0] for words in news.waiting if "not in campaign.toml" in words] == ["more.csv"]
    assert [words.split(":")[0] for words in news.steps[-1].refused] == ["readme.txt is left out"]


def test_a_run_that_comes_in_breaks_off_what_is_left_to_say(tmp_path, judged, monkeypatch):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    day = watch(tmp_path, tmp_path / "watch.json")
    until(day, "places")
    write(tmp_path / "two.csv", 2)
    assert until(day, "broken off").steps[-1].runs == ("one",)
    assert until(day, "next").steps[-1].runs == ("two",)


def test_a_watch_that_was_killed_goes_on_where_it_was(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    kept = tmp_path / "watch.json"
    day = watch(tmp_path, kept)
    until(day, "verdict")
    day.close()  # as a kill does, before the step is finished
    assert [step.finished for step in load_steps(kept)] == [False]
    day = watch(tmp_path, kept)
    assert [step.finished for step in until(day, "next").steps] == [True]
    assert judged == [("one",), ("one",)]
    day.close()
    write(tmp_path / "two.csv", 2)
    steps = until(watch(tmp_path, kept), "next").steps
    assert [step.runs for step in steps] == [("one",), ("two",)]
    assert judged[2:] == [("one", "two")]


def test_a_changed_run_is_judged_again(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    day = watch(tmp_path, tmp_path / "watch.json")
    until(day, "next")
    write(tmp_path / "one.csv", 3)
    assert until(day, "next").steps[-1].runs == ("one",)
    assert len(judged) == 2


def test_a_campaign_file_that_is_being_edited_ends_nothing(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    day = watch(tmp_path, tmp_path / "watch.json")
    until(day, "next")
    (tmp_path / "campaign.toml").write_text("rig = ")
    assert any("not valid TOML" in words for words in until(day, "waiting").waiting)


def test_a_folder_without_a_campaign_and_a_foreign_file_are_refused(tmp_path, judged):
    with pytest.raises(InputError, match="slipwise init"):
        next(watch(tmp_path, tmp_path / "watch.json"))
    (tmp_path / "campaign.toml").write_text(FIRST)
    (tmp_path / "watch.json").write_text(json.dumps({"steps": 3}))
    with pytest.raises(InputError, match="cannot be gone on from"):
        next(watch(tmp_path, tmp_path / "watch.json"))


def test_the_page_reads_itself_again_until_the_watch_has_ended(tmp_path, judged):
    (tmp_path / "campaign.toml").write_text(FIRST)
    write(tmp_path / "one.csv", 1)
    news = until(watch(tmp_path, tmp_path / "watch.json"), "next")
    page = watch_page("slider", news.steps, news.waiting)
    assert 'http-equiv="refresh"' in page and "Nothing is missing" in page and "sine:1Hz,0.2g" in page
    assert 'http-equiv="refresh"' not in watch_page("slider", news.steps, news.waiting, ended=True)
