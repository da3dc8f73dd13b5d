"""Files as loggers write them: preambles, units and statistics in rows, time stamps, repeated blocks, no times."""

import datetime

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.data_files.table import open_table
from slipwise.errors import InputError, SlipwiseError

N = 60
TIME = 0.01 * np.arange(N)
SLIP = 5.0 * np.sin(6.0 * TIME)
LOAD = np.full(N, 150.0)
FORCE = 15.0 * np.cos(6.0 * TIME)


def rows(*columns, separator: str = "\t", decimal: str = ".", first=None) -> str:
    """Lines of numbers, four digits each; `first` gives texts of the first column."""
    lines = []
    for i in range(len(columns[0])):
        cells = [f"{column[i]:.4f}".replace(".", decimal) for column in columns]
        lines.append(separator.join([first[i], *cells] if first else cells))
    return "\n".join(lines) + "\n"


def read(tmp_path, text: str | bytes, name: str = "run.txt"):
    path = tmp_path / name.partition("#")[0]
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return open_table(tmp_path / name)


def values(table, *wanted: int) -> np.ndarray:
    return np.stack(table.columns(wanted or range(len(table.headers))).values, axis=1)


PLAIN = ("Time [s]", "Slip [mm]", "Force [kN]")
DATA = np.stack([TIME, SLIP, FORCE], axis=1)


@pytest.mark.parametrize(
    "preamble",
    [
        "Origin\tlogger V5\n\nNumber of channels:\t4\nDate:\t03.02.2031\nSample rate\t100 Hz\n\n",
        "Device\tQuantumX\nChannels\t3\nRate\t100\nFirst\t0\nLast\t59\n\n",
        "Test 7\n1\t2\n",
        "[Header]\nA\t1\nB\t2\nC\t3\n[Data]\n",
    ],
)
@pytest.mark.parametrize("decimal", [".", ","])
def test_keys_with_numbers_above_the_table_are_no_columns(tmp_path, preamble, decimal):
    table = read(tmp_path, preamble + "Time\tSlip\tForce\ns\tmm\tkN\n" + rows(TIME, SLIP, FORCE, decimal=decimal))
    assert table.headers == PLAIN
    np.testing.assert_allclose(values(table), DATA, atol=1e-4)


def test_a_line_of_two_columns_above_a_table_of_two_columns_does_not_name_them(tmp_path):
    table = read(tmp_path, "Sample rate\t100 Hz\nSlip\tForce\nmm\tkN\n" + rows(SLIP, FORCE))
    assert table.headers == ("Slip [mm]", "Force [kN]")
    assert table.step == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("words", "step"),
    [
        ("Sample rate: 100 Hz", 0.01), ("Sampling Frequency (Hz);100", 0.01), ("SampleRate=0,1 kHz", 0.01),
        ("Scan rate\t100\tHz", 0.01), ("Sampling interval (ms): 10", 0.01), ("sample rate 100 S/s", 0.01),
        ("Sample time = 0.01 s", 0.01), ("Corner frequency: 80 Hz", None), ("Date: 03.02.2031", None),
    ],
)  # fmt: skip
def test_the_step_that_a_preamble_states_is_understood(tmp_path, words, step):
    table = read(tmp_path, f"Logger 7\n{words}\n\nSlip [mm]\tForce [kN]\n" + rows(SLIP, FORCE))
    assert table.step == (None if step is None else pytest.approx(step))


def test_two_rates_that_contradict_each_other_are_refused_naming_both(tmp_path):
    with pytest.raises(InputError, match=r"contradicts itself: .*100 Hz.*0\.02 s"):
        read(tmp_path, "Sample rate: 100 Hz\nSample interval: 0.02 s\n\nSlip [mm]\tForce [kN]\n" + rows(SLIP, FORCE))


def toa5(stamps) -> str:
    head = [
        '"TOA5","RIG7","CR6","4711","CR6.Std.09","CPU:slide.CR6","1234","Fast"',
        '"TIMESTAMP","RECORD","Slip","Shear"',
        '"TS","RN","mm","kN"',
        '"","","Smp","Smp"',
    ]
    body = [f'"{t}",{i},{SLIP[i]:.4f},{FORCE[i]:.4f}' for i, t in enumerate(stamps)]
    return "\n".join([*head, *body]) + "\n"


def stamps(form: str = "%Y-%m-%d %H:%M:%S.%f", start=datetime.datetime(2031, 2, 3, 23, 59, 59, 800000)) -> list[str]:
    return [(start + datetime.timedelta(seconds=float(t))).strftime(form) for t in TIME]


