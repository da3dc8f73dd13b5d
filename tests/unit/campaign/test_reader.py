"""A campaign is read into runs in SI: columns, units, constants, arithmetic, windows, roles; and what is refused."""

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.errors import InputError, SlipwiseError, UnitError
from unit.campaign.slider import HEADER, RUNS, slider, text

ONE = '[[run]]\nfile = "one.csv"\nrole = "fit"\n'


def test_our_own_headers_need_no_map_and_everything_is_si(campaign):
    read = load_campaign(campaign())
    record, table = read.runs[0].record, slider(1)
    assert read.name == "slider" and [run.role for run in read.runs] == ["fit", "holdout"]
    assert record["slip_x"] == pytest.approx(1e-3 * table[:, 1], rel=1e-5)
    assert record["pad_A_N"] == pytest.approx(1e3 * table[:, 2], rel=1e-5)
    assert len(read.runs[0].sha256) == 64


def test_a_campaign_without_a_name_has_that_of_its_folder_from_within_too(campaign, monkeypatch):
    folder = campaign()
    settings = folder / "campaign.toml"
    settings.write_text(settings.read_text(encoding="utf-8").replace('name = "slider"\n', ""), encoding="utf-8")
    monkeypatch.chdir(folder)
    assert load_campaign(folder).name == load_campaign(".").name == "slider"


@pytest.mark.parametrize(
    ("unit", "factor"), [("kip", 4448.2216), ("kN", 1e3), ("N", 1.0), ("lbf", 4.4482216), ("micronewton", 1e-6)]
)
def test_foreign_headers_are_mapped_with_unit_and_sign(campaign, unit, factor):
    foreign = text(slider(1), "t (s),disp (in),load,friction force")
    entries = {
        "t (s)": '{channel = "time", unit = "s"}',
        "disp (in)": '{channel = "slip_x", unit = "inch"}',
        "load": '{channel = "pad_A_N", unit = "kN"}',
        "friction force": f'{{channel = "pad_A_Fx", unit = "{unit}", sign = -1}}',
    }
    lines = "\n".join(f'"{header}" = {entry}' for header, entry in entries.items())
    record = load_campaign(campaign(f"[columns]\n{lines}", ONE, one=foreign)).runs[0].record
    assert record["slip_x"] == pytest.approx(0.0254 * slider(1)[:, 1], rel=1e-5)
    assert record["pad_A_Fx"] == pytest.approx(-factor * slider(1)[:, 3], rel=1e-5)


def test_a_temperature_in_celsius_becomes_kelvin(campaign):
    table = slider(1)
    folder = campaign(runs=ONE, one=text(table, HEADER.replace("pad_A_N [kN]", "pad_A_T [degC]")))
    assert load_campaign(folder).runs[0].record["pad_A_T"] == pytest.approx(table[:, 2] + 273.15, rel=1e-5)


def test_constants_and_derived_channels_carry_their_units(campaign):
    header = "time [s],slip_x [mm],pad_A_P [bar],pad_A_Fx_raw [kN]"
    more = '[derived]\npad_A_Fx = "pad_A_Fx_raw - pad_A_P * 490.87 mm^2"\n[constants]\npad_B_N = "12.5 kN"'
    record = load_campaign(campaign(more, ONE, one=text(slider(1), header))).runs[0].record
    expected = 1e3 * slider(1)[:, 3] - 1e5 * slider(1)[:, 2] * 490.87e-6
    assert record["pad_A_Fx"] == pytest.approx(expected, abs=0.1)
    assert record["pad_B_N"] == pytest.approx(12500.0)


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("abs(-pad_A_N) * 2", lambda n: 2.0 * n),
        ("sqrt(pad_A_N ^ 2)", lambda n: n),
        ("(pad_A_N + 1 kN) / 2", lambda n: 0.5 * (n + 1e3)),
        ("1 t * 9.81 m/s^2", lambda n: np.full(len(n), 9810.0)),
    ],
)
def test_arithmetic_of_channels(campaign, expression, value):
    record = load_campaign(campaign(f'[derived]\npad_B_N = "{expression}"', ONE)).runs[0].record
    assert record["pad_B_N"] == pytest.approx(value(record["pad_A_N"]))


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("pad_A_N + slip_x", "adds"),
        ("pad_A_N * slip_x", "cannot be turned into 'N'"),
        ("pad_A_M", "did you mean pad_A_N"),
        ("pad_A_N +", "ends too early"),
        ("pad_A_N pad_A_N", "is an operator missing"),
        ("(pad_A_N", "closing bracket"),
        ("pad_A_N / (slip_x - slip_x)", "divides by zero"),
        ("__import__('os')", "."),
    ],
)
def test_arithmetic_that_makes_no_sense_is_refused_and_nothing_is_run_as_python(campaign, expression, message):
    with pytest.raises(SlipwiseError, match=message) as caught:
        load_campaign(campaign(f'[derived]\npad_B_N = "{expression}"', ONE))
    assert "pad_B_N" in str(caught.value)


def test_a_window_cuts_a_run_and_two_windows_of_one_file_have_two_names(campaign):
    runs = "".join(
        f'[[run]]\nfile = "one.csv"\nrole = "{role}"\nwindow = ["{a} s", "{b} s"]\nrest_before = "2 min"\n'
        for role, a, b in (("fit", 0.5, 1.5), ("holdout", 2, 3.5))
    )
    first, second = load_campaign(campaign(runs=runs)).runs
    assert (first.record.time[0], first.record.time[-1]) == pytest.approx((0.5, 1.5))
    assert (first.name, second.name) == ("one 0.5-1.5 s", "one 2-3.5 s")
    assert first.rest_before == pytest.approx(120.0) and second.window == pytest.approx((2.0, 3.5))


