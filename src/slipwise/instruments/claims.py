"""What a posterior claims of each fault: its size, its probability, what would stand in its place, and doubts."""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Mask
from slipwise.instruments.fault_posterior import FaultPosterior, plain_form
from slipwise.instruments.sentences import as_sentence
from slipwise.instruments.suspects import Suspect

#: Doubt about a fault that is there.
SMALL = "small"
#: Likelier than this, it is named; likelier than that to be more than a trifle, it is mentioned.
_NAMED, _MENTIONED = 0.5, 0.2
#: A balance that may accuse shows a fault that is named by so much [floors].
_CONFIRMED = 0.2
#: A rival stands in the place of a fault in more than this share of the samples.
_RIVALS = 0.02


@dataclass(frozen=True)
class Claim:
    """What is claimed of one fault.

    Attributes:
        suspect: which, in its likeliest form.
        size: fitted [SI].
        low: lower end of its 95 % interval.
        high: upper end.
        probability: that it is there, and as large as matters.
        rivals: what stands in its place where it is absent, most frequent first.
        doubt: why it is not named, in words, or "".
    """

    suspect: Suspect
    size: float
    low: float
    high: float
    probability: float
    rivals: tuple[str, ...]
    doubt: str

    @property
    def note(self) -> str:
        """What is said of a fault that is not named."""
        words = as_sentence(self.suspect, self.size)
        small = self.doubt == SMALL
        return f"{words}: too little to matter" if small else f"{words} would explain something, but {self.doubt}"


def list_claims(found: FaultPosterior) -> list[Claim]:
    """Return what is claimed of every fault that is likely to be more than a trifle."""
    there = found.posterior.forms != -1
    gauges = {c.label for c in found.linear.columns if c.gauge}
    likely = [t for t in np.argsort(-there.mean(axis=0)) if there[:, t].mean() > _MENTIONED]
    return [_claim(found, int(t), there) for t in likely if found.posterior.labels[t] in gauges]


def list_physics(found: FaultPosterior) -> list[str]:
    """Return the names of disturbances that are likelier there than not."""
    chance = np.mean(found.posterior.forms != -1, axis=0)
    physics = {c.label: c.effect for c in found.linear.columns if not c.gauge}
    named = [physics[n] for n, p in zip(found.posterior.labels, chance, strict=True) if p > _NAMED and n in physics]
    return list(dict.fromkeys(named))


def _claim(found: FaultPosterior, term: int, there: Mask) -> Claim:
    posterior, columns = found.posterior, found.linear.columns
    form = plain_form(found.linear, posterior, term)
    label = posterior.labels[term]
    column = found.linear.list_places(label, form)[0]
    suspect = columns[column].suspect
    assert suspect is not None
    drawn = posterior.strengths[posterior.forms[:, term] == form, column] * suspect.least
    fitted = found.last.sizes.get(column)
    size = float(drawn.mean()) if fitted is None else fitted * suspect.least
    low, high = size + np.quantile(drawn, (0.025, 0.975)) - drawn.mean()
    large = posterior.sizes[:, term] > 1.0
    shown = found.shown[:, term] > _CONFIRMED
    probability = float(np.mean(large & shown))
    rivals = _rivals(found, term, there)
    doubt = ""
    if probability <= _NAMED:
        at = there[:, term]
        if np.mean(large[at]) <= _NAMED:
            doubt = SMALL
        elif np.mean(shown[at]) <= _NAMED:
            doubt = "the balances that may accuse are too noisy to confirm it: only pads that differ show it"
        else:
            doubt = f"so would {' or '.join(rivals)}" if rivals else "as likely nothing matters"
    return Claim(suspect, size, float(low), float(high), probability, rivals, doubt)


def _rivals(found: FaultPosterior, term: int, there: Mask) -> tuple[str, ...]:
    at = there[:, term]
    if at.all():
        return ()
    instead = (there[~at].mean(axis=0) - there[at].mean(axis=0)) * np.mean(~at)
    names = []
    for t in np.argsort(-instead):
        if t != term and instead[t] > _RIVALS:
            form = plain_form(found.linear, found.posterior, int(t))
            c = found.linear.columns[found.linear.list_places(found.posterior.labels[t], form)[0]]
            names.append(c.effect if c.suspect is None else f"{c.suspect.effect.name} {c.suspect.label}")
    return tuple(dict.fromkeys(names))
