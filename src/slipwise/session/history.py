"""Every step of a session, backwards and forwards."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from slipwise.errors import SettingError
from slipwise.session.state import EffectOf, SessionState, as_json, from_json

#: Steps that are kept.
_MOST = 100


@dataclass(frozen=True)
class History:
    """Steps of a session.

    Attributes:
        states: oldest first.
        place: of the one that is looked at.
    """

    states: tuple[SessionState, ...]
    place: int

    @property
    def state(self) -> SessionState:
        """The step that is looked at."""
        return self.states[self.place]

    @property
    def before(self) -> SessionState | None:
        """The step that an undo leads to."""
        return self.states[self.place - 1] if self.place else None

    @property
    def after(self) -> SessionState | None:
        """The step that a redo leads to."""
        return self.states[self.place + 1] if self.place + 1 < len(self.states) else None

    def pushed(self, state: SessionState) -> "History":
        """Return the history with one step more; what was undone before is gone.

        A number that is dragged makes one step, not hundreds.
        """
        here = self.state
        end = self.place if state.edit and state.edit == here.edit and self.place else self.place + 1
        states = (*self.states[:end], state)[-_MOST:]
        return History(states, len(states) - 1)

    def undone(self) -> "History":
        """Return the history one step back.

        Raises:
            SettingError: there is none.
        """
        if self.before is None:
            raise SettingError("there is no step before this one; `redo` goes forward again")
        return replace(self, place=self.place - 1)

    def redone(self) -> "History":
        """Return the history one step forward.

        Raises:
            SettingError: there is none.
        """
        if self.after is None:
            raise SettingError("there is no step after this one; nothing was undone since the last change")
        return replace(self, place=self.place + 1)

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON holds it."""
        return {"states": [as_json(state) for state in self.states], "place": self.place}


def history_from_json(content: Mapping[str, Any], effect_of: EffectOf) -> History:
    """Return the history that `as_json` wrote."""
    return History(tuple(from_json(one, effect_of) for one in content["states"]), content["place"])
