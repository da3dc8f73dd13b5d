"""Small files in the layouts of agencies beyond those of samples.py; values are our own, headers are invented."""

from collections.abc import Sequence

import numpy as np

from unit.motion.samples import _rows, _text, wave


def esm(
    values: np.ndarray,
    stream: str = "HNE",
    dt: float = 0.005,
    station: str = "TST1",
    unit: str = "cm/s^2",
    **facts: str,
) -> bytes:
    """ESM/ITACA and AFAD: DYNA's "KEY: value" lines, then a value a line."""
    peak = int(np.abs(values).argmax())
    head = {
        "EVENT_NAME": "TEST",
        "EVENT_ID": "XX-20010203_0000001",
        "NETWORK": "XX",
        "STATION_CODE": station,
        "STATION_NAME": "Test Town",
        "LOCATION": "",
        "SENSOR_DEPTH_M": "0.0",
        "VS30_M/S": "",
        "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": "20010203_040506.780",
        "SAMPLING_INTERVAL_S": f"{dt:.6f}",
        "NDATA": str(len(values)),
        "DURATION_S": f"{(len(values) - 1) * dt:.3f}",
        "STREAM": stream,
        "UNITS": unit,
        "INSTRUMENTAL_FREQUENCY_HZ": "",
        f"PGA_{unit.upper()}": f"{values[peak]:.6f}",
        "TIME_PGA_S": f"{peak * dt:.6f}",
        "LOW_CUT_FREQUENCY_HZ": "0.100",
        "DATA_TYPE": "ACCELERATION",
        **facts,
    }
    return _text([f"{key}: {value}" for key, value in head.items()] + [f"{value:.6f}" for value in values])


def cwb(values: np.ndarray, rate: int = 50) -> bytes:
    """CWB/TSMIP: values (n, 3) in the order U, N, E."""
    n = len(values)
    extremes = [f"#AmplitudeMAX. {c}: {v.max():8.3f}~ {v.min():8.3f}" for c, v in zip("UNE", values.T, strict=True)]
    head = [
        "#Earthquake Information",
        "#Origin Time(GMT+08): 2001/02/03-04:05:00",
        "#Depth(km): 10.0",
        "",
        "#Station Information",
        "#StationCode: TST",
        "#StationLongitude(E): 121.0",
        "#StartTime(GMT+08): 2001/02/03-04:05:06.000",
        f"#RecordLength(sec): {n / rate:g}",
        f"#SampleRate(Hz): {rate}",
        "#AmplitudeUnit:  gal. DCoffset(corr)",
        *extremes,
        "#DataSequence: Time U(+); N(+); E(+)",
        "#Data: 4F10.3 ",
    ]
    rows = [f"{i / rate:10.3f}" + "".join(f"{v:10.3f}" for v in row) for i, row in enumerate(values)]
    return _text(head + rows)


def csmnc(values: np.ndarray, component: str = "EW", dt: float = 0.005, station: str = "51TST") -> bytes:
    peak = int(np.abs(values).argmax())
    head = [
        "051TST010203040506",
        "0102030405060 2001-02-03 4:5:6 BTM",
        "TEST EARTHQUAKE, TEST,CHN",
        "EPICENTER  30.300N 103.000E DEPTH 13 KM",
        "MAGNITUDE  5.0(Ms)",
        f"STATION: {station} 30.400N 102.800E",
        "SITE CONDITION: ROCK",
        "INSTRUMENT TYPE: TEST",
        "OBSERVING POINT: GROUND",
        f"COMP. {component}",
        "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC",
        f"NO. OF POINTS:  {len(values)}  EQUALLY SPACED INTERVALS OF:  {dt:g}  SEC",
        f"PEAK VALUE:    {values[peak]:.3f}   AT   {peak * dt:.3f} SEC    DURATION:  1 SEC",
        "PRE-EVENT TIME:  20  SEC",
        "CSMNC",
        "",
    ]
    return _text(head + _rows([f"{value:13.6E} " for value in values], 8), "\r\n")


