"""COSMOS V0 to V3: text lines, 100 integers, 100 reals, comments, then the values; one or more records a file.

The text lines are counted in the first one, "(Format v01.20 with 13 text lines)"; each block that follows says how many
numbers and lines it has and its Fortran format. Real 62 is the step in ms, reals 64 and 65 are the peak and its time.
Source: COSMOS Strong-Motion Data Format, version 1.20.
"""

import re

import numpy as np

from slipwise.errors import InputError, UnitError
from slipwise.motion.fixed_width import check_format, fixed_width, lines_of
from slipwise.motion.origin import MotionOrigin, time_in
from slipwise.motion.source_file import SourceFile, header_field, number, positive
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import Trace, half_last_digit

_START = re.compile(
    r"^\s*(?P<level>raw|uncorrected|corrected)\s+(?P<what>\w+)\b.*\(format v[\d.]+ with +(\d+) text", re.I
)
_BLOCK = re.compile(r"^\s*(?P<count>\d{1,9})\s.*follow.*format=\s*\(\s*(\d{1,2})[IF](\d{1,2})(?:\.\d+)?\)", re.I)
_DATA = re.compile(
    r"^\s*(?P<count>\d{1,9})\s+(?P<what>\w+)\s.*units=\s*(?P<unit>[^(,]+?)\s*(?:\(\s*\d+\s*\))?\s*,\s*"
    r"format=\s*\(\s*(?P<per_line>\d{1,2})[FE](?P<width>\d{1,2})(?:\.\d+)?\)",
    re.IGNORECASE,
)
_CHANNEL = re.compile(r"sta\s+cha[n]?:?\s*(?P<number>\d+):?\s*(?P<name>.*?)\s*(?:\(|location:|$)", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Return whether the first line is that of a COSMOS record."""
    lines = head.decode("utf-8", "replace").lstrip().splitlines()
    return bool(lines and re.search(r"\(format v[\d.]+ with", lines[0], re.IGNORECASE))


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the acceleration of every record of a file; velocity, displacement and spectra are left out.

    Raises:
        InputError: a header line is missing or odd, or a block is incomplete.
        UnitError: no record of acceleration in a unit of acceleration.
    """
    starts = [i for i, line in enumerate(source.lines) if re.search(r"\(format v[\d.]+ with", line, re.IGNORECASE)]
    traces: list[Trace] = []
    left: list[str] = []
    for start, end in zip(starts, [*starts[1:], len(source.lines)], strict=True):
        match = _START.match(source.lines[start])
        if match is None or not match["what"].lower().startswith("accel"):
            left.append(" ".join(source.lines[start].split("(")[0].split()).lower())
        elif match["level"].lower() == "raw":
            left.append("raw counts of acceleration")
        else:
            traces.append(_record(source, given, start, end, int(match[3]), match["level"].lower()))
    if not traces:
        raise UnitError(
            f"{source.name}: this COSMOS file holds {', '.join(dict.fromkeys(left))}; a table needs acceleration "
            "in physical units: take the V1 or V2 file"
        )
    return traces


def _record(source: SourceFile, given: Given, start: int, end: int, text_lines: int, level: str) -> Trace:
    """Read the record whose header starts at a line."""
    at = start + text_lines
    _, at = _numbers(source, at, "the integer header")
    reals, at = _numbers(source, at, "the real header")
    if len(reals) < 65:
        raise InputError(
            f"{source.name}: the real header has {len(reals)} numbers, 100 are needed; the file is damaged"
        )
    found, data = header_field(source, _DATA.pattern, at, end, "number, unit and format of its values")
    count, per_line, width = int(found["count"]), int(found["per_line"]), int(found["width"])
    step = positive(reals[61] * 1e-3, source.name, "the step in the real header (number 62)")
    dt, dt_words = settle_step(step, given, source)
    factor, unit_words = settle_unit(found["unit"], given, source)
    values = np.array(fixed_width(source, data + 1, count, per_line, width)) * factor
    after = data + 1 + lines_of(count, per_line)
    if after < end and source.lines[after].strip() and not re.match(r"\s*(end|/&)", source.lines[after], re.IGNORECASE):
        raise InputError(f"{source.at(after)}: more values follow than the {count} that the header states")
    text = source.lines[start : start + text_lines]
    channel = next((m for line in text if (m := _CHANNEL.search(line))), None)
    if channel is None or not channel["name"]:
        raise InputError(f"{source.name}: the header does not state the channel's direction ('Sta Cha: 1: 340 deg')")
    peak = _peak(reals, text, factor)
    name = channel["name"]
    return Trace(
        source=source,
        name=name,
        title=f"{text[4].strip()} {text[1].strip()}"[:80] if len(text) > 4 else source.stem,
        dt=dt,
        acceleration=values,
        treatment=(f"read as COSMOS: {source.name}, {level} acceleration, channel {name}", f"{unit_words}; {dt_words}"),
        header_peak=peak,
        origin=_origin(text),
        aliases=(channel["number"], f"Chan {channel['number']}"),
    )


def _numbers(source: SourceFile, at: int, what: str) -> tuple[list[float], int]:
    """Read a block of the header whose first line says how it is written; give the numbers and the line after."""
    match = _BLOCK.match(source.lines[at]) if at < len(source.lines) else None
    if match is None:
        raise InputError(f"{source.at(min(at, len(source.lines) - 1))}: {what} should begin here; the file is damaged")
    count, per_line, width = (int(part) for part in match.groups())
    check_format(per_line, width, source.at(at))
    end = at + 1 + lines_of(count, per_line)
    # Numbers of a header do not touch, and hand-made files shift them.
    values = [
        number(f, source.at(i)) for i in range(at + 1, min(end, len(source.lines))) for f in source.lines[i].split()
    ]
    return values, end


def _peak(reals: list[float], text: tuple[str, ...], factor: float) -> HeaderPeak | None:
    """Return the peak of the real header, rounded as the text lines write it; None where it is not known."""
    value, time = reals[63], reals[64]
    if value in (-999.0, 0.0):
        return None
    written = re.search(r"max\s*=\s*(-?[\d.]+)\s*cm", " ".join(text), re.IGNORECASE)
    rounding = half_last_digit(written[1]) if written else 5e-4
    return HeaderPeak(value * factor, None if time == -999.0 else time, max(rounding, 5e-4) * factor)


def _origin(text: tuple[str, ...]) -> MotionOrigin:
    joined = "\n".join(text)
    station = re.search(r"stat(?:io)?n no:\s*(\S+)", joined, re.IGNORECASE)
    place = re.search(r"location:\s*(.*)", joined, re.IGNORECASE)
    start = re.search(r"start time:\s*(\d+)/(\d+)/(\d+),?\s*([\d:.]+)", joined, re.IGNORECASE)
    begun = time_in(f"{start[3]}-{start[1]}-{start[2]} {start[4]}") if start else None
    return MotionOrigin(station[1] if station else "", "", place[1].strip() if place else "", "", begun)
