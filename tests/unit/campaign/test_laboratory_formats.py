"""Binary files of laboratories: MDF, universal files, DIAdem, catman, Dewesoft; and damaged ones."""

import struct
import sys
import types
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.campaign.draft import draft_campaign
from slipwise.data_files.dewesoft_channels import keep_channels
from slipwise.data_files.dewesoft_file import kept_columns
from slipwise.data_files.table import open_table
from slipwise.errors import InputError

N = 300
TIME = 0.01 * np.arange(N)
SLIP = 5.0 * np.sin(5.0 * TIME)
FRICTION = 60.0 * np.cos(5.0 * TIME)
LOAD = 500.0 + 0.2 * np.sin(40.0 * TIME)
CHANNELS = (("Slip", "mm", SLIP), ("Friction", "N", FRICTION), ("Normal load", "N", LOAD))


def write_mdf(path: Path, *, slow: bool = False, version: str = "4.10") -> None:
    asammdf = pytest.importorskip("asammdf")
    with asammdf.MDF(version=version) as file:
        file.append([asammdf.Signal(values, TIME, unit, name) for name, unit, values in CHANNELS])
        if slow:
            file.append([asammdf.Signal(np.full(30, 21.0), 0.1 * np.arange(30), "degC", "Room")])
        file.save(path, overwrite=True)


def write_uff(path: Path, *, kind: int = 1, binary: int = 0) -> None:
    pyuff = pytest.importorskip("pyuff")
    file = pyuff.UFF(str(path))
    for k, (name, unit, values) in enumerate(CHANNELS):
        one = pyuff.prepare_58(
            binary=binary, func_type=kind, id1=name, id2="NONE", rsp_node=k, rsp_dir=1, ref_node=0, ref_dir=0,
            ord_data_type=4, data=values, x=TIME, num_pts=N, abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=0.01,
            abscissa_spec_data_type=17, abscissa_axis_units_lab="s", ordinate_spec_data_type=8,
            ordinate_axis_units_lab=unit, rsp_ent_name="NONE", ref_ent_name="NONE", orddenom_axis_units_lab="NONE",
            z_axis_axis_units_lab="NONE", orddenom_spec_data_type=0, z_axis_spec_data_type=0,
        )  # fmt: skip
        file.write_sets([one], "add")


def write_tdm(path: Path, *, waveform: bool = True, numbers: bool = True) -> None:
    """A .tdm as DIAdem writes it: XML that points into blocks of the .tdx."""
    columns = CHANNELS if waveform else (("Time", "s", TIME), *CHANNELS)
    blocks, channels, locals_, values, data = [], [], [], [], b""
    for k, (name, unit, column) in enumerate(columns):
        blocks.append(f'<block byteOffset="{len(data)}" id="inc{k}" length="{N}" valueType="eFloat64Usi"/>')
        data += column.astype("<f8").tobytes()
        wave = (
            '<instance_attributes><double_attribute name="wf_increment">0.01</double_attribute></instance_attributes>'
        )
        channels.append(
            f'<tdm_channel id="ch{k}"><name>{name}</name><unit_string>{unit}</unit_string>{wave if waveform else ""}'
            f'<group>#xpointer(id("g"))</group><local_columns>#xpointer(id("lc{k}"))</local_columns></tdm_channel>'
        )
        locals_.append(
            f'<localcolumn id="lc{k}"><global_flag>15</global_flag><submatrix>#xpointer(id("sm"))</submatrix>'
            f"<sequence_representation>explicit</sequence_representation>"
            f'<values>#xpointer(id("ds{k}"))</values></localcolumn>'
        )
        values.append(f'<double_sequence id="ds{k}"><values external="inc{k}"/></double_sequence>')
    pointers = " ".join(f'id("ch{k}")' for k in range(len(columns)))
    path.write_text(
        '<?xml version="1.0" encoding="UTF-8"?><usi:tdm version="1.0" xmlns:usi="http://www.ni.com/Schemas/USI/1_0">'
        f'<usi:include><file byteOrder="littleEndian" url="{path.stem}.tdx">{"".join(blocks)}</file></usi:include>'
        '<usi:data><tdm_root id="r"><channelgroups>#xpointer(id("g"))</channelgroups></tdm_root>'
        f'<tdm_channelgroup id="g"><name>Rig</name><channels>#xpointer({pointers})</channels></tdm_channelgroup>'
        f'<submatrix id="sm"><number_of_rows>{N}</number_of_rows></submatrix>'
        f"{''.join(channels)}{''.join(locals_)}{''.join(values)}</usi:data></usi:tdm>"
    )
    if numbers:
        path.with_suffix(".tdx").write_bytes(data)


