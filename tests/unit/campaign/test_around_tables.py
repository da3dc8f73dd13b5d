"""What stands above, below and beside a table's numbers: labelled rows, clocks, totals; and what is damaged there."""

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.data_files.table import open_table
from slipwise.errors import InputError, UnitError

N = 60
TIME = 0.02 * np.arange(N)
SLIP = 5.0 * np.sin(6.0 * TIME)
FORCE = 60.0 * np.cos(6.0 * TIME)
LABELLED = "Sampling frequency (Hz),50\nChannel name,Slip,Friction\nChannel No,1,2\nRange,OFF,OFF\nUnit,mm,N\n"
COLUMNS = """rig = "pad"
[columns]
"Slip [mm]" = { channel = "slip_x", unit = "mm" }
"Friction [N]" = { channel = "pad_A_Fx", unit = "N" }
{time}[constants]
pad_A_N = "500 N"
[[run]]
file = "run.csv"
role = "fit"
"""
TIMED = '"Time [s]" = { channel = "time", unit = "s" }\n'


def rows(*columns, first=None, separator=",") -> str:
    lines = [[f"{c[i]:.4f}" for c in columns] for i in range(N)]
    return "".join(separator.join([*(f[i] for f in first or ()), *line]) + "\n" for i, line in enumerate(lines))


def opened(tmp_path, text: str, encoding: str = "utf-8"):
    (tmp_path / "run.csv").write_bytes(text.encode(encoding))
    return open_table(tmp_path / "run.csv")


def read(tmp_path, text: str) -> np.ndarray:
    table = opened(tmp_path, text)
    return np.stack(table.columns(range(len(table.headers))).values, axis=1)


def run(tmp_path, text: str, time: str = TIMED, rate: str = ""):
    (tmp_path / "run.csv").write_text(text, encoding="utf-8")
    (tmp_path / "campaign.toml").write_text(rate + COLUMNS.replace("{time}", time), encoding="utf-8")
    return load_campaign(tmp_path)


@pytest.mark.parametrize(
    "head",
    [
        LABELLED,
        "Abtastrate;50 Hz\nKanalname;Slip;Friction\nKanal Nr;1;2\nBereich;10 mm;5 kN\nEinheit;mm;N\n",
        "サンプリング周波数(Hz),50\nCH名称,Slip,Friction\nCH No,1,2\nレンジ,OFF,OFF\n単位,mm,N\n",
        "采样频率(Hz),50\n通道名称,Slip,Friction\n量程,OFF,OFF\n单位,mm,N\n",
        "Scan rate (Hz),50\nSignal,Slip,Friction\nUnits,mm,N\nRange,10,5 kN\n",
    ],
)
def test_rows_that_say_what_they_hold_give_names_and_units(tmp_path, head):
    separator = ";" if ";" in head else ","
    table = opened(tmp_path, head + rows(TIME, SLIP, FORCE, separator=separator))
    assert table.headers == ("time", "Slip [mm]", "Friction [N]")
    assert table.step == pytest.approx(0.02)


@pytest.mark.parametrize(
    "between",
    ["1,2,3\ns,mm,N\n", "CH0,CH1,CH2\ns,mm,N\n", "±10 V,±10 V,±5 V\ns,mm,N\n", "auto,OFF,OFF\n[s],[mm],[N]\n",
     "s,mm,N\n0,1,2\n", "s,mm,N\n10,50,100\n"[:7] + "off,off,off\n"],
)  # fmt: skip
def test_numbers_and_ranges_between_names_and_rows_are_neither(tmp_path, between):
    table = opened(tmp_path, "Time,Slip,Friction\n" + between + rows(TIME, SLIP, FORCE))
    assert table.headers == ("Time [s]", "Slip [mm]", "Friction [N]")
    assert len(table.columns([0]).values[0]) == N


def test_units_may_stand_above_the_names(tmp_path):
    assert opened(tmp_path, "s,mm,N\nTime,Slip,Friction\n" + rows(TIME, SLIP, FORCE)).headers == (
        "Time [s]", "Slip [mm]", "Friction [N]",
    )  # fmt: skip


def test_a_first_row_of_whole_numbers_is_data_where_the_time_goes_on_from_it(tmp_path):
    assert read(tmp_path, "Time [s],a,b\n0,1,2\n0.5,1.5,2\n1,2,2.5\n1.5,3,4\n")[0].tolist() == [0, 1, 2]


