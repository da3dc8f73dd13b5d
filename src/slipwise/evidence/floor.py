"""The noise floor: what would a perfect model leave in each channel, stuck, near a reversal, and sliding?

Three bases, best first: a repeated run of the same motion (pure error), quiet stretches (a lower bound: the table may
hum while it shakes), the top of the spectrum (only if noise is white). Two runs of one motion differ by more than
noise: friction has run in or warmed up, reversals have moved. What is in step with the channel itself, with its rate,
or constant is therefore taken out of the difference first, and said.

Source: docs/theory.md, section 3.1; Draper, Smith, Applied Regression Analysis (pure error); Rice (1984), Annals of
Statistics 12.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign import Campaign, States
from slipwise.campaign.aligned import quiet_samples
from slipwise.channels import channel
from slipwise.errors import SettingError
from slipwise.noise.effective_samples import correlation_sum
from slipwise.record import Record
from slipwise.signals.derivative import derivative
from slipwise.signals.noise import quantum, white_level
from slipwise.signals.outliers import outliers

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
STATES: tuple[str, ...] = ("stuck", "near reversal", "sliding")
#: What moves by less than this part of itself is a constant; taking a logger's lag out rounds [1].
_CONSTANT = 1e-9
#: Fewer samples than this are no basis.
_ENOUGH = 60
#: Two runs are of one motion when their tables' difference leaves this part of the motion unexplained, less noise [1].
_SAME = 0.95
#: A repeat whose difference is larger than this many times the lowest level holds more than noise [1].
_MORE = 1.5
#: A change of friction between two runs that is worth a word [1].
_CHANGED = 0.01
#: Quiet stretches from which a level is taken: the calmest fifth [1].
_CALMER = 0.2


@dataclass(frozen=True)
class ChannelFloor:
    """Noise floor of one channel.

    Attributes:
        channel: name.
        level: of one sample, without regard to the state [SI]; NaN when there is no basis.
        by_state: state -> level [SI]; NaN when that state has no basis.
        basis: state -> "repeat", "quiet stretch", "top of the spectrum" or the reason why the floor is unknown.
        rounding: what the steps of the channel contribute, step / sqrt(12) [SI].
        correlation_time: the sum over all lags of the noise's correlation, times the step [s]: dt for white noise.
    """

    channel: str
    level: float
    by_state: Mapping[str, float]
    basis: Mapping[str, str]
    rounding: float
    correlation_time: float

    @property
    def known(self) -> bool:
        """Whether there is a basis."""
        return bool(np.isfinite(self.level))


@dataclass(frozen=True)
class Floor:
    """Noise floor of a campaign.

    Attributes:
        channels: name -> floor.
        notes: what was taken out of repeats, and why floors are unknown.
    """

    channels: Mapping[str, ChannelFloor]
    notes: tuple[str, ...]

    def of(self, name: str, state: str) -> float:
        """Return the floor of a channel in a state [SI]; NaN when it is unknown.

        Raises:
            SettingError: no such channel or state.
        """
        if name not in self.channels or state not in STATES:
            raise SettingError(
                f"no floor of {name!r} {state!r}; channels: {', '.join(self.channels)}; states: {', '.join(STATES)}"
            )
        return self.channels[name].by_state[state]

    def rows(self) -> list[dict[str, Any]]:
        """Return the floors as rows of a table."""
        return [
            {
                "channel": f.channel,
                "unit": channel(f.channel).unit,
                "level": f.level,
                **{state: f.by_state[state] for state in STATES},
                "basis": "; ".join(dict.fromkeys(f.basis.values())),
                "correlation_time": f.correlation_time,
            }
            for f in self.channels.values()
        ]


def noise_floor(campaign: Campaign, states: Sequence[States]) -> Floor:
    """Estimate the noise floor of every channel that all runs have.

    Args:
        campaign: whose roles say which run repeats which motion.
        states: measured states of its runs, in their order.

    Raises:
        SettingError: not one state for each run.
    """
    if len(states) != len(campaign.runs):
        raise SettingError(f"{len(states)} measured states for {len(campaign.runs)} runs; give one for each run")
    notes: list[str] = []
    pairs = _pairs(campaign, states, notes)
    quiet = [quiet_samples(s.record) for s in states]
    names = [n for n in states[0].record.channels if all(n in s.record for s in states)]
    changes: dict[str, list[float]] = {}
    floors = {name: _channel(name, states, quiet, pairs, changes) for name in names}
    notes += [
        f"{name}: the repeated run differs by {np.mean(found):+.1%} of the channel itself, wear or heat; taken out"
        for name, found in changes.items()
        if abs(float(np.mean(found))) > _CHANGED
    ]
    notes += [f"{f.channel}: floor unknown, {f.basis['sliding']}" for f in floors.values() if not f.known]
    return Floor(floors, tuple(notes))


def _pairs(campaign: Campaign, states: Sequence[States], notes: list[str]) -> list[tuple[States, States]]:
    """Find for each repeated run the run that it repeats."""
    pairs = []
    for i, run in enumerate(campaign.runs):
        if run.role != "repeat":
            continue
        driven = [n for n in ("table_ax", "table_ay", "table_az") if n in run.record] or ["slip_x"]
        found = [
            (min(_agreement(states[k].record, states[i].record, name) for name in driven), k)
            for k in range(len(states))
            if k != i and campaign.runs[k].role != "repeat" and states[k].record.has_all(*driven)
        ]
        best = max(found, default=(0.0, -1))
        if best[0] < _SAME:
            notes.append(f"{run.name} repeats no other run: no table motion agrees with its own")
        else:
            pairs.append((states[best[1]], states[i]))
    if not pairs:
        notes.append("no repeated run: a floor while sliding rests on quiet stretches, which are a lower bound")
    return pairs


def _agreement(one: Record, other: Record, name: str) -> float:
    count = min(len(one), len(other))
    if count < _ENOUGH or abs(len(one) - len(other)) > 0.02 * count or abs(one.dt / other.dt - 1.0) > 0.01:
        return 0.0
    first, second = one[name][:count], other[name][:count]
    noise = 2.0 * max(white_level(first), white_level(second)) ** 2
    apart, moving = float(np.var(first - second)), max(float(np.var(first)), float(np.var(second)))
    # what does not move in either run agrees
    return 1.0 - max(apart - 1.5 * noise, 0.0) / max(moving, 1e-300)


def _channel(
    name: str,
    states: Sequence[States],
    quiet: Sequence[Mask],
    pairs: Sequence[tuple[States, States]],
    changes: dict[str, list[float]],
) -> ChannelFloor:
    if all(np.ptp(s.record[name]) <= _CONSTANT * np.max(np.abs(s.record[name])) for s in states):
        words = "it is a constant of the campaign, not a measurement"
        return _unknown(name, words)
    dt = states[0].dt
    still = [x for s, q in zip(states, quiet, strict=True) for x in _stretches(s.record[name], q)]
    white = float(np.median([white_level(s.record[name]) for s in states]))
    # the calmer ones: after a motion, cells and slip may still relax and ring
    calm = float(np.quantile([np.sqrt(np.mean(x**2)) for x in still], _CALMER)) if still else float("nan")
    lowest = max(calm, white) if still else white
    source = "quiet stretch" if still else "top of the spectrum"
    pure = _pure_error(name, pairs, changes)
    # what rings on alike in both runs of a pair is no noise, quiet or not
    lowest = min([lowest, *(level for level in pure.values() if level > 0.0)])
    by_state, basis = {}, {}
    for state in STATES:
        repeated = pure.get(state, float("nan"))
        if np.isfinite(repeated):
            by_state[state], basis[state] = repeated, "repeat"
            if repeated > _MORE * lowest:
                basis[state] = f"repeat, {repeated / lowest:.1f} times the lowest: the motion did not repeat exactly"
        elif state == "stuck" or still or white > 0.0:
            by_state[state], basis[state] = lowest, source
        else:
            by_state[state], basis[state] = float("nan"), "no repeat, no quiet stretch and no signal-free band"
    rounding = quantum(states[0].record[name]) / np.sqrt(12.0)
    return ChannelFloor(name, lowest, by_state, basis, float(rounding), correlation_sum(still) * dt)


def _unknown(name: str, why: str) -> ChannelFloor:
    nothing = float("nan")
    return ChannelFloor(name, nothing, dict.fromkeys(STATES, nothing), dict.fromkeys(STATES, why), 0.0, nothing)


def _stretches(values: Array, quiet: Mask) -> list[Array]:
    """Return the quiet stretches of a channel, each without its slow curve."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], quiet.astype(int), [0]])))
    found = []
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        if end - start >= _ENOUGH:
            place = np.arange(end - start)
            found.append(values[start:end] - np.polynomial.Polynomial.fit(place, values[start:end], 2)(place))
    return found


