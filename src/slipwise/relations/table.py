"""What a fit leaves of every relation."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.relations.girder import BALANCES

Array = NDArray[np.float64]
RELATIONS: tuple[str, ...] = ("pads", *BALANCES, "across")


@dataclass(frozen=True)
class Residuals:
    """Residuals of every relation, in units of the noise, per run.

    Attributes:
        parts: relation -> per run (n,), or (n, p) for pads; zero where masked.
        pad_forces: per run (n, p) predicted [N].
    """

    parts: dict[str, list[Array]]
    pad_forces: list[Array]

    def stacked(self, which: Sequence[int], relations: Sequence[str] = RELATIONS) -> Array:
        """Return all residuals of these runs in one vector."""
        return np.concatenate([self.parts[r][i].ravel() for r in relations if r in self.parts for i in which])
