"""The ladder: effects added one by one, the error falling step by step, on runs the fit has not seen."""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.campaign import Campaign
from slipwise.diagnosis.replays import replayed_errors
from slipwise.display import Drawn, Tabular
from slipwise.effects import Effect, find_effect
from slipwise.errors import InputError, SettingError
from slipwise.estimation.base_fit import BaseFit
from slipwise.evidence.residual_summary import ResidualSummary, get_error
from slipwise.jobs.parallel import on_every_core, one_thread_algebra
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.noise.level import is_at_floor
from slipwise.preparation.data_corrections import DataCorrection
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared, fit_prepared
from slipwise.selection.candidates import list_candidates
from slipwise.selection.explained_alone import ExplainedAlone, explain_alone
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis, polish, refit, refit_for_report
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.proposals import MOST_EFFECTS
from slipwise.selection.search_state import Search, take_fit
from slipwise.selection.select import select_effects
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class LadderStep:
    """One model of the ladder.

    Attributes:
        effects: labels of what was added to the base model.
        fit_error: component-level error on fitted runs, worst relation, in floors.
        holdout_error: the same on held-out runs; NaN where none is held out.
        system_holdout_error: held-out error of the replay, in floors; NaN where it was not asked for or cannot be.
        floor: 1 by definition of the errors.
        relations: relation -> held-out error in floors; that of the fitted runs where none is held out.
    """

    effects: tuple[str, ...]
    fit_error: float
    holdout_error: float
    system_holdout_error: float
    floor: float
    relations: dict[str, float]


@dataclass(frozen=True, repr=False)
class Ladder(Drawn, Tabular):
    """All steps.

    Attributes:
        campaign: its name.
        steps: base first.
        tried: number of candidates that were held against the residual, and of hypotheses that were refitted.
        stopped: why no further step was climbed.
        fits: the fit of each step, for model.toml; none where a diagnosis has climbed already.
        seconds: it took.
        corrections: what was done about the data before any fit.
    """

    campaign: str
    steps: tuple[LadderStep, ...]
    tried: tuple[int, int]
    stopped: str
    fits: tuple[BaseFit, ...]
    seconds: float
    corrections: tuple[DataCorrection, ...] = ()

    def as_json(self) -> list[dict[str, Any]]:
        """Return the contract of ladder.json: the steps; the last one says why no further one was climbed."""
        screened, refitted = self.tried
        last = len(self.steps) - 1
        return [
            {**step, "screened": screened, "refitted": refitted, "stopped": self.stopped if place == last else ""}
            for place, step in enumerate(self.table())
        ]

    def table(self) -> list[dict[str, Any]]:
        """Return the errors of every step; none where there is none."""
        return [
            {
                "effects": list(r.effects),
                "fit_error": _number(r.fit_error),
                "holdout_error": _number(r.holdout_error),
                "system_holdout_error": _number(r.system_holdout_error),
                "floor": r.floor,
            }
            for r in self.steps
        ]

    def _headline(self) -> str:
        added = ", ".join(self.steps[-1].effects) or "nothing"
        return f"{self.campaign}: {added} added to the base model; {self.stopped}"

    def _rows(self) -> list[dict[str, Any]]:
        return [{**row, "effects": " + ".join(["base", *row["effects"]])} for row in self.table()]


@one_thread_algebra()
def ladder(
    campaign: Campaign | Path | str | Prepared,
    add: Sequence[str] = (),
    model: Model | Path | str | None = None,
    *,
    own: Iterable[Effect] = (),
    system: bool = False,
    progress: Callable[[str, float], None] | None = None,
) -> Ladder:
    """Climb the ladder: effects that a diagnosis finds, or those asked for, added one by one.

    Args:
        campaign: or its folder.
        add: effects to add in this order instead of searching: names, or paths of a user's files ("./mine.py").
        model: where the ladder stands, or its model.toml; the paper's law on the campaign's rig when not given.
        own: effects that are searched beside those of the catalogue.
        system: replay every step as well.
        progress: called with what is being done and the share done.

    Raises:
        UnknownNameError: an effect of `add` does not exist.
        SettingError: the campaign cannot test an effect of `add`.
    """
    began = time.perf_counter()
    tell = progress or (lambda words, share: None)
    asked = [find_effect(name) for name in add]
    prepared = prepare(campaign)
    start = None if model is None else as_model(model)
    tell("fitting base parameters", 0.02)
    part = 0.6 if system else 1.0
    if asked:
        base = fit_prepared(prepared, start)
        path, counts, stopped = _asked(base, asked, lambda share: tell("refitting", part * share))
    else:
        selected = select_effects(prepared, start, own, lambda words, share: tell(words, part * share))
        base, state = selected.base, selected.search
        path, counts, stopped = _hypothesis_path(state), (len(state.alone), len(state.tried)), _why(state)
    fits = tuple(make_fit(base, h) for h in path)
    errors = [float("nan")] * len(fits)
    if system:
        tell("replaying", part)
        with suppress(InputError):  # nothing to replay: the table's motion was not recorded
            errors = replayed_errors(fits, ("holdout",), lambda share: tell("replaying", part + (1.0 - part) * share))
    steps = [_step(h, error) for h, error in zip(path, errors, strict=True)]
    tell("done", 1.0)
    name, seconds = prepared.recorded.name, time.perf_counter() - began
    return Ladder(name, tuple(steps), counts, stopped, fits, seconds, prepared.corrections)


