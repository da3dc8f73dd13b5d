"""`diagnose` of several campaigns and `bench`: one that fails stops no other, and what is done is not done again."""

import csv
import json

import pytest

from hypotheses import base, diagnosed, left_by, searched
from slipwise.cli.batch import _names
from slipwise.errors import InputError, SettingError


@pytest.fixture
def lab(monkeypatch, tmp_path):
    """Folders of campaigns whose diagnosis is known: run_in in b, nothing elsewhere; counts what was diagnosed."""
    of, seen = base(pads=20.0), []
    quiet, worn = diagnosed(searched(base())), diagnosed(searched(of, left_by("run_in", of=of)), None, [0.97])
    for name in ("a", "b", "c"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "campaign.toml").write_text(f'name = "{name}"\nrig = "bridge1"\n')

    def load(folder):
        seen.append(folder.name)
        if not folder.is_dir():
            raise InputError(f"{folder}: no such folder")
        if "broken" in (folder / "campaign.toml").read_text():
            raise InputError(f"{folder.name}.csv: column 3 has no unit")
        return folder.name, quiet.final.campaign

    class Campaign(tuple):
        specimen = quiet.final.campaign.specimen

    monkeypatch.setattr("slipwise.campaign.load_campaign", lambda folder: Campaign(load(folder)))
    monkeypatch.setattr(
        "slipwise.discovery.discover.diagnose_with_law", lambda m, *_, **__: worn if m[0] == "b" else quiet
    )
    monkeypatch.setattr("slipwise.view.pages.diagnosis_page.diagnosis_page", lambda *_: "the page")
    monkeypatch.setattr("slipwise.cli.diagnosis_files._record", lambda *_: [])
    return tmp_path, seen


def test_several_campaigns_get_a_folder_each_a_table_and_a_page_that_leads_to_them(lab, slipwise):
    home, _ = lab
    code, out, _ = slipwise("diagnose", home / "a", home / "b", "--out", home / "o", "--workers", "1")
    assert code == 0
    assert "common to all: nothing" in out and "differs: run_in: has it: b; has it not: a" in out
    assert "no law over all: one law over several specimens needs two campaigns at least; none was given" in out
    for name in ("a", "b"):
        assert json.loads((home / "o" / name / "diagnosis.json").read_text())["schema"] == 2
        assert f'href="{name}/report.html"' in (home / "o" / "index.html").read_text()
        assert (home / "o" / name / "report.html").read_text() == "the page"
    summary = json.loads((home / "o" / "summary.json").read_text())
    assert [c["verdict"] for c in summary["campaigns"]] == ["complete", "named"]
    assert summary["differs"] == [{"effect": "run_in", "has": {"a": "no", "b": "yes"}}]
    rows = list(csv.DictReader((home / "o" / "summary.csv").open()))
    assert [r["campaign"] for r in rows] == ["a", "b"] and float(rows[0]["rig.mass [kg]"]) > 0.0


def test_a_campaign_that_cannot_be_used_is_told_and_the_others_are_diagnosed(lab, slipwise):
    home, _ = lab
    (home / "a" / "campaign.toml").write_text("broken")
    code, out, err = slipwise("diagnose", home / "a", home / "nowhere", home / "b", "--out", home / "o", "--workers", 1)
    assert code == 2
    assert "a failed: a.csv: column 3 has no unit" in out and "run_in" in out
    assert "2 of 3 campaigns could not be diagnosed: a, nowhere" in err
    assert (home / "o" / "b" / "diagnosis.json").is_file() and not (home / "o" / "a").exists()


def test_a_fault_of_ours_is_told_as_one_and_stops_nobody(lab, slipwise, monkeypatch):
    home, _ = lab

    def fault(measured, *_, **__):
        raise KeyError("inner")

    monkeypatch.setattr("slipwise.discovery.discover.diagnose_with_law", fault)
    code, _, err = slipwise("diagnose", home / "a", home / "b", "--out", home / "o", "--workers", "1")
    assert code == 1
    assert "fault of Slipwise" in err and "KeyError" in err and "2 of 2" in err


def test_what_is_done_is_skipped_until_its_files_change_or_its_results_are_gone(lab, slipwise):
    home, seen = lab
    words = ("diagnose", home / "a", home / "b", home / "c", "--out", home / "o", "--workers", "1", "--json")
    first = json.loads(slipwise(*words)[1])
    assert sorted(seen) == ["a", "b", "c"]
    seen.clear()
    assert json.loads(slipwise(*words)[1]) == first and seen == []
    with (home / "a" / "campaign.toml").open("a") as stream:
        stream.write("# changed\n")
    (home / "o" / "b" / "report.html").unlink()
    slipwise(*words)
    assert sorted(seen) == ["a", "b"]


def test_what_failed_is_tried_again(lab, slipwise):
    home, seen = lab
    (home / "a" / "campaign.toml").write_text("broken")
    words = ("diagnose", home / "a", home / "b", "--out", home / "o", "--workers", "1")
    assert (slipwise(*words)[0], slipwise(*words)[0]) == (2, 2)
    assert seen == ["a", "b", "a"]


def test_bench_scores_verdicts_and_a_wrong_one_is_no_error(lab, slipwise):
    home, seen = lab
    for name, missing in (("a", []), ("b", ["run_in"]), ("c", ["heating"])):
        (home / name / "truth.json").write_text(json.dumps({"missing": missing}))
    code, out, _ = slipwise("bench", home, "--out", home / "o", "--workers", "1")
    assert code == 0 and sorted(seen) == ["a", "b", "c"]
    assert "2 of 3" in out
    content = json.loads((home / "o" / "bench.json").read_text())
    assert [c["right"] for c in content["campaigns"]] == [True, True, False]
    assert content["rates"]["complete models accused"] == [0, 1]


def test_bench_without_answers_is_told_what_is_missing(lab, slipwise):
    home, _ = lab
    code, _, err = slipwise("bench", home, "--out", home / "o")
    assert code == 2 and "truth.json" in err


def test_folders_of_one_name_get_results_apart(tmp_path):
    assert _names([tmp_path / "x" / "march", tmp_path / "y" / "march", tmp_path / "may"]) == [
        "x_march",
        "y_march",
        "may",
    ]
    with pytest.raises(SettingError, match="twice"):
        _names([tmp_path / "x", tmp_path / "y" / ".." / "x"])
