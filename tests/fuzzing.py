"""Files of every kind that slipwise reads, and how each is read: what the fuzzing scripts damage.

A reader gives nothing; it raises a `SlipwiseError` where it refuses.
"""

import io
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.campaign import load_campaign
from slipwise.campaign.draft import draft_campaign
from slipwise.data_files.table import open_table
from slipwise.errors import SlipwiseError
from slipwise.model.file import load_model
from slipwise.motion.load import load_motion
from slipwise.record import Record, write_record
from slipwise.rig import load_specimen
from unit.motion import agency_samples, samples

MODELS = Path(__file__).parents[1] / "models"
CAMPAIGN = b"""name = "march"
rig = "bridge1"

[specimen]
mass = "9.8 t"

[logger]
lowpass = "80 Hz"
order = 2
phase = "zero"

[columns]
"a [gal]" = {channel = "girder_ax", unit = "gal", sign = -1}

[constants]
pad_A_N = "24 kN"

[derived]
table_az = "0.5 * (girder_ax + table_ax)"

[materiality]
channel = "3 %"

[[run]]
file = "one.csv"
role = "fit"
window = ["0.2 s", "2.8 s"]
rest_before = "30 min"
"""
MODEL = b"""rig = "bridge1"

[specimen]
mass = "9.9 t"

[[effect]]
name = "run_in"
rise = 0.3

[[effect]]
name = "heating"
"""
#: The same with a file that is code.
WITH_CODE = (
    MODEL
    + b"""
[[effect]]
file = "mine.py"
"""
)
#: What a user's effect file does if it is run though nobody said so.
MINE = "raise SystemExit('an effect file was run that nobody trusts')"


@dataclass(frozen=True)
class Target:
    """A file that can be damaged.

    Attributes:
        path: where it is to be written; what its reader needs beside it is there.
        data: whole.
        read: reads the file at a path.
    """

    path: Path
    data: bytes
    read: Callable[[Path], None]

    def try_with(self, data: bytes) -> None:
        """Write other bytes in its place, read them, and remove them.

        Raises:
            SlipwiseError: the reader refuses them.
        """
        self.path.write_bytes(data)
        try:
            self.read(self.path)
        finally:
            self.path.unlink(missing_ok=True)


def targets(folder: Path) -> list[Target]:
    """Give every target, with folders for them in this one."""
    alone, campaign = folder / "alone", folder / "campaign"
    alone.mkdir()
    campaign.mkdir()
    rows = "".join(f"{0.01 * i:.2f},{np.sin(0.1 * i):.4f},{np.cos(0.1 * i):.4f},{10 + i % 3}\n" for i in range(300))
    (campaign / "one.csv").write_text(f"time [s],a [gal],slip_x [mm],table_ax [gal]\n{rows}")
    (campaign / "mine.py").write_text(MINE)
    (campaign / "common.xml").write_bytes((MODELS / "common.xml").read_bytes())
    motions = list((samples.every_format() | agency_samples.every_agency()).values()) + seismograms()
    found = [Target(folder / f"motion_{i}.txt", data, read_motion) for i, data in enumerate(motions)]
    found += [Target(alone / name, data, read_table) for name, data in tables(folder).items()]
    found += [Target(campaign / "campaign.toml", CAMPAIGN, read_campaign)]
    found += [Target(campaign / f"model_{i}.toml", data, read_model) for i, data in enumerate((MODEL, WITH_CODE))]
    rigs = {name: (MODELS / f"{name}.xml").read_bytes() for name in ("bridge1", "pad")}
    return [*found, *(Target(campaign / f"{name}.xml", data, read_rig) for name, data in rigs.items())]


