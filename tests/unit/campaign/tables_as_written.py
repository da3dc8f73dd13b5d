"""Sixty tables as people write them, each with what its columns are: the data that `slipwise init` is held against.

Names without brackets, units in names, in rows or nowhere, clocks, footers, totals, several languages, workbooks.
"""

import datetime
import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import slipwise
from slipwise.campaign import load_campaign

Array = NDArray[np.float64]
#: Unit -> factor to SI.
SI = {
    "s": 1.0, "ms": 1e-3, "m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "in": 0.0254, "N": 1.0, "kN": 1e3,
    "kip": 4448.2216152605, "m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "g": 9.80665, "m/s^2": 1.0, "MPa": 1e6, "1": 1.0,
}  # fmt: skip
COUNT, STEP = 240, 0.02
CLOCK = datetime.datetime(2031, 2, 3, 10, 15, 7)


@dataclass(frozen=True)
class Written:
    """A table and what it holds.

    Attributes:
        name: of the case.
        content: of the file.
        suffix: of the file.
        channels: the truth, name of a channel -> (n,) SI.
        units: channel -> unit in which the table holds it: what a person fills in where a table does not say.
    """

    name: str
    content: bytes
    suffix: str
    channels: dict[str, Array]
    units: dict[str, str]

    def write(self, folder: Path) -> Path:
        """Write it into a folder."""
        path = folder / f"run1{self.suffix}"
        path.write_bytes(self.content)
        return path


def reciprocating(load: float = 500.0, coefficient: float = 0.12, stroke: float = 5e-3) -> dict[str, Array]:
    """A slider that goes to and fro."""
    rng = np.random.default_rng(5)
    time = STEP * np.arange(COUNT)
    phase = 2.0 * np.pi * 0.8 * time
    return {
        "time": time,
        "slip_x": stroke * np.sin(phase),
        "slip_vx": stroke * 2.0 * np.pi * 0.8 * np.cos(phase),
        "pad_A_Fx": coefficient * load * (np.sign(np.cos(phase) + 1e-9) + 0.01 * rng.standard_normal(COUNT)),
        "pad_A_N": load * (1.0 + 0.002 * rng.standard_normal(COUNT)),
        "pad_A_T": 293.0 + 0.5 * time,
    }


def one_way(load: float = 9.0, coefficient: float = 0.16, speed: float = 0.075) -> dict[str, Array]:
    """A pin on a disc."""
    rng = np.random.default_rng(6)
    time = STEP * np.arange(COUNT)
    rate = speed * (1.0 + 0.001 * rng.standard_normal(COUNT))
    normal = load * (1.0 + 0.001 * rng.standard_normal(COUNT))
    friction = coefficient * normal * (1.0 + 0.01 * rng.standard_normal(COUNT))
    return {
        "time": time,
        "slip_x": np.concatenate([[0.0], np.cumsum(0.5 * STEP * (rate[1:] + rate[:-1]))]),
        "slip_vx": rate,
        "pad_A_Fx": friction,
        "pad_A_N": normal,
        "pad_A_P": normal / 100e-6,
    }


TWO, ONE = reciprocating(), one_way()


def columns(run: dict[str, Array], *wanted: tuple[str, str]) -> list[Array]:
    """Columns in the units of a table; wanted: (channel, unit)."""
    return [run[name] / SI[unit] for name, unit in wanted]


def cells(values: Sequence[Array | Sequence[str]], decimal: str = ".", form: str = ".6g") -> list[list[str]]:
    """Rows of cells as text; a column may be texts."""
    return [
        [cell if isinstance(cell, str) else format(float(cell), form).replace(".", decimal) for cell in row]
        for row in zip(*values, strict=True)
    ]


def body(
    rows: Sequence[Sequence[str]], separator: str = ",", ending: str = "\n", *, tail: str = "", quote: str = ""
) -> str:
    """Rows of a table as lines."""
    return "".join(separator.join(f"{quote}{cell}{quote}" for cell in row) + tail + ending for row in rows)


