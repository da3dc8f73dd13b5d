"""What a session leaves on disk, and how the next one goes on from it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign
from slipwise.errors import SlipwiseError
from slipwise.session.history import History, history_from_json
from slipwise.session.snapshot import fingerprint
from slipwise.session.state import EffectOf, State, as_json, from_json


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
    reference: State
    accepted: bool = False
    findings: Mapping[str, dict[str, Any]] = field(default_factory=dict[str, dict[str, Any]])
    notes: tuple[str, ...] = ()

    def as_json(self, campaign: Campaign, model: Path) -> dict[str, Any]:
        """Give it as JSON holds it.

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


def begun(state: State) -> Kept:
    """Give a session that begins."""
    return Kept(History((state,), 0), state)


def resumed(
    content: Mapping[str, Any] | None,
    campaign: Campaign,
    model: Path,
    effect_of: EffectOf,
    start: State,
    *,
    given: bool,
) -> Kept:
    """Give a session that goes on where the last one ended, as far as it may.

    Args:
        content: what it left; None where there was none.
        campaign: as it is now.
        model: the model.toml beside it.
        effect_of: finds effects; it refuses a file that may not be run.
        start: the model as it is stated now.
        given: whether a user asks for that one.
    """
    if content is None:
        return begun(start)
    if content["campaign"] != fingerprint(campaign):
        words = "the campaign has changed since the last session, which was not taken up again"
        return replace(begun(start), notes=(words,))
    try:
        history = history_from_json(content["history"], effect_of)
        reference = from_json(content["reference"], effect_of)
        kept = Kept(history, reference, content["accepted"], content["findings"])
    except SlipwiseError as error:
        return replace(begun(start), notes=(f"the last session was not taken up again: {error}",))
    if not given and content["model"] == _hash_of(model):
        return kept
    words = "the model was read anew; undo leads back to the last session"
    anew = history.pushed(replace(start, words="the model was read anew"))
    return replace(kept, history=anew, accepted=False, notes=(words,))


def _hash_of(path: Path) -> str:
    return sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
