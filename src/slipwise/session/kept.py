"""What a session leaves on disk, and how the next one goes on from it."""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from hashlib import sha256
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.campaign import Campaign
from slipwise.errors import InputError, SlipwiseError, SlipwiseWarning
from slipwise.session.evaluation import Evaluator, errors_of
from slipwise.session.history import History, history_from_json
from slipwise.session.snapshot import Store, fingerprint
from slipwise.session.state import EffectOf, SessionState, as_json, from_json

#: What arithmetic says of numbers and names that fit the schema and make no model.
_NONSENSE = (ArithmeticError, LookupError, TypeError, ValueError)

#: A number that lies outside its range by so many times its width was never one of a session; a little outside it
#: comes to lie when a user edits the rig [1].
_FAR = 100.0


@dataclass(frozen=True)
class Kept:
    """A session as it lasts.

    Attributes:
        history: every step.
        reference: the state with which errors are compared.
        accepted: whether model.toml holds that one.
        findings: what was found last, as plain data.
        notes: what a user should know of how it was taken up again.
    """

    history: History
    reference: SessionState
    accepted: bool = False
    findings: Mapping[str, dict[str, Any]] = field(default_factory=dict[str, dict[str, Any]])
    notes: tuple[str, ...] = ()

    def as_json(self, campaign: Campaign, model: Path) -> dict[str, Any]:
        """Return it as JSON holds it.

        Args:
            campaign: that it is of.
            model: the model.toml beside it; if that is changed by others, the next session reads it anew.
        """
        return {
            "campaign": fingerprint(campaign),
            "model": _hash_of(model),
            "history": self.history.as_json(),
            "reference": as_json(self.reference),
            "accepted": self.accepted,
            "findings": dict(self.findings),
        }


def begun(state: SessionState) -> Kept:
    """Return a session that begins."""
    return Kept(History((state,), 0), state)


def resumed(
    store: Store | None,
    campaign: Campaign,
    ready: Evaluator,
    model: Path,
    effect_of: EffectOf,
    start: SessionState,
    *,
    given: bool,
) -> Kept:
    """Return a session that goes on where the last one ended, as far as it may.

    A session that cannot be taken up is never overwritten: it is moved aside, and a note and a warning say where it is.

    Args:
        store: what the last session left; None for a session that leaves nothing on disk.
        campaign: as it is now.
        ready: the same, ready for fits.
        model: the model.toml beside it.
        effect_of: finds effects; it refuses a file that may not be run.
        start: the model as it is stated now.
        given: whether a user asks for that one.

    Raises:
        OutputError: the last session can neither be taken up nor be moved aside.
    """
    if store is None:
        return begun(start)
    try:
        content = store.read()
        if content is None:
            return begun(start)
        if content["campaign"] != fingerprint(campaign):
            raise InputError("the campaign has changed since")
        kept = _taken_up(content, ready, effect_of)
    except SlipwiseError as error:
        words = f"the last session was not taken up again, and is kept as {store.move_aside()}: {error}"
        warnings.warn(words, SlipwiseWarning, stacklevel=3)
        return replace(begun(start), notes=(words,))
    if not given and content["model"] == _hash_of(model):
        return kept
    words = "the model was read anew; undo leads back to the last session"
    anew = kept.history.pushed(replace(start, words="the model was read anew"))
    return replace(kept, history=anew, accepted=False, notes=(words,))


def _taken_up(content: Mapping[str, Any], ready: Evaluator, effect_of: EffectOf) -> Kept:
    history = history_from_json(content["history"], effect_of)
    reference = from_json(content["reference"], effect_of)
    for state in (*history.states, reference):
        _check_numbers(ready, state)
    for state in (history.state, reference):
        _check_errors(ready, state)
    return Kept(history, reference, content["accepted"], content["findings"])


def _check_numbers(ready: Evaluator, state: SessionState) -> None:
    """Refuse a step that lacks a number, has one beyond reason, or acts on what the campaign has not."""
    try:
        every = ready.free(state)
    except _NONSENSE as error:
        raise _impossible(state, error) from None
    for free in every:
        value, reach = state.values.get(free.key), _FAR * (free.high - free.low)
        if value is None:
            raise InputError(f"its step {state.words!r} lacks {free.key}")
        if not free.low - reach <= value <= free.high + reach:
            raise InputError(f"its step {state.words!r} has {free.key} = {value:g}, far beyond its bounds")


def _check_errors(ready: Evaluator, state: SessionState) -> None:
    """Refuse a step that predicts nothing."""
    try:
        with np.errstate(all="ignore"):
            errors = errors_of(ready.objective(state), ready.residuals(state))
    except _NONSENSE as error:
        raise _impossible(state, error) from None
    if not all(e.fitted is None or isfinite(e.fitted) for e in errors):
        raise InputError(f"its step {state.words!r} holds numbers by which nothing can be predicted")


def _impossible(state: SessionState, error: Exception) -> InputError:
    return InputError(f"its step {state.words!r} cannot be evaluated ({type(error).__name__}: {error})")


def _hash_of(path: Path) -> str:
    return sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