def plain(
    name: str,
    header: str,
    run: dict[str, Array],
    *wanted: tuple[str, str],
    decimal: str = ".",
    above: str = "",
    below: str = "",
    encoding: str = "utf-8",
    suffix: str = ".csv",
    sign: dict[str, int] | None = None,
    tail: str = "",
    form: str = ".6g",
) -> Written:
    """A text table; the separator is that of the header. wanted: (channel, unit), or ("", text) for what is none."""
    last = header.splitlines()[-1]
    separator = next(s for s in ("\t", ";", ",") if s in last)
    turned = sign or {}
    extra = {
        "index": np.arange(COUNT, dtype=float),
        "room": 21.0 + 0.001 * np.arange(COUNT) ** 0.5,
        "up": 0.02 * np.sin(0.7 * np.arange(COUNT)),
        "path": np.cumsum(np.abs(np.gradient(TWO["slip_x"]))) * 1e3,
        "command": TWO["slip_x"] * 1.01e3,
        "zero": np.zeros(COUNT),
    }
    values = [
        extra[unit] if not channel else turned.get(channel, 1) * run[channel] / SI[unit] for channel, unit in wanted
    ]
    rows = cells(values, decimal, form)
    text = above + header + tail + "\n" + body(rows, separator, tail=tail) + below
    units = {channel: unit for channel, unit in wanted if channel}
    return Written(name, text.encode(encoding), suffix, {c: run[c] for c in units}, units)


def with_texts(
    name: str,
    header: str,
    texts: Sequence[Sequence[str]],
    run: dict[str, Array],
    *wanted: tuple[str, str],
    separator: str = ",",
    decimal: str = ".",
) -> Written:
    """A table whose first columns are texts, such as a clock: its time is that of the run."""
    rows = cells([*texts, *columns(run, *wanted)], decimal)
    units = {"time": "s"} | dict(wanted)
    return Written(name, (header + "\n" + body(rows, separator)).encode(), ".csv", {c: run[c] for c in units}, units)


def stamps(form: str, digits: int = 6) -> list[str]:
    """The times of a run as a clock showed them."""
    out = []
    for seconds in TWO["time"]:
        text = (CLOCK + datetime.timedelta(seconds=round(float(seconds), 6))).strftime(form)
        out.append(text[: len(text) - 6 + digits] if form.endswith("%f") else text)
    return out


def milliseconds() -> list[str]:
    """The part of each second that a clock of seconds does not show."""
    return [str(round(1e3 * float(t)) % 1000) for t in TWO["time"]]


def workbook(
    name: str,
    rows: Sequence[Sequence[object]],
    run: dict[str, Array],
    *wanted: tuple[str, str],
    left: int = 0,
    below: Sequence[Sequence[object]] = (),
    first: Sequence[object] | None = None,
    text: bool = False,
) -> Written:
    """A workbook; rows stand above the numbers."""
    import openpyxl

    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    numbers = columns(run, *wanted)
    lines: list[list[object]] = []
    for i in range(COUNT):
        line: list[object] = [f"{c[i]:.6g}".replace(".", ",") if text else float(c[i]) for c in numbers]
        lines.append([first[i], *line] if first is not None else line)
    for row in [*rows, *lines, *below]:
        sheet.append([None] * left + list(row) if row else [])
    stream = io.BytesIO()
    book.save(stream)
    units = dict(wanted) | ({"time": "s"} if first is not None else {})
    return Written(name, stream.getvalue(), ".xlsx", {c: run[c] for c in units}, units)


T, X, F, N = ("time", "s"), ("slip_x", "mm"), ("pad_A_Fx", "N"), ("pad_A_N", "N")
FK, NK = ("pad_A_Fx", "kN"), ("pad_A_N", "kN")
V = ("slip_vx", "mm/s")