def write_catman(path: Path, *, cut: int = 0) -> None:
    """A .bin of catman: a header for each channel, then the numbers of one channel after the other."""

    def text(value: str, size: str = "<h") -> bytes:
        return struct.pack(size, len(value)) + value.encode()

    columns = (("Time  1 - default sample rate", "s", TIME), *CHANNELS)
    heads = b""
    for k, (name, unit, column) in enumerate(columns):
        extended = struct.pack("<dd4h3f4f", 0.0, 10.0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        extended += b" " * 48 + struct.pack("<4h2f3hbbfb", 0, 0, 0, 0, 0.0, 0.0, 0, 0, 0, 0, 0, 0.0, 0)
        extended += b" " * 3 + struct.pack("<ffb", 0.0, 0.0, 0) + b" " * 7
        heads += struct.pack("<hi", k + 1, len(column)) + text(name) + text(unit) + text("")
        heads += struct.pack("<hhdi", 0, 8, 1.0e9, len(extended)) + extended
        heads += b"00" + struct.pack("<b", 0) + struct.pack("<h", 0) + text("") + text("", "<i")
    before = text("") + text("") * 32 + struct.pack("<hi", len(columns), 0)
    before += struct.pack(f"<{len(columns)}i", *range(len(columns))) + struct.pack("<i", 0)
    offset = 6 + len(before) + len(heads)
    numbers = b"".join(column.astype("<f8").tobytes() for _, _, column in columns)
    content = struct.pack("<hi", 5012, offset) + before + heads + numbers
    path.write_bytes(content[: len(content) - cut])


WRITERS = {".mf4": write_mdf, ".uff": write_uff, ".tdm": write_tdm, ".bin": write_catman}
EXTRAS = {
    ".mf4": ("asammdf", "mdf"), ".uff": ("pyuff", "uff"), ".tdm": ("tdm_loader", "diadem"),
    ".bin": ("apread", "catman"), ".dxd": ("dwdatareader", "dewesoft"),
}  # fmt: skip


def written(folder: Path, suffix: str, **options) -> Path:
    pytest.importorskip(EXTRAS[suffix][0])
    path = folder / f"run{suffix}"
    WRITERS[suffix](path, **options)
    return path


@pytest.mark.parametrize("suffix", WRITERS)
def test_names_units_times_and_numbers_are_those_that_were_written(tmp_path, suffix):
    table = open_table(written(tmp_path, suffix))
    for name, unit, values in CHANNELS:
        (read,) = table.columns([table.headers.index(f"{name} [{unit}]")]).values
        np.testing.assert_allclose(read, values, atol=1e-5)
    time = next((i for i, header in enumerate(table.headers) if header.lower().startswith("time")), None)
    if time is None:
        assert table.step == pytest.approx(0.01)
    else:
        np.testing.assert_allclose(table.columns([time]).values[0], TIME, atol=1e-9)
    assert not table.notes


@pytest.mark.parametrize("suffix", WRITERS)
def test_a_folder_of_such_files_is_drafted_and_read(tmp_path, suffix, capfd):
    written(tmp_path, suffix)
    draft, _ = draft_campaign(tmp_path)
    assert "not read" not in draft
    (tmp_path / "campaign.toml").write_text(draft, encoding="utf-8")
    record = load_campaign(tmp_path).runs[0].record
    np.testing.assert_allclose(record["slip_x"], 1e-3 * SLIP, atol=1e-8)
    np.testing.assert_allclose(record["pad_A_Fx"], FRICTION, atol=1e-4)
    np.testing.assert_allclose(record["pad_A_N"], LOAD, atol=1e-4)
    np.testing.assert_allclose(record.time, TIME, atol=1e-9)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("suffix", WRITERS)
@pytest.mark.parametrize("kept", [0.02, 0.3, 0.6, 0.95])
def test_a_file_that_was_cut_is_refused_in_one_sentence(tmp_path, suffix, kept, capfd):
    path = written(tmp_path, suffix)
    target = path.with_suffix(".tdx") if suffix == ".tdm" else path
    data = target.read_bytes()
    target.write_bytes(data[: int(kept * len(data))])
    with pytest.raises(InputError) as caught:
        open_table(path)
    assert "\n" not in str(caught.value) and str(path) in str(caught.value)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("suffix", EXTRAS)
@pytest.mark.parametrize("content", [b"", b"hello\n" * 40, bytes(range(256)) * 8])
def test_what_only_bears_the_suffix_is_refused_in_one_sentence(tmp_path, suffix, content, capfd):
    try:
        __import__(EXTRAS[suffix][0])
    except ImportError:
        pytest.skip(f"{EXTRAS[suffix][0]} is not installed")
    path = tmp_path / f"run{suffix}"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        open_table(path)
    assert "\n" not in str(caught.value) and str(path) in str(caught.value)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("suffix", EXTRAS)
def test_a_missing_extra_is_named_with_the_command_that_installs_it(tmp_path, monkeypatch, suffix):
    module, extra = EXTRAS[suffix]
    (tmp_path / f"run{suffix}").write_bytes(b"x" * 20)
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError, match=rf"pip install 'slipwise\[{extra}\]'"):
        open_table(tmp_path / f"run{suffix}")


