"""What leaving an effect out changes is told in per cent, for what it can change, and as material or minor."""

import pytest

from hypotheses import base, decided, diagnosed, left_by, on, searched
from slipwise.diagnosis.result import Diagnosis
from slipwise.selection.importance import Change
from slipwise.view.words.importance_rows import changed, importance_rows, replayed_run


def _found(material: dict[str, float] | None = None, *, held_out: bool = True) -> Diagnosis:
    of = base(held_out=held_out, pads=20.0, girder=3.0)
    whole = left_by("heating", "table_pitch", on("channel_gain", "pad_B_N"), of=of)
    return diagnosed(searched(of, whole), material=material)


def test_the_most_important_comes_first_and_what_is_minor_is_called_so():
    rows = importance_rows(_found({"heating": 3.0, "table_pitch": 0.4, "channel_gain": 6.0}))
    assert [(row["without"], row["it is"]) for row in rows] == [
        ("channel_gain", "material"),
        ("heating", "material"),
        ("table_pitch", "minor"),
    ]
    assert (rows[1]["most in"], rows[1]["by"]) == ("pad_A_Fx", "6 %")


def test_a_gauge_moves_no_girder():
    rows = {row["without"]: row for row in importance_rows(_found())}
    assert rows["channel_gain"]["peak slip"] == rows["channel_gain"]["energy"] == "-"
    assert rows["heating"]["peak slip"] == "+5.0 % (+4.0 to +6.0)"


def test_a_terminal_has_room_for_short_headings_only():
    (row, *_) = importance_rows(_found({"heating": 9.0}), brief=True)
    assert (row["slip"], row["energy"], row["most in"]) == ("+9.0 %", "-9.0 %", "pad_A_Fx")


def test_what_nothing_was_replayed_for_has_no_column():
    of = base(pads=20.0)
    rows = importance_rows(diagnosed(searched(of, left_by(on("channel_gain", "pad_B_N"), of=of))))
    assert [list(row) for row in rows] == [["without", "most in", "by", "it is"]]


def test_nothing_found_gives_no_row():
    assert importance_rows(diagnosed(searched(base()))) == []


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (Change(0.05, 0.04, 0.06), "+5.0 % (+4.0 to +6.0)"),
        (Change(-0.0004, -0.004, 0.004), "+0.0 % (-0.4 to +0.4)"),
        (Change(-1.0, -1.25, -0.75), "-100.0 % (-125.0 to -75.0)"),
    ],
)
def test_a_change_is_written_with_its_sign_and_its_interval(change: Change, words: str) -> None:
    assert changed(change) == words
    assert changed(change, intervals=False) == words.partition(" (")[0]


def test_the_run_that_is_replayed_is_named():
    assert replayed_run(_found()) == "the held-out run sine_holdout_2"
    assert replayed_run(_found(held_out=False)) == "the last run, sine_fit_2"


def test_an_effect_in_the_place_of_another_has_no_row_of_its_own():
    of = base(pads=20.0)
    state = searched(of, left_by("heating", of=of), left_by("run_in", of=of))
    assert decided(state).kind == "ambiguous"
    assert [row["without"] for row in importance_rows(diagnosed(state))] == ["heating"]
