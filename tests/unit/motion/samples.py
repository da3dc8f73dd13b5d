"""Small files made for the tests, in the shape of every format; the values are our own, the headers are invented."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

SHARED = Path(__file__).resolve().parents[3].parent / "shared" / "motions"


def wave(n: int = 40, amplitude: float = 120.0, phase: float = 0.3) -> np.ndarray:
    """A decaying sine (n,), its largest value close to the amplitude."""
    i = np.arange(n)
    return amplitude * np.exp(-i / n) * np.sin(0.7 * i + phase)


def _rows(fields: Sequence[str], per_line: int) -> list[str]:
    return ["".join(fields[i : i + per_line]) for i in range(0, len(fields), per_line)]


def _text(lines: Sequence[str], end: str = "\n") -> bytes:
    return (end.join(lines) + end).encode("utf-8")


def knet(counts: np.ndarray, direction: str = "E-W", scale: tuple[int, int] = (2000, 8388608), rate: int = 10) -> bytes:
    gal = counts * scale[0] / scale[1]
    head = {
        "Origin Time": "2001/02/03 04:05:00",
        "Lat.": "35.0",
        "Long.": "135.0",
        "Depth. (km)": "10",
        "Mag.": "5.0",
        "Station Code": "TST001",
        "Station Lat.": "35.1",
        "Station Long.": "135.1",
        "Station Height(m)": "3",
        "Record Time": "2001/02/03 04:05:06",
        "Sampling Freq(Hz)": f"{rate}Hz",
        "Duration Time(s)": f"{len(counts) // rate}",
        "Dir.": direction,
        "Scale Factor": f"{scale[0]}(gal)/{scale[1]}",
        "Max. Acc. (gal)": f"{np.abs(gal - gal.mean()).max():.3f}",
        "Last Correction": "2001/02/03 04:05:06",
        "Memo.": "",
    }
    lines = [f"{key:<18}{value}" for key, value in head.items()]
    return _text(lines + [row + " " for row in _rows([f"{value:9d}" for value in counts], 8)])


def counts(n: int = 40, amplitude: float = 40000.0, offset: int = 9000, phase: float = 0.3) -> np.ndarray:
    return np.round(wave(n, amplitude, phase)).astype(int) + offset


def jma(values: np.ndarray, unit: str = "gal(cm/s/s)", order: str = "NS,EW,UD") -> bytes:
    head = [
        "SITE CODE= T01試験町        ,35.0,135.0, 10,5.0,1.0,  1.0,  2.0",
        " LAT.=   35.0000",
        " LON.=  135.0000",
        " SAMPLING RATE= 100Hz ",
        f" UNIT  = {unit}",
        "INITIAL TIME = 2001 02 03 04 05 06",
        f" {order}",
    ]
    rows = [",".join(f"{value:.3f}" for value in row) for row in values]
    return ("\r\n".join(head + rows) + "\r\n").encode("cp932")


def at2(
    values: np.ndarray,
    component: str = "EW",
    dt: str = ".0100",
    after: str = " SEC",
    unit: str = "UNITS OF G",
    per_line: int = 5,
    end: str = "\r\n",
    count: int | None = None,
) -> bytes:
    head = [
        "A STRONG MOTION DATABASE RECORD",
        f"Test Shock, 1/2/2001, Test Town, {component}",
        f"ACCELERATION TIME SERIES IN {unit}",
        f"NPTS= {len(values) if count is None else count:6d}, DT= {dt}{after}      ",
    ]
    return _text(head + _rows([f"{value:15.7E}" for value in values], per_line), end)


def csmip(
    channels: Sequence[tuple[str, np.ndarray]], old: bool = False, dt: float = 0.01, unit: str = "", end: str = "\r\n"
) -> bytes:
    lines: list[str] = []
    unit = unit or ("CM/SEC/SEC" if old else "cm/sec2")
    decimals = 3 if old else 5
    for number, (name, values) in enumerate(channels, start=1):
        peak = int(np.abs(values).argmax())
        head = [
            f"Corrected accelerogram   00001-S0001-00001.01       Chan  {number}: {name}     from",
            "Uncorrected Accelerogram Data             Processed: 01/02/01, TEST",
            "Test Shock of Jan 2, 2001",
            "Origin: to be determined",
            "00001-S0001-00001.01                 Start time: 01/02/01",
            f"Station No. 00001   35.000N, 120.000W     TEST s/n 1  ({len(channels)} Chns of  3 at Sta)",
            "Test Town - Hall",
            f"Chan  {number}: {name}",
            "Test Shock of Jan 2, 2001",
            "Hypocenter: to be determined",
            "Instr Period = .04 sec",
            "Record Length = 1.0 sec.",
            "Uncor Max = 1.0 g, at 0.1 sec.",
            "RMS accel = .1",
            "Accelerogram bandpass filtered",
            f" {len(values)} points of instrument- and baseline-corrected accel, veloc and displ data",
            f"At equally-spaced intervals of   {dt:.3f}  sec.",
            f"Peak acceleration = {values[peak]:.{decimals - 2}f}    cm/sec/sec  at   {peak * dt:.3f}   sec.",
            *["filler"] * 7,
            *["    0" * 16] * 6,
            "    0    0    0    0",
            *["  0.000000" * 8] * 12,
            "  0.000000" * 4,
        ]
        assert len(head) == 45
        for what, block in (("accel", values), ("veloc", values / 7), ("displ", values / 70)):
            its_unit = unit if what == "accel" else "cm"
            stated = f"  (UNITS: {its_unit})" if old else f", in {its_unit}. (8f10.5)"
            head.append(
                f" {len(values)} points of {what} data equally spaced at  {dt:.3f} sec{'.' if old else ''}{stated}"
            )
            head += _rows([f"{value:10.{decimals}f}" for value in block], 8)
        head.append(f"/&  ----------  End of data for channel  {number}  ----------")
        lines += [line.upper() for line in head] if old else head
    return _text(lines, end) + (b"\x1a" * 40 if old else b"")


def geonet(
    channels: Sequence[tuple[str, np.ndarray]], dt: float = 0.02, prepended: int = 5, unit: str = "mm/s/s"
) -> bytes:
    lines: list[str] = []
    for name, values in channels:
        peak = int(np.abs(values).argmax())
        n = len(values)
        head = [
            "Corrected accelerogram 20010203_040506_TEST_20 Test Science",
            "Site TEST      42 37 10S  173 03 13E     Test file:  20010203",
            "Test Farm",
            "Instrument Test_1",
            "Resolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700",
            "Accelerogram 20010203_040506_TEST_20         Processed 2001 February 4",
            "5 km south-west of Test",
            "2001 February 3         04:05:06 UT",
            "Epicentre  42 41 33S 173 01 19E",
            f"Number of points  {n}    Duration {n * dt:.2f} sec",
            f"Instrument corrected data at {dt:.3f} sec intervals",
            "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz",
            f"Component {name}  Test Accelerometer Axis",
            f"Acceleration:  peak  {values[peak]:.1f} {unit} at  {(peak - prepended) * dt:.2f} sec     rms  7.0 {unit}",
            "Velocity:      peak -1016.55 mm/s   at  46.58 sec     rms    96.10 mm/s",
            "Displacement:  peak  234.852 mm     at  46.36 sec     rms   38.013 mm",
        ]
        integers = np.zeros(40, dtype=int)
        integers[31], integers[33:36] = prepended, n
        numbers = np.zeros(60)
        numbers[21] = prepended * dt
        head += _rows([f"{value:8d}" for value in integers], 10)
        head += _rows([f"{value:8.3f}" for value in numbers], 10)
        for block in (values, values / 9, values / 90):
            head += _rows([f"{value:8.1f}" for value in block], 10)
        lines += head
    return _text(lines)


def smc(
    values: np.ndarray, component: str = "360", rate: float = 200.0, kind: str = "2 CORRECTED ACCELEROGRAM"
) -> bytes:
    head = [
        kind,
        "*",
        "TEST",
        "     2001  02  03    0405 Test Shock",
        "Moment Mag=      5.0",
        f"station = Test Town, Hall      component=    {component}",
        "epicentral dist =     10.0       pk     =    100.0",
        "inst type=SMA-1      data source = TEST",
        "*",
        "*",
        "*",
    ]
    integers = np.full(48, -32768)
    integers[15], integers[16] = 2, len(values)
    high, low = int(values.argmax()), int(values.argmin())
    numbers = np.full(50, 0.17e39)
    numbers[1] = rate
    numbers[28:32] = high / rate, values[high], low / rate, values[low]
    head += _rows([f"{value:10d}" for value in integers], 8)
    head += _rows([_exponent_first(value) for value in numbers], 5)
    head += ["|", "|a comment of the test"]
    head += _rows([f"{_one_digit_exponent(value):>10}" for value in values], 8)
    return _text([line.ljust(80) if len(line) < 70 else line for line in head[:11]] + head[11:], "\r\n")


def _exponent_first(value: float) -> str:
    mantissa, exponent = f"{value / 10:.6E}".split("E")
    return f"{float(mantissa) / 10 * 10 if value == 0 else float(mantissa) / 10:.7f}E{int(exponent) + 2:+03d}".rjust(15)


def _one_digit_exponent(value: float) -> str:
    mantissa, exponent = f"{value:.4E}".split("E")
    return f"{mantissa}E{int(exponent):+d}"


def columns(
    values: np.ndarray, dt: float = 0.01, head: str = "# Time (s),Acceleration (g's)\n", bom: bool = False
) -> bytes:
    rows = "".join(f"{i * dt:.10g},{value:.6E}\n" for i, value in enumerate(values))
    return (b"\xef\xbb\xbf" if bom else b"") + (head + rows).encode()


def one_column(values: np.ndarray) -> bytes:
    return "".join(f"{value:18.10f} \n" for value in values).encode()


def own_csv(
    values: np.ndarray, dt: float = 0.002, names: Sequence[str] = ("table_ax", "table_ay", "table_az")
) -> bytes:
    head = ",".join(["time [s]", *(f"{name} [m/s^2]" for name in names)])
    rows = (",".join([f"{i * dt:.10g}", *(f"{value:.8g}" for value in row)]) for i, row in enumerate(values))
    return ("\n".join([head, *rows]) + "\n").encode()


def every_format() -> dict[str, bytes]:
    """One file of each format, about forty values long."""
    three = np.stack([wave(phase=p) for p in (0.3, 1.0, 2.0)], axis=1)
    names = ("90 Deg", "Up", "0 Deg")
    return {
        "GeoNet V2A": geonet([(name, 40 * three[:, i]) for i, name in enumerate(("N28W", "S62W", "Up"))]),
        "CSMIP new": csmip([(name, three[:, i]) for i, name in enumerate(names)]),
        "CSMIP old": csmip([(name, three[:, i]) for i, name in enumerate(names)], old=True),
        "JMA CSV": jma(three),
        "K-NET": knet(counts()),
        "KiK-net": knet(counts(), direction="4"),
        "USGS SMC": smc(wave()),
        "Slipwise CSV": own_csv(three / 100),
        "PEER AT2": at2(wave() / 1000),
        "PEER AT2, CR CR LF": at2(wave() / 1000, end="\r\r\n", after=" SEC,"),
        "columns": columns(wave() / 1000),
        "columns with a byte-order mark": columns(wave() / 1000, bom=True),
    }