@pytest.mark.parametrize(
    ("form", "unit", "name"),
    [(1000, "ms", "ms"), (1000, "", "Milliseconds"), (1000, "", "ミリ秒"), (1000000, "", "usec"), (1000, "", "msec")],
)
def test_a_clock_of_whole_seconds_takes_its_parts_from_the_column_beside(tmp_path, form, unit, name):
    clock = [f"23:59:{59 + int(t):02d}" if t < 1 else f"00:00:{int(t) - 1:02d}" for t in TIME]
    parts = [str(round(form * t) % form) for t in TIME]
    header = f"Clock,{name},Slip\n" + (f"-,{unit},mm\n" if unit else "")
    table = opened(tmp_path, header + rows(SLIP, first=(clock, parts)))
    np.testing.assert_allclose(table.columns([0]).values[0], TIME, atol=1e-9)


@pytest.mark.parametrize(
    "clock",
    [[f"59:{59 + t:04.1f}" if t < 0.999 else f"00:{t - 1:04.1f}" for t in 0.1 * np.arange(N)],
     [f"10:15:{int(t):02d}:{round(1000 * (t % 1)):03d}" for t in 0.1 * np.arange(N)]],
)  # fmt: skip
def test_clocks_of_spreadsheets_and_loggers_with_a_colon_before_the_milliseconds(tmp_path, clock):
    table = opened(tmp_path, "Clock,Slip\n" + rows(SLIP, first=(clock,)))
    np.testing.assert_allclose(table.columns([0]).values[0], 0.1 * np.arange(N), atol=1e-9)


@pytest.mark.parametrize(
    "below",
    ["\nEnd of test\n", "Max,5,60\nMin,-5,-60\n", "\n,,\nMean,0,1\n", ",,\n,,\n,,\n", "Summe;;\n", "\n-0.3,5.0,60.0\n",
     "\n3.5,42.0,60.0\n240,240,240\n", "Ende der Messung: 3 L\u00e4ufe, 2 g\u00fcltig\n"],
)  # fmt: skip
@pytest.mark.parametrize("wanted", [[0], [1], [2], [0, 1, 2]])
def test_what_stands_below_a_table_is_in_no_column(tmp_path, below, wanted):
    table = opened(tmp_path, "Time [s],Slip [mm],Friction [N]\n" + rows(TIME, SLIP, FORCE) + below)
    assert [len(values) for values in table.columns(wanted).values] == [N] * len(wanted)
    words = below.strip("\n,; ")
    assert bool(table.notes) == bool(words)
    assert not words or "left out, beginning" in table.notes[0]


def test_a_campaign_says_what_it_left_out_below_a_table(tmp_path):
    found = run(tmp_path, "Time [s],Slip [mm],Friction [N]\n" + rows(TIME, SLIP, FORCE) + "Max,5,60\n")
    assert "run.csv: 1 line below the table is left out, beginning 'Max 5 60'" in found.notes


def test_rows_after_an_empty_line_that_go_on_are_rows(tmp_path):
    text = "Time [s],Slip [mm]\n" + rows(TIME, SLIP) + "\n" + "1.2,0.1\n1.22,0.2\n"
    assert len(read(tmp_path, text)) == N + 2


def test_columns_between_blanks_are_read_with_names_of_several_words(tmp_path):
    text = "Shear rig 2\n# Time (s)   Slip gauge (mm)   Friction (N)\n" + rows(TIME, SLIP, FORCE, separator="   ")
    table = opened(tmp_path, text)
    assert table.headers == ("Time (s)", "Slip gauge (mm)", "Friction (N)")
    np.testing.assert_allclose(table.columns([2]).values[0], FORCE, atol=1e-4)


@pytest.mark.parametrize(
    ("statement", "step"),
    [
        ("Abtastfrequenz: 50 Hz", 0.02), ("Messrate = 0,05 kHz", 0.02), ("Fréquence d'échantillonnage : 50 Hz", 0.02),
        ("Frecuencia de muestreo: 50 Hz", 0.02), ("Frequenza di campionamento: 50 Hz", 0.02),
        ("Örnekleme frekansı: 50 Hz", 0.02), ("Frequência de amostragem: 50 Hz", 0.02), ("采样频率: 50 Hz", 0.02),
        ("サンプリング間隔(ms),20", 0.02), ("Pas de temps : 0,02 s", 0.02), ("Zeitschritt: 20 ms", 0.02),
        ("Intervalo de muestreo: 20 ms", 0.02), ("Grenzfrequenz: 50 Hz", None),
    ],
)  # fmt: skip
def test_the_rate_is_understood_in_many_languages(tmp_path, statement, step):
    table = opened(tmp_path, f"{statement}\n\nSlip [mm];Friction [N]\n" + rows(SLIP, FORCE, separator=";"))
    assert table.step == (None if step is None else pytest.approx(step))


