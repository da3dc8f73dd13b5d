"""From a prepared campaign to a finished selection: base fitted, effects searched."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from slipwise.diagnosis.forward_selection import search
from slipwise.diagnosis.search_state import Search
from slipwise.effects import Effect
from slipwise.estimation.base_fit import BaseFit, restart_base_fit
from slipwise.model import Model
from slipwise.preparation.prepared import Prepared, fit_prepared


@dataclass(frozen=True)
class SelectionResult:
    """A campaign that was searched.

    Attributes:
        prepared: the campaign.
        base: the base fit.
        search: what was looked at.
    """

    prepared: Prepared
    base: BaseFit
    search: Search


def select_effects(
    prepared: Prepared,
    model: Model | None = None,
    own: Iterable[Effect] = (),
    progress: Callable[[str, float], None] | None = None,
) -> SelectionResult:
    """Search what a model lacks.

    Args:
        prepared: the campaign.
        model: where to start; the paper's law on the campaign's rig when not given.
        own: effects beside those of the catalogue.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the campaign lacks what every fit needs.
    """
    own = tuple(own)
    base = fit_prepared(prepared, model)
    state = search(base, own, progress)
    # what an effect seems to explain may be a local minimum that the base fit has missed
    better = restart_base_fit(base, state.best.solution.values) if state.best.terms else None
    if better is not None:
        base = better
        state = search(base, own, progress, state)
    return SelectionResult(prepared, base, state)
