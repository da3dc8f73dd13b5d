"""Components of one table must be of one record: station, sensor, event and start of those that are joined."""

import warnings
from collections.abc import Sequence

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion.trace import Trace

#: Starts this far apart are those of two records [s]; closer, but by more than half a step, they are warned of.
_TWO_RECORDS = 1.0


def check_one_record(traces: Sequence[Trace], anyway: bool) -> None:
    """Refuse components of different records; what is not stated is not compared.

    Args:
        traces: the components that are joined.
        anyway: warn instead of refusing.

    Raises:
        InputError: stations, sensors (borehole and surface), events or starts differ.
    """
    first = traces[0]
    for other in traces[1:]:
        differing = _differences(first, other)
        if differing:
            words = f"{_called(first)} and {_called(other)} are of different records: {'; '.join(differing)}"
            if not anyway:
                raise InputError(f"{words}; give the files of one record, or --join-anyway to shake with both")
            warnings.warn(f"{words}; joined all the same", SlipwiseWarning, stacklevel=4)
        one, two = first.origin, other.origin
        if one.place and two.place and one.place != two.place:
            warnings.warn(
                f"{_called(first)} stands at {one.place}, {_called(other)} at {two.place}: two places of one structure",
                SlipwiseWarning,
                stacklevel=4,
            )
        if 0.5 * first.dt < _apart(first, other) <= _TWO_RECORDS and not _exact(first, other):
            warnings.warn(
                f"{_called(first)} starts at {one.start}, {_called(other)} at {two.start}: they are joined as if they "
                "started together",
                SlipwiseWarning,
                stacklevel=4,
            )


def common_starts(traces: Sequence[Trace]) -> list[int]:
    """Return how many samples of each component lie before the time from which on all of them are there.

    Starts that files state to the sample are trusted; other components start together.
    """
    if len(traces) < 2 or not all(_exact(traces[0], trace) for trace in traces):
        return [0] * len(traces)
    latest = max(trace.origin.start for trace in traces if trace.origin.start)
    return [
        round((latest - trace.origin.start).total_seconds() / trace.dt) if trace.origin.start else 0 for trace in traces
    ]


def _exact(one: Trace, two: Trace) -> bool:
    """Return whether both state the time of their first sample exactly, and share some of their time."""
    return (
        one.origin.exact_start
        and two.origin.exact_start
        and _apart(one, two) < min(one.dt * len(one.acceleration), two.dt * len(two.acceleration))
    )


def _apart(one: Trace, two: Trace) -> float:
    starts = one.origin.start, two.origin.start
    return abs((starts[0] - starts[1]).total_seconds()) if starts[0] and starts[1] else 0.0


def _differences(first: Trace, other: Trace) -> list[str]:
    """Say what differs, naming both."""
    one, two = first.origin, other.origin
    pairs = [("station", one.station, two.station), ("sensor", one.sensor, two.sensor), ("event", one.event, two.event)]
    words = [f"{what} {a} and {b}" for what, a, b in pairs if a and b and a.casefold() != b.casefold()]
    if _apart(first, other) > _TWO_RECORDS and not _exact(first, other):
        words.append(f"start {one.start} and {two.start}")
    return words


def _called(trace: Trace) -> str:
    return f"{trace.name} ({trace.source.name})"
