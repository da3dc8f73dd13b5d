"""The next test: which table motion would best tell the rivals of a diagnosis apart.

Each motion of a library within the table's limits is shaken twice on the computer: once as the best hypothesis has it,
measured with the campaign's own noise; then both hypotheses are fitted to that measurement, everything free. What the
rival still leaves, beyond what the best one leaves, is what the motion is worth. Without the refit every motion looks
good (Atkinson and Fedorov 1975; Hunter and Reiner 1965).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.campaign import Campaign, Run
from slipwise.diagnose import Diagnosis
from slipwise.diagnose.refit import Account, Hypothesis, base_hypothesis
from slipwise.diagnose.worth import MATERIAL
from slipwise.errors import SimulationError, SlipwiseError
from slipwise.fit.base import fit_base
from slipwise.model import Model
from slipwise.motion import displacement_peak, parse_motion, velocity_peak
from slipwise.record import Record
from slipwise.replay import replay
from slipwise.signals import lowpass

#: Motions that laboratories make: slow and fast, small and large, with and without vertical part.
LIBRARY: tuple[str, ...] = (
    "sine:0.5Hz,0.03g,cycles=9",
    "triangle:0.25Hz,3cm/s,cycles=4",
    "sine:1.6Hz,0.2g,cycles=12",
    "sine:1.6Hz,0.2g,cycles=12,vertical=5Hz,0.25g",
    "sine:4.2Hz,0.5g,cycles=24",
    "sine:4.2Hz,0.5g,cycles=24,vertical=6.5Hz,0.3g",
    "quake:seed=1,peak=0.4g,f=4Hz,strong=4s",
    "quake:seed=2,peak=0.7g,f=4Hz,strong=4s,vertical=0.3g",
    "quake:seed=3,peak=0.7g,f=3Hz,strong=5s,vertical=0.6g",
)
#: No motion makes anybody surer than this.
_SUREST = 0.99


@dataclass(frozen=True)
class Limits:
    """What the table can do. Source of the defaults: DPRI, Kyoto University, the paper's table.

    Attributes:
        stroke: from the middle [m].
        speed: [m/s].
        acceleration: [m/s^2].
    """

    stroke: float = 0.3
    speed: float = 1.5
    acceleration: float = 9.8


@dataclass(frozen=True)
class Proposal:
    """What a motion would tell.

    Attributes:
        motion: as `slipwise replay` takes it.
        separation: mean squared residual that the rival would leave beyond the best hypothesis [noise variance].
        relation: where.
        probability: expected of the better hypothesis afterwards [1].
        refused: why the table cannot make it; "" where it can.
    """

    motion: str
    separation: float
    relation: str
    probability: float
    refused: str


@dataclass(frozen=True)
class NextTest:
    """Motions, the best first.

    Attributes:
        best: names of the better hypothesis.
        rival: names of the other; empty for the base model.
        now: probability of the better one today [1].
        proposals: sorted by what they would tell.
    """

    best: tuple[str, ...]
    rival: tuple[str, ...]
    now: float
    proposals: tuple[Proposal, ...]


def next_test(
    found: Diagnosis,
    limits: Limits | None = None,
    library: Sequence[str] = LIBRARY,
    progress: Callable[[str, float], None] | None = None,
) -> NextTest:
    """Rank table motions by how well they would tell a diagnosis and its rival apart.

    Args:
        found: the diagnosis.
        limits: of the table.
        library: motions as `slipwise motions` describes them.
        progress: called with what is being done and the share done.
    """
    allowed = limits or Limits()
    best, rival = rivals(found)
    out = []
    for i, text in enumerate(library):
        if progress:
            progress(text[:32], i / len(library))
        refused = _refused(text, allowed)
        separation, relation = (0.0, "") if refused else _separation(found, best, rival, text)
        now = found.verdict.probability
        # A material difference leaves a third of today's doubt, twice that a ninth.
        later = min(_SUREST, 1.0 - (1.0 - now) * float(np.exp(-separation / MATERIAL)))
        out.append(Proposal(text, separation, relation, max(now, later), refused))
    ranked = sorted(out, key=lambda p: (bool(p.refused), -p.separation))
    return NextTest(best.names, rival.names, found.verdict.probability, tuple(ranked))


def rivals(found: Diagnosis) -> tuple[Hypothesis, Hypothesis]:
    """Give the best hypothesis and its strongest rival: one that does not merely add to it, or the base model."""
    best = found.search.best
    named = set(best.names)
    others = [h for h in found.search.tried if h.terms and not named <= set(h.names)]
    if not best.terms:
        others = [h for h in found.search.tried if h.terms]
    if not others:
        return best, found.search.path[0]
    return best, min(others, key=lambda h: h.account.total)


def _refused(text: str, limits: Limits) -> str:
    motion = parse_motion(text)
    reached = {
        "stroke": (float(displacement_peak(motion, "none").max()), limits.stroke, "m"),
        "speed": (float(velocity_peak(motion, "none").max()), limits.speed, "m/s"),
        "acceleration": (float(motion.peaks.max()), limits.acceleration, "m/s^2"),
    }
    over = [f"{name} {have:.2g} of {can:.2g} {unit}" for name, (have, can, unit) in reached.items() if have > can]
    return ", ".join(over)


def _separation(found: Diagnosis, best: Hypothesis, rival: Hypothesis, text: str) -> tuple[float, str]:
    base = found.search.base
    try:
        campaign = _measured(found, _model(best), text)
        ours, theirs = (base_hypothesis(fit_base(campaign, _model(h))).account for h in (best, rival))
    except (SimulationError, SlipwiseError):
        return 0.0, ""
    gains = {name: _level(theirs, name) - _level(ours, name) for name in base.problem.relations if name in ours.fitted}
    where = max(gains, key=lambda name: gains[name])
    return max(gains[where], 0.0), where


def _level(account: Account, relation: str) -> float:
    return account.level(relation, held_out=False)


def _model(found: Hypothesis) -> Model:
    return found.problem.model(found.solution.values)


def _measured(found: Diagnosis, model: Model, text: str) -> Campaign:
    """Shake a model on the computer and measure it as the campaign was measured: channels, filter, noise."""
    campaign = found.final.campaign
    pattern = found.search.base.problem.runs[0]
    rng = np.random.default_rng(1)
    record = replay(model, parse_motion(text), output_dt=0.002).record
    channels = {}
    for name in pattern.record.channels:
        if name not in record:
            continue
        values = record[name]
        kept = campaign.logger.of(name)
        if kept is not None:
            values = lowpass(values, record.dt, kept)
        channels[name] = values + pattern.noise.get(name, 0.0) * rng.standard_normal(len(values))
    run = Run("next", "fit", Record(record.time, channels), None, None, "next", "")
    return replace(campaign, runs=(run,))
