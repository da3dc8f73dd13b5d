"""Every number by which a diagnosis decides is listed, with its unit and what it stands on."""

import ast

import pytest

from thresholds import BASES, SCALES, SOURCE, as_written, find_statements, moved, read_table, with_value

STATEMENTS = find_statements()
TABLE = read_table()


def test_the_table_lists_the_numbers_of_the_code_and_no_others_in_their_order():
    assert [one.name for one in STATEMENTS] == list(TABLE), (
        "run `python scripts/19_thresholds.py --update`, and fill in what is new"
    )


def test_the_table_has_the_values_of_the_code():
    assert {one.name: as_written(one.value) for one in STATEMENTS} == {n: row["value"] for n, row in TABLE.items()}


def test_every_number_has_a_meaning_beside_it_a_unit_a_way_to_scale_and_a_basis():
    assert not [one.name for one in STATEMENTS if not one.meaning]
    assert not [name for name, row in TABLE.items() if not row["unit"]]
    assert {row["scales"] for row in TABLE.values()} <= set(SCALES)
    assert {row["basis"] for row in TABLE.values() if row["scales"] != "definition"} <= set(BASES)


def test_a_number_that_was_moved_says_at_how_many_verdicts_of_which_bench():
    measured = [row for row in TABLE.values() if row["turned"] is not None]
    assert all(0 <= row["turned"] <= row["read"] <= row["of"] and row["bench"] for row in measured)


def test_every_number_can_be_moved_both_ways_in_the_text_of_its_module():
    for one in (one for one in STATEMENTS if TABLE[one.name]["scales"] != "definition"):
        text = (SOURCE / one.file).read_text(encoding="utf-8")
        for factor in (1.3, 0.7):
            value = moved(one.value, factor, TABLE[one.name]["scales"])
            assert value != one.value, one.name
            before, after = ast.dump(ast.parse(text)), ast.dump(ast.parse(with_value(text, one, value)))
            assert before != after, one.name


def test_a_share_stays_a_share_when_it_is_moved():
    assert moved((0.05, 0.9), 1.3, "share") == pytest.approx((0.065, 1.0 - 0.1 / 1.3), rel=1e-3)
    assert moved((0.05, 0.9), 0.7, "share") == pytest.approx((0.035, 1.0 - 0.1 / 0.7), rel=1e-3)