def test_what_the_campaign_knows_better_than_the_rated_values_is_used(campaign):
    read = load_campaign(campaign('[specimen]\npad_radius = "30 mm"'))
    assert read.specimen.pad_radius == pytest.approx(0.03)
    assert read.known == {"pad_radius": pytest.approx(0.03)}


@pytest.mark.parametrize(
    ("more", "order", "phase"), [("", 4, "zero"), ('order = 2\nphase = "causal"', 2, "causal")], ids=["plain", "causal"]
)
def test_the_logger_is_known_where_the_campaign_describes_it(campaign, more, order, phase):
    more = f'[logger]\nlowpass = "80 Hz"\n{more}'
    more += '\n"pad_*_N" = {lowpass = "30 Hz"}\nslip_x = {lowpass = "none"}'
    logger = load_campaign(campaign(more)).logger
    by = logger.of("pad_A_Fx")
    assert logger.known and by is not None and (by.frequency, by.order, by.phase) == (80.0, order, phase)
    narrow = logger.of("pad_A_N")
    assert narrow is not None and narrow.frequency == 30.0 and logger.of("slip_x") is None
    assert not load_campaign(campaign()).logger.known


def test_columns_that_are_no_channels_are_named_and_not_used(campaign):
    wide = text(np.column_stack([slider(1), slider(1)[:, 1]]), HEADER + ",slip_z [mm]")
    read = load_campaign(campaign(runs=ONE, one=wide))
    assert "slip_z" not in read.runs[0].record
    assert any("'slip_z [mm]' is no channel" in note and "did you mean slip_" in note for note in read.notes)


@pytest.mark.parametrize("role", ["holdout", "repeat"])
def test_a_run_that_is_a_copy_is_refused_though_renamed_and_moved_in_time(campaign, role):
    copy = slider(1) + np.array([7.0, 0.0, 0.0, 0.0])
    with pytest.raises(InputError, match=f"{role} run 'two'.*holds 100% of the samples.*'one'"):
        load_campaign(campaign(runs=RUNS.replace("holdout", role), two=text(copy)))


def test_a_fitted_run_that_is_a_copy_of_another_is_said_so(campaign):
    copy = slider(1) + np.array([7.0, 0.0, 0.0, 0.0])
    runs = RUNS.replace("holdout", "fit")
    assert not any("share" in note for note in load_campaign(campaign(runs=runs)).notes)
    twice = load_campaign(campaign(runs=runs, two=text(copy)))
    said = [note for note in twice.notes if "share 100% of their samples" in note]
    assert len(said) == 1 and "'one' (one.csv) and 'two' (two.csv)" in said[0]


def test_windows_that_overlap_are_refused_as_copies(campaign):
    runs = ONE + 'window = ["0 s", "2 s"]\n[[run]]\nfile = "one.csv"\nrole = "holdout"\nwindow = ["1 s", "3 s"]\n'
    with pytest.raises(InputError, match="windows that do not overlap"):
        load_campaign(campaign(runs=runs))


@pytest.mark.parametrize(
    ("header", "error", "message"),
    [
        (HEADER.replace("[kN]", "[mm]", 1), UnitError, r"one\.csv, column 'pad_A_N \[mm\]'.*wrong dimension"),
        (HEADER.replace("[kN]", "[kNN]", 1), UnitError, r"'kNN' is not known"),
        (HEADER.replace(" [kN]", "", 1), UnitError, r"'pad_A_N' has no unit.*kN"),
        (HEADER.replace("time", "tme"), InputError, "no column holds the time"),
        (HEADER.replace("pad_A_Fx", "pad_A_N"), InputError, r"pad_A_N stands in two columns.*number 3.*number 4"),
    ],
)
def test_a_header_that_cannot_be_used_names_file_column_and_cure(campaign, header, error, message):
    with pytest.raises(error, match=message):
        load_campaign(campaign(runs=ONE, one=text(slider(1), header)))


def with_bad_value(row: int, column: int, value: float) -> str:
    table = slider(1)
    table[row, column] = value
    return text(table)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (with_bad_value(5, 0, 0.04), "the time repeats 1 times"),
        (with_bad_value(5, 0, 0.01), "the time runs backwards"),
        (with_bad_value(5, 0, np.nan), "the time is missing in 1 rows, first in data row 6"),
        (with_bad_value(9, 1, np.nan), "slip_x is missing or infinite in 1 samples, first at 0.09 s"),
        (text(slider(1)[:1]), "holds 1 rows of data, and a record needs two"),
    ],
)
def test_samples_that_cannot_be_used_say_where_they_are(campaign, content, message):
    with pytest.raises(InputError, match=message):
        load_campaign(campaign(runs=ONE, one=content))


@pytest.mark.parametrize(
    ("more", "runs", "message"),
    [
        ("", ONE.replace("one.csv", "uno.csv"), r"uno\.csv: no such file; data files in that folder: one\.csv"),
        ("", ONE + 'window = ["2 s", "9 s"]', r"from 2 s to 9 s lies outside the data.*0 s to 3.99 s"),
        ("", ONE + ONE, "twice"),
        ('[columns]\n"disp" = {channel = "slip_x", unit = "mm"}', ONE, "the column 'disp' of .columns. is missing"),
        ('[constants]\npad_A_N = "1 kN"', ONE, "both a column and one of .constants."),
    ],
)
def test_what_is_missing_outside_or_doubled_is_said(campaign, more, runs, message):
    with pytest.raises(InputError, match=message):
        load_campaign(campaign(more, runs))


def test_a_folder_that_is_no_campaign_says_how_to_make_one(tmp_path):
    with pytest.raises(InputError, match="slipwise init"):
        load_campaign(tmp_path)
    with pytest.raises(InputError, match="no such folder"):
        load_campaign(tmp_path / "nowhere")
