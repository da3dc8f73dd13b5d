"""Add an effect to a model or take one away: both are fitted to a campaign, and the errors stand side by side."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign, as_campaign
from slipwise.diagnosis.hypothesis import base_hypothesis
from slipwise.diagnosis.ladder import ladder
from slipwise.estimation.base_fit import BaseFit, fit_finely
from slipwise.evidence.residual_summary import error_of
from slipwise.model import Model, base_model
from slipwise.model_file import as_model
from slipwise.shown import Drawn, Tabular


@dataclass(frozen=True, repr=False)
class ModelChange(Drawn, Tabular):
    """A model that was changed and fitted.

    Attributes:
        words: what was done.
        model: afterwards, fitted; `save_model` writes it.
        before: balance -> error before in floors: held-out, of the fitted runs where none is held out.
        after: balance -> the same afterwards.
    """

    words: str
    model: Model
    before: Mapping[str, float]
    after: Mapping[str, float]

    def _headline(self) -> str:
        return f"{self.words}; errors in multiples of the noise floor"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"balance": n, "before": round(b, 2), "after": round(self.after.get(n, b), 2)}
            for n, b in self.before.items()
        ]

    def rows(self) -> list[dict[str, Any]]:
        """Give the errors before and after as rows of a table."""
        return self._rows()


def add(
    effect: str,
    campaign: Campaign | Path | str,
    model: Model | Path | str | None = None,
    *,
    progress: Callable[[str, float], None] | None = None,
) -> ModelChange:
    """Add an effect to a model and refit everything; a gauge's fault goes to the channel where it explains most.

    Args:
        effect: its name, or the path of a user's file ("./mine.py").
        campaign: or its folder.
        model: or its model.toml; the paper's law on the campaign's rig when not given.
        progress: called with what is being done and the share done.

    Raises:
        UnknownNameError: no such effect.
        SettingError: the campaign cannot test it, or the model holds it already.
    """
    result = ladder(campaign, [effect], model, progress=progress)
    first, last = result.steps[0], result.steps[-1]
    return ModelChange(f"{effect} added", _model(result.fits[-1]), first.relations, last.relations)


def remove(
    effect: str,
    campaign: Campaign | Path | str,
    model: Model | Path | str | None = None,
    *,
    progress: Callable[[str, float], None] | None = None,
) -> ModelChange:
    """Take an effect out of a model and refit everything.

    Args:
        effect: its name, or its label ("channel_gain[pad_A_N]").
        campaign: or its folder.
        model: or its model.toml; the paper's law on the campaign's rig when not given.
        progress: called with what is being done and the share done.

    Raises:
        SettingError: the model does not hold it.
    """
    tell = progress or (lambda words, share: None)
    measured = as_campaign(campaign)
    before = base_model(measured.specimen) if model is None else as_model(model)
    after = before.without(effect)
    tell("fitting with it", 0.0)
    old = fit_finely(measured, before)
    tell("fitting without it", 0.5)
    new = fit_finely(measured, after)
    return ModelChange(f"{effect} removed", _model(new), _errors(old), _errors(new))


def _model(fit: BaseFit) -> Model:
    return fit.problem.model(fit.solution.values)


def _errors(fit: BaseFit) -> dict[str, float]:
    summary = base_hypothesis(fit).summary
    return {relation: error_of(summary, relation) for relation in summary.fitted}
