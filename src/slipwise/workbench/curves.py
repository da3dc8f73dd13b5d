"""Curves for the page: what was measured in a run, once; what the model says of it, after every change."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.model import base_model
from slipwise.session.responses import RESPONSES, RunReplay
from slipwise.session.series import ALL_BEARINGS
from slipwise.session.session import Session
from slipwise.session.state import SessionState
from slipwise.workbench.frames import frame
from slipwise.workbench.replies import errors_told, other_models

#: What may stand beside without a file: the reference, and the paper's law as stated.
BEFORE, PAPER = "before", "paper"


@dataclass(frozen=True)
class View:
    """What one page looks at.

    Attributes:
        run: name.
        relation: balance whose history is shown; "pads" for what the loops show too, see `Session.series`.
        beside: "", `BEFORE`, `PAPER`, or the name of a model file of the campaign's folder.
        watches: whether a recorded channel is shown, of which only a replay says anything.
    """

    run: str
    relation: str = "pads"
    beside: str = ""
    watches: bool = False


def beside_of(session: Session, view: View) -> SessionState | None:
    """Return the model that stands beside; None where there is none, or no such file in the campaign's folder."""
    if view.beside == BEFORE:
        return session.reference
    if view.beside == PAPER:
        return session.beside(base_model(session.campaign.specimen))
    files = {path.name: path for path in other_models(session)}
    return session.beside(files[view.beside]) if view.beside in files else None


def measured_frame(session: Session, run: str) -> bytes:
    """Pack what was measured in a run."""
    own = next(r for r in session.ready.runs if r.name == run)
    shown = session.series(run)
    together = not own.forces_measured  # only what all bearings carry is known
    arrays = {
        "time": own.time,
        "slip": own.slip,
        "velocity": own.velocity,
        "load": np.zeros_like(shown.measured) if together else np.nan_to_num(own.load),
        "force": shown.measured,
        **{f"channel:{name}": values for name, values in own.record.channels.items()},
    }
    panels = [ALL_BEARINGS.capitalize()] if together else [f"Pad {pad}" for pad in own.pads]
    head = {"kind": "measured", "run": run, "role": own.role, "panels": panels}
    return frame(head, arrays)


def curves_frame(session: Session, view: View, answers: int = 0, *, dragged: bool = False) -> bytes:
    """Pack what the model says of a run, with the errors.

    Args:
        session: its state.
        view: what the page looks at.
        answers: number of the question that this answers.
        dragged: in half the time, and without the model that stands beside, which does not change meanwhile.
    """
    other = beside_of(session, view) if view.beside and not dragged else None
    relation, state = view.relation, session.ready.coarse(session.state) if dragged else session.state
    shown = session.series(view.run, relation, state)
    arrays = {"pads": session.series(view.run, "pads", state).predicted}
    if relation != "pads":
        arrays |= {"measured": shown.measured, "predicted": shown.predicted}
    if other is not None:
        arrays["beside_pads"] = session.series(view.run, "pads", other).predicted
        if relation != "pads":
            arrays["beside_predicted"] = session.series(view.run, relation, other).predicted
    head: dict[str, Any] = {
        "kind": "curves",
        "answers": answers,
        "run": view.run,
        "relation": relation,
        "labels": list(shown.labels),
        "unit": shown.unit,
        "floor": list(shown.floor),
        "errors": errors_told(session, state, other),
    }
    return frame(head, arrays)


def replay_frame(now: RunReplay, without: RunReplay | None, left_out: list[str]) -> bytes:
    """Pack the replay of the held-out run, with what an engineer reads off, with and without what was added.

    Args:
        now: of the model as it is.
        without: without the effects that were added to the base model; None where there are none.
        left_out: their labels.
    """
    head = {
        "kind": "replay",
        "run": now.run,
        "units": RESPONSES,
        "measured": now.measured,
        "now": now.responses,
        "without": None if without is None else without.responses,
        "left_out": left_out,
    }
    return frame(head, _channels(now))


def watched_frame(watched: RunReplay) -> bytes:
    """Pack the replay of a run whose channels somebody looks at."""
    return frame({"kind": "watched", "run": watched.run}, _channels(watched))


def shown_answer(job: str, answer: Any) -> Mapping[str, Any] | bytes | None:
    """Return what pages are shown of an answer of `jobs.SHOWN`; None where it has nothing to show."""
    if job == "system":
        return {"kind": "system", "errors": answer}
    if isinstance(answer, str):
        return {"kind": "no replay", "words": answer}
    if job == "replay":
        return replay_frame(*answer)
    return None if answer is None else watched_frame(answer)


def _channels(replayed: RunReplay) -> dict[str, Any]:
    record = replayed.record
    return {"time": record.time, **{f"channel:{n}": v for n, v in record.channels.items()}}
