"""What the page is told: the campaign once, the state after every step; SI, with the units that people read."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from slipwise.channels import channel
from slipwise.comparison.component_level import NAMES
from slipwise.effects import catalogue
from slipwise.noise.level import AT_FLOOR
from slipwise.preparation.gauge_groups import find_places_of_gauges
from slipwise.relations.parameters import Free
from slipwise.selection.candidates import list_candidates
from slipwise.session.session import Session
from slipwise.session.state import SessionState
from slipwise.units import parse_unit
from slipwise.view.words.limit_words import limit_sentence
from slipwise.view.words.number_names import called
from slipwise.view.words.numbers import usual_unit


def campaign_told(session: Session) -> dict[str, Any]:
    """Tell what does not change while a session is open: runs, balances, effects and whether they can be tested."""
    ready, record = session.ready, session.ready.runs[0].record
    testable, cannot = list_candidates(ready.as_fit(session.state))
    names = {term.effect.name for term in testable}
    objective = ready.objective(session.state)
    return {
        "kind": "campaign",
        "name": session.campaign.name,
        "rig": session.campaign.rig,
        "notes": [*ready.prepared.campaign.notes, *(one.words for one in session.corrections), *session.notes],
        "runs": [{"name": r.name, "role": r.role, "seconds": float(r.time[-1] - r.time[0])} for r in ready.runs],
        "relations": {r: {"name": NAMES[r][0], "unit": _unit(NAMES[r][1])} for r in objective.relations},
        # where no pad's friction was measured, what all bearings carry together stands in its place
        "pads": list(ready.runs[0].pads) if ready.runs[0].forces_measured else [],
        "pad_unit": _unit(NAMES["pads"][1]),
        "pad_area": objective.specimen.pad_area,
        "channels": {name: {"unit": _shown(channel(name).unit, channel(name).shown_in)} for name in record.channels},
        "effects": [
            {
                "name": effect.name,
                "component": effect.component,
                "summary": effect.summary,
                "equation": effect.equation,
                "signature": effect.signature,
                "base": effect.base,
                "targets": list(find_places_of_gauges(effect, record)) if effect.target else [],
                "cannot": "" if effect.name in names or effect.base else cannot.get(effect.name, ""),
            }
            for effect in catalogue().values()
            if not effect.in_samples and effect.base != "springs"
        ],
        "at_floor": AT_FLOOR,
        "models": [path.name for path in other_models(session)],
    }


def state_told(session: Session) -> dict[str, Any]:
    """Tell the state, and where it stands in the history."""
    state, history = session.state, session.history
    return {
        "kind": "state",
        "words": state.words,
        "fitted": state.fitted,
        "accepted": session.accepted and state == session.reference,
        "effects": [{"name": t.effect.name, "label": t.label, "group": t.group} for t in state.terms],
        "own": [
            {"name": t.effect.name, "summary": t.effect.summary, "equation": t.effect.equation}
            for t in state.terms
            if t.effect.name not in catalogue()
        ],
        "numbers": [_number(session, free) for free in session.ready.free(state)],
        "errors": errors_told(session, state),
        "undo": state.words if history.before else "",
        "redo": history.after.words if history.after else "",
        "findings": dict(session.findings),
        "limits": _limits(session),
    }


def _limits(session: Session) -> dict[str, str]:
    """Tell how large each effect can be that the last diagnosis of this model has not named, in words."""
    last = session.findings.get("explain") or {}
    if last.get("of") != [t.label for t in session.state.terms]:
        return {}
    return {name: limit_sentence(catalogue().get(name), one) for name, one in last.get("limits", {}).items()}


def errors_told(session: Session, state: SessionState, beside: SessionState | None = None) -> list[dict[str, Any]]:
    """Tell the error of every balance of a state, of the reference, and of another model if one stands beside."""
    before = {e.relation: e for e in session.errors(session.reference)}
    other = {e.relation: e for e in session.errors(beside)} if beside is not None else {}
    out = []
    for now in session.errors(state):
        row: dict[str, Any] = {"relation": now.relation, "name": now.name, "runs": dict(now.runs)}
        for key, found in (("now", now), ("before", before.get(now.relation)), ("beside", other.get(now.relation))):
            if found is not None:
                row[key] = {"fitted": found.fitted, "held_out": found.held_out}
        out.append(row)
    return out


def other_models(session: Session) -> list[Path]:
    """Return the model files of the campaign's folder: what may stand beside; a link that leads out of it may not."""
    folder = session.place.path
    files = sorted(p for p in folder.glob("*.toml") if p.name != "campaign.toml" and p.is_file())
    return [p for p in files if p.resolve().is_relative_to(folder)]


def _number(session: Session, free: Free) -> dict[str, Any]:
    state = session.state
    label, _, name = free.key.rpartition(".")
    term = state.term(label)
    if term is None:
        words, unit = called(free.key, free.unit)
        neutral = None
    else:
        parameter = term.effect.parameter(name)
        words, unit, neutral = parameter.meaning, parameter.shown_in or usual_unit(free.unit), parameter.neutral
    known = state.known.get(free.key)
    return {
        "key": free.key,
        "label": label,
        "name": words,
        "unit": _shown(free.unit, unit),
        "low": free.low,
        "high": free.high,
        "neutral": neutral,
        "value": state.values[free.key],
        "known": None if known is None else [known.low, known.high, known.bound, known.limit],
        "before": session.reference.values.get(free.key),
    }


def _unit(unit: str) -> dict[str, Any]:
    return _shown(unit, usual_unit(unit))


def _shown(unit: str, usual: str) -> dict[str, Any]:
    """Tell a unit in SI and as people read it, with the factor between; a temperature stays in kelvin."""
    if usual == "degC":
        usual = unit
    return {"si": unit, "usual": usual, "factor": parse_unit(usual, unit, "unit")}


def progress_told(job: str, words: str, share: float, seconds: float, *, aside: bool) -> Mapping[str, Any]:
    """Tell how far a piece of work is; `aside` if nobody has asked for it."""
    return {"kind": "progress", "job": job, "words": words, "share": share, "seconds": seconds, "aside": aside}
