"""Heavy work of the workbench, as it is done in the worker: a state comes in, plain data or arrays go out."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from slipwise.comparison.compare import compare
from slipwise.design.next_test import next_test
from slipwise.diagnosis.diagnose import diagnose
from slipwise.discovery.discover import diagnose_with_law, discover
from slipwise.errors import InputError
from slipwise.session.changes import without_additions
from slipwise.session.findings import discovered, explained
from slipwise.session.fitting import Progress, fit_state
from slipwise.session.responses import RunReplay, replay_errors
from slipwise.session.session import Session
from slipwise.session.state import SessionState, as_json
from slipwise.view.files import save_page
from slipwise.view.pages.compare_page import compare_page
from slipwise.view.pages.diagnosis_page import diagnosis_page
from slipwise.view.pages.why_not_section import why_not_anchor
from slipwise.view.words.why_not_words import why_not_words

#: Pages that the workbench writes, beside its snapshot.
REPORT, DIAGNOSIS = "report.html", "diagnosis.html"


@dataclass(frozen=True)
class Task:
    """What a piece of work is done with.

    Attributes:
        session: opened in the worker.
        state: of the model, as it was when the work began.
        run: name, for work on one run.
    """

    session: Session
    state: SessionState
    run: str = ""


Job = Callable[[Task, Progress], Any]


def _fit(task: Task, tell: Progress) -> dict[str, Any]:
    return as_json(fit_state(task.session.ready, task.state, tell))


def _replay(task: Task, tell: Progress) -> tuple[RunReplay, RunReplay | None, list[str]] | str:
    """Replay the held-out run with and without what was added; why not, where there is nothing to replay."""
    tell("replaying the held-out run", 0.0)
    plain = without_additions(task.session.ready, task.state)
    try:
        now = task.session.replay(task.state)
        tell("replaying it without what was added", 0.5)
        without = None if plain == task.state else task.session.replay(plain)
    except InputError as error:
        return str(error)
    return now, without, [label for label in task.state.labels if label not in plain.labels]


def _watch(task: Task, tell: Progress) -> RunReplay | None:
    """Replay the run that somebody looks at."""
    tell(f"replaying {task.run}", 0.0)
    try:
        return task.session.replay(task.state, task.run)
    except InputError:
        return None


def _system(task: Task, tell: Progress) -> dict[str, float]:
    words = "how far replays are from the measurement"
    tell(words, 0.0)
    try:
        return replay_errors(task.session.ready, task.state, lambda share: tell(words, share))
    except InputError:
        return {}


def _locate(task: Task, tell: Progress) -> dict[str, Any]:
    """Say what the instruments tell, and where the model fails."""
    found = compare(task.session.ready.prepared, task.session.ready.model_of(task.state), system=False, progress=tell)
    relation, error = found.worst
    return {
        "of": list(task.state.labels),
        "instruments": found.checks.words,
        "accused": found.checks.accused,
        "worst": relation,
        "error": error,
        "places": [{"relation": p.relation, "words": p.words, "error": p.error} for p in found.places],
        "cannot": list(found.cannot),
    }


def _report(task: Task, tell: Progress) -> dict[str, Any]:
    """Write the report of the comparison, replays included."""
    found = compare(
        task.session.ready.prepared, task.session.ready.model_of(task.state), progress=lambda w, s: tell(w, 0.8 * s)
    )
    tell("drawing the report", 0.8)
    save_page(compare_page(found), task.session.place.session_folder() / REPORT)
    return {"of": list(task.state.labels), "file": REPORT}


def _explain(task: Task, tell: Progress) -> dict[str, Any]:
    """Say what is missing, and write the page that says why."""
    model = task.session.ready.model_of(task.state)
    found = diagnose_with_law(task.session.ready.prepared, model, progress=lambda w, s: tell(w, 0.9 * s))
    tell("drawing the report", 0.9)
    save_page(diagnosis_page(found, found.ladder()), task.session.place.session_folder() / DIAGNOSIS)
    rivals = [
        {"effect": one.effect, "words": why_not_words(one), "file": f"{DIAGNOSIS}#{why_not_anchor(one.effect)}"}
        for one in found.explain_rivals()
    ]
    return {**explained(found, task.state.labels), "file": DIAGNOSIS, "rivals": rivals}


def _discover(task: Task, tell: Progress) -> dict[str, Any]:
    found = discover(task.session.ready.prepared, task.session.ready.model_of(task.state), progress=tell)
    return discovered(found, task.session.place.session_folder(), task.state.labels)


def _next(task: Task, tell: Progress) -> dict[str, Any]:
    """Say which motion would tell most."""
    model = task.session.ready.model_of(task.state)
    found = diagnose(task.session.ready.prepared, model, progress=lambda w, s: tell(w, 0.6 * s))
    try:
        ranked = next_test(found, progress=lambda w, s: tell(w, 0.6 + 0.4 * s))
    except InputError as error:
        return {"of": list(task.state.labels), "words": str(error)}
    return {"of": list(task.state.labels), "words": " ".join(filter(None, [ranked.sentence, ranked.words]))}


#: Work whose answers pages are shown, and nobody keeps.
SHOWN = ("replay", "watch", "system")
#: Name -> work. What "fit" and "replay" answer is no finding: it is taken into the task.session, or shown.
JOBS: dict[str, Job] = {
    "fit": _fit,
    "replay": _replay,
    "watch": _watch,
    "system": _system,
    "locate": _locate,
    "report": _report,
    "explain": _explain,
    "discover": _discover,
    "next": _next,
}
