"""From a campaign to a finished selection: samples corrected, base fitted, and both done anew where need be."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from inspect import signature

from slipwise.campaign import Campaign, Logger
from slipwise.diagnosis.forward_selection import completed, first_effects, search
from slipwise.diagnosis.hypothesis import Hypothesis, base_hypothesis
from slipwise.diagnosis.search_state import Search
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit, fit_base, restarted
from slipwise.estimation.logger_filter import estimated_logger
from slipwise.estimation.measurement_model import shifts
from slipwise.estimation.parameters import Term
from slipwise.evidence.materiality import MATERIAL
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.instruments.repairs import InvalidSamples, for_fits
from slipwise.instruments.sample_faults import RAILS, SampleFault, sample_faults
from slipwise.model import Model

#: Faults of samples that a gauge has; a gap is the clock's.
_OF_GAUGES = ("turned", *RAILS, "held", "lost")


@dataclass(frozen=True)
class SelectionResult:
    """A campaign that was searched.

    Attributes:
        base: the base fit.
        search: what was looked at.
        faults: of samples, which were turned back, bridged or left out before.
        uncorrected: residuals of the base fit of the campaign as it was recorded.
    """

    base: BaseFit
    search: Search
    faults: tuple[SampleFault, ...]
    uncorrected: ResidualSummary


def prepared(campaign: Campaign) -> tuple[Campaign, InvalidSamples, tuple[SampleFault, ...]]:
    """Give a campaign with wrong signs turned back, the samples that must not be judged, and the faults found."""
    faults = tuple(fault for fault in sample_faults(campaign) if fault.kind in _OF_GAUGES)
    return (*for_fits(campaign, faults), faults) if faults else (campaign, {}, ())


def select_effects(
    campaign: Campaign,
    model: Model | None = None,
    own: Iterable[Effect] = (),
    progress: Callable[[str, float], None] | None = None,
) -> SelectionResult:
    """Search what a model lacks.

    Args:
        campaign: the runs.
        model: where to start; the paper's law on the campaign's rig when not given.
        own: effects beside those of the catalogue.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the campaign lacks what every fit needs.
    """
    own = tuple(own)
    whole, invalid, faults = prepared(campaign)
    base = fit_base(whole, model, invalid)
    state = first_effects(base, own, progress)
    estimated = _logger_estimated_again(whole, base, state.best)
    if estimated is not None:
        base = fit_base(estimated, model, invalid)
        state = first_effects(base, own, progress)
    state = completed(state, progress)
    # what an effect seems to explain may be a valley that the base fit has missed
    better = restarted(base, state.best.solution.values) if state.best.terms else None
    if better is not None:
        base = better
        state = search(base, own, progress, state)
    uncorrected = base_hypothesis(fit_base(campaign, model)).summary if faults else state.path[0].summary
    return SelectionResult(base, state, faults, uncorrected)


def _logger_estimated_again(campaign: Campaign, base: BaseFit, found: Hypothesis) -> Campaign | None:
    """Give the campaign with its logger's filter as it sounds beside what was found; None where that is no other.

    A filter that nobody knew was read from reversals by a law that lacked an effect, and has bent itself to it, if that
    effect speaks there.
    """
    if campaign.logger.known or not base.model.specimen.free or not found.terms:
        return None  # of one slider no filter is told from a law, see `fit_base`
    turned = found.problem.kinematics.turns != base.problem.kinematics.turns
    if not turned and not any(_speaks_at_reversals(t) for t in found.terms):
        return None
    if found.summary.level("pads", held_out=False) < 1.0 + MATERIAL:
        return None
    before = base.campaign.logger.every
    now = estimated_logger(campaign, base.model, found.solution, found.terms, before)
    return None if now == before else replace(campaign, logger=Logger(now, known=True))


def _speaks_at_reversals(term: Term) -> bool:
    """Tell whether an effect shapes how friction turns round: by speed, by a bristle, or by a gauge's lag."""
    if term.effect.port == "stick":
        return True
    if term.effect.port == "gauge":
        return shifts([term]) or any(p.unit == "s" for p in term.effect.parameters)
    laws = [term.effect.hooks[h] for h in ("shear", "pad") if h in term.effect.hooks]
    return any({"speed", "velocity_x"} & set(signature(law).parameters) for law in laws)
