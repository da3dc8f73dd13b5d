"""What stands behind the words of a fact in a header: "(ms): 10", "= .0200 SEC", "NS 12.2 EW 8.2"."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from slipwise.data_files.acceleration_unit import is_acceleration, is_velocity_or_displacement
from slipwise.data_files.words import folded, words
from slipwise.errors import UnitError
from slipwise.units import quantity

NUMBER = r"[+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eEdD][+-]?\d+)?"
#: Beyond this a number is no statement.
_LARGEST = 1e30
#: A step of few digits may be off by its rounding, but by no more than this [1].
_COARSEST = 0.01
#: "dt_ms", "time step (ms)", "time step in ms:".
_INNER = re.compile(
    r"(?:_(?P<tail>[A-Za-z][\w/^]*))?\"?(?:[.\s]*[(\[](?P<inner>[^)\]]*)[)\]]|\s+(?:in|en|em)\s+(?P<said>[^\s:=]+)(?=\s*[:=]))?"
)
_SIGN = re.compile(r"\"?\s*(?:[:=]+|\t|;|->|\|)[\s\"'=]*")
#: A line of key and value in a table of commas: "fs,50", "Interval;20;ms".
_ALONE = re.compile(rf"\"?\s*[,;]\s*\"?(?={NUMBER}\"?\s*(?:[,;][^,;\d]*)?[,;\s]*$)")
_WHOLE = re.compile(r"\d{1,3}(?:[,']\d{3})+(?![\d.])|\d+(?:\.0*)?(?![\d.])")
_UNIT = re.compile(r"\s*[(\[]?\s*([^\s,;:()\[\]=\"\d][^\s,;:()\[\]=\"]*)")
#: "Acceleration in g", "Ground Accel. (g)", "acceleration m/s2", "ivme g cinsinden": the unit of the values below.
_MEASURED_IN = (
    re.compile(r"[^:=\d(\[]{0,30}?(?:\b(?:in|en|em)\s+|[(\[,:=]\s*)([^\s,;()\[\]]+)", re.IGNORECASE),
    re.compile(r"\s+([^\s,;()\[\]]+/s\S*)", re.IGNORECASE),
    re.compile(r"[^:=\d(\[]{0,30}?\s(\S+)\s+cinsinden", re.IGNORECASE),
)
_DIRECTION = "(?:[东東]西|南北|上下|竖直?|垂直)向?"
_LABEL = rf"[(\[]?(?P<{{}}>[A-Za-z+][\w+.-]{{{{0,11}}}}|{_DIRECTION}|\d{{{{3}}}}(?=\s*[):=\]]))[)\]]?"
_PEAK = re.compile(
    rf"\s*[,;/|]?\s*(?:{_LABEL.format('label')}\s*[:=]?\s*)?(?P<number>{NUMBER})(?![\d.])(?P<rest>.*)", re.DOTALL
)
_BEHIND = re.compile(r"\s*\(([A-Za-z+][\w+.-]{0,11})\)")
_AT = re.compile(r"\s*(?:at|@)\s*(?:t\s*=\s*)?([\d.]+)\s*s", re.IGNORECASE)
#: "200 points per channel", "8 values a line" state no count.
EACH = re.compile(r"\s*(?:/|per\b|pro\b|por\b|je\b|par\b|al\b|a line|each)", re.IGNORECASE)


@dataclass(frozen=True)
class Peak:
    """A stated peak as written.

    Attributes:
        text: its number.
        unit: "" if it has none.
        time: [s], None if it has none.
        label: the component that it is of, "" if it names none.
        line: where it stands.
    """

    text: str
    unit: str
    time: float | None
    label: str = ""
    line: str = ""


class StatementValue:
    """What stands behind a fact's words."""

    def __init__(self, text: str, room: int, how: str) -> None:
        """Find the unit in brackets and the sign; `used` is how much of the text the value takes, 0 if it is none."""
        self.used = 0
        self.how = how
        self.behind_key = text
        self.room = room
        inner = _INNER.match(text)
        self.unit = ((inner["inner"] or inner["said"] or inner["tail"] or "") if inner else "").strip()
        at = inner.end() if inner else 0
        # "between samples: ", "est de ", "of data = "
        between = re.compile(rf"(?:[\s,\"']|\.(?!\d))*(?:(?:{words().links})[\s,\"']*){{0,4}}", re.IGNORECASE)
        linked = between.match(text, at)
        self.start = linked.end() if linked else at
        sign = _SIGN.match(text, at) or _SIGN.match(text, self.start) or _ALONE.match(text, at)
        self.signed = sign is not None
        if sign:
            linked = between.match(text, sign.end())
            self.start = linked.end() if linked else sign.end()
        self.text = text[self.start :]

    def contents(self, fact: str, label: str) -> Iterator[tuple[object, float]]:
        """Yield what the value states of a fact."""
        if fact == "acceleration":
            for pattern in _MEASURED_IN:
                match = pattern.match(self.behind_key)
                if match and is_acceleration(match[1].rstrip(".")):
                    self.used = match.end()
                    yield match[1].rstrip("."), 0.0
                    return
            return
        if fact == "peak":
            yield from ((peak, 0.0) for peak in self._peaks(label))
            return
        # "単位(gal)" and "Einheit g" need no sign, and "passo 0.01 s" none for its unit.
        if (
            self.how == "signed"
            and not self.signed
            and not (fact == "unit" and (self.unit or self._begins_with_unit()))
        ):
            return
        if fact == "unit":
            yield from self._unit()
        elif fact in ("step", "rate", "peak time"):
            yield from self._step(fact)
        elif fact == "count":
            match = _WHOLE.match(self.text)
            behind = self.text[match.end() :] if match else ""
            if match and not EACH.match(behind) and not re.match(r"\s*(?:Hz|sps|s\b)", behind, re.IGNORECASE):
                self.used = self.start + match.end()
                yield int(re.sub(r"[,']|\..*", "", match[0])), 0.0
        elif self.signed:
            value = self.text[: max(0, self.room - self.start)].strip(" ,;\"'\t")
            depth = re.match(NUMBER, value)
            if value and (fact != "sensor" or depth):
                self.used = self.start + len(self.text)
                yield (depth[0] if fact == "sensor" and depth else value), 0.0

    def _begins_with_unit(self) -> bool:
        word = _UNIT.match(self.text)
        return word is not None and is_acceleration(word[1].rstrip("."))

    def _unit(self) -> Iterator[tuple[str, float]]:
        """Yield the first unit of acceleration, else one of velocity or, with a sign, the first word."""
        inner = self.unit if is_acceleration(self.unit) else ""
        value = inner or self.text[: max(0, self.room - self.start)] or self.text
        listed = [part.strip("().[]\"'") for part in re.split(r"[\s,;]+", value)]
        found = next((part for part in listed if part and is_acceleration(part)), None)
        if found is None:
            plain = self.signed or len(listed) == 1
            found = next((part for part in listed if part and (plain or is_velocity_or_displacement(part))), None)
        if found:
            self.used = self.start + max(0, self.text.find(found) + len(found)) if not inner else self.start
            yield found, 0.0

    def _step(self, fact: str) -> Iterator[tuple[float, float]]:
        known = words()
        number = rf"({NUMBER})(?![\d.]|[:/-]\d)"
        # "Interval;20;ms": the unit has a cell of its own
        cell = re.match(rf'{number}"?[,;\t]"?({known.unit})"?\s*(?:[,;\t]|$)', self.text, re.IGNORECASE)
        match = cell or re.match(rf"{number}\s*[(\[]?\s*({known.unit})?", self.text, re.IGNORECASE)
        if match is None:
            return
        unit = match[2] or self.unit
        if not match[2] and (other := _UNIT.match(self.text[: self.room - self.start], match.end(1))) and not self.unit:
            unit = other[1].rstrip(".")
        if self.how == "with_unit" and folded(unit).lower() not in known.units:
            return  # "Step 3 of 5", "every 10 stations"
        for _, content, rounding in step_of(match[1], unit, fact):
            self.used = self.start + match.end()
            yield content, rounding

    def _peaks(self, label: str) -> Iterator[Peak]:
        """Yield one peak, or those of several components: "(N-S) 12.2 (E-W) 8.2", "NS=12.2, EW=8.2", "12.2/8.2/2.9"."""
        bracket = bool(self.unit) and self.behind_key.lstrip().startswith(("(", "["))
        # "PGA (NS/EW/UD): 12.2/8.2/2.9 gal"
        listed = [] if is_acceleration(self.unit) else re.split(r"[\s,;/]+", self.unit)
        self.unit = "" if listed else self.unit
        behind_key = self.behind_key.lstrip(". ")
        named = re.match(rf"{_LABEL.format('label')}\s*[:=]", behind_key)
        text = behind_key if named and not (self.signed or bracket) else self.text
        # Without a sign a number is a peak only if a unit of acceleration stands behind it.
        direct = re.match(rf"{NUMBER}\s*([^\s,;]+)", text)
        if not (self.signed or bracket or named or (direct and is_acceleration(direct[1].rstrip(".")))):
            return
        peaks: list[Peak] = []
        behind_all = True
        while match := _PEAK.match(text):
            unit, rest = self.unit, match["rest"]
            written = _UNIT.match(rest)
            if written and is_acceleration(written[1].rstrip(".")):
                unit, rest = written[1].rstrip("."), rest[written.end() :].lstrip(")] ")
            # Names stand before all numbers or behind all of them.
            behind = _BEHIND.match(rest) if behind_all and not match["label"] else None
            rest = rest[behind.end() :] if behind else rest
            if behind and not unit and (written := _UNIT.match(rest)) and is_acceleration(written[1].rstrip(".")):
                unit, rest = written[1].rstrip("."), rest[written.end() :]
            at = _AT.match(rest)
            rest = rest[at.end() :] if at else rest
            called = match["label"] or (behind[1] if behind else "") or ("" if peaks else label)
            behind_all = behind is not None
            called = "" if words().is_acceleration(called) else called
            peaks.append(Peak(match["number"].replace(",", "."), unit, float(at[1]) if at else None, called))
            text, self.used = rest, len(self.behind_key) - len(rest)
        # "12.2 / 8.2 / 2.9 gal": the unit of the last is that of all.
        last = peaks[-1].unit if peaks else ""
        if len(listed) == len(peaks) > 1 and not any(peak.label for peak in peaks):
            peaks = [replace(peak, label=name) for peak, name in zip(peaks, listed, strict=True)]
        yield from (replace(peak, unit=peak.unit or last) for peak in peaks)


def step_of(number: str, unit: str, fact: str) -> Iterator[tuple[str, float, float]]:
    """Yield ("step", step [s], relative rounding); the unit says whether it is a step or a rate, if there is one."""
    text = number.replace(",", ".").lower().replace("d", "e")
    value = float(text)
    if not 0.0 < abs(value) < _LARGEST:
        return
    known = words().units.get(folded(unit).lower().strip("."))
    si, factor = known or ("Hz" if fact == "rate" else "s", 1.0)
    if unit and not known:
        for dimension in ("s", "Hz"):
            try:
                factor, si = quantity(f"1 {unit}", dimension, "", plain_unit=unit), dimension
                break
            except UnitError as error:
                if "wrong dimension" in str(error) and dimension == "Hz":
                    return  # "delta: 45 km" is no step
    step = value * factor if si == "s" else 1.0 / (value * factor)
    digits = text.partition("e")[0].partition(".")[2]
    rounding = 0.5 * 10.0 ** -len(digits) / abs(float(text.partition("e")[0])) if digits else 0.0
    rounding = min(rounding, _COARSEST)
    if step > 0.0:
        yield "step", step, rounding