def names_and_units() -> list[Written]:
    """Where the unit stands, and how it is written."""
    return [
        plain("names without units", "time,slip,Fx,Fz", TWO, T, X, F, N),
        plain("single letters", "t;x;F;N", TWO, T, X, F, N),
        plain("a timestamp in seconds", "Timestamp,slip [mm],Fx [N],Fz [N]", TWO, T, X, F, N),
        plain("quantity / unit", "Zeit / s;Weg / mm;Reibkraft / N;Normalkraft / N", TWO, T, X, F, N, decimal=","),
        plain("quantity, unit", "Time, s;Displacement, mm;Friction force, N;Normal load, N", TWO, T, X, F, N),
        plain("unit after an underscore", "time_s,disp_mm,force_N,load_N", TWO, T, X, F, N),
        plain("our names, unit after an underscore", "time_s\tslip_x_mm\tpad_A_Fx_kN\tpad_A_N_kN", TWO, T, X, FK, NK),
        plain("unit as the last word", "Time s,Displacement mm,Friction N,Normal N", TWO, T, X, F, N),
        plain("quantity in unit", "Zeit in s;Weg in mm;Kraft horizontal in kN;Kraft vertikal in kN", TWO, T, X, FK, NK),
        plain("symbols over units", "t/s,s/mm,F_R/N,F_N/N", TWO, T, X, F, N),
        plain("capitals", "TIME (SEC),STROKE (IN),LATERAL LOAD (KIP),VERTICAL LOAD (KIP)", TWO, T,
              ("slip_x", "in"), ("pad_A_Fx", "kip"), ("pad_A_N", "kip")),
        plain("time last", "Load (kN),Friction (kN),Slip (in),Time (sec)", TWO, NK, FK, ("slip_x", "in"), T),
        plain("camel case", "timeSec,posMm,frictionN,normalN", TWO, T, X, F, N),
        plain("milliseconds", "Time (ms),Position (mm),Tangential (N),Normal (N)", TWO, ("time", "ms"), X, F, N),
        plain("a millisecond counter", "millis,pos_mm,fx_N,fz_N", TWO, ("time", "ms"), X, F, N),
        plain("a first column without a meaning", "Column1,slip (mm),friction (N),normal (N)", TWO, T, X, F, N),
        plain("our channels without units", "time,slip_x,pad_A_Fx,pad_A_N", TWO, T, X, FK, NK),
    ]  # fmt: skip


def languages() -> list[Written]:
    """Words of laboratories elsewhere."""
    return [
        plain("French", "Temps (s);Déplacement (mm);Force de frottement (N);Force normale (N)", TWO, T, X, F, N,
              decimal=",", encoding="latin-1"),
        plain("Spanish", "Tiempo [s];Desplazamiento [mm];Fuerza de fricción [kN];Carga vertical [kN]", TWO, T, X, FK,
              NK),
        plain("Italian", "Tempo (s)\tSpostamento (mm)\tForza di attrito (N)\tForza normale (N)", TWO, T, X, F, N),
        plain("Turkish", "Zaman (s);Yer değiştirme (mm);Sürtünme kuvveti (kN);Düşey yük (kN)", TWO, T, X, FK, NK),
        plain("Japanese", "時間 [s],変位 [mm],摩擦力 [N],鉛直荷重 [N]", TWO, T, X, F, N, encoding="cp932"),
        plain("Chinese", "时间(s),位移(mm),摩擦力(N),法向载荷(N)", TWO, T, X, F, N, encoding="utf-8-sig"),
        plain("Portuguese", "Tempo (s);Deslocamento (mm);Força de atrito (N);Força normal (N)", TWO, T, X, F, N),
        plain("German without units", "Zeit;Geschwindigkeit;Reibkraft;Normalkraft", ONE, T, V, F, N, decimal=","),
        plain("Spanish without units", "tiempo,desplazamiento,fricción,carga", TWO, T, X, F, N),
        plain("Japanese without units", "時刻,変位,水平荷重,鉛直荷重", TWO, T, X, FK, NK, encoding="cp932"),
    ]  # fmt: skip


def rows_above() -> list[Written]:
    """What stands between names and numbers, and above both."""
    kyowa = (
        "IDM,T-100\nサンプリング周波数(Hz),50\nデータ数,240\nCH名称,変位,摩擦力,荷重\nCH No,1,2,3\nレンジ,OFF,OFF,OFF\n"
    )
    return [
        plain("a row of units", "Time,Slip,Shear,Normal\ns,mm,N,N", TWO, T, X, F, N,
              above="Operator,M. N.\nTest,7\nDate,2031-02-03\n\n"),
        plain("units in brackets in a row", "Time,Stroke,Lateral,Axial\n[s],[mm],[kN],[kN]", TWO, T, X, FK, NK),
        plain("labelled rows, Japanese", f"{kyowa}単位,mm,N,N", TWO, T, X, F, N, encoding="cp932", form=".4f"),
        plain("labelled rows, English", "Sampling frequency (Hz),50\nChannel name,Slip,Friction,Load\n"
              "Channel No,1,2,3\nRange,OFF,OFF,OFF\nUnit,mm,N,N", TWO, T, X, F, N, form=".4f"),
        plain("a row of numbers", "Time,Slip,Shear,Normal\n1,2,3,4\ns,mm,kN,kN", TWO, T, X, FK, NK),
        plain("a row of ranges", "Time,Slip,Shear,Normal\nauto,50 mm,5 kN,10 kN\ns,mm,kN,kN", TWO, T, X, FK, NK),
        plain("numbers and ranges", "Time;Weg;Querkraft;Normalkraft\nCH0;CH1;CH2;CH3\n±10 V;±10 V;±10 V;±10 V\n"
              "s;mm;kN;kN", TWO, T, X, FK, NK, decimal=","),
        plain("MTS", "Running Time\tHorizontal Displacement\tHorizontal Force\tVertical Force\nSec\tmm\tkN\tkN", TWO,
              T, X, FK, NK, above="MTS793|MPT|ENU\n\n", suffix=".dat"),
        plain("rate above", "Slip (mm),Friction (N),Normal (N)", TWO, X, F, N, above="Sample rate: 50 Hz\n\n"),
        plain("rate above, German", "Weg [mm];Reibkraft [N];Normalkraft [N]", TWO, X, F, N, decimal=",",
              above="Versuch: 7\nAbtastrate: 50 Hz\n\n"),
        plain("rate above and a count", "No.,Slip (mm),Friction (N),Normal (N)", TWO, ("", "index"), X, F, N,
              above="Sampling interval (ms): 20\n"),
        plain("a count before the time", "Sample,Time,Slip,Fx,Fz", TWO, ("", "index"), T, X, F, N),
    ]  # fmt: skip