def test_campbells_three_header_rows_and_time_stamps_over_midnight(tmp_path):
    table = read(tmp_path, toa5(stamps()), "fast.dat")
    # "RN" is a record's number, no ronnanewton
    assert table.headers == ("TIMESTAMP [s]", "RECORD", "Slip [mm]", "Shear [kN]")
    np.testing.assert_allclose(values(table, 0, 2, 3), DATA, atol=1e-4)


@pytest.mark.parametrize(
    "form", ["%H:%M:%S.%f", "%d.%m.%Y %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S.%f", "%Y-%m-%dT%H:%M:%S.%f"]
)
def test_time_stamps_of_other_forms(tmp_path, form):
    text = "Clock;Slip;Force\n-;mm;kN\n" + rows(SLIP, FORCE, separator=";", first=stamps(form))
    np.testing.assert_allclose(values(read(tmp_path, text)), DATA, atol=1e-4)


def test_day_and_month_that_cannot_be_told_apart_matter_only_where_the_date_changes(tmp_path):
    noon = datetime.datetime(2031, 2, 3, 12)
    text = "Clock;Slip;Force\n" + rows(SLIP, FORCE, separator=";", first=stamps("%m/%d/%Y %I:%M:%S.%f %p", noon))
    np.testing.assert_allclose(values(read(tmp_path, text)), DATA, atol=1e-4)
    late = "Clock;Slip;Force\n" + rows(SLIP, FORCE, separator=";", first=stamps("%m/%d/%Y %H:%M:%S.%f"))
    with pytest.raises(InputError, match="day and month cannot be told apart"):
        values(read(tmp_path, late))


def mts(starts=(0.0, 0.2, 0.4)) -> str:
    """An MTS file whose header repeats before every block of twenty rows."""
    text = "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\r\n\r\n"
    for k, start in enumerate(starts):
        part = slice(20 * k, 20 * k + 20)
        text += f"Data Acquisition\t\tTime:\t{k + 1}\tSec\t2/3/2031 1:02:0{k} PM\r\n"
        text += "Running Time\tSlip\tForce\r\nSec\tmm\tkN\r\n"
        text += rows(start + TIME[:20], SLIP[part], FORCE[part]).replace("\n", "\r\n") + "\r\n"
    return text


MAPPED = """rig = "pad"
[columns]
"Running Time [Sec]" = { channel = "time", unit = "Sec" }
"Slip [mm]" = { channel = "slip_x", unit = "mm" }
"Force [kN]" = { channel = "pad_A_Fx", unit = "kN" }
[constants]
pad_A_N = "150 kN"
"""


def campaign(tmp_path, settings: str, **files: str):
    for name, text in files.items():
        (tmp_path / f"{name}.dat").write_bytes(text.encode())
    (tmp_path / "campaign.toml").write_text(settings, encoding="utf-8")
    return load_campaign(tmp_path)


def test_blocks_of_one_test_under_a_repeated_header_are_one_run(tmp_path):
    run = campaign(tmp_path, MAPPED + '[[run]]\nfile = "a.dat"\nrole = "fit"\n', a=mts()).runs[0]
    np.testing.assert_allclose(run.record.time, TIME, atol=1e-9)
    np.testing.assert_allclose(run.record["slip_x"], SLIP / 1e3, atol=1e-7)


def test_tables_that_start_anew_are_refused_and_each_can_be_a_run_as_the_message_says(tmp_path):
    with pytest.raises(InputError, match=r'holds 3 tables.*starts anew in line 30.*file = "a\.dat#1"'):
        campaign(tmp_path, MAPPED + '[[run]]\nfile = "a.dat"\nrole = "fit"\n', a=mts((0.0, 0.0, 0.0)))
    runs = "".join(f'[[run]]\nfile = "a.dat#{k}"\nrole = "fit"\n' for k in (1, 2, 3))
    found = campaign(tmp_path, MAPPED + runs, a=mts((0.0, 0.0, 0.0))).runs
    np.testing.assert_allclose(np.concatenate([run.record["slip_x"] for run in found]), SLIP / 1e3, atol=1e-7)
    with pytest.raises(InputError, match="the file holds 3 tables"):
        campaign(tmp_path, MAPPED + '[[run]]\nfile = "a.dat#4"\nrole = "fit"\n', a=mts((0.0, 0.0, 0.0)))


