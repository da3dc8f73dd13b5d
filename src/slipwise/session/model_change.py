"""Add an effect to a model or take one away: both are fitted to a campaign, and the errors stand side by side."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign, as_campaign
from slipwise.diagnosis.ladder import place_effect
from slipwise.diagnosis.result import Diagnosis
from slipwise.display import Drawn, Tabular
from slipwise.errors import SettingError
from slipwise.model import Model, base_model
from slipwise.session import changes
from slipwise.session.evaluation import NOT_JUDGED
from slipwise.session.findings import explained
from slipwise.session.fitting import Progress
from slipwise.session.session import Session

#: An error that is so many times larger has risen [1].
_RISEN = 1.01


@dataclass(frozen=True, repr=False)
class ModelChange(Drawn, Tabular):
    """A model that was changed and fitted.

    Attributes:
        words: what was done.
        model: afterwards, fitted; `save_model` writes it.
        before: balance -> error before in floors: held-out, of the fitted runs where none is held out;
            None for a balance that no sample judges.
        after: balance -> the same afterwards.
    """

    words: str
    model: Model
    before: Mapping[str, float | None]
    after: Mapping[str, float | None]

    @property
    def remarks(self) -> tuple[str, ...]:
        """What a reader should not miss: an error that has risen, and numbers that ran to an end of their bounds."""
        out = []
        worst = [max((x for x in each.values() if x is not None), default=0.0) for each in (self.before, self.after)]
        if worst[1] > _RISEN * worst[0]:
            out.append(f"the largest error has risen from {worst[0]:.3g} to {worst[1]:.3g} floors")
        for use in self.model.uses:
            for p in use.effect.parameters if not use.effect.base else ():
                value, near = use.values[p.name], 1e-6 * (p.high - p.low)
                if not p.whole and value not in (p.neutral, p.typical) and min(value - p.low, p.high - value) < near:
                    end = "low" if value - p.low < near else "high"
                    out.append(
                        f"{use.effect.name}.{p.name} ran to the {end} end of its bounds: the data do not tell it"
                    )
        return tuple(out)

    def _headline(self) -> str:
        return f"{self.words}; errors in multiples of the noise floor"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"balance": n, "before": _shown(b), "after": _shown(self.after.get(n, b))} for n, b in self.before.items()
        ]

    def rows(self) -> list[dict[str, Any]]:
        """Return the errors before and after as rows of a table."""
        return self._rows()


def add(
    effect: str | Diagnosis,
    campaign: Campaign | Path | str | Session,
    model: Model | Path | str | None = None,
    *,
    progress: Progress | None = None,
) -> ModelChange:
    """Add an effect to a model and refit everything; a gauge's fault goes to the channel where it explains most.

    Args:
        effect: its name, or the path of a user's file ("./mine.py"); or a diagnosis, for all that it names.
        campaign: or its folder; or a session, of which each fit becomes a step.
        model: or its model.toml; the paper's law on the campaign's rig, or the session's model, when not given.
        progress: called with what is being done and the share done.

    Raises:
        UnknownNameError: no such effect.
        SettingError: the campaign cannot test it, or the model holds it already; or the diagnosis names nothing.
    """
    session = _session(campaign, model)
    return _added(session, effect, progress) if isinstance(effect, str) else _taken(session, effect, progress)


def remove(
    effect: str,
    campaign: Campaign | Path | str | Session,
    model: Model | Path | str | None = None,
    *,
    progress: Progress | None = None,
) -> ModelChange:
    """Take an effect out of a model and refit everything.

    Args:
        effect: its name, or its label ("channel_gain[pad_A_N]").
        campaign: or its folder; or a session, of which each fit becomes a step.
        model: or its model.toml; the paper's law on the campaign's rig, or the session's model, when not given.
        progress: called with what is being done and the share done.

    Raises:
        SettingError: the model does not hold it.
    """
    session = _session(campaign, model)
    changes.removed(session.ready, session.state, effect)  # refuses what is not there before anything is fitted
    tell = progress or _silent
    _fit(session, tell, "fitting with it", 0.0)
    before = _errors(session)
    session.push(changes.removed(session.ready, session.state, effect), keep=False)
    _fit(session, tell, "fitting without it", 0.5)
    return ModelChange(f"{effect} removed", session.model, before, _errors(session))


def _added(session: Session, effect: str, progress: Progress | None) -> ModelChange:
    wanted = session.effect(effect)
    tell = progress or _silent
    _fit(session, tell, "fitting without it", 0.0)
    tell("looking where it explains most", 0.45)
    best = place_effect(session.ready.with_slopes(session.state), wanted)
    words = f"{best.term.label} added"
    before = _errors(session)
    session.push(changes.with_terms(session.ready, session.state, [(best.term, best.values)], words), keep=False)
    _fit(session, tell, "fitting with it", 0.5)
    return ModelChange(words, session.model, before, _errors(session))


def _taken(session: Session, found: Diagnosis, progress: Progress | None) -> ModelChange:
    if not found.added:
        raise SettingError("the diagnosis names no effect; there is nothing to add")
    tell = progress or _silent
    session.remember("explain", explained(found, session.state.labels))
    _fit(session, tell, "fitting without it", 0.0)
    before = _errors(session)
    words = session.take_suggestion().words
    _fit(session, tell, "fitting with it", 0.5)
    return ModelChange(words, session.model, before, _errors(session))


def _session(campaign: Campaign | Path | str | Session, model: Model | Path | str | None) -> Session:
    """Return the session, or open one of a model alone, which leaves nothing on disk."""
    if isinstance(campaign, Session):
        return campaign
    measured = as_campaign(campaign)
    return Session(measured, base_model(measured.specimen) if model is None else model, resume=False, keep=False)


def _fit(session: Session, tell: Progress, words: str, begin: float) -> None:
    if not session.state.fitted:
        session.fit(lambda _, share: tell(words, begin + 0.45 * share))


def _shown(error: float | None) -> float | str:
    return NOT_JUDGED if error is None else round(error, 2)


def _errors(session: Session) -> dict[str, float | None]:
    return {each.relation: each.error for each in session.errors()}


def _silent(words: str, share: float) -> None:
    pass
