"""What an effect means for the bridge: distributions with and without it, as an object, JSON and a sentence."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.display import Drawn, Tabular
from slipwise.rig.similarity import similarity
from slipwise.short_repr import short_repr
from slipwise.studies.ensemble.distributions import Varied
from slipwise.studies.ensemble.responses import Response

#: Quantiles that are reported, and the one of the sentence [1].
QUANTILES, OF_THE_SENTENCE = (0.5, 0.9), 0.9
#: Resamples of the motions from which the interval of a change is taken, and its ends [1].
_RESAMPLES, _ENDS = 1000, (0.025, 0.975)
#: A change below this share is none in the sentence [1].
_NO_CHANGE = 0.005
SCHEMA = 1


@short_repr
@dataclass(frozen=True)
class Distribution:
    """One response over all earthquakes.

    Attributes:
        response: which.
        without: (n,) in the model without what was named [SI]; each at the same motion and draw as its neighbour.
        with_named: (n,) in the model with it.
        to_bridge: bridge over model [1].
    """

    response: Response
    without: Array
    with_named: Array
    to_bridge: float

    def quantiles(self, share: float) -> tuple[float, float]:
        """Return a quantile without and with, at the model [SI]."""
        return float(np.quantile(self.without, share)), float(np.quantile(self.with_named, share))

    def change(self, share: float) -> tuple[float, float, float]:
        """Return the change of a quantile by what was named [1], and the ends of its 95 % interval.

        The interval is that of drawing the earthquakes again, both models with the same.
        """
        low, high = self.quantiles(share)
        if not low > 0.0:
            return float("nan"), float("nan"), float("nan")
        generator = np.random.default_rng(0)
        chosen = generator.integers(0, len(self.without), (_RESAMPLES, len(self.without)))
        before, after = (np.quantile(values[chosen], share, axis=1) for values in (self.without, self.with_named))
        ratio = after[before > 0.0] / before[before > 0.0] - 1.0
        ends = np.quantile(ratio, _ENDS)
        return high / low - 1.0, float(ends[0]), float(ends[1])


@dataclass(frozen=True, repr=False)
class Consequence(Drawn, Tabular):
    """The answer.

    Attributes:
        rig: its name.
        named: labels of the effects that one model has and the other has not.
        length_scale: bridge over model [1].
        earthquakes: number of motions.
        draws: of the sizes at each motion.
        drawn: sizes that were drawn.
        distributions: of every response.
        failed: replays that diverged; their motion is in no distribution.
        path: of members.parquet.
        notes: what was left out, which intervals are missing, what similarity does not hold for.
        run: replays that were run now; the others had been finished before.
        seconds: that they took.
    """

    rig: str
    named: tuple[str, ...]
    length_scale: float
    earthquakes: int
    draws: int
    drawn: tuple[Varied, ...]
    distributions: tuple[Distribution, ...]
    failed: int
    path: Path
    notes: tuple[str, ...]
    run: int
    seconds: float

    @property
    def scaled(self) -> bool:
        """Whether the model stands for a larger bridge."""
        return self.length_scale != 1.0

    @property
    def what(self) -> str:
        """What the numbers of the sentence are of: the bridge, or the rig where it stands for itself."""
        return "the bridge" if self.scaled else f"the rig {self.rig}"

    @property
    def sentence(self) -> str:
        """What the named effects do to the peak slip, in one sentence."""
        first, names = self.distributions[0], " and ".join(self.named)
        before, after = (1e3 * first.to_bridge * value for value in first.quantiles(OF_THE_SENTENCE))
        share = f"the {100 * OF_THE_SENTENCE:.0f} % peak slip of {self.what}"
        plural = len(self.named) > 1
        if abs(after - before) < _NO_CHANGE * before:
            return f"{names} {'leave' if plural else 'leaves'} {share} at {_short(before)} mm."
        verb = "raise" if after > before else "lower"
        return f"{names} {verb if plural else verb + 's'} {share} from {_short(before)} to {_short(after)} mm."

    def as_json(self) -> dict[str, Any]:
        """Return the content of consequence.json."""
        return {
            "schema": SCHEMA,
            "words": self.sentence,
            "rig": self.rig,
            "named": list(self.named),
            "length_scale": self.length_scale,
            "earthquakes": self.earthquakes,
            "draws": self.draws,
            "drawn": [
                {"key": v.key, "value": v.value, "low": v.low, "high": v.high, "unit": v.unit} for v in self.drawn
            ],
            "responses": [self._response(d) for d in self.distributions],
            "failed": self.failed,
            "notes": list(self.notes),
            "run": self.run,
            "seconds": round(self.seconds, 1),
        }

    def _response(self, found: Distribution) -> Mapping[str, Any]:
        value, low, high = (x if np.isfinite(x) else None for x in found.change(OF_THE_SENTENCE))
        return {
            "response": found.response.name,
            "unit": found.response.unit,
            "bridge_over_model": found.to_bridge,
            "quantiles": {
                f"{100 * q:.0f} %": dict(zip(("without", "with"), found.quantiles(q), strict=True)) for q in QUANTILES
            },
            "change": {"value": value, "low": low, "high": high},
        }

    def _headline(self) -> str:
        return self.sentence

    def _rows(self) -> list[dict[str, Any]]:
        rows = []
        for d in self.distributions:
            for q in QUANTILES:
                before, after = d.quantiles(q)
                rows.append({"response": d.response.name, "quantile": q, "without": before, "with": after})
        return rows


def to_bridge(response: Response, length_scale: float) -> float:
    """Return the bridge's value over the model's [1], by the unit of the response."""
    scales = similarity(length_scale)
    return {"m": scales.length, "N": scales.force, "J": scales.energy, "s": scales.time}.get(response.unit, 1.0)


def _short(value: float) -> str:
    return f"{value:.0f}" if value >= 99.5 else f"{value:.3g}"