def read_motion(path: Path) -> None:
    """Read a motion as `replay` does, with the step and unit that a refusal asks for."""
    try:
        load_motion(path)
    except SlipwiseError as error:
        asked: dict[str, Any] = {"--motion-dt": {"dt": 0.01}, "--unit": {"unit": "gal"}}
        given = {key: value for flag, pair in asked.items() if flag in str(error) for key, value in pair.items()}
        if not given:
            raise
        load_motion(path, **{"dt": 0.01, "unit": "gal"} if len(given) == 1 and "dt" in given else given)


def read_table(path: Path) -> None:
    """Read a data file as a campaign does, and draft a campaign from it."""
    table = open_table(path)
    table.columns(range(min(len(table.headers), 6)))
    draft_campaign(path.parent)


def read_campaign(path: Path) -> None:
    """Read the campaign of a campaign.toml."""
    load_campaign(path.parent)


def read_model(path: Path) -> None:
    """Read a model.toml; code beside it must not run."""
    load_model(path)


def read_rig(path: Path) -> None:
    """Read the MJCF file of a rig."""
    load_specimen(path)


def tables(folder: Path) -> dict[str, bytes]:
    """One small data file of each kind that the installed extras can write."""
    from scipy.io import savemat

    step = np.arange(300, dtype=np.float64) * 0.01
    rows = "".join(f"{t:.2f}\t{np.sin(t):.4f}\t{np.cos(t):.4f}\n" for t in step)
    stamps = "".join(f"2031-02-03 10:15:{t:05.2f},{np.sin(t):.4f},{np.cos(t):.4f}\n" for t in step)
    found = {
        "a.txt": f"Sample rate\t100 Hz\n\nTime\tSlip\tForce\ns\tmm\tkN\n{rows}".encode(),
        "b.csv": f'"TOA5","R"\n"TIMESTAMP","Slip","Load"\n"TS","mm","kN"\n{stamps}'.encode(),
        "c.dat": f"MTS793\n\nTime\tSlip\tForce\n{rows}\nTime\tSlip\tForce\n{rows}".encode(),
        "d.lvm": f"LabVIEW Measurement\t\nX_Value\tA\tB\tComment\n{rows}".encode(),
        "e.csv": f"Zeit;Weg;Kraft\n{rows.replace('.', ',').replace(chr(9), ';')}".encode("utf-16"),
    }
    savemat(folder / "f.mat", {"t": step, "s": {"x": np.stack([step, step])}}, do_compression=True)
    write_record(Record(step, {"slip_x": np.sin(step)}), folder / "g.parquet")
    try:
        from openpyxl import Workbook

        book = Workbook()
        for row in [["Time [s]", "Slip [mm]"], *[[float(t), float(np.sin(t))] for t in step]]:
            book.active.append(row)  # type: ignore[union-attr]
        book.save(folder / "h.xlsx")
    except ModuleNotFoundError:
        print("openpyxl is not installed: no workbook is damaged")
    try:
        from nptdms import ChannelObject, TdmsWriter  # type: ignore[import-not-found]

        with TdmsWriter(str(folder / "i.tdms")) as writer:
            writer.write_segment([ChannelObject("Rig", "Slip", np.sin(step), {"wf_increment": 0.01})])
    except ModuleNotFoundError:
        print("npTDMS is not installed: no .tdms file is damaged")
    written = [p for p in folder.iterdir() if p.suffix in (".mat", ".parquet", ".xlsx", ".tdms")]
    return found | {path.name: path.read_bytes() for path in written}


def seismograms() -> list[bytes]:
    """SAC and miniSEED, where obspy is installed."""
    try:
        import obspy  # type: ignore[import-untyped]
    except ModuleNotFoundError:
        print("obspy is not installed: no SAC and no miniSEED file is damaged")
        return []
    out = []
    for kind in ("SAC", "MSEED"):
        values = np.sin(0.1 * np.arange(300.0)).astype(np.float32)
        trace = obspy.Trace(values, {"delta": 0.01, "channel": "HNE", "station": "TST"})
        file = io.BytesIO()
        trace.write(file, format=kind)
        out.append(file.getvalue())
    return out