def test_a_second_table_with_another_header_says_where_to_cut(tmp_path):
    text = "Time\tSlip\tForce\n" + rows(TIME, SLIP, FORCE) + "Time\tTemperature\tRoom\n" + rows(TIME, SLIP, FORCE)
    with pytest.raises(InputError, match=r"run\.txt, line 62: another table begins here"):
        values(read(tmp_path, text))


def test_words_below_the_table_are_left(tmp_path):
    text = "Time [s]\tSlip [mm]\tForce [kN]\n" + rows(TIME, SLIP, FORCE) + "\nEnd of test\nOperator: M. N.\n"
    np.testing.assert_allclose(values(read(tmp_path, text)), DATA, atol=1e-4)


def test_a_typographic_minus_is_a_minus(tmp_path):
    text = "Time [s]\tSlip [mm]\tForce [kN]\n" + rows(TIME, SLIP, FORCE).replace("-", "\u2212")
    np.testing.assert_allclose(values(read(tmp_path, text)), DATA, atol=1e-4)


def lvm(x_columns: str = "One", decimal: str = ".") -> str:
    head = ["LabVIEW Measurement\t", "Writer_Version\t2", "Separator\tTab", f"Decimal_Separator\t{decimal}"]
    head += ["Multi_Headings\tNo", f"X_Columns\t{x_columns}", "Time\t16:20:35,8", "***End_of_Header***\t", "\t"]
    head += ["Channels\t2\t\t\t", "Samples\t60\t60\t\t", "Y_Unit_Label\tmm\tkN\t\t", "X_Dimension\tTime\tTime\t\t"]
    head += ["X0\t0.0E+0\t0.0E+0\t\t", "Delta_X\t0.010000\t0.010000\t\t", "***End_of_Header***\t\t\t"]
    head += ["X_Value\tSlip\tForce\tComment"]
    if x_columns == "One":
        return "\n".join(head) + "\n" + rows(TIME, SLIP, FORCE, decimal=decimal)
    return "\n".join(head) + "\n" + rows(SLIP, FORCE, decimal=decimal, first=[""] * N)


@pytest.mark.parametrize("decimal", [".", ","])
def test_labview_text_names_its_units_in_the_header_and_may_have_no_times(tmp_path, decimal):
    table = read(tmp_path, lvm(decimal=decimal), "run.lvm")
    assert table.headers == ("X_Value [s]", "Slip [mm]", "Force [kN]")
    np.testing.assert_allclose(values(table), DATA, atol=1e-4)
    bare = read(tmp_path, lvm("No", decimal), "bare.lvm")
    assert bare.step == pytest.approx(0.01)
    np.testing.assert_allclose(values(bare, 1, 2), DATA[:, 1:], atol=1e-4)


def test_a_tdms_file_gives_names_units_and_step(tmp_path):
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(str(tmp_path / "run.tdms")) as writer:
        about = {"wf_increment": 0.01, "unit_string": "mm"}
        writer.write_segment([nptdms.ChannelObject("Rig", "Slip", SLIP, about)])
        writer.write_segment([nptdms.ChannelObject("Rig", "Force", FORCE, {**about, "unit_string": "kN"})])
    table = open_table(tmp_path / "run.tdms")
    assert (table.headers, table.step) == (("Slip [mm]", "Force [kN]"), 0.01)
    np.testing.assert_allclose(values(table), DATA[:, 1:])
    (tmp_path / "bad.tdms").write_bytes(b"TDMx" + b"\x0e\xff" * 200)
    with pytest.raises(InputError, match=r"not a readable \.tdms file: no segment begins at byte 0"):
        open_table(tmp_path / "bad.tdms")


@pytest.mark.parametrize("kept", [0.02, 0.2, 0.5, 0.8, 0.97])
def test_a_tdms_file_that_was_cut_off_is_refused_in_words(tmp_path, capfd, kept):
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(str(tmp_path / "run.tdms")) as writer:
        about = {"wf_increment": 0.01, "unit_string": "mm"}
        for _ in range(3):
            writer.write_segment([nptdms.ChannelObject("Rig", name, SLIP, about) for name in ("Slip", "Force")])
    whole = (tmp_path / "run.tdms").read_bytes()
    (tmp_path / "run.tdms").write_bytes(whole[: int(kept * len(whole))])
    with pytest.raises(InputError, match=r"run\.tdms: the file ends before its segment number \d .*export it again"):
        open_table(tmp_path / "run.tdms")
    assert capfd.readouterr().err == ""


