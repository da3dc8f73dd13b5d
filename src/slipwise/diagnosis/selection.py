"""From a campaign to a finished selection: samples corrected, base fitted, effects searched."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from slipwise.campaign import Campaign
from slipwise.diagnosis.forward_selection import search
from slipwise.diagnosis.hypothesis import base_hypothesis, final_refit_of
from slipwise.diagnosis.search_state import Search
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit, fit_base, restarted
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.model import Model
from slipwise.preparation.decimation import decimated
from slipwise.preparation.excerpts import stretched
from slipwise.preparation.repairs import InvalidSamples, for_fits
from slipwise.preparation.rig_check import HELD_AGAINST, WrongRig, wrong_rig
from slipwise.preparation.sample_faults import RAILS, SampleFault, sample_faults
from slipwise.rig.known import better_known

#: Faults of samples that a gauge has; a gap is the clock's.
_OF_GAUGES = ("late", "turned", "scaled", "shifted", "wild", "dead", *RAILS, "held", "lost")


@dataclass(frozen=True)
class SelectionResult:
    """A campaign that was searched.

    Attributes:
        base: the base fit.
        search: what was looked at.
        faults: of samples, which were reversed, bridged or left out before.
        uncorrected: residuals of the base fit of the campaign as it was recorded, where samples had faults.
        uncut: the campaign with its samples corrected, before stretches of long runs were cut out, and the samples
            of it that must not be judged.
        other_rig: the rig that was shaken, where it is not the declared one.
    """

    base: BaseFit
    search: Search
    faults: tuple[SampleFault, ...]
    uncorrected: ResidualSummary | None
    uncut: tuple[Campaign, InvalidSamples]
    other_rig: WrongRig | None = None


def prepared(campaign: Campaign) -> tuple[Campaign, InvalidSamples, tuple[SampleFault, ...]]:
    """Return a campaign with wrong signs reversed, the samples that must not be judged, and the faults found."""
    uncut, invalid, faults = _corrected(campaign)
    return (*stretched(uncut, invalid), faults)


def _corrected(campaign: Campaign) -> tuple[Campaign, InvalidSamples, tuple[SampleFault, ...]]:
    faults = tuple(fault for fault in sample_faults(campaign) if fault.kind in _OF_GAUGES)
    whole, invalid = for_fits(campaign, faults) if faults else (campaign, {})
    return (*decimated(whole, invalid), faults)


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
    uncut, unjudged, faults = _corrected(campaign)
    whole, invalid = stretched(uncut, unjudged)
    base = fit_base(whole, model, invalid)
    other = wrong_rig(base)
    if other is not None:  # from its rated numbers the fit begins anew, and the rest is diagnosed
        known = {name: value for name, value in whole.known.items() if name not in HELD_AGAINST}
        specimen = better_known(other.fitting, known, "campaign.toml")
        whole = replace(whole, specimen=specimen)
        model = None if model is None else replace(model, specimen=specimen)
        base = fit_base(whole, model, invalid)
    state = search(base, own, progress)
    # what an effect seems to explain may be a local minimum that the base fit has missed
    better = restarted(base, state.best.solution.values) if state.best.terms else None
    if better is not None:
        base = better
        state = search(base, own, progress, state)
    uncorrected = None
    if faults:
        recorded, _ = stretched(*decimated(campaign, {}))
        uncorrected = final_refit_of(base_hypothesis(fit_base(recorded, model))).summary
    return SelectionResult(base, state, faults, uncorrected, (uncut, unjudged), other)
