"""What a header of free text states: "KEY: value", "Time Step = 0.01 s", "Sample rate<tab>100 Hz".

The keys are those that agencies and programs use; a line with several statements is cut at its commas and semicolons.
A fact that the header states twice with two values is refused.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from slipwise.errors import InputError
from slipwise.motion.orientation import orientation
from slipwise.motion.origin import Origin, time_in
from slipwise.motion.source_file import LARGEST, SourceFile, is_number

_SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3}
_PER_SECOND = ("", "hz", "sps", "samples s", "samples sec", "samples second", "1 s", "s 1", "points s", "samples")
#: Fact -> the keys that state it, in lower case with blanks for all other signs; a unit may follow the key.
_KEYS: dict[str, str] = {
    "step": r"dt|delta t|delta|time ?step|step size|(?:sampling|sample|time|digitization) ?(?:time )?"
    r"(?:interval|period|step|increment)",
    "rate": r"(?:sampling|sample|scan|acquisition|data|output) ?(?:rate|freq|frequency)|fs|sps|"
    r"samples per (?:second|sec|s)",
    "count": r"npts|ndata|nsamples|n ?samples|npoints|samples|(?:total )?(?:no|nr|num|number|n)(?: of)?(?: data)? "
    r"(?:points|samples|data|values|records)|data points|points",
    "unit": r"(?:acc|acceleration|amplitude|data|y) ?units?|units?(?: of (?:data|acc|acceleration))?",
    "peak": r"pga|pa|peak(?: ground)?(?: acc| acceleration| value)?|max(?:imum)?(?: acc| acceleration)",
    "peak time": r"time (?:of )?(?:pga|pa|peak|max|maximum)",
    "component": r"component|comp|stream|channel|direction|dir|orientation|azimuth",
    "station": r"station(?: ?code| ?name| ?id)?|site(?: code| name)?|sta|stn",
    "sensor": r"sensor depth",
    "event": r"(?:event|earthquake)(?: id| name)?",
    "start": r"start ?time|record(?:ing)? ?time|date time first sample|time of first sample|initial time",
}
_KEY_OF = re.compile("|".join(f"(?P<{k.replace(' ', '_')}>{v})" for k, v in _KEYS.items()))
_STATEMENT = re.compile(r"\s*[\"#%!*/|-]*\s*(?P<key>[A-Za-z][^:=\t]*?)\"?\s*(?:[:=]+|\t)\s*(?P<value>.*?)\s*$")
#: Without a sign between them only these are told from prose: "Time Step 0.01 sec".
_BARE = re.compile(
    r"^\W*(?P<key>dt|npts|time step|(?:sampling|sample) (?:rate|interval|period|frequency)|number of points)"
    r"(?P<unit>\s*[(\[][^)\]]*[)\]])?\s+(?P<value>[\d.]\S*(?:\s+\S+)?)\s*$",
    re.IGNORECASE,
)
_QUANTITY = re.compile(r"([+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eEdD][+-]?\d+)?)\s*[(\[]?\s*([^\s,;()\[\]]*)")
_FIRST_SAMPLE = re.compile(r"(?P<v>\S+)\s+at\s+(?P<t>[\d.]+)\s*s", re.IGNORECASE)


@dataclass(frozen=True)
class Peak:
    """A stated peak as written: its number, its unit ("" if there is none), its time [s] or None."""

    text: str
    unit: str
    time: float | None


@dataclass(frozen=True)
class Stated:
    """What a header states; None and "" where it states nothing."""

    step: float | None = None
    unit: str | None = None
    count: int | None = None
    peak: Peak | None = None
    component: str = ""
    origin: Origin = field(default_factory=Origin)


def read_free_header(source: SourceFile, lines: Sequence[str]) -> Stated:
    """Read what the lines of a header state.

    Args:
        source: the file, for messages.
        lines: of the header.

    Raises:
        InputError: two statements of one fact that contradict each other.
    """
    found: dict[str, tuple[object, str]] = {}
    for line in lines:
        for key, in_key, value in _statements(line):
            fact, content = _fact(key, in_key, value)
            if content is None or content == "":
                continue
            before = found.get(fact)
            if before is None:
                found[fact] = (content, line.strip())
            elif fact in ("step", "count", "unit") and not _same(before[0], content):
                raise InputError(
                    f"{source.name}: the header contradicts itself: {before[1][:60]!r} and {line.strip()[:60]!r}; "
                    "correct the wrong line"
                )
    facts = {name: content for name, (content, _) in found.items()}
    time = facts.get("peak time")
    peak = facts.get("peak")
    if isinstance(peak, Peak) and peak.time is None and isinstance(time, float):
        peak = Peak(peak.text, peak.unit, time)
    return Stated(
        step=facts.get("step"),  # type: ignore[arg-type]
        unit=facts.get("unit"),  # type: ignore[arg-type]
        count=facts.get("count"),  # type: ignore[arg-type]
        peak=peak,  # type: ignore[arg-type]
        component=str(facts.get("component", "")),
        origin=Origin(
            station=str(facts.get("station", "")),
            sensor=str(facts.get("sensor", "")),
            event=str(facts.get("event", "")),
            start=time_in(str(facts.get("start", ""))),
        ),
    )


def _statements(line: str) -> list[tuple[str, str, str]]:
    """Cut a line into (key, unit in the key, value)."""
    several = len(re.findall(r"[:=]", line)) > 1 and "=" in line
    out = []
    for part in re.split(r"[,;]", line) if several else [line]:
        match = _STATEMENT.match(part) or _BARE.match(part)
        if match:
            raw = match["key"]
            bracket = re.search(r"[(\[]([^)\]]*)[)\]]", raw)
            value = re.sub(r"\t+", " ", match["value"]).strip().strip("\"'").strip()
            out.append((raw, bracket[1] if bracket else "", value))
    return out


def _fact(raw: str, in_key: str, value: str) -> tuple[str, object]:
    """Tell which fact a statement is, and its content; ("", None) for all others."""
    key = " ".join(re.sub(r"[^a-z0-9]+", " ", re.sub(r"[(\[].*", "", raw).lower()).split())
    match = _KEY_OF.match(key)
    if match is None or match.lastgroup is None:
        return "", None
    # DYNA writes the unit into the key: SAMPLING_INTERVAL_S, PGA_CM/S^2.
    rest = key[match.end() :].strip()
    fact = match.lastgroup.replace("_", " ")
    if rest and fact not in ("peak", "peak time", "step", "rate", "start", "sensor"):
        return "", None
    quantity = _QUANTITY.match(value)
    number = float(quantity[1].replace(",", ".").lower().replace("d", "e")) if quantity else None
    if number is not None and not abs(number) < LARGEST:
        return "", None
    unit = (quantity[2] if quantity else "").strip(".")
    if fact in ("step", "peak time") and number is not None:
        factor = _SECONDS.get((in_key or rest or unit).lower().strip("."))
        return fact, None if factor is None else number * factor
    if fact == "rate" and number is not None:
        words = " ".join(re.sub(r"[^a-z0-9]+", " ", (in_key or rest or unit).lower()).split())
        return "step", 1.0 / number if words in _PER_SECOND and number > 0 else None
    if fact == "count":
        return fact, int(number) if number is not None and number == int(number) and not unit else None
    if fact == "unit":
        return fact, re.split(r"[\s,;]", value.strip(" .()[]"))[0].strip(".()[]") if value else None
    if fact == "peak" and quantity:
        at = _FIRST_SAMPLE.search(value)
        written = in_key or re.sub(r"^[^_]*_(?=[^_]*$)", "", raw) if rest else in_key or unit
        time = float(at["t"]) if at and is_number(at["t"]) else None
        return fact, Peak(quantity[1], written, time)
    if fact == "component":
        return fact, value if orientation(value) != "unknown" else None
    if fact == "sensor" and number is not None:
        return fact, f"{number:g} m deep" if number else "surface"
    return (fact, value) if fact in ("station", "event", "start") else ("", None)


def _same(one: object, other: object) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= 1e-4 * abs(one)
    return str(one).lower() == str(other).lower()
