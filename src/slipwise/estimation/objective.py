"""One stacked fit: pads, girder, heave, pitch, roll, warps, motion and friction across with one set of numbers.

Residuals are (measured - predicted) / noise in measured units: a fault of a gauge is put on the prediction, or its
inverse on the measurement with the noise scaled alike. Else a gain below one would shrink the noise and look good.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from slipwise.campaign.scales import Scales
from slipwise.model import Model
from slipwise.relations.girder_across import GIRDER_ACROSS
from slipwise.relations.girder_stages import BALANCES_LEFT
from slipwise.relations.kinematics import is_pitching_table
from slipwise.relations.measurement import is_shifting
from slipwise.relations.pad_stages import ACROSS, PADS, is_reversing
from slipwise.relations.parameters import PITCH_INERTIA, YAW_INERTIA, Term, build_fitted_model
from slipwise.relations.run_data import FINER, FitRun
from slipwise.relations.setting import Measurements, Weighing
from slipwise.relations.stages import Evaluation, Memo, make_memo
from slipwise.relations.table import Block, Residuals
from slipwise.relations.weighing import weigh
from slipwise.rig import Specimen
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True, eq=False)
class Objective:
    """A campaign's runs held against a base model with further terms.

    Attributes:
        measurements: the runs.
        terms: effects of the base model, then those of the hypothesis.
        memo: what the stages of evaluations have made; objectives of the same runs share it.
        weighing: noise of every relation.
        yaw: whether the girder's yaw is made from the measured forces even if no term asks for it.
        around: values from which slopes are taken, where faults move noise in time; see `measurement.without`.
        watch: called before every evaluation, if given; what it raises ends a fit.
    """

    measurements: Measurements
    terms: tuple[Term, ...]
    memo: Memo
    weighing: Weighing = Weighing()
    yaw: bool = False
    around: Mapping[str, float] | None = None
    watch: Callable[[], None] | None = None

    @property
    def runs(self) -> tuple[FitRun, ...]:
        """Every run, in the order in which they were made."""
        return self.measurements.runs

    @property
    def specimen(self) -> Specimen:
        """Rated values."""
        return self.measurements.specimen

    @property
    def relations(self) -> tuple[str, ...]:
        """Names of the relations, in the order in which their residuals are stacked."""
        return self.measurements.relations

    @property
    def balanced(self) -> bool:
        """Whether the balances of a girder are there."""
        return self.measurements.balanced

    @property
    def forces_measured(self) -> bool:
        """Whether the pads' friction was measured; else what all of them carry together follows from inertia."""
        return self.measurements.forces_measured

    @property
    def loads_measured(self) -> bool:
        """Whether the pads' loads were measured; else they follow from weight and inertia."""
        return self.measurements.loads_measured

    @property
    def fitted(self) -> list[int]:
        """Places of the runs that may be fitted."""
        return self.measurements.fitted

    @property
    def held_out(self) -> list[int]:
        """Places of the runs that are never fitted."""
        return self.measurements.held_out

    @property
    def motions(self) -> list[list[int]]:
        """Places of the runs that may be fitted, by motion."""
        return self.measurements.motions

    @property
    def scales(self) -> Scales:
        """Scales of the campaign."""
        return self.runs[0].scales

    @property
    def pads(self) -> tuple[str, ...]:
        """Pads of which both friction and load were measured."""
        return self.runs[0].pads

    @property
    def fitted_runs(self) -> tuple[FitRun, ...]:
        """The runs that may be fitted."""
        return tuple(self.runs[i] for i in self.fitted)

    @property
    def run_names(self) -> list[str]:
        """Names of the runs by their places."""
        return [run.name for run in self.runs]

    def runs_before(self, place: int) -> tuple[FitRun, ...]:
        """Return the runs before a place: what pads and buffers remember there is of these."""
        return self.runs[:place]

    def run(self, place: int) -> FitRun:
        """Return the run at a place, as measured."""
        return self.runs[place]

    @property
    def makes_yaw(self) -> bool:
        """Whether the girder's yaw is made from the measured forces."""
        return (self.yaw or any(t.effect.turns for t in self.terms)) and self.measurements.yaw_is_computable

    @property
    def inertias(self) -> tuple[str, ...]:
        """Keys of the inertias of the girder that the terms speak of."""
        rocks = self.loads_measured and any(is_pitching_table(term) for term in self.terms)
        return (YAW_INERTIA,) * self.makes_yaw + (PITCH_INERTIA,) * rocks

    @property
    def has_stick(self) -> bool:
        """Whether an effect says over which slip friction turns round."""
        return any(is_reversing(term) for term in self.terms)

    def adding(self, *terms: Term) -> "Objective":
        """Return the same objective with more terms; the noise stays."""
        return self.having((*self.terms, *terms))

    def having(self, terms: tuple[Term, ...]) -> "Objective":
        """Return the same objective with other terms; the noise stays."""
        return replace(self, terms=terms)

    def with_yaw(self) -> "Objective":
        """Return the same objective with the girder's yaw made from the measured forces, whatever the terms."""
        return replace(self, yaw=True)

    def with_held_out(self, place: int) -> "Objective":
        """Return the same objective with one more run that is never fitted; the noise stays."""
        return replace(self, measurements=self.measurements.with_held_out(place))

    def near(self, values: Mapping[str, float]) -> "Objective":
        """Return the objective of which slopes at these values are to be taken."""
        return replace(self, around=values) if is_shifting(self.terms) else self

    def weigh(self, values: Mapping[str, float], *, finer: bool = False) -> "Objective":
        """Return the same objective with the noise, and what the filter took at reversals, as these numbers alone say.

        Args:
            values: key -> value of everything.
            finer: evaluate the laws at twice the instants from now on.
        """
        begun = replace(self, measurements=self.measurements.refined(FINER)) if finer else self
        return replace(begun, weighing=weigh(begun.evaluation(values)))

    def model(self, values: Mapping[str, float]) -> Model:
        """Return the model that these numbers describe."""
        return build_fitted_model(self.specimen, self.terms, values)

    def evaluation(self, values: Mapping[str, float], count: int | None = None) -> Evaluation:
        """Return an evaluation with these numbers, of which stages can be asked.

        Args:
            values: key -> value, of every term's parameters and the rig's numbers.
            count: of runs from the first on; all, if not given.
        """
        count = len(self.runs) if count is None else count
        return Evaluation(
            self.measurements, self.weighing, self.terms, values, count, self.makes_yaw, self.around, self.memo
        )

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        """Evaluate every relation.

        Args:
            values: key -> value, of every term's parameters and the rig's numbers.
            fitted_only: leave out the runs after the last one that may be fitted; their blocks are missing then.
        """
        if self.watch is not None:
            self.watch()
        evaluation = self.evaluation(values, max(self.fitted) + 1 if fitted_only else None)
        pads = evaluation.of(PADS)
        left = {"pads": pads.left} if "pads" in self.relations else {}
        if "across" in self.relations:
            left["across"] = evaluation.of(ACROSS)
        if "girder_y" in self.relations:
            left["girder_y"] = evaluation.of(GIRDER_ACROSS)
        if self.balanced:
            left |= evaluation.of(BALANCES_LEFT)
        return self.layout.filled(left, pads.predicted)

    @cached_property
    def layout(self) -> Residuals:
        """Table of all runs before it is evaluated: times, masks, noise, and rows; every residual is zero."""
        return Residuals(tuple(self._block(name, place) for name in self.relations for place in range(len(self.runs))))

    def _block(self, relation: str, place: int) -> Block:
        run, sigmas = self.runs[place], self.weighing.sigmas
        mask, motion = run.judged[relation], self.measurements.motion_of[place]
        sigma = sigmas[relation][place] if relation in sigmas else np.ones(())
        nothing = np.broadcast_to(0.0, mask.shape)
        return Block(relation, place, run.name, motion, run.role, run.time, run.dt, nothing, sigma, mask)


def make_objective(
    runs: Iterable[FitRun],
    specimen: Specimen,
    terms: tuple[Term, ...],
    *,
    watch: Callable[[], None] | None = None,
) -> Objective:
    """Return the objective of a model on some runs, before its noise is known.

    Args:
        runs: in the order in which they were made.
        specimen: rated values.
        terms: effects of the model.
        watch: called before every evaluation; what it raises ends a fit.
    """
    measurements = Measurements(tuple(runs), specimen)
    return Objective(measurements, terms, make_memo(measurements), watch=watch)
