"""From a few numbers for every effect to what is said: the part of a verdict that was calibrated.

complete    nothing that matters was found, and nothing that matters is left
unknown     what is left matters, and nothing that was found is believed
ambiguous   another effect is as likely in the place of one that is named
named       effects that matter; `instrument` where all of them are faults of gauges; beside them something may be left
            that the catalogue does not have
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import expit

from slipwise.evidence.calibration import Calibration

#: What is more likely than this to be there and to matter is named, and so is a rival [1].
EVEN_ODDS = 0.5
#: What does not matter is listed where it is likelier than this to be there: nobody asked for it [1].
LISTED = 0.9


@dataclass(frozen=True)
class Decision:
    """What the evidence says.

    Attributes:
        kind: complete, named, ambiguous, unknown or instrument.
        named: effects that matter, most important first.
        minor: effects that are there and do not matter.
        tied: those of the named whose nearest rival is as likely.
        unknown_beside: whether beside what is named something matters that has no name.
        probability: that kind and names are right.
    """

    kind: str
    named: tuple[str, ...]
    minor: tuple[str, ...]
    tied: tuple[str, ...]
    unknown_beside: bool
    probability: float


def is_left(rest: Mapping[str, float], least: float) -> bool:
    """Return whether what is left matters: as a share of the balance, or of what a law leaves that does.

    A law is a function of some state of motion: what no state organises is held against the balance only.

    Arguments as of `decide`.
    """
    of_a_law = np.exp(rest.get("limit", 0.0)) if rest["left"] > 0.0 else least
    return bool(np.exp(rest["relative"]) >= min(least, of_a_law))


def compute_chance_to_matter(of: Mapping[str, float], chances: Calibration) -> float:
    """Return the chance that an effect is there and matters: from `EVEN_ODDS` on it is named [1].

    Args:
        of: its evidence, as of `decide`.
        chances: the calibration.
    """
    return chances.matters(of) * float(expit(of["inclusion"]))


def decide(
    effects: Mapping[str, Mapping[str, float]], rest: Mapping[str, float], least: float, chances: Calibration
) -> Decision:
    """Decide what is missing.

    Args:
        effects: name -> its evidence, most important first: "lead" and so on as the calibration asks, "inclusion"
            (log-odds of the posterior that it matters), "gauge" (1 for a fault of gauges) and "rival" (standard errors
            by which the nearest rival is behind).
        rest: evidence on what is left: "relative" (logarithm of its share of what a balance is made of), "limit"
            (logarithm of the share that a law of one limit leaves there as a rule; 0 where that is not known), "left"
            (share of it that has structure: then an effect may only stand for another law), "floors" (logarithm of the
            error [noise floors]) and so on.
        least: share of a balance that matters [1].
        chances: the calibration.
    """
    effects = {name: {**of, "left": rest["left"]} for name, of in effects.items()}
    sure = {name: chances.present(of) for name, of in effects.items()}
    both = {name: compute_chance_to_matter(of, chances) for name, of in effects.items()}
    named = tuple(name for name in effects if both[name] >= EVEN_ODDS)
    minor = tuple(name for name in effects if sure[name] >= LISTED and name not in named)
    left = is_left(rest, least)
    exact = chances.family(rest) if left else 1.0
    if left and not named:
        return Decision("unknown", (), minor, (), False, 1.0 - exact)
    right = max(exact, 1.0 - exact)
    for name in effects:  # what is not named would be wrong only if it were there and mattered
        right *= both[name] if name in named else 1.0 - both[name]
    probability = chances.whole(right, rest["floors"] if named else 0.0)
    if not named:
        return Decision("complete", (), minor, (), False, probability)
    tied = tuple(name for name in named if chances.leads(effects[name]["rival"]) < EVEN_ODDS)
    kind = "instrument" if all(effects[name]["gauge"] for name in named) else "named"
    return Decision("ambiguous" if tied else kind, named, minor, tied, left and exact < EVEN_ODDS, probability)