def _pure_error(name: str, pairs: Sequence[tuple[States, States]], changes: dict[str, list[float]]) -> dict[str, float]:
    """Return the standard deviation of one sample from the difference of two runs of one motion, by state."""
    squares: dict[str, list[float]] = {}
    for one, other in pairs:
        count = min(len(one.time), len(other.time))
        first, second = one.record[name][:count], other.record[name][:count]
        usable = one.usable[:count] & other.usable[:count]
        for states in (one, other):
            usable &= ~outliers(states.record[name])[:count]
        mean = 0.5 * (first + second)
        columns = np.stack([mean, derivative(mean, one.dt), np.ones(count)], axis=1)
        difference = second - first
        step = np.linalg.lstsq(columns[usable], difference[usable], rcond=None)[0]
        changes.setdefault(name, []).append(float(step[0]))
        left = difference - columns @ step
        for state, mask in _masks(one, other, count).items():
            here = usable & mask
            if here.sum() >= _ENOUGH:
                squares.setdefault(state, []).append(float(np.mean(left[here] ** 2)) / 2.0)
    return {state: float(np.sqrt(np.mean(found))) for state, found in squares.items()}


def _masks(one: States, other: States, count: int) -> dict[str, Mask]:
    """Samples at which both runs are in the same state."""
    return {
        "stuck": one.stuck[:count] & other.stuck[:count],
        "near reversal": one.near_reversal[:count] & other.near_reversal[:count],
        "sliding": one.sliding[:count] & other.sliding[:count],
    }