def unam(values: np.ndarray, names: Sequence[str] = ("V", "N00E", "N90E"), dt: float = 0.005) -> bytes:
    at = np.abs(values).argmax(axis=0)

    def each(items: Sequence[object]) -> str:
        return "".join(f"/{item}" for item in items)

    facts = {
        "NOMBRE DE LA ESTACION": "PUEBLO",
        "CLAVE DE LA ESTACION": "TEST",
        "NUMERO DE CANALES": "3",
        "ORIENTACION C1-C6 (rumbo;orientacion)": each(names),
        "ORIENTACION C7-C12 (rumbo;orientacion)": "",
        "INTERVALO DE MUESTREO, C1-C6 (s)": each([dt] * 3),
        "FECHA DEL SISMO [GMT]": "2001/02/03",
        "HORA DE LA PRIMERA MUESTRA (GMT)": "04:05:06",
        "NUM. TOTAL DE MUESTRAS, C1-C6": each([len(values)] * 3),
        "ACEL. MAX.(Gal), C1-C6": each([f"{values[i, k]:.4f}" for k, i in enumerate(at)]),
        "ACEL. MAX., C1-C6, EN LA MUESTRA": each(at + 1),
        "UNIDADES DE LOS DATOS": "Gal (cm/s/s)",
    }
    head = ["*" * 80, "INSTITUTO", "GRUPO", "", "", "*" * 80, "ARCHIVO ESTANDAR DE ACELERACION:"]
    head += [f"{key:<39}: {value}" for key, value in facts.items()]
    head += [""] * (105 - len(head))
    head += [
        "---------+---------",
        "   CANAL-1   CANAL-2   CANAL-3",
        "         V      N00E      N90E",
        "---------+---------",
    ]
    return _text(head + ["".join(f"{v:10.4f}" for v in row) for row in values])


def cosmos(
    values: np.ndarray, channel: str = "340 deg", number: int = 1, dt: float = 0.01, what: str = "acceleration",
    level: str = "Corrected", unit: str = "cm/sec2(04)",
) -> bytes:  # fmt: skip
    peak = int(np.abs(values).argmax())
    reals = np.full(100, -999.0)
    reals[61:65] = dt * 1e3, len(values) * dt, values[peak], peak * dt
    head = [
        f"{level} {what}    (Format v01.20 with 13 text lines) Src: test.txt",
        "Test Shock                              Feb 3, 2001 04:05 PDT",
        "Hypocenter: unknown",
        "Origin: 02/03/2001, 04:05:00.0 UTC",
        "Statn No: 01-99001  Code:CE-99001  Test Town",
        "Coords: 34.0460 -117.0350",
        "Recorder: TEST  s/n 1 ( 1 Chns of 12  at Sta) Sensor:TEST",
        "Rcrd start time:02/03/2001, 04:05:06.000 UTC (Q=2) RcrdId: 1",
        f"Sta Cha:  {number}: {channel} (Rcrdr Chan  1) Location: Roof",
        "Raw record length = 1.000  sec",
        f"Processed: 02/04/2001, 12:01:00 PDT      Max = {values[peak]:10.3f} cm/sec2  at {peak * dt:8.3f} sec",
        "Record filtered below 0.30  Hz",
        "Values used when parameter or data value is unknown/unspecified:   -999, -999.0",
        " 100 Integer-header values follow on  10 lines, Format= (10I8)",
        *_rows([f"{-999:8d}"] * 100, 10),
        " 100 Real-header values follow on  17 lines, Format= (6F13.6)",
        *_rows([f"{value:13.6f}" for value in reals], 6),
        '  1 Comment line(s) follow, each starting with a "|":',
        " | a comment of the test",
        f"{len(values):7d}  {what} pts, approx    1 secs, units={unit},Format=(8F10.5)",
        *_rows([f"{value:10.5f}" for value in values], 8),
        f"End-of-data for Chan {number} {what}",
    ]
    return _text(head)


