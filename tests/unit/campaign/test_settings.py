"""A slip of the pen in campaign.toml is answered with the nearest name, the table it stands in, and an example."""

import pytest

from slipwise.campaign import load_campaign
from slipwise.errors import InputError, SettingError, SlipwiseError, UnitError, UnknownNameError
from unit.campaign.slider import RUNS

COLUMN = '[columns]\n"slip_x [mm]" = '


@pytest.mark.parametrize(
    ("more", "runs", "message"),
    [
        ("[colums]", RUNS, "key in campaign.toml .*'colums'.*did you mean columns"),
        ("", RUNS.replace("role", "roll", 1), "number 1.*'roll'.*did you mean role"),
        ("", RUNS.replace('"fit"', '"fitt"'), "'fitt'.*did you mean fit"),
        ("", RUNS + 'rest = "1 min"', "did you mean rest_before"),
        ('[specimen]\nmas = "10 t"', RUNS, r"\[specimen\].*did you mean mass"),
        ('[constants]\npad_A_M = "1 kN"', RUNS, "did you mean pad_A_"),
        ('[derived]\npad_A_Fz = "1 kN"', RUNS, "pad_A_F"),
        ('[logger]\nlowpas = "80 Hz"', RUNS, r"\[logger\].*did you mean lowpass"),
        ('[logger]\nslip_xx = {lowpass = "80 Hz"}', RUNS, "did you mean slip_x"),
        ('[logger]\n"pod_*_N" = {lowpass = "80 Hz"}', RUNS, r"pattern of channels"),
        ('[logger]\nlowpass = "80 Hz"\nphase = "casual"', RUNS, "did you mean causal"),
        (COLUMN + '{channel = "slip", unit = "mm"}', RUNS, "did you mean .*slip_x"),
        (COLUMN + '{chanel = "slip_x", unit = "mm"}', RUNS, "did you mean channel"),
        ("", RUNS + '[run.columns]\n"slip_x [mm]" = {channel = "slip", unit = "mm"}', "did you mean .*slip_x"),
    ],
)
def test_a_name_that_does_not_exist_is_answered_with_the_nearest(campaign, more, runs, message):
    with pytest.raises(UnknownNameError, match=message):
        load_campaign(campaign(more, runs))


@pytest.mark.parametrize(
    ("more", "runs", "error", "message"),
    [
        (COLUMN + '{channel = "slip_x"}', RUNS, InputError, "'unit' is missing.*mm"),
        (COLUMN + '{unit = "mm"}', RUNS, InputError, "'channel' is missing"),
        (COLUMN + '{channel = "slip_x", unit = "mm", sign = 2}', RUNS, SettingError, "possible: 1, -1"),
        (COLUMN + '"slip_x"', RUNS, InputError, "must be a table"),
        ('[specimen]\nmass = "10"', RUNS, UnitError, "has no unit; write for example '10 kg'"),
        ('[specimen]\nmass = "10 m"', RUNS, UnitError, "wrong dimension"),
        ("[logger]\norder = 4", RUNS, InputError, "'lowpass' is missing"),
        ('[logger]\nlowpass = "80 Hz"\norder = "four"', RUNS, SettingError, "whole number"),
        ("", RUNS.replace('role = "fit"\n', ""), InputError, "number 1.*'role' is missing"),
        ("", RUNS + 'window = ["3 s", "1 s"]', SettingError, "ends at 1 s, before its start"),
        ("", RUNS + 'window = "3 s"', InputError, "a window is two times"),
        ("", RUNS + 'rest_before = "-1 s"', SettingError, "cannot be below zero"),
        ("", "[run]\n" + 'file = "one.csv"', InputError, "double brackets"),
        ("", "", InputError, "'run' is missing"),
        ("", RUNS + 'columns = "slip_x"', InputError, r"\[run.columns\] of .* number 2 .* must be a table"),
        ("[columns", RUNS, InputError, "not valid TOML"),
    ],
)
def test_what_is_missing_or_impossible_is_said_with_an_example(campaign, more, runs, error, message):
    with pytest.raises(error, match=message):
        load_campaign(campaign(more, runs))


def test_a_rig_that_does_not_exist_is_answered_with_those_that_do(campaign):
    with pytest.raises(SlipwiseError, match="bridge1"):
        load_campaign(campaign(rig="bridge7"))


def test_campaign_toml_may_carry_a_byte_order_mark(campaign):
    folder = campaign()
    path = folder / "campaign.toml"
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert load_campaign(folder).name == "slider"


def test_columns_of_a_run_count_for_that_run_alone_and_take_the_place_of_those_of_all(campaign):
    own = '[run.columns]\n"slip_x [mm]" = {channel = "slip_x", unit = "mm", sign = -1}\n'
    usual, turned = (load_campaign(campaign(runs=runs)).runs for runs in (RUNS, RUNS + own))
    assert (turned[0].record["slip_x"] == usual[0].record["slip_x"]).all()
    assert (turned[1].record["slip_x"] == -usual[1].record["slip_x"]).all()
