"""Patterns: the mean residual over each state of motion, in both directions of sliding, and how much that explains.

Noise has no pattern and a missing force has one: the mean over a bin keeps what the law lacks there. Odd in the
direction of sliding is friction that is larger or smaller than the law says; even is a force that always points one
way.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.comparison.cells import Samples, choose_edges
from slipwise.comparison.mean_residual import compute_mean_residual
from slipwise.short_repr import short_repr

#: What a mean residual is drawn and sorted over.
KINDS: tuple[str, ...] = ("since reversal", "speed", "pressure", "position", "path", "time")
#: Fewer independent samples than this say nothing of a bin.
_FEWEST = 4.0
#: Both directions are unequal from this ratio, and beyond this many standard errors [1].
_EQUAL, _SURE = 1.2, 2.0


@short_repr
@dataclass(frozen=True)
class Pattern:
    """Mean residual of one relation over the bins of one state.

    Attributes:
        relation: which.
        kind: the state.
        edges: (b + 1,) of the bins [SI].
        plus: (b,) mean residual sliding to +x [floors]; NaN where there is too little.
        minus: (b,) sliding to -x.
        plus_error: (b,) standard error.
        minus_error: (b,) standard error.
        samples: (b,) in both directions.
        explained: part of the squared residual that the means explain, what noise would explain taken off [1].
        few: (2, b) mean residual sliding to +x and to -x of bins with samples, but too few that are independent for an
            error of it [floors]; NaN elsewhere.
    """

    relation: str
    kind: str
    edges: Array
    plus: Array
    minus: Array
    plus_error: Array
    minus_error: Array
    samples: Array
    explained: float
    few: Array

    @property
    def odd(self) -> Array:
        """Measured less predicted friction against the motion (b,), by which the law is too small [floors]."""
        return 0.5 * (self.plus - self.minus)

    @property
    def even(self) -> Array:
        """Force that points to +x in both directions (b,) [floors]."""
        return 0.5 * (self.plus + self.minus)

    def strongest(self) -> tuple[slice, bool]:
        """Return the neighbouring bins that carry most of the pattern with one sign, and whether it is odd."""
        odd, even = (np.nan_to_num(v) for v in (self.odd, self.even))
        is_odd = bool(np.sum(self.samples * odd**2) >= np.sum(self.samples * even**2))
        part = odd if is_odd else even
        peak = int(np.argmax(self.samples * part**2))
        first = last = peak
        while first > 0 and part[first - 1] * np.sign(part[peak]) > 0.3 * abs(part[peak]):
            first -= 1
        while last < len(part) - 1 and part[last + 1] * np.sign(part[peak]) > 0.3 * abs(part[peak]):
            last += 1
        return slice(first, last + 1), is_odd

    def directions(self, where: slice) -> str:
        """Say whether some bins show the same in both directions."""
        weight = np.where(np.isfinite(self.plus + self.minus), self.samples, 0.0)[where]
        if weight.sum() == 0.0:
            return ""
        sizes = [abs(float(np.nansum(weight * v[where]) / weight.sum())) for v in (self.plus, self.minus)]
        errors = [
            float(np.sqrt(np.nansum((weight * e[where]) ** 2)) / weight.sum())
            for e in (self.plus_error, self.minus_error)
        ]
        pairs = ((sizes[0], sizes[1], errors[1], "+x"), (sizes[1], sizes[0], errors[0], "−x"))
        for size, other, error, name in pairs:
            if other < 0.2 * size and size > 1.0 and other < 2.0 * error:
                return f"only sliding to {name}"
        apart = abs(sizes[0] - sizes[1]) > _SURE * float(np.hypot(errors[0], errors[1]))
        unequal = apart and max(sizes) > _EQUAL * min(sizes)
        return "both directions, unequal" if unequal else "both directions, equal"


def find_patterns(samples: Samples) -> list[Pattern]:
    """Return the patterns of a relation over every state that it has."""
    total = float(samples.squared.sum())
    out = []
    for kind in KINDS:
        values = samples.values.get(kind)
        if values is None or not np.isfinite(values).any():
            continue
        edges = choose_edges(kind, values[np.isfinite(values)])
        if len(edges) < 3:
            continue
        plus, minus = (compute_mean_residual(samples, [kind], [edges], way, _FEWEST) for way in (1.0, -1.0))
        kept = sum(float(np.nansum(side.count * (side.mean**2 - side.error**2))) for side in (plus, minus))
        out.append(
            Pattern(
                samples.relation, kind, edges, plus.mean, minus.mean, plus.error, minus.error,
                (plus.count + minus.count).astype(float), max(kept / total, 0.0), np.stack([plus.few, minus.few]),
            )
        )  # fmt: skip
    return out
