"""A column that was read in another unit is named with its factor, and nobody else is accused."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from slipwise.campaign import Campaign
from slipwise.instruments.audit import audit
from slipwise.instruments.checks import check_instruments, corrected_campaign
from slipwise.preparation.prepare import prepare
from slipwise.preparation.wrong_units import WrongUnit, _unlike_its_card, find_wrong_units
from slipwise.record import Record


def times(campaign: Campaign, factor: float, *names: str) -> Campaign:
    records = {r.name: r.record.replaced(**{n: factor * r.record[n] for n in names}) for r in campaign.runs}
    return campaign.with_records(records, "")


def test_sound_gauges_are_in_their_units(sound):
    assert find_wrong_units(sound) == []


@pytest.mark.parametrize(
    ("name", "factor"),
    [
        ("pad_A_Fx", 1e3),
        ("pad_C_N", 4.4482216),
        ("pad_B_Fx", 1.0 / 9.80665),
        ("slip_x", 25.4),
        ("girder_ax", 1.0 / 9.80665),
        ("girder_az", 100.0),
        ("table_ax", 1e-3),
        ("table_az", 9.80665),
    ],
)
def test_a_factor_of_units_is_found_in_its_channel(sound, name, factor):
    (found,) = find_wrong_units(times(sound, factor, name))
    assert found.channels == (name,)
    assert found.factor == pytest.approx(factor, rel=1e-4)


def test_a_whole_card_in_kilonewtons_is_found(sound):
    cells = tuple(f"pad_{pad}_Fx" for pad in "ABCD")
    (found,) = find_wrong_units(times(sound, 1e-3, *cells))
    assert (found.channels, found.factor) == (cells, 1e-3)


def test_two_columns_are_both_found(sound):
    found = find_wrong_units(times(times(sound, 1e3, "pad_B_N"), 0.1, "slip_x"))
    assert {(one.channels, one.factor) for one in found} == {(("pad_B_N",), 1e3), (("slip_x",), 0.1)}


@pytest.mark.parametrize("factor", [1.05, 0.9, 1.4])
def test_a_gain_is_no_unit(sound, factor):
    assert find_wrong_units(times(sound, factor, "pad_A_Fx")) == []


def test_a_dead_a_tared_and_a_turned_cell_are_in_no_other_unit(sound):
    rng = np.random.default_rng(3)
    for name, change in (
        ("pad_A_Fx", lambda x: rng.normal(0.0, 15.0, len(x))),
        ("pad_B_N", lambda x: x - x[:50].mean()),
        ("girder_az", lambda x: x + 9.80665),
    ):
        changed = {r.name: r.record.replaced(**{name: change(r.record[name])}) for r in sound.runs}
        assert find_wrong_units(sound.with_records(changed, "")) == []


@pytest.mark.parametrize(
    ("move", "rest", "factor"),
    [
        (0.1, 1.0, None),  # a pad in the middle of a girder that pitches
        (0.1, 0.1, 0.1),  # a cell in another unit
        (0.1, 0.0, 0.1),  # the same, tared
        (10.0, 0.9, None),
    ],
)
def test_a_cell_that_moves_less_is_in_another_unit_only_if_its_weight_at_rest_is_too(move, rest, factor):
    swing = np.sin(np.linspace(0.0, 60.0, 2000)) * 1e3
    cells = {f"pad_{p}_N": 20e3 * (1.0 + 0.05 * k) + swing for k, p in enumerate("ACDE")}
    record = Record(0.002 * np.arange(2000), {**cells, "pad_B_N": 17e3 * rest + move * swing})
    found = _unlike_its_card([cast(Any, SimpleNamespace(record=record))])
    assert found == (None if factor is None else WrongUnit(("pad_B_N",), factor))


def test_an_audit_names_the_unit_and_accuses_nobody_else(sound):
    (finding,) = audit(times(sound, 1e3, "pad_A_Fx")).findings
    assert finding.words == "pad_A_Fx is 1 000 times too large (N read as kN?)"
    assert finding.name == "channel_gain:pad_A_Fx"


def test_preparation_divides_by_the_factor_and_says_so(sound):
    ready = prepare(times(sound, 1e3, "pad_A_Fx"))
    np.testing.assert_allclose(ready.campaign.runs[0].record["pad_A_Fx"], sound.runs[0].record["pad_A_Fx"], rtol=1e-9)
    (told,) = ready.corrections
    assert told.kind == "wrong_unit" and "1 000 times too large" in told.words


def test_records_are_put_right_on_request(sound):
    wrong = times(sound, 1e3, "pad_A_Fx")
    mended = corrected_campaign(wrong, check_instruments(wrong), ["channel_gain:pad_A_Fx"])
    np.testing.assert_allclose(mended.runs[0].record["pad_A_Fx"], sound.runs[0].record["pad_A_Fx"], rtol=1e-9)


@pytest.mark.parametrize(
    ("name", "factor", "words"),
    [
        ("pad_A_N", 1e-3, "x is 1 000 times too small (kN read as N?)"),
        ("slip_x", 25.4, "x is 25.4 times too large (mm read as inch?)"),
        ("girder_ax", 1.0 / 9.80665, "x is 9.807 times too small (g read as m/s^2?)"),
        ("pad_A_Fx", 1e9, "x is 10^9 times too large (is its decimal point right, and the unit of its calibration?)"),
    ],
)
def test_the_sentence_says_what_was_probably_read_as_what(name, factor, words):
    assert WrongUnit((name,), factor).words("x") == words
