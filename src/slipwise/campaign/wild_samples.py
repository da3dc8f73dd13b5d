"""Wild samples: what a logger has written and no gauge can have read, found, bridged and named before all else.

A sample is wild where a burst of at most 20 stands out of its channel by more than the range of everything else there
(`slipwise.signals.short_bursts`), unless a balance of forces says that the girder has moved like that: a pad that lands
shows in the loads and in the vertical acceleration at the same time, a glitch in one of them alone.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.channels import channel
from slipwise.rig import Specimen
from slipwise.short_repr import short_repr
from slipwise.signals.short_bursts import bridge_samples, short_bursts, stretches
from slipwise.units import convert

#: A burst is motion where the rest of a balance leaves less than this share of it unexplained [1].
_UNEXPLAINED = 0.5
#: Bursts of a channel that are named one by one.
_NAMED = 3


@short_repr
@dataclass(frozen=True)
class WildSamples:
    """Wild samples of one channel of one run.

    Attributes:
        channel: that shows them.
        bad: (n,) where in the run's record they were; they are bridged there.
        times: (k,) of each [s].
        values: (k,) of each as it was written, in the channel's unit.
    """

    channel: str
    bad: Mask
    times: Array
    values: Array

    def within(self, kept: slice, time: Array) -> "WildSamples":
        """Return those within a part of the record, whose time is (m,) [s]."""
        inside = (self.times >= time[0]) & (self.times <= time[-1])
        return WildSamples(self.channel, self.bad[kept], self.times[inside], self.values[inside])

    @property
    def words(self) -> str:
        """Count, times and values, such as "2 wild samples (103.2 kN at 1.4 s, -88 kN at 2.5 s)"."""
        known = channel(self.channel)
        unit = known.unit if known.shown_in == "degC" else known.shown_in
        bursts = np.split(np.arange(len(self.times)), np.flatnonzero(np.diff(np.flatnonzero(self.bad)) > 1) + 1)
        if len(self.times) != np.count_nonzero(self.bad):  # thinned out since
            bursts = [np.arange(len(self.times))]
        told = []
        for burst in bursts[:_NAMED]:
            worst = burst[np.argmax(np.abs(self.values[burst]))]
            size = f"{convert(float(self.values[worst]), known.unit, unit):.4g} {unit}".rstrip(" 1")
            first, last = float(self.times[burst[0]]), float(self.times[burst[-1]])
            told.append(f"{size} at {first:.6g} s" if first == last else f"{size} from {first:.6g} to {last:.6g} s")
        more = f" and {len(bursts) - _NAMED} bursts more" if len(bursts) > _NAMED else ""
        count = len(self.times)
        return f"{count} wild sample{'s' if count > 1 else ''} ({', '.join(told)}{more})"


def without_wild_samples(
    time: Array, channels: Mapping[str, Array], specimen: Specimen
) -> tuple[dict[str, Array], tuple[WildSamples, ...]]:
    """Return channels with their wild samples bridged, and what was found.

    Args:
        time: (n,) [s].
        channels: of one record, each (n,), SI; values that are missing stay so.
        specimen: whose girder ties the channels together.
    """
    bad = not_motion({name: short_bursts(values) for name, values in channels.items()}, channels, specimen)
    bridges = {name: bridge_samples(channels[name], marks) for name, marks in bad.items()}
    wild = (WildSamples(name, marks, time[marks], channels[name][marks]) for name, marks in bad.items())
    return {**channels, **bridges}, tuple(wild)


def not_motion(bursts: Mapping[str, Mask], channels: Mapping[str, Array], specimen: Specimen) -> dict[str, Mask]:
    """Return the bursts that no balance confirms as a motion of the girder; channels without any are left out.

    Args:
        bursts: channel -> its samples (n,) that stand out.
        channels: of one record, each (n,), SI.
        specimen: whose girder ties the channels together.
    """
    out = {}
    for name, found in bursts.items():
        bad = found.copy()
        for start, end in stretches(found):
            if _is_motion(name, slice(start, end), channels, specimen):
                bad[start:end] = False
        if bad.any():
            out[name] = bad
    return out


def inherited(wild: Sequence[WildSamples], name: str, sources: Sequence[str]) -> tuple[WildSamples, ...]:
    """Return samples at which a channel that was computed from others has taken theirs, which are not told again."""
    bad = [one.bad for one in wild if one.channel in sources]
    return (WildSamples(name, np.any(bad, axis=0), np.empty(0), np.empty(0)),) if bad else ()


def _is_motion(name: str, burst: slice, channels: Mapping[str, Array], specimen: Specimen) -> bool:
    """Return whether the rest of a balance shows the burst of a channel too."""
    for balance in _balances(specimen):
        if name not in balance or any(other not in channels for other in balance):
            continue
        out = {n: factor * _beyond_line(channels[n], burst) for n, factor in balance.items()}
        left = float(np.abs(np.sum(list(out.values()), axis=0)).max())
        if left < _UNEXPLAINED * float(np.abs(out[name]).max()):
            return True
    return False


def _beyond_line(values: Array, burst: slice) -> Array:
    """Return by how much a burst leaves the line from the sample before it to the one after it, (k,)."""
    before, after = max(burst.start - 1, 0), min(burst.stop, len(values) - 1)
    line = np.interp(np.arange(burst.start, burst.stop), [before, after], [values[before], values[after]])
    return values[burst] - line


def _balances(specimen: Specimen) -> Iterator[dict[str, float]]:
    """Yield what adds up to nothing in a moment: channel -> factor [N per unit]; slip and its buffers are slower."""
    if not specimen.free:
        return
    yield {**{f"pad_{pad}_N": 1.0 for pad in specimen.pads}, "girder_az": -specimen.carried_mass}
    for axis in "xy":
        yield {**{f"pad_{pad}_F{axis}": 1.0 for pad in specimen.pads}, f"girder_a{axis}": specimen.mass}