def test_a_workbook_gives_the_first_sheet_with_a_table_and_names_the_others(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.append(["Only words"])
    for name, factor in (("Run 1", 1.0), ("Run 2", 2.0)):
        sheet = book.create_sheet(name)
        for line in (["Logger", 7], [], ["Time", "Slip", "Force"], ["s", "mm", "kN"]):
            sheet.append(line)
        for row in DATA:
            sheet.append([row[0], factor * row[1], row[2]])
    book.save(tmp_path / "run.xlsx")
    table = open_table(tmp_path / "run.xlsx")
    assert table.headers == PLAIN
    assert table.notes == ("sheets Run 2 of run.xlsx hold tables too and are not read",)
    np.testing.assert_allclose(values(table), DATA)
    np.testing.assert_allclose(values(open_table(tmp_path / "run.xlsx#Run 2"), 1)[:, 0], 2 * SLIP)
    with pytest.raises(InputError, match="no sheet is called 'Run 3'; it has Sheet, Run 1, Run 2"):
        open_table(tmp_path / "run.xlsx#Run 3")


@pytest.mark.parametrize(
    ("below", "words"),
    [
        ([["Max", 5, 60]], "1 line below the table is left out, beginning 'Max 5 60'"),
        ([[], ["Repaired", "by", "hand"], [9, 9, 9]], "2 lines below the table are left out, beginning 'Repaired by"),
        ([[], []], ""),
    ],
)
def test_a_workbook_says_which_rows_below_its_table_are_left_out(tmp_path, below, words):
    book = pytest.importorskip("openpyxl").Workbook()
    for line in (["Time [s]", "Slip [mm]", "Force [kN]"], *DATA.tolist(), *below):
        book.active.append(line)
    book.save(tmp_path / "run.xlsx")
    table = open_table(tmp_path / "run.xlsx")
    np.testing.assert_allclose(values(table), DATA)
    assert len(table.notes) == bool(words)
    assert not words or table.notes[0].startswith(f"run.xlsx, sheet Sheet: {words}")


@pytest.mark.parametrize(("module", "file"), [("nptdms", "run.tdms"), ("openpyxl", "run.xlsx")])
def test_a_missing_extra_is_named_with_the_command_that_installs_it(tmp_path, monkeypatch, module, file):
    (tmp_path / file).write_bytes(b"x")
    monkeypatch.setitem(__import__("sys").modules, module, None)
    with pytest.raises(InputError, match=r"pip install 'slipwise\["):
        open_table(tmp_path / file)


NO_TIME = 'rig = "pad"\n{rate}[columns]\n"Slip [mm]" = {{ channel = "slip_x", unit = "mm" }}\n[constants]\n' + (
    'pad_A_N = "1 kN"\n[[run]]\nfile = "a.dat"\nrole = "fit"\n'
)


@pytest.mark.parametrize(
    ("head", "rate", "by"),
    [("", 'sample_rate = "100 Hz"\n', "campaign.toml"), ("Sample rate: 100 Hz\n\n", "", "the file")],
)
def test_a_file_without_times_takes_the_rate_of_the_campaign_or_its_own_and_says_so(tmp_path, head, rate, by):
    found = campaign(tmp_path, NO_TIME.format(rate=rate), a=head + "Slip [mm]\tForce [kN]\n" + rows(SLIP, FORCE))
    np.testing.assert_allclose(found.runs[0].record.time, TIME, atol=1e-12)
    assert f"times from the sample rate of 100 Hz that {by} states" in " ".join(found.notes)


def test_a_rate_that_nobody_states_is_asked_for_and_one_that_is_contradicted_refused(tmp_path):
    body = "Slip [mm]\tForce [kN]\n" + rows(SLIP, FORCE)
    with pytest.raises(InputError, match='or write sample_rate = "500 Hz"'):
        campaign(tmp_path, NO_TIME.format(rate=""), a=body)
    with pytest.raises(InputError, match="the file states a sample rate of 100 Hz, campaign.toml 200 Hz"):
        campaign(tmp_path, NO_TIME.format(rate='sample_rate = "200 Hz"\n'), a="Sample rate: 100 Hz\n\n" + body)
    timed = "time [s]\tSlip [mm]\n" + rows(TIME, SLIP)
    with pytest.raises(InputError, match=r"its times advance by 0\.01 s, sample_rate = 200 Hz says 0\.005 s"):
        campaign(tmp_path, NO_TIME.format(rate='sample_rate = "200 Hz"\n'), a=timed)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "time [s]," + ",".join(f"c{i}" for i in range(5000)) + "\n" + ("1," * 5000 + "1\n") * 3,
            "more than 4096 columns",
        ),
        ("time [s],slip_x [mm]\n0,1\n1e-15,2\n2e-15,3\n", r"advance by 1e-15 s; is the unit of the time right"),
    ],
)
def test_hostile_tables_are_refused_in_words(tmp_path, text, words):
    with pytest.raises(SlipwiseError, match=words):
        campaign(
            tmp_path, 'rig = "pad"\n[constants]\npad_A_N = "1 kN"\n[[run]]\nfile = "a.dat"\nrole = "fit"\n', a=text
        )


