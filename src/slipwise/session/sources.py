"""Where a session takes models and effects from: names, files that may be run, and with which bounds."""

from dataclasses import dataclass
from pathlib import Path

from slipwise.campaign import Campaign
from slipwise.campaign.scales import scales_of
from slipwise.effects import Effect, Trust, check_trusted, find_effect, for_pads, scaled
from slipwise.estimation.base_fit import scale_model
from slipwise.model import Model
from slipwise.model.file import as_model, load_model
from slipwise.rig.load_basis import has_corners


@dataclass(frozen=True)
class Sources:
    """What a session may read and run.

    Attributes:
        campaign: whose scales bounds have.
        trust: effect files that a model or the last session names and that may be run.
    """

    campaign: Campaign
    trust: Trust

    def model(self, given: Model | Path | str) -> Model:
        """Return a model, or that of a file.

        Raises:
            SlipwiseError: a file that cannot be read, or names an effect file that is not trusted.
        """
        if isinstance(given, Path | str) and Path(given).suffix == ".toml":
            return load_model(given, trust=self.trust)
        return as_model(given)

    def bounded(self, model: Model) -> Model:
        """Return a model as it was stated, its effects with the bounds that they have in this campaign."""
        return scale_model(model, scales_of(self.campaign), typical=False)

    def effect(self, name: str) -> Effect:
        """Return an effect that a user names, with the bounds that it has in this campaign.

        Raises:
            UnknownNameError: no such effect.
            InputError: no such file, or Python cannot import it.
        """
        scales, specimen = scales_of(self.campaign), self.campaign.specimen
        effect = scaled(find_effect(name), scales.of, scales.room)
        return for_pads(effect, specimen.pads, corners=has_corners(specimen))

    def kept_effect(self, name: str) -> Effect:
        """Return an effect that the last session names.

        Raises:
            UnknownNameError: no such effect.
            InputError: a file that is not trusted.
        """
        if name.endswith(".py"):
            check_trusted(Path(name), self.campaign.folder / "session.json", self.trust)
        return self.effect(name)