def clocks() -> list[Written]:
    """Times of the day."""
    return [
        with_texts("a clock", "Time,Slip (mm),Friction (N),Normal (N)", [stamps("%H:%M:%S.%f", 3)], TWO, X, F, N),
        with_texts("a clock and milliseconds", "Time,ms,Slip (mm),Friction (N),Normal (N)",
                   [stamps("%H:%M:%S"), milliseconds()], TWO, X, F, N),
        with_texts("date, clock and milliseconds", "Datum;Uhrzeit;Millisekunden;Weg [mm];Reibkraft [N];Normalkraft [N]",
                   [stamps("%d.%m.%Y"), stamps("%H:%M:%S"), milliseconds()], TWO, X, F, N, separator=";", decimal=","),
        with_texts("a stamp with date", "Timestamp,slip_mm,fric_N,norm_N", [stamps("%Y-%m-%dT%H:%M:%S.%f", 3)], TWO, X,
                   F, N),
        with_texts("seconds since 1970", "timestamp,disp (mm),force (N),normal (N)",
                   [[f"{1.93e9 + t:.3f}" for t in TWO["time"]]], TWO, X, F, N),
    ]  # fmt: skip


def rows_below() -> list[Written]:
    """What stands below the numbers."""
    header, run = "Time (s),Slip (mm),Friction (N),Normal (N)", (T, X, F, N)
    rate = "Sample rate: 50 Hz\n"
    return [
        plain("words below", header, TWO, *run, below="\nEnd of test\nOperator: N. N.\n"),
        plain("totals below", header, TWO, *run, below="Max,5,61,501\nMin,-5,-61,499\nMean,0,0.1,500\n"),
        plain("totals after an empty line", header, TWO, *run, below="\n,,Average:,499.9\n"),
        plain("totals below, times by rate", "Slip (mm),Friction (N),Normal (N)", TWO, X, F, N, above=rate,
              below="\nMaximum,61,501\n"),
        plain("empty rows of a spreadsheet", header, TWO, *run, below=",,,,\n,,,,\n", tail=","),
    ]  # fmt: skip


def workbooks() -> list[Written]:
    """Exports of spreadsheets."""
    quoted = cells(columns(TWO, T, X, F, N), ",")
    text = '"time","slip","Fx","Fz"\n' + body(quoted, ",", quote='"')
    truth = {name: TWO[name] for name, _ in (T, X, F, N)}
    clock = [CLOCK + datetime.timedelta(seconds=round(float(t), 6)) for t in TWO["time"]]
    return [
        Written("every field in quotes", text.encode(), ".csv", truth, dict([T, X, F, N])),
        workbook("a workbook", [["Time (s)", "Slip (mm)", "Friction (N)", "Normal (N)"]], TWO, T, X, F, N),
        workbook("a workbook with a title, off the corner",
                 [["Test 7 of February"], [], ["Time", "Slip", "Shear force", "Normal force"], ["s", "mm", "kN", "kN"]],
                 TWO, T, X, FK, NK, left=1),
        workbook("a workbook with a clock and a total", [["Time", "Slip (mm)", "Friction (N)", "Normal (N)"]], TWO, X,
                 F, N, first=clock, below=[["Mean", 0.0, 0.1, 500.0]]),
        workbook("numbers as text, German", [["Zeit [s]", "Weg [mm]", "Reibkraft [N]", "Auflast [N]"]], TWO, T, X, F, N,
                 text=True),
    ]  # fmt: skip


