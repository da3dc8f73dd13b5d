"""What the header of a data file states: step or rate, unit, count, peaks, and texts such as the station.

A statement is a fact's words, perhaps a unit in brackets, a sign or a linking word, and a value; it may stand anywhere
in a line, and several may share one. Statements of one fact that contradict each other are refused.
"""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from slipwise.data_files.acceleration_unit import acceleration_factor, is_acceleration
from slipwise.data_files.statement_value import EACH, NUMBER, Peak, StatementValue, step_of
from slipwise.data_files.words import folded, words
from slipwise.errors import InputError

#: Words for a rate state the step, those for an acceleration with a unit behind them the unit.
_FACTS = {"rate": "step", "acceleration": "unit"}
#: Facts of which a record has one.
BINDING = ("step", "count", "unit")
_SEPARATOR = re.compile(r"[,;|\t()#]|\s{2,}|[.:]\s|\s-\s")


@dataclass(frozen=True)
class Statements:
    """What a header states; None and empty where it states nothing.

    Attributes:
        step: [s], a rate as its step.
        unit: of the acceleration, as written.
        count: of the samples.
        peaks: in the header's order.
        texts: "component", "station", "sensor", "event", "start" -> what stands there.
        lines: fact -> the line that states it.
    """

    step: float | None = None
    unit: str | None = None
    count: int | None = None
    peaks: tuple[Peak, ...] = ()
    texts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    lines: Mapping[str, str] = field(default_factory=dict)

    def quoted(self, fact: str) -> str:
        """Return the line that states a fact, in quotes, for a message; "" if none does."""
        return repr(self.lines[fact][:70]) if fact in self.lines else ""


def read_statements(lines: Sequence[str], what: str, binding: Collection[str] = BINDING) -> Statements:
    """Read what the lines of a header state.

    Args:
        lines: of the header.
        what: the file, for messages.
        binding: the facts that must not be stated twice with different contents; a table of many gauges states
            several units.

    Raises:
        InputError: two statements of such a fact that contradict each other.
    """
    found: dict[str, tuple[object, float, str]] = {}
    peaks: list[Peak] = []
    texts: dict[str, tuple[str, ...]] = {}
    for line in lines:
        stated = line.strip()
        for fact, content, rounding in _facts(folded(line), line):
            if isinstance(content, Peak):
                peaks.append(replace(content, line=stated))
                continue
            if fact not in ("step", "count", "unit", "peak time"):
                texts[fact] = (*texts.get(fact, ()), str(content))
                continue
            before = found.get(fact)
            if before is None or (_agree(before, content, rounding) and rounding < before[1]):
                found[fact] = (content, rounding, stated)
            elif fact in binding and not _agree(before, content, rounding):
                raise InputError(
                    f"{what}: the header contradicts itself: {before[2][:60]!r} and {stated[:60]!r}; "
                    "correct the wrong line"
                )
    step, unit, count, time = (found.get(fact, (None,))[0] for fact in ("step", "unit", "count", "peak time"))
    if isinstance(time, float):
        peaks = [p if p.time is not None else replace(p, time=time) for p in peaks]
    return Statements(
        step=step if isinstance(step, float) else None,
        unit=unit if isinstance(unit, str) else None,
        count=count if isinstance(count, int) else None,
        peaks=tuple(peaks),
        texts=texts,
        lines={fact: line for fact, (_, _, line) in found.items()},
    )


def _facts(line: str, original: str) -> Iterator[tuple[str, object, float]]:
    """Yield every (fact, content, relative rounding of its digits) of a folded line."""
    known = words()
    keys = [match for match in known.key.finditer(line)]
    end = 0
    taken: list[tuple[int, int]] = []
    for k, match in enumerate(keys):
        if match.start() < end:
            continue
        group = str(match.lastgroup).split("__")
        fact, how = group[0].replace("_", " "), group[1]
        # What is signed begins a statement; a name, as in "N-S PGA", may stand before a peak.
        before = _SEPARATOR.split(line[end : match.start()])[-1]
        begins = not re.search(r"\w", before.replace("_", " "))
        label = re.fullmatch(r"\W*([A-Za-z+][\w+-]{0,11})\W*", before) if fact == "peak" else None
        if known.others.search(before) or (how == "signed" and not begins and label is None):
            continue
        following = next((m.start() for m in keys[k + 1 :] if m.start() >= match.end()), len(line))
        statement = StatementValue(line[match.end() :], following - match.end(), how)
        for content, rounding in statement.contents(fact, label[1] if label else ""):
            yield _FACTS.get(fact, fact), content, rounding
        if statement.used:
            taken.append((match.start(), match.end() + statement.used))
            end = match.end() + statement.used
    for match in known.behind.finditer(line):
        number = re.search(rf"(?<![\w.,+-])({NUMBER})\s*({known.unit})?\s*$", line[: match.start()], re.IGNORECASE)
        if number is None or any(start < match.end() and number.start() < stop for start, stop in taken):
            continue
        fact = str(match.lastgroup).split("__")[0]
        if fact == "count" and len(number[1]) > 1 and number[1].isdigit() and not number[2]:
            if not EACH.match(line[match.end() :]):
                yield "count", int(number[1]), 0.0
        elif fact == "rate" and (not number[2] or known.units[number[2].lower()][0] == "Hz"):
            yield from step_of(number[1], number[2] or "hz", "rate")
        elif fact == "step" and number[2]:
            yield from step_of(number[1], number[2], "step")


def _agree(before: tuple[object, float, str], content: object, rounding: float) -> bool:
    one = before[0]
    if isinstance(one, float) and isinstance(content, float):
        return abs(one - content) <= max(1e-4, before[1] + rounding) * abs(one)
    texts = str(one), str(content)
    if all(map(is_acceleration, texts)):  # gal is cm/s^2
        first, second = (acceleration_factor(text, "") for text in texts)
        return abs(first - second) <= 1e-4 * second
    return texts[0].lower() == texts[1].lower()