def csmip_v1(channels: Sequence[tuple[str, np.ndarray]], rate: int = 200) -> bytes:
    lines: list[str] = []
    for number, (name, values) in enumerate(channels, 1):
        peak = int(np.abs(values).argmax())
        lines += [
            "Uncorrected Accelerogram Data             Processed: 02/13/12, TEST",
            "Record of Sat Feb 3, 2001 04:05:06.0 PST",
            "CSMIP Preliminary Processing            (Origin:  To be determined)",
            "99001-Z0001-01034.01                 Start time:  2/03/01, 12:05:06.0 UTC (GPS)",
            "Station No. 99001   40.941N, 123.633W      Test  s/n 2500  (3 Chns of  3 at Sta)",
            "Test Town                              CGS",
            f"Chan  {number}: {name}",
            f"No. of Points =  {len(values)}  Record Length = 1.0 sec   at {rate} Samples/sec",
            f"Units of uncor data are sec and g .   Max  = {abs(values[peak]):7.3f} g , at {peak / rate:7.3f} sec.",
            *["    0" * 16] * 6,
            *[" .0000000" * 8] * 7,
            f" {len(values)} Accelerogram points at {rate} pts/sec in units of g .      Format: (8f9.6)",
            *_rows([f"{value:9.6f}" for value in values], 8),
            f"/&  ----------  End of data for channel  {number}  ----------",
        ]
    return _text(lines, "\r\n")


def geonet_v1a(channels: Sequence[tuple[str, np.ndarray]], dt: float = 0.005) -> bytes:
    lines: list[str] = []
    for name, values in channels:
        peak, n = int(np.abs(values).argmax()), len(values)
        integers = np.zeros(40, dtype=int)
        integers[33] = n
        lines += [
            "Uncorrected accelerogram 20010203_040506_TEST_20 Test Science",
            "Site TEST      42 37 10S  173 03 13E     Test file:  20010203",
            "Test Farm",
            "Instrument Test_1",
            "Resolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700",
            "Accelerogram 20010203_040506_TEST_20         Processed 2001 February 4",
            "5 km south-west of Test",
            "2001 February 3         04:05:06 UT",
            "Epicentre  42 41 33S 173 01 19E",
            f"Number of points  {n}    Duration {n * dt:.2f} s",
            f"Raw readings in units of 1.00 mm/s/s  at intervals of {dt:.3f} s",
            "Data is unfiltered",
            f"Component {name}",
            f"Acceleration:  Peak  {values[peak]:.1f} mm/s/s at {peak * dt:.3f} s     RMS  7.0 mm/s/s",
            "Velocity record unevaluated",
            "Displacement record unevaluated",
            *_rows([f"{value:8d}" for value in integers], 10),
            *_rows([f"{0.0:8.3f}"] * 60, 10),
            *_rows([f"{value:8.1f}" for value in values], 10),
        ]
    return _text(lines)


def three(scale: float = 1.0) -> np.ndarray:
    """Three components (40, 3)."""
    return scale * np.stack([wave(phase=p) for p in (0.3, 1.0, 2.0)], axis=1)


def every_agency() -> dict[str, bytes]:
    """One file of each of these layouts, and the format by which it is recognised."""
    values = three()
    return {
        "ESM": esm(values[:, 0]),
        "CWB/TSMIP": cwb(values),
        "CSMNC": csmnc(values[:, 0]),
        "UNAM ASA": unam(values),
        "COSMOS": cosmos(values[:, 0]) + cosmos(values[:, 0] / 9, what="velocity", unit="cm/sec (05)"),
        "CSMIP/CESMD V1": csmip_v1([("360 Deg", values[:, 0] / 1e3), ("Up", values[:, 1] / 1e3)]),
        "GeoNet V1A": geonet_v1a([(n, 9 * values[:, k]) for k, n in enumerate(("S90E", "N00E", "Up"))]),
    }