# damaged twins


def test_times_that_contradict_the_stated_rate_are_refused_with_both(tmp_path):
    text = "Sample rate: 100 Hz\n\nTime [s],Slip [mm],Friction [N]\n" + rows(TIME, SLIP, FORCE)
    with pytest.raises(InputError, match=r"advance by 0\.02 s, the lines above them state 100 Hz; correct one of them"):
        run(tmp_path, text)
    decided = run(tmp_path, text, rate='sample_rate = "50 Hz"\n')
    assert "the times agree with campaign.toml and are taken" in " ".join(decided.notes)


def test_a_name_and_a_row_of_units_that_contradict_each_other_are_refused_with_both(tmp_path):
    head = "Time (s),Slip (mm),Friction (N)\n"
    assert opened(tmp_path, head + "s,mm,N\n" + rows(TIME, SLIP, FORCE)).headers[1] == "Slip (mm)"
    with pytest.raises(InputError, match=r"'Slip \(mm\)' states its unit in its name, and the row of units says 'in'"):
        opened(tmp_path, head + "s,in,N\n" + rows(TIME, SLIP, FORCE))


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda t: t[:-12], "a row with 2 columns where the header has 3"),
        (lambda t: t + t.split("\n", 1)[1], "the time runs backwards 1 times"),
        (lambda t: t + t.splitlines()[-1] + "\n", "the time repeats 1 times"),
        (lambda t: t.replace("Friction [N]", "Slip [mm]"), "'Slip \\[mm\\]' \\(number 2\\) and 'Slip"),
        (lambda t: t.replace("Friction", "Fric"), "the column 'Friction \\[N\\]' of \\[columns\\] is missing"),
        (lambda t: t.replace("0.2000,", "0.2000;"), "0.2000;"),
        (lambda t: t.splitlines()[0] + "\n", "no line of column names above rows of numbers"),
    ],
    ids=["cut", "doubled", "last row doubled", "column doubled", "column renamed", "separator", "no rows"],
)
def test_a_damaged_table_is_refused_in_a_sentence(tmp_path, damage, message):
    text = "Time [s],Slip [mm],Friction [N]\n" + rows(TIME, SLIP, FORCE)
    with pytest.raises(InputError, match=message):
        run(tmp_path, damage(text))


def test_a_labelled_table_without_its_names_is_no_table_of_ranges(tmp_path):
    text = LABELLED.replace("Channel name,Slip,Friction\n", "") + rows(TIME, SLIP, FORCE)
    with pytest.raises(InputError, match="no line of column names above rows of numbers"):
        opened(tmp_path, text)


def test_a_clock_with_a_part_of_a_second_that_is_none_is_refused_where_the_time_turns(tmp_path):
    clock, parts = [f"10:15:{int(t):02d}" for t in TIME], [str(round(1000 * t) % 1000) for t in TIME]
    parts[30] = "12"
    time = '"Clock [s]" = { channel = "time", unit = "s" }\n'
    with pytest.raises(InputError, match="the time runs backwards"):
        run(tmp_path, "Clock,ms,Slip [mm],Friction [N]\n" + rows(SLIP, FORCE, first=(clock, parts)), time)


def test_a_unit_that_was_left_open_is_asked_for_by_column(tmp_path):
    with pytest.raises(UnitError, match=r"column 'Friction \[N\]'.*still \"\?\".*unit = \"kN\", or unit = \"1\""):
        (tmp_path / "run.csv").write_text("Time [s],Slip [mm],Friction [N]\n" + rows(TIME, SLIP, FORCE))
        text = COLUMNS.replace("{time}", TIMED).replace('"pad_A_Fx", unit = "N"', '"pad_A_Fx", unit = "?"')
        (tmp_path / "campaign.toml").write_text(text)
        load_campaign(tmp_path)


def test_two_tables_without_times_are_no_run_of_twice_the_length(tmp_path):
    text = "Sample rate: 50 Hz\n\nSlip [mm],Friction [N]\n" + rows(SLIP, FORCE)
    assert len(run(tmp_path, text, time="").runs[0].record.time) == N
    with pytest.raises(InputError, match=r"it holds 2 tables, from lines .* no column of times tells .*run\.csv#1"):
        run(tmp_path, text + text, time="")
