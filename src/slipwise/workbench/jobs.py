"""Heavy work of the workbench, as it is done in the worker: a state comes in, plain data or arrays go out."""

from collections.abc import Callable
from typing import Any

from slipwise.comparison.compare import compare
from slipwise.diagnosis.diagnose import diagnose
from slipwise.discovery.discover import diagnose_with_law, discover
from slipwise.errors import InputError
from slipwise.experiment.next_test import next_test
from slipwise.session.changes import without_additions
from slipwise.session.findings import discovered, explained
from slipwise.session.fitting import Progress, fit_state
from slipwise.session.responses import HeldOutReplay, replay_held_out
from slipwise.session.session import Session
from slipwise.session.state import State, as_json
from slipwise.view.compare_page import compare_page
from slipwise.view.diagnosis_page import diagnosis_page
from slipwise.view.files import save_page

#: Pages that the workbench writes, beside its snapshot.
REPORT, DIAGNOSIS = "report.html", "diagnosis.html"
Job = Callable[[Session, State, Progress], Any]


def _fit(session: Session, state: State, tell: Progress) -> dict[str, Any]:
    return as_json(fit_state(session.ready, state, tell))


def _replay(
    session: Session, state: State, tell: Progress
) -> tuple[HeldOutReplay, HeldOutReplay | None, list[str]] | str:
    """Replay with and without what was added; why not, where there is nothing to replay."""
    tell("replaying the held-out run", 0.0)
    plain = without_additions(session.ready, state)
    try:
        now = replay_held_out(session.ready, state)
        tell("replaying it without what was added", 0.5)
        without = None if plain == state else replay_held_out(session.ready, plain)
    except InputError as error:
        return str(error)
    return now, without, [label for label in state.labels if label not in plain.labels]


def _locate(session: Session, state: State, tell: Progress) -> dict[str, Any]:
    """Say what the instruments tell, and where the model fails."""
    found = compare(session.campaign, session.ready.model_of(state), system=False, progress=tell)
    relation, error = found.worst
    return {
        "of": list(state.labels),
        "instruments": found.checks.words,
        "accused": found.checks.accused,
        "worst": relation,
        "error": error,
        "places": [{"relation": p.relation, "words": p.words, "error": p.error} for p in found.places],
        "cannot": list(found.cannot),
    }


def _report(session: Session, state: State, tell: Progress) -> dict[str, Any]:
    """Write the report of the comparison, replays included."""
    found = compare(session.campaign, session.ready.model_of(state), progress=lambda w, s: tell(w, 0.8 * s))
    tell("drawing the report", 0.8)
    save_page(compare_page(found), session.folder / REPORT)
    return {"of": list(state.labels), "file": REPORT}


def _explain(session: Session, state: State, tell: Progress) -> dict[str, Any]:
    """Say what is missing, and write the page that says why."""
    model = session.ready.model_of(state)
    found = diagnose_with_law(session.campaign, model, progress=lambda w, s: tell(w, 0.9 * s))
    tell("drawing the report", 0.9)
    save_page(diagnosis_page(found, found.ladder()), session.folder / DIAGNOSIS)
    return {**explained(found, state.labels), "file": DIAGNOSIS}


def _discover(session: Session, state: State, tell: Progress) -> dict[str, Any]:
    found = discover(session.campaign, session.ready.model_of(state), progress=tell)
    return discovered(found, session.folder, state.labels)


def _next(session: Session, state: State, tell: Progress) -> dict[str, Any]:
    """Say which motion would tell most."""
    model = session.ready.model_of(state)
    found = diagnose(session.campaign, model, progress=lambda w, s: tell(w, 0.6 * s))
    try:
        ranked = next_test(found, progress=lambda w, s: tell(w, 0.6 + 0.4 * s))
    except InputError as error:
        return {"of": list(state.labels), "words": str(error)}
    return {"of": list(state.labels), "words": " ".join(filter(None, [ranked.sentence, ranked.words]))}


#: Name -> work. What "fit" and "replay" answer is no finding: it is taken into the session, or shown.
JOBS: dict[str, Job] = {
    "fit": _fit,
    "replay": _replay,
    "locate": _locate,
    "report": _report,
    "explain": _explain,
    "discover": _discover,
    "next": _next,
}
