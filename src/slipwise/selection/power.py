"""Power of a campaign: each effect at the limit of what matters, put into twins of it, and what is said of them.

"Breakaway would be seen in 95 of 100 campaigns like this one" says what a verdict that does not name it is worth. What
is said of a twin is decided as for the campaign itself, by the same calibrated chances; only the standard errors by
which a refit would lead are told by products.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.calibration import load_calibration
from slipwise.evidence.decision import EVEN_ODDS, LISTED, compute_chance_to_matter
from slipwise.evidence.posterior import Posterior
from slipwise.evidence.prior import OF_MODEL
from slipwise.jobs.parallel import on_every_core
from slipwise.selection.inclusion import compute_inclusions, make_evidence
from slipwise.selection.proposals import LIKELY, compute_chances_of_large
from slipwise.selection.twins import compute_posterior_of_twin, make_twin
from slipwise.selection.weighed_model import DRAWS, WeighedModel
from slipwise.short_repr import short_repr

#: Twins of each effect.
TWINS = 16
#: Effects of a twin of which it is decided whether they are named: more are never likely.
_MOST = 12
#: No likelihood leads by more [standard errors].
_SUREST = 30.0


@short_repr
@dataclass(frozen=True)
class EffectPower:
    """What would be said of an effect at the limit of what matters.

    Attributes:
        effect: its name.
        twins: how many campaigns were looked at.
        seen: in how many it is named, or listed as there.
        named: in how many it is the first that is named.
        taken_for: another effect -> in how many of the rest it is named in its place.
    """

    effect: str
    twins: int
    seen: int
    named: int
    taken_for: Mapping[str, int]

    def as_json(self) -> dict[str, Any]:
        """Return the effect's entry of diagnosis.json."""
        return {"twins": self.twins, "seen": self.seen, "named": self.named, "taken_for": dict(self.taken_for)}


def compute_power(weighed: WeighedModel, twins: int = TWINS) -> dict[str, EffectPower]:
    """Return effect -> what would be said of it, for every candidate that the model has not.

    Args:
        weighed: of the campaign; effects that have planted columns are put in by these.
        twins: of each effect, `DRAWS` at most.
    """
    present = {c.effect for c in weighed.columns if c.form == OF_MODEL}
    members: dict[str, list[int]] = {}
    for place, c in enumerate(weighed.columns):
        if c.effect not in present and c.form != OF_MODEL:
            members.setdefault(c.effect, []).append(place)
    for name, places in members.items():
        members[name] = [k for k in places if k < weighed.planted] or places
    asked = [(name, k) for name in members for k in range(min(twins, DRAWS))]
    shown = _compute_shown(weighed)

    def ask(k: int) -> tuple[str, ...]:
        name, number = asked[k]
        places = members[name]
        place = places[number * len(places) // min(twins, DRAWS) if len(places) > twins else number % len(places)]
        sign = -1.0 if weighed.columns[place].two_sided and number % 2 else 1.0
        posterior = compute_posterior_of_twin(weighed, make_twin(weighed, place, sign, number))
        return decide_what_is_said(weighed, posterior, shown, present)

    answers: dict[str, list[tuple[str, ...]]] = {}
    for (name, _), said in zip(asked, on_every_core(ask, len(asked)), strict=True):
        answers.setdefault(name, []).append(said)
    return {name: _count(name, said) for name, said in answers.items()}


def _count(name: str, said: Sequence[tuple[str, ...]]) -> EffectPower:
    others = Counter(names[0] for names in said if names and name not in names)
    seen, first = sum(name in names for names in said), sum(names[:1] == (name,) for names in said)
    return EffectPower(name, len(said), seen, first, dict(others.most_common()))


def decide_what_is_said(
    weighed: WeighedModel, posterior: Posterior, shown: Array, present: set[str]
) -> tuple[str, ...]:
    """Return the effects that would be named or listed beside those of the model, the one that matters most first.

    Args:
        weighed: of the campaign.
        posterior: of its twin.
        shown: (K,) what the base fit leaves of one limit of each column, all samples together [noise variance].
        present: effects of the model, of which nothing is asked.
    """
    inclusions = compute_inclusions(posterior, {})
    likely: dict[str, float] = {}
    for effect, chance in zip(posterior.effects, compute_chances_of_large(posterior), strict=True):
        likely[effect] = max(likely.get(effect, 0.0), float(chance))
    strongest: dict[str, float] = {}
    for c, square in zip(weighed.columns, shown, strict=True):
        strongest[c.effect] = max(strongest.get(c.effect, 0.0), float(square))
    gauges = {c.effect for c in weighed.columns if c.gauge}
    chances, out = load_calibration(), list[tuple[bool, float, str]]()
    for name in sorted(likely, key=lambda e: -likely[e])[:_MOST]:
        if name in present or likely[name] < LIKELY:
            continue
        of = inclusions[name]
        errors = of.size * strongest[name] ** 0.5  # of noise, that tell it from none
        # the likelihood of its samples leads by half of that, in standard errors of its own
        evidence = make_evidence(of, lead=min(0.5 * errors, _SUREST), gauge=name in gauges)
        named = compute_chance_to_matter(evidence, chances) >= EVEN_ODDS
        if named or chances.present(evidence) >= LISTED:
            out.append((named, of.size, name))
    return tuple(name for _, _, name in sorted(out, reverse=True))


def _compute_shown(weighed: WeighedModel) -> Array:
    """Return what the base fit leaves of one limit of each column, all samples together (K,) [noise variance]."""
    squares = np.einsum("rii,r->i", weighed.left_by_base, np.maximum(weighed.statistics.samples, 1.0))
    return np.maximum(squares, 0.0)