def make_ladder(
    search: Search, system: Mapping[str, float], corrections: tuple[DataCorrection, ...], *, named: bool
) -> Ladder:
    """Return the ladder that a search has climbed already.

    Args:
        search: of a diagnosis.
        system: {"base", "final"} errors of its replays, in floors; empty where none was asked for.
        corrections: of the data, before any fit.
        named: whether the diagnosis names what the search came to; where it names nothing, the base model was replayed.
    """
    path = _hypothesis_path(search)
    ends = {0: system.get("base", np.nan)}
    if named:
        ends[len(path) - 1] = system.get("final", np.nan)
    steps = [_step(h, float(ends.get(i, np.nan))) for i, h in enumerate(path)]
    counts = (len(search.alone), len(search.tried))
    return Ladder(search.base.campaign.name, tuple(steps), counts, _why(search), (), 0.0, corrections)


def _hypothesis_path(state: Search) -> list[Hypothesis]:
    """Return the hypotheses of a search step by step, each once, fitted as all that is reported is."""
    last = {frozenset(t.label for t in h.terms): h for h in state.path[:-1]}
    last.pop(frozenset(t.label for t in state.best.terms), None)
    before = list(last.values())
    memory = state.base.solution.fit_memory
    # what is replayed of a step is what its error is of
    fits = on_every_core(lambda i: take_fit(refit_for_report(before[i]), keep=False), len(before), memory=memory)
    refitted = [
        replace(h, solution=solution, summary=summary) for h, (solution, summary) in zip(before, fits, strict=True)
    ]
    return [*refitted, state.final if state.best.terms else refit_for_report(state.best)]


def place_effect(base: BaseFit, effect: Effect) -> ExplainedAlone:
    """Find where an effect explains most of what a fit leaves, and how large it is there.

    Args:
        base: a fit with its slopes.
        effect: a fault of a gauge may be of any channel.

    Raises:
        SettingError: the campaign cannot test it, or the model holds it already.
    """
    terms, cannot = list_candidates(base, [effect])
    own = [t for t in terms if t.effect.name == effect.name]
    if not own:
        faults = "a fault of samples is found by looking at them: `slipwise diagnose` says whether there is one"
        known = faults if effect.in_samples else "it is part of the model already"
        raise SettingError(f"{effect.name} cannot be added here: {cannot.get(effect.name, known)}")
    found = explain_alone(base, own)
    if not found:
        raise SettingError(f"{effect.name} changes nothing in this campaign, so it cannot be fitted")
    return found[0]


def _asked(
    base: BaseFit, add: Sequence[Effect], tell: Callable[[float], None]
) -> tuple[list[Hypothesis], tuple[int, int], str]:
    """Add effects in the order asked for; a gauge's fault goes to the channel where it explains most."""
    path = [make_base_hypothesis(base)]
    for i, effect in enumerate(add):
        before = path[-1]
        best = place_effect(make_fit(base, before), effect)
        path.append(polish(refit(base, [*before.terms, best.term], {best.term.label: best.values}, before)))
        tell((i + 1) / len(add))
    return [refit_for_report(h) for h in path], (len(add), len(add)), "these effects were asked for"


def _why(state: Search) -> str:
    if not state.alone:
        return "no effect of the catalogue can be tested here"
    account = state.final.summary
    worst = max(get_error(account, relation) for relation in account.fitted)
    if is_at_floor(worst):
        return "nothing above the noise floor is left"
    if len(state.best.terms) >= MOST_EFFECTS:
        return f"{MOST_EFFECTS} effects are the most that are added; {worst:.2g} floors are left"
    return f"no further effect of the catalogue is worth a step; {worst:.2g} floors are left"


def _step(found: Hypothesis, replayed: float) -> LadderStep:
    fitted = _errors(found.summary, held_out=False)
    held = _errors(found.summary, held_out=True)
    return LadderStep(
        effects=tuple(t.label for t in found.terms),
        fit_error=max(fitted.values()),
        holdout_error=max(held.values(), default=float("nan")),
        system_holdout_error=replayed,
        floor=1.0,
        relations={r: get_error(found.summary, r) for r in found.summary.fitted},
    )


def _errors(account: ResidualSummary, *, held_out: bool) -> dict[str, float]:
    counted = [r for r, c in account.counts.items() if c[int(held_out)] > 0]
    level = account.held_out_level if held_out else account.fitted_level
    return {r: float(np.sqrt(level(r))) for r in counted}


def _number(value: float) -> float | None:
    return float(f"{value:.4g}") if np.isfinite(value) else None
