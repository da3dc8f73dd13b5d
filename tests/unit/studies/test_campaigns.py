"""Many campaigns: what is common, what differs by how much, whether a verdict is right, when one is done anew."""

import json

import pytest

from hypotheses import base, diagnosed, left_by, searched
from slipwise.errors import InputError
from slipwise.studies.campaigns import (
    CHANGED,
    Outcome,
    campaign_key,
    compare_outcomes,
    is_right,
    numbers_of,
    rates,
    read_truth,
    score_outcomes,
    standard_error,
    with_truth,
)

TOML = 'rig = "bridge1"\n[[run]]\nfile = "a.csv"\nrole = "fit"\n'


def number(value, error, unit="kg", **more):
    half = 1.959964 * error
    return {"value": value, "low": value - half, "high": value + half, "unit": unit, "at_bound": False, **more}


def outcome(name, verdict="complete", effects=(), **more):
    numbers = {"verdict": verdict, "effects": list(effects), "minor": [], "cannot_tell": [], "rig": "bridge1"}
    return Outcome(name, {**numbers, "sizes": {}, "base": {}, **more})


FAILED = Outcome("broken", {"failed": "no such file"})


def test_what_all_have_is_common_and_what_some_have_differs():
    found = compare_outcomes([outcome("a", "named", ["run_in", "heating"]), FAILED, outcome("b", "named", ["heating"])])
    assert found.common == ("heating",)
    assert [(d.effect, dict(d.has)) for d in found.differs] == [("run_in", {"a": "yes", "b": "no"})]


def test_one_campaign_that_could_be_read_has_nothing_in_common_with_none():
    assert compare_outcomes([FAILED, outcome("a", "named", ["run_in"])]).common == ()


def test_what_was_not_said_is_not_taken_for_absent():
    others = [
        outcome("b", minor=["run_in"]),
        outcome("c", "ambiguous", ["run_in", "heating"]),
        outcome("d", cannot_tell=["run_in: the motion is too short"]),
        outcome("e", "unknown"),
        outcome("f", cannot_tell=["run_in_too: another"]),
    ]
    found = compare_outcomes([outcome("a", "named", ["run_in"]), *others])
    said = found.differs[0].has
    assert said == {"a": "yes", "b": "minor", "c": "perhaps", "d": "untested", "e": "unknown", "f": "no"}
    assert found.common == ()


def test_a_change_is_told_in_standard_errors_of_the_difference():
    pair = [outcome(n, base={"rig.mass": number(m, e)}) for n, m, e in (("a", 1e4, 3.0), ("b", 10050.0, 4.0))]
    change = compare_outcomes(pair).changes[0]
    assert (change.first, change.other, change.before, change.after) == ("a", "b", 1e4, 10050.0)
    assert change.errors == pytest.approx(10.0, rel=1e-4) and change.significant


def test_what_chance_moves_has_not_changed():
    pair = [outcome(n, base={"rig.mass": number(m, 10.0)}) for n, m in (("a", 1e4), ("b", 1e4 + CHANGED * 14.0))]
    assert not compare_outcomes(pair).changes[0].significant


@pytest.mark.parametrize("more", [{"at_bound": True}, {"limit": "upper"}, {"low": None}])
def test_a_number_without_an_interval_has_no_standard_error(more):
    assert standard_error({**number(1.0, 0.1), **more}) is None
    pair = [outcome("a", base={"k": {**number(1.0, 0.1), **more}}), outcome("b", base={"k": number(9.0, 0.1)})]
    assert compare_outcomes(pair).changes[0].errors is None


def test_base_parameters_of_different_rigs_are_not_held_against_each_other():
    mass, size = {"rig.mass": number(1.0, 0.1)}, {"run_in.rise": number(0.2, 0.01, "1")}
    one, other = outcome("a", base=mass, sizes=size), outcome("b", base=mass, sizes=size, rig="bridge2")
    assert [c.key for c in compare_outcomes([one, other]).changes] == ["run_in.rise"]


def test_every_number_is_held_against_the_first_campaign_that_has_it_largest_change_first():
    masses = [outcome(n, base={"rig.mass": number(m, 1.0)}) for n, m in (("a", 10.0), ("b", 11.0), ("c", 30.0))]
    assert [(c.first, c.other) for c in compare_outcomes(masses).changes] == [("a", "c"), ("a", "b")]


