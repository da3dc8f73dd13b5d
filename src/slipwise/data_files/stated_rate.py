"""The step that a preamble states: "Sample rate: 100 Hz", "Sampling interval (ms) = 2", "Delta_X<tab>0.001"."""

import re
from collections.abc import Sequence

from slipwise.errors import InputError, UnitError
from slipwise.units import quantity

_NUMBER = r"(?P<value>[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?)\s*(?P<unit>[A-Za-z/]*)"
_BETWEEN = r"\s*(?:[\[(](?P<inner>[A-Za-z/]+)[\])])?\s*[\"']?\s*[:=;,\t ]+\s*[\"']?"
#: Words before a rate, and before a step, in the languages of laboratories.
_RATE_WORDS = (
    r"\b(?:sampl(?:e|ing)|scan|acquisition|logging|storage)[\s_-]*(?:rate|freq(?:uency)?|frequenz)",
    r"\b(?:abtast|mess|sample)[\s_-]*(?:rate|frequenz)",
    r"\b(?:fr[eé]quence d['’ ]?[eé]chantillonnage|cadence d['’ ]?acquisition)",
    r"\b(?:frecuencia|frequ[eê]ncia|tasa|taxa) de (?:muestreo|amostragem|adquisici[oó]n)",
    r"\bfrequenza di (?:campionamento|acquisizione)",
    r"\b[oö]rnekleme (?:frekans[ıi]|h[ıi]z[ıi])",
    r"(?:サンプリング|サンプル)(?:周波数|レート|速度)|(?:采样|采集|採樣|取樣)(?:频率|頻率|速率|率)",
)
_STEP_WORDS = (
    r"\b(?:sampl(?:e|ing)|scan)[\s_-]*(?:interval|period|time|step)|\btime[\s_-]*(?:step|increment)|\bdelta_x",
    r"\b(?:abtast|mess)[\s_-]*(?:intervall|zeit|schritt|periode)|\bzeitschritt",
    r"\b(?:pas de temps|p[eé]riode d['’ ]?[eé]chantillonnage)",
    r"\b(?:intervalo|per[ií]odo) de (?:muestreo|amostragem)|\bpaso de tiempo",
    r"\b(?:intervallo|passo|periodo) di (?:campionamento|tempo)|\bpasso temporale",
    r"\b[oö]rnekleme (?:aral[ıi][gğ][ıi]|periyodu)|\bzaman ad[ıi]m[ıi]",
    r"(?:サンプリング|サンプル)(?:間隔|周期)|(?:采样|採樣|取樣)(?:间隔|間隔|周期)|时间步长",
)
_RATE = re.compile(f"(?:{'|'.join(_RATE_WORDS)})" + _BETWEEN + _NUMBER, re.IGNORECASE)
_STEP = re.compile(f"(?:{'|'.join(_STEP_WORDS)})" + _BETWEEN + _NUMBER, re.IGNORECASE)
_PER_SECOND = {"": "Hz", "sps": "Hz", "s/s": "Hz", "samples/s": "Hz", "samples/sec": "Hz", "/s": "Hz", "1/s": "Hz"}


def stated_step(lines: Sequence[str], what: str) -> float | None:
    """Give the step [s] that the lines above a table state, None if they state none.

    Args:
        lines: above the names of the columns.
        what: the file, for messages.

    Raises:
        InputError: two lines that contradict each other.
    """
    found: dict[float, str] = {}
    for line in lines:
        for pattern, rate in ((_RATE, True), (_STEP, False)):
            match = pattern.search(line)
            if match is None:
                continue
            unit = match["inner"] or match["unit"]
            try:
                # A bare number is in Hz, or in s: nobody writes it otherwise.
                si = _PER_SECOND.get(unit.lower(), unit) if rate else unit or "s"
                value = quantity(f"{match['value'].replace(',', '.')} {si}", "Hz" if rate else "s", what)
            except UnitError:
                continue
            if value > 0.0:
                found.setdefault(1.0 / value if rate else value, line.strip())
    steps = list(found)
    if len(steps) > 1 and max(steps) > 1.001 * min(steps):
        raise InputError(
            f"{what}: the lines above the table contradict each other: {found[min(steps)][:60]!r} and "
            f"{found[max(steps)][:60]!r}; correct the wrong one"
        )
    return steps[0] if steps else None
