"""How sure evidence makes: small logistic models in a few numbers, kept as data.

`calibration.json` holds the coefficients, and says where they come from.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np
from scipy.special import expit

#: No chance is smaller or larger [1].
_SUREST = (0.01, 0.99)


@dataclass(frozen=True)
class Logistic:
    """A probability that is logistic in a few numbers.

    Attributes:
        constant: log-odds where every number is zero.
        weights: number -> log-odds per unit of it.
    """

    constant: float
    weights: Mapping[str, float]

    def __call__(self, evidence: Mapping[str, float]) -> float:
        """Return the probability; numbers that the model does not use are passed over."""
        odds = self.constant + sum(weight * evidence[name] for name, weight in self.weights.items())
        return float(np.clip(expit(odds), *_SUREST))


@dataclass(frozen=True)
class Calibration:
    """The logistic models of a verdict.

    Attributes:
        present: of an effect that was found: that it is there.
        matters: of an effect that was found: that it is there with the size that the posterior says.
        right_family: of effects that leave something with structure: that they are of the right family all the same.
        leads_rival: of a hypothesis: that it and not its nearest rival is right, by how many standard errors it leads.
        all_right: of a verdict, by the product of these chances, which are not independent, and by what names leave:
            an error above the floor says that something is not as they say.
    """

    present: Logistic
    matters: Logistic
    right_family: Logistic
    leads_rival: Logistic
    all_right: Logistic

    def family(self, evidence: Mapping[str, float]) -> float:
        """Return the chance that effects which leave something with structure are of the right family."""
        return self.right_family(evidence)

    def leads(self, errors: float) -> float:
        """Return the chance that a hypothesis is right and not its nearest rival."""
        return self.leads_rival({"lead": errors})

    def whole(self, product: float, floors: float) -> float:
        """Return the chance that a verdict is right.

        Args:
            product: of the chances of its parts.
            floors: logarithm of the error that the named effects leave [noise floors]; 0 where nothing is named.
        """
        return self.all_right({"product": compute_log_odds(float(np.clip(product, *_SUREST))), "floors": floors})


def compute_log_odds(probability: float) -> float:
    """Return the log-odds of a probability, finite also at 0 and 1."""
    kept = float(np.clip(probability, 1e-6, 1.0 - 1e-6))
    return float(np.log(kept / (1.0 - kept)))


@cache
def load_calibration() -> Calibration:
    """Return what the package was calibrated with."""
    content = json.loads(files("slipwise.evidence").joinpath("calibration.json").read_text(encoding="utf-8"))
    models = {name: Logistic(of["constant"], of["weights"]) for name, of in content["models"].items()}
    return Calibration(**models)