def test_what_is_kept_of_a_diagnosis_is_json_and_parts_effects_from_base():
    of = base(pads=20.0)
    kept = numbers_of(diagnosed(searched(of, left_by("heating", of=of)), None, [0.99]))
    assert json.loads(json.dumps(kept, allow_nan=False)) == kept
    assert kept["effects"] == ["heating"] and "rig.mass" in kept["base"] and "shear_rate.strength" in kept["base"]
    assert not any(key.startswith("heating.") for key in kept["base"])


@pytest.mark.parametrize(
    ("missing", "verdict", "effects", "right"),
    [
        ([], "complete", [], True),
        ([], "named", ["run_in"], False),
        (["run_in"], "named", ["run_in"], True),
        (["run_in"], "complete", [], False),
        (["run_in"], "unknown", [], False),
        (["run_in"], "named", ["run_in", "heating"], False),
        (["run_in", "heating"], "named", ["heating", "run_in"], True),
        (["run_in", "heating"], "named", ["heating"], False),
        (["run_in"], "instrument", ["run_in"], False),
        (["channel_gain"], "instrument", ["channel_gain"], True),
        (["unknown"], "unknown", [], True),
        (["unknown"], "named", ["run_in"], False),
        (["guide_drag"], "ambiguous", ["guide_drag", "buffer_damping"], True),
        (["guide_drag"], "ambiguous", ["run_in", "heating"], False),
        (["run_in"], "named", ["run_in", "pad_compliance"], True),
    ],
)
def test_a_verdict_is_right_where_kind_and_every_name_are(missing, verdict, effects, right):
    assert is_right(missing, {"verdict": verdict, "effects": effects}) is right


def test_scores_count_what_misleads_and_a_failure_is_not_right():
    said = [
        outcome("a", "named", ["heating"]), outcome("b", "named", ["heating"]), outcome("c", "named", ["heating"]),
        outcome("d", "complete"), FAILED,
    ]  # fmt: skip
    scored = score_outcomes(said, [(), ("unknown",), ("channel_gain",), (), ("run_in",)])
    assert [s.right for s in scored] == [False, False, False, True, False]
    assert list(rates(scored).values()) == [(1, 5), (1, 2), (1, 1), (1, 1)]


def test_campaigns_are_found_by_their_answers(tmp_path):
    for name, files in (("a", ("campaign.toml", "truth.json")), ("b", ("campaign.toml",)), ("c", ("truth.json",))):
        (tmp_path / name).mkdir()
        for file in files:
            (tmp_path / name / file).write_text('{"missing": ["run_in"]}')
    assert with_truth([tmp_path]) == with_truth([tmp_path / "a"]) == [tmp_path / "a"]
    assert read_truth(tmp_path / "a") == ("run_in",)
    with pytest.raises(InputError, match="truth.json"):
        with_truth([tmp_path / "b"])
    (tmp_path / "a" / "truth.json").write_text('{"missing": "run_in"}')
    with pytest.raises(InputError, match="list of effects"):
        read_truth(tmp_path / "a")


def test_a_campaign_is_done_anew_when_what_decides_it_changes_and_only_then(tmp_path):
    (tmp_path / "campaign.toml").write_text(TOML)
    (tmp_path / "a.csv").write_text("1")
    mine = tmp_path / "elsewhere.py"

    def key(*settings):
        return campaign_key(tmp_path, None, [mine], settings)

    first = key(True)
    (tmp_path / "truth.json").write_text("{}")
    (tmp_path / "notes.txt").write_text("looked at")
    assert key(True) == first
    seen = {first, key(False)}
    for file, text in (("a.csv", "2"), ("model.toml", "a"), ("campaign.toml", TOML + "# more"), ("elsewhere.py", "1")):
        (tmp_path / file).write_text(text)
        seen.add(key(True))
    assert len(seen) == 6


def test_a_campaign_that_cannot_be_read_has_a_key_too(tmp_path):
    assert campaign_key(tmp_path / "nowhere", None, [], []) != campaign_key(tmp_path, None, [], [])