def one_way_tables() -> list[Written]:
    """Sliding one way: no force changes its sign."""
    return [
        plain("pin on disc", "time [s],speed [mm/s],Fx [N],Fz [N]", ONE, T, V, F, N),
        plain("tribometer", "Time (s)\tLinear speed (cm/s)\tFriction force (N)\tNormal force (N)\t"
              "Penetration depth (um)", ONE, T, ("slip_vx", "cm/s"), F, N, ("", "up"), suffix=".txt"),
        plain("rock", "time (s),lp_disp (um),mu,normal stress (MPa)", ONE, T, ("slip_x", "um"), ("pad_A_Fx", "1"),
              ("pad_A_P", "MPa")),
        plain("coefficient and load", "Time [s];Distance [m];µ [-];Load [N]", ONE, T, ("slip_x", "m"),
              ("pad_A_Fx", "1"), N, decimal=","),
        plain("single letters", "t,v,Ft,Fn", ONE, T, V, F, N),
        plain("compression negative", "Time (s),Position (mm),Lateral load (N),Axial load (N)", ONE, T, X, F, N,
              sign={"pad_A_N": -1}),
        plain("two forces of one name", "Time (s),Position (mm),Force 1 (N),Force 2 (N)", ONE, T, X, F, N),
    ]  # fmt: skip


def with_others() -> list[Written]:
    """Columns beside those that a rig needs."""
    space = "# time  slip  friction  normal\n# s  mm  N  N\n" + body(cells(columns(TWO, T, X, F, N)), "   ")
    truth = {name: TWO[name] for name, _ in (T, X, F, N)}
    return [
        plain("command and measured", "Time (s),Disp cmd (mm),Disp fb (mm),Horiz Force (kN),Vert Force (kN)", TWO, T,
              ("", "command"), X, FK, NK),
        plain("vertical gauge first",
              "Time (s),LVDT vertical (mm),LVDT horizontal (mm),Friction (N),Normal load (N),Room temp (degC)", TWO, T,
              ("", "up"), X, F, N, ("", "room")),
        plain("path and position", "Time (s);Sliding distance (mm);Position (mm);Friction (N);Normal (N)", TWO, T,
              ("", "path"), X, F, N),
        Written("columns between blanks", space.encode(), ".txt", truth, dict([T, X, F, N])),
    ]  # fmt: skip


@cache
def shaken() -> dict[str, Array]:
    """Four pads on a shaking table: the demonstration campaign."""
    record = load_campaign(Path(slipwise.__file__).parent / "demo_data").run("quake_hv").record
    return {"time": record.time, **record.channels}


def girder(name: str, header: str, acceleration: str, *pads: tuple[str, str]) -> Written:
    """A table of time [s], accelerations of table and girder, slip [mm], and forces of pads [kN] by pad and kind."""
    wanted = [T, ("table_ax", acceleration), ("girder_ax", acceleration), X]
    wanted += [(f"pad_{pad}_{kind}", "kN") for pad, kind in pads]
    rows = cells(columns(shaken(), *wanted), form=".9g")
    text = header + "\n" + body(rows, ";" if ";" in header else ",")
    return Written(name, text.encode(), ".csv", {c: shaken()[c] for c, _ in wanted}, dict(wanted))


PAIRS = [(pad, kind) for pad in "ABCD" for kind in ("N", "Fx")]
LOADS_FIRST = [(pad, kind) for kind in ("N", "Fx") for pad in "ABCD"]


def girders() -> list[Written]:
    """The demonstration campaign under other names."""
    return [
        girder(
            "girder, snake case",
            "time_s,acc_table_x_g,acc_deck_x_g,lvdt_mm,"
            + ",".join(f"LC{k}_vert_kN,LC{k}_horz_kN" for k in (1, 2, 3, 4)),
            "g",
            *PAIRS,
        ),
        girder(
            "girder, German",
            "Zeit [s];Tisch ax [g];Träger ax [g];Weg [mm];"
            + ";".join(f"Last {k} [kN];Reibung {k} [kN]" for k in (1, 2, 3, 4)),
            "g",
            *PAIRS,
        ),
    ]


def all_tables() -> list[Written]:
    """All sixty-and-some of them."""
    kinds = (
        names_and_units,
        languages,
        rows_above,
        clocks,
        rows_below,
        workbooks,
        one_way_tables,
        with_others,
        girders,
    )
    return [table for kind in kinds for table in kind()]
