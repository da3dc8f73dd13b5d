"""What a posterior says of each effect in a few numbers without a scale: the evidence on which a probability rests."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.evidence.calibration import compute_log_odds
from slipwise.evidence.posterior import Posterior

#: What matters and is seen: more than so many limits of materiality, and so many floors after a fit of the base [1].
MATTERS, SEEN = 0.85, 0.65
#: A posterior of some hundred draws says no more of an effect than these log-odds.
_SUREST_ODDS = 6.0


@dataclass(frozen=True)
class Inclusion:
    """An effect in a posterior, all its terms together.

    Attributes:
        matters: probability that it is of `MATTERS` limits and `SEEN` floors.
        present: probability that it is more than a trifle.
        size: mean where it is [limits].
        spread: standard deviation where it is, over that mean [1].
        seen: mean of what a fit of the base leaves of it where it is [floors].
        rival: probability that it is absent and another effect, more often than beside it, is there.
        stays: share of the size that it was fitted with which stays where every small imperfection may be there too.
    """

    matters: float
    present: float
    size: float
    spread: float
    seen: float
    rival: float
    stays: float

    @property
    def log_odds(self) -> float:
        """Log-odds that it matters, no surer than a posterior's draws can tell."""
        return float(np.clip(compute_log_odds(self.matters), -_SUREST_ODDS, _SUREST_ODDS))


#: Of an effect that no posterior knows.
ABSENT = Inclusion(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def make_evidence(
    of: Inclusion, *, lead: float, gauge: bool, share: float = 1.0, beside: float = 1.0, left: float = 0.0
) -> dict[str, float]:
    """Return the numbers on which the probability of an effect rests, as a calibration asks for them.

    Args:
        of: what a posterior says of it.
        lead: standard errors by which the likelihood leads that without it.
        gauge: whether it is a fault of gauges.
        share: of what the base leaves that it takes away [1].
        beside: what is left where it shows best [floors].
        left: share of what is left that has structure [1].
    """
    return {
        "lead": float(np.log(max(lead, 0.1))),
        "share": float(np.log(max(share, 1e-4))),
        "gauge": float(gauge),
        "stays": of.stays,
        "inclusion": of.log_odds,
        "spread": min(of.spread, 1.0),
        "seen": float(np.log(max(of.seen, 1e-2))),
        "limits": float(np.log(max(of.size, 1e-2))),
        "beside": float(np.log(beside)),
        "left": left,
    }


def compute_inclusions(posterior: Posterior, fitted: Mapping[str, float]) -> dict[str, Inclusion]:
    """Return effect -> what the posterior says of it.

    Args:
        posterior: about a model.
        fitted: effect of that model -> size as it was fitted [limits].
    """
    effects = list(dict.fromkeys(posterior.effects))
    members = {e: [t for t, name in enumerate(posterior.effects) if name == e] for e in effects}
    size = np.stack([posterior.sizes[:, members[e]].max(axis=1) for e in effects], axis=1)
    seen = np.stack([posterior.seen[:, members[e]].max(axis=1) for e in effects], axis=1)
    large = np.stack(
        [((posterior.sizes > MATTERS) & (posterior.seen > SEEN))[:, members[e]].any(axis=1) for e in effects], axis=1
    )
    there = size > 0.0
    out: dict[str, Inclusion] = {}
    for k, name in enumerate(effects):
        at = there[:, k]
        rival = 0.0
        if not at.all():
            beside = there[at].mean(axis=0) if at.any() else np.zeros(len(effects))
            more = there[~at].mean(axis=0) - beside
            more[k] = 0.0
            rival = float(max(more.max(), 0.0) * np.mean(~at))
        mean = float(size[at, k].mean()) if at.any() else 0.0
        out[name] = Inclusion(
            matters=float(large[:, k].mean()),
            present=float(at.mean()),
            size=mean,
            spread=float(size[at, k].std() / max(mean, 1e-12)) if at.any() else 0.0,
            seen=float(seen[at, k].mean()) if at.any() else 0.0,
            rival=rival,
            stays=float(np.clip(mean / fitted[name], 0.0, 1.0)) if fitted.get(name, 0.0) > 0.0 else 1.0,
        )
    return out