def test_a_window_between_two_samples_is_refused(tmp_path):
    run = '[[run]]\nfile = "a.dat"\nrole = "fit"\nwindow = ["0.101 s", "0.102 s"]\n'
    with pytest.raises(InputError, match=r"the window holds 0 samples, at least 16 are needed; the step is 0\.01 s"):
        campaign(tmp_path, MAPPED + run, a=mts())


OURS = 'rig = "pad"\n[constants]\npad_A_N = "1 kN"\n[[run]]\nfile = "a.dat"\nrole = "fit"\n'


def test_a_slip_that_only_its_speed_tells_is_integrated_without_drift_and_it_is_said(tmp_path):
    time = 0.002 * np.arange(2000)
    slip = 5e-3 * np.clip(time - 0.5, 0.0, None) * np.sin(9.0 * np.clip(time - 0.5, 0.0, None))
    speed = np.gradient(slip, time) + 0.8e-3
    text = "time [s]\tslip_vx [mm/s]\n" + rows(time, 1e3 * speed)
    found = campaign(tmp_path, OURS, a=text)
    np.testing.assert_allclose(found.runs[0].record["slip_x"], slip, atol=3e-5)
    assert "slip_x is integrated from slip_vx, a drift of 0.8 mm/s" in " ".join(found.notes)
    assert "integrated from slip_vx" in found.runs[0].record.provenance["made"][0]


def test_a_slip_at_constant_speed_is_no_drift(tmp_path):
    time = 0.01 * np.arange(300)
    found = campaign(tmp_path, OURS, a="time [s]\tslip_vx [mm/s]\n" + rows(time, np.full(300, 20.0)))
    np.testing.assert_allclose(found.runs[0].record["slip_x"], 0.02 * time, atol=1e-9)


def test_the_tables_displacement_gives_its_acceleration(tmp_path):
    time = 0.005 * np.arange(1000)
    shape = np.sin(np.pi * time / time[-1]) ** 4
    place = 0.02 * shape * np.sin(12.0 * time)
    found = campaign(tmp_path, OURS, a="time [s]\ttable_dx [mm]\n" + rows(time, 1e3 * place))
    expected = np.gradient(np.gradient(place, time), time)
    np.testing.assert_allclose(found.runs[0].record["table_ax"], expected, atol=0.03)
    assert "table_ax is table_dx differentiated twice, below 40 Hz" in " ".join(found.notes)


def test_a_sign_turns_the_number_that_was_written(tmp_path):
    mapped = OURS.replace(
        "[constants]", '[columns]\n"T" = { channel = "pad_A_T", unit = "degC", sign = -1 }\n[constants]'
    )
    found = campaign(tmp_path, mapped, a="time [s]\tslip_x [mm]\tT\n" + rows(TIME, SLIP, np.full(N, -20.0)))
    np.testing.assert_allclose(found.runs[0].record["pad_A_T"], 293.15)


@pytest.mark.parametrize(
    ("words", "kelvin"), [("20 degC", 293.15), ("-20 degC", 253.15), ("68 degF", 293.15), ("20 °C + 5 K", 298.15)]
)
def test_a_temperature_in_derived_and_constants_is_the_one_that_is_written(tmp_path, words, kelvin):
    text = "time [s]\tslip_x [mm]\n" + rows(TIME, SLIP)
    derived = OURS.replace("[[run]]", f'[derived]\npad_A_T = "{words}"\n[[run]]')
    np.testing.assert_allclose(campaign(tmp_path, derived, a=text).runs[0].record["pad_A_T"], kelvin)
    if "+" not in words:
        constant = OURS.replace("[constants]", f'[constants]\npad_A_T = "{words}"')
        np.testing.assert_allclose(campaign(tmp_path, constant, a=text).runs[0].record["pad_A_T"], kelvin)
