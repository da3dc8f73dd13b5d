"""What any tool says of a campaign is read from a small file and scored by one rule."""

import json
from pathlib import Path

import pytest

from slipwise_benchmarks.__main__ import main
from slipwise_benchmarks.hidden import INSTRUMENTS, PHYSICS
from slipwise_benchmarks.hidden_rig import FRAME_EFFECTS
from slipwise_benchmarks.verdicts import (
    Scored,
    UnusableVerdict,
    brier,
    find_strays,
    read_verdict,
    score_folder,
    score_verdict,
    table,
)


def answer(family: str, **effects: float) -> dict:
    """Give an answer key with effects of these sizes in limits of materiality."""
    entries = {name: {"of_limit": size} for name, size in effects.items()}
    missing = [name for name, size in effects.items() if size >= 1.0]
    return {"family": family, "missing": missing, "effects": entries, "alternatives": {}, "first": []}


def write(folder: Path, name: str, **said: object) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.json").write_text(json.dumps(said), encoding="utf-8")


def test_what_matters_must_be_given_and_what_is_absent_must_not():
    key = answer("clean", run_in=2.0, heating=0.1)
    assert score_verdict(key, {"verdict": "named", "effects": ["run_in"]}).right
    assert score_verdict(key, {"verdict": "named", "effects": [], "minor": ["run_in"]}).right
    assert score_verdict(key, {"verdict": "named", "effects": ["run_in", "heating"]}).absent == ("heating",)
    assert score_verdict(key, {"verdict": "complete"}).missed == ("run_in",)
    assert not score_verdict(key, {"verdict": "failed"}).right


def test_names_that_are_listed_and_not_there_are_counted():
    key = answer("clean", run_in=2.0, heating=0.1)
    found = score_verdict(key, {"verdict": "named", "effects": [], "minor": ["run_in", "heating", "breakaway"]})
    assert found.right and found.listed_absent == ("breakaway",)


def test_a_folder_that_is_not_there_and_a_file_of_no_campaign_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert main(["score", str(tmp_path / "nowhere")]) == 2
    assert "there is no folder" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["make", "clean", "abc", "1", "--out", str(tmp_path)])
    assert "write a whole number from 0 on" in capsys.readouterr().err
    write(tmp_path, "a", verdict="complete")
    write(tmp_path, "b", verdict="complete")
    assert find_strays({"a": answer("clean")}, tmp_path) == ["b.json"]


def test_a_complete_model_is_right_when_nothing_is_named():
    key = answer("clean")
    assert score_verdict(key, {"verdict": "complete"}).complete
    assert score_verdict(key, {"verdict": "unknown"}).complete is False
    assert score_verdict(answer("clean", run_in=2.0), {"verdict": "complete"}).complete is None


def test_a_probability_that_is_always_right_costs_nothing_and_a_coin_a_quarter():
    def said(right: bool, probability: float | None) -> Scored:
        return Scored("clean", right, (), (), (), None, probability)

    assert brier([said(True, 1.0), said(False, 0.0)]) == 0.0
    assert brier([said(True, 0.5), said(False, 0.5), said(True, None)]) == 0.25
    assert brier([said(True, None)]) is None
    assert "no probability was given" in table([said(True, None)], 1)


@pytest.mark.parametrize(
    ("said", "word"),
    [({"verdict": "guilty"}, "guilty"), ([1], "verdict"), ({"verdict": "named", "effects": "run_in"}, "list of names"),
     ({"verdict": "named", "probability": 90}, "from 0 to 1"), ({"effects": []}, "key verdict"),
     ({"verdict": "named", "effects": ["run-in"]}, "did you mean run_in"),
     ({"verdict": "named", "minor": [3]}, "no name"),
     ({"verdict": "complete", "leftover": "maybe"}, "none or unknown")],
)  # fmt: skip
def test_a_file_that_is_no_verdict_says_what_to_write(tmp_path: Path, said: object, word: str):
    (tmp_path / "a.json").write_text(json.dumps(said), encoding="utf-8")
    with pytest.raises(UnusableVerdict, match=word):
        read_verdict(tmp_path / "a.json")


def test_a_diagnosis_of_the_library_is_a_verdict(tmp_path: Path):
    (tmp_path / "a").mkdir()
    said = {"schema": 2, "verdict": "named", "effects": ["run_in"], "minor": [], "leftover": "none", "probability": 0.8}
    (tmp_path / "a" / "diagnosis.json").write_text(json.dumps(said), encoding="utf-8")
    scored = score_folder({"a": answer("clean", run_in=2.0), "b": answer("clean")}, tmp_path)
    assert list(scored) == ["a"] and scored["a"].right and scored["a"].probability == 0.8


def test_the_readme_lists_every_name_that_is_hidden():
    text = (Path(__file__).parents[2] / "benchmarks" / "README.md").read_text(encoding="utf-8")
    assert [name for name in (*PHYSICS, *INSTRUMENTS, *FRAME_EFFECTS) if f"`{name}`" not in text] == []
    assert len(text.splitlines()) <= 110


def test_a_stranger_makes_campaigns_and_has_verdicts_scored(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["make", "springs_and_walls", "990000", "2", "--out", str(tmp_path)]) == 0
    folders = sorted((tmp_path / "campaigns").iterdir())
    keys = {path.stem: json.loads(path.read_text()) for path in (tmp_path / "answers").iterdir()}
    assert [folder.name for folder in folders] == sorted(keys)
    for folder in folders:
        assert "answer" not in {path.stem for path in folder.iterdir()} and (folder / "campaign.toml").exists()
        write(tmp_path / "verdicts", folder.name, verdict="named", effects=keys[folder.name]["missing"])
    capsys.readouterr()
    assert main(["score", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert "verdicts on 2 of 2 campaigns" in printed and "2 of 2" in printed.splitlines()[-3]
    assert main(["score", str(tmp_path), "--verdicts", str(tmp_path / "nowhere")]) == 2
    assert "NAME.json" in capsys.readouterr().err