def test_channels_of_another_rate_are_left_out_by_name(tmp_path):
    table = open_table(written(tmp_path, ".mf4", slow=True))
    assert len(table.headers) == 4
    assert table.notes == ("run.mf4: 1 channel has other times and is left out: Room",)


def test_mdf_of_version_3_is_read(tmp_path):
    pytest.importorskip("asammdf")
    write_mdf(tmp_path / "run.mdf", version="3.30")
    assert "Slip [mm]" in open_table(tmp_path / "run.mdf").headers


def test_a_binary_universal_file_is_read_and_spectra_are_refused_by_what_they_are(tmp_path):
    table = open_table(written(tmp_path, ".uff", binary=1))
    np.testing.assert_allclose(table.columns([1]).values[0], SLIP)
    write_uff(tmp_path / "spectra.unv", kind=2)
    with pytest.raises(InputError, match=r"no time response is in this universal file; it holds 3 functions"):
        open_table(tmp_path / "spectra.unv")


def test_two_responses_of_one_name_are_numbered(tmp_path):
    path = written(tmp_path, ".uff")
    path.write_text(path.read_text().replace("Friction", "Slip    "))
    assert [h.split(" [")[0] for h in open_table(path).headers] == ["time", "Slip", "Slip", "Normal load"]


def test_a_tdm_with_its_time_as_a_channel_is_read_and_one_without_its_numbers_refused(tmp_path):
    table = open_table(written(tmp_path, ".tdm", waveform=False))
    assert table.headers[0] == "Time [s]" and table.step is None
    with pytest.raises(InputError, match=r"its numbers are in alone\.tdx, which is missing; copy it beside the \.tdm"):
        write_tdm(tmp_path / "alone.tdm", numbers=False)
        open_table(tmp_path / "alone.tdm")


def test_a_bin_of_another_program_is_no_catman_file(tmp_path):
    pytest.importorskip("apread")
    (tmp_path / "run.bin").write_bytes(np.arange(200.0).tobytes())
    with pytest.raises(InputError, match=r"none of catman's"):
        open_table(tmp_path / "run.bin")


def stand_in(channels: dict) -> types.ModuleType:
    """DWDataReader as far as it is used: nobody but Dewesoft writes its files."""

    class DWError(RuntimeError):
        message = "CAN channels are not supported"

    class Channel:
        def __init__(self, name, unit, values, rate):
            self.name, self.unit, self.values, self.rate = name, unit, values, rate
            self.number_of_samples, self.array_size = len(values), 1

        def scaled(self):
            if self.unit == "CAN":
                raise DWError
            return np.arange(len(self.values)) / self.rate, self.values

    class DWFile(dict):
        def __init__(self, path):
            super().__init__({name: Channel(name, *rest) for name, rest in channels.items()})

        def __enter__(self):
            return self

        def __exit__(self, *_):
            return None

    module = types.ModuleType("dwdatareader")
    vars(module).update(DWFile=DWFile, DWError=DWError)
    return module


def test_channels_of_a_dewesoft_file_that_its_library_cannot_read_are_named(tmp_path):
    channels = {name: (unit, values, 100.0) for name, unit, values in CHANNELS}
    channels |= {"Bus": ("CAN", np.zeros(N), 100.0), "Room": ("degC", np.full(30, 21.0), 10.0)}
    keep_channels(stand_in(channels), "run.dxd", tmp_path)
    read = kept_columns(Path("run.dxd"), tmp_path)
    assert tuple(read.columns) == ("time [s]", "Slip [mm]", "Friction [N]", "Normal load [N]")
    assert read.notes[0] == "run.dxd: 1 channel has other times and is left out: Room"
    assert "Bus (CAN channels are not supported)" in read.notes[1]
