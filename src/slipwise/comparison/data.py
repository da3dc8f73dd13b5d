"""What a comparison found, as data: what tables, pages and sentences are made of."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from slipwise.campaign import Campaign
from slipwise.comparison.cells import Cell
from slipwise.comparison.component_level import ComponentError, pool_errors
from slipwise.comparison.friction_surface import FrictionSurface
from slipwise.comparison.isolation_layer import IsolationLayer
from slipwise.comparison.odd_even import Parity
from slipwise.comparison.patterns import Pattern
from slipwise.comparison.sentences import ErrorPlace
from slipwise.comparison.system_level import SystemLevel, list_held_out_channels
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import Intervals
from slipwise.estimation.prediction_interval import PredictedFriction
from slipwise.instruments.checks import Checks
from slipwise.model import Model
from slipwise.noise.gauges import Gauge
from slipwise.preparation.data_corrections import DataCorrection


@dataclass(frozen=True, repr=False)
class ComparisonData:
    """A model held against a campaign.

    Attributes:
        campaign: that was measured.
        model: fitted on the runs that may be fitted.
        base: the fit, with residuals of all runs.
        corrections: what was done about the data before any fit.
        checks: of the instruments, before any fit.
        residuals: relation -> per run residual in floors, zero where masked.
        components: error of every relation in every run.
        repeats: relation -> what a repeated run says of its floor: 1 where the floor is right.
        system: the replays; None where there are none, see `cannot`.
        intervals: of the fitted numbers.
        surface: mu(P, V) with its band; None where no load is known.
        layer: what all bearings did together in every run, where the force of none was measured.
        predicted_friction: mean friction of every run, measured and predicted.
        cells: every part of the samples that was looked at.
        patterns: mean residual over every state of motion.
        parities: relation -> odd and even part.
        places: where the error is, in words, the worst first.
        cannot: what could not be done, and for lack of what.
        notes: what was assumed.
        seconds: that it took.
    """

    campaign: Campaign
    model: Model
    base: BaseFit
    corrections: tuple[DataCorrection, ...]
    checks: Checks
    residuals: Mapping[str, Sequence[Any]]
    components: tuple[ComponentError, ...]
    repeats: Mapping[str, float]
    system: SystemLevel | None
    intervals: Intervals
    surface: FrictionSurface | None
    layer: tuple[IsolationLayer, ...]
    predicted_friction: tuple[PredictedFriction, ...]
    cells: tuple[Cell, ...]
    patterns: tuple[Pattern, ...]
    parities: Mapping[str, Parity]
    places: tuple[ErrorPlace, ...]
    cannot: tuple[str, ...]
    notes: tuple[str, ...]
    seconds: float

    @property
    def gauges(self) -> Mapping[str, Gauge]:
        """Noise of every channel: what the floors of all balances are made of."""
        return self.base.campaign.gauges

    @property
    def relations(self) -> tuple[str, ...]:
        """Relations that the channels allow."""
        return tuple(self.residuals)

    def error(self, relation: str, *, held_out: bool) -> float | None:
        """Return the error of a relation over all fitted, or all held-out, runs [floors]; None without such runs.

        Args:
            relation: name of the balance.
            held_out: whether held-out runs are asked for, or fitted ones.
        """
        return pool_errors(self.components, relation, held_out=held_out)

    @property
    def worst(self) -> tuple[str, float]:
        """The relation that fails worst, and its error in the held-out runs (fitted ones where none is held out)."""
        found = {}
        for relation in self.relations:
            held = self.error(relation, held_out=True)
            found[relation] = self.error(relation, held_out=False) if held is None else held
        known = {r: e for r, e in found.items() if e is not None}
        return max(known.items(), key=lambda item: item[1])

    @property
    def system_errors(self) -> Mapping[str, float]:
        """Channel -> error at system level in the held-out runs [floors]; empty without a replay."""
        return list_held_out_channels(self.system) if self.system else {}
