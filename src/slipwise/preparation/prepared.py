"""A campaign made ready: what was found in it, what was done about it, and what audits and fits see of it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from slipwise.campaign import Campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.estimation.base_fit import BaseFit, fit_base, refine_base_fit
from slipwise.model import Model
from slipwise.preparation.balance_records import BalanceRecords
from slipwise.preparation.data_corrections import DataCorrection, describe_corrections
from slipwise.preparation.dead_cells import EstimatedLoad
from slipwise.preparation.logger import LoggerEstimate
from slipwise.preparation.rig_check import WrongRig
from slipwise.preparation.sample_fault import SampleFault


@dataclass(frozen=True)
class Prepared:
    """A campaign that was prepared.

    Attributes:
        recorded: the campaign as it was recorded.
        faults: of samples, that were put right, bridged or left out.
        masks: kind of fault -> run -> channel -> samples (n,) of the recorded runs that are no measurement.
        estimated: loads that stand in the place of dead cells.
        logger: what friction's spectrum says of the logger's filter; None where campaign.toml describes it.
        other_rig: the rig that was shaken, where it is not the declared one.
        balances: records for balances, which look at all channels at one instant.
        uncut: the campaign with its channels put right, decimated, before excerpts of long runs were cut out.
        unjudged: run -> channel -> samples (n,) of it at which a channel is no measurement.
        campaign: what is fitted: of `uncut` the excerpts, its logger known, on the rig that was shaken.
        invalid: run -> channel -> samples (n,) of it at which a channel is no measurement.
        start: key -> value where fits begin, as far as preparing has found any.
        unmended: the recorded campaign, decimated, cut, with the logger and the rig of `campaign`, and no fault put
            right; the same as `campaign` where gauges have none.
    """

    recorded: Campaign
    faults: tuple[SampleFault, ...]
    masks: Mapping[str, InvalidSamples]
    estimated: tuple[EstimatedLoad, ...]
    logger: LoggerEstimate | None
    other_rig: WrongRig | None
    balances: BalanceRecords
    uncut: Campaign
    unjudged: InvalidSamples
    campaign: Campaign
    invalid: InvalidSamples
    start: Mapping[str, float]
    unmended: Campaign

    @property
    def gauge_faults(self) -> tuple[SampleFault, ...]:
        """Faults that gauges have; a gap is the clock's."""
        return tuple(fault for fault in self.faults if fault.kind != "gap")

    @property
    def corrections(self) -> tuple[DataCorrection, ...]:
        """What was done before any fit, in words."""
        return describe_corrections(self.faults, self.estimated, self.other_rig)

    def on_rig(self, model: Model | None) -> Model | None:
        """Return a user's model on the rig that was shaken, where it stands on the one that was wrongly declared."""
        if model is None or self.other_rig is None or model.specimen.name != self.other_rig.declared:
            return model
        return replace(model, specimen=self.campaign.specimen)


def fit_prepared(
    prepared: Prepared, model: Model | None = None, watch: Callable[[], None] | None = None, *, finely: bool = False
) -> BaseFit:
    """Return the base fit of a prepared campaign.

    Args:
        prepared: the campaign.
        model: the user's current model; the paper's law on the campaign's rig when not given.
        watch: called before every evaluation; what it raises ends the fit.
        finely: fit on as all that is reported is, and not only to be searched from.

    Raises:
        InputError: a run lacks what every fit needs, or the runs are too short for one.
    """
    base = fit_base(prepared.campaign, prepared.on_rig(model), prepared.invalid, prepared.start, watch)
    return refine_base_fit(base) if finely else base
