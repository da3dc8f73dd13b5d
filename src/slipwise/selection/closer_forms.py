"""Forms about the best one of a law that acts at a place or a frequency, and of a gauge's lag."""

from collections.abc import Mapping

import numpy as np

from slipwise.evidence.posterior import Posterior
from slipwise.evidence.prior import OF_MODEL, Prior
from slipwise.relations.parameters import Term
from slipwise.selection.columns import FULL_SIZES, CandidateColumn, CandidateForm
from slipwise.selection.initial_grid import REFERENCES, is_lag, is_placed, is_resonance
from slipwise.selection.linearisation import Linearisation
from slipwise.selection.sensitivities import typical

#: A form is looked at more closely where it would explain so much [nats].
_WORTH_A_LOOK = 0.5


def list_closer_forms(
    here: Linearisation, of: Mapping[str, Term], posterior: Posterior, finer: tuple[float, float]
) -> list[CandidateForm]:
    """Return forms about the best one of every law that acts at a place or a frequency, and of every lag of a gauge.

    From afar a place or a frequency is hardly seen, and a lag is no straight line. A resonance is looked for beside
    what is believed and alone: a part of the girder that swings below the frequencies of a quake is first taken for a
    gain of its accelerometer, and beside that no frequency near its own explains anything.

    Args:
        here: a linearisation.
        of: label -> candidate.
        posterior: at it.
        finer: factors by which place or frequency, and width, are moved.
    """
    out: list[CandidateForm] = []
    for term in of.values():
        members = _list_forms_of(here, term)
        if not members or not (is_placed(term.effect) or is_lag(term.effect)):
            continue
        number = max(here.columns[i].form for i in members)
        top = max(members, key=lambda i: posterior.gain[i])
        alone = list_best_alone(here, term, posterior)
        beside = [top] if posterior.gain[top] >= _WORTH_A_LOOK and top not in alone else []
        closer = [x for i in beside for x in _closer_to(term, here.columns[i], finer)]
        closer += [x for i in alone for x in _closer_to(term, here.columns[i], finer, jointly=True)]
        out += [CandidateForm(term, number + k, values, size) for k, (values, size) in enumerate(closer, 1)]
    return out


def list_best_alone(here: Linearisation, term: Term, posterior: Posterior) -> list[int]:
    """Return the places of a resonance's columns that explain most alone, one for each set of constants no fit changes.

    What explains less than an effect costs is none of them.
    """
    if not is_resonance(term.effect):
        return []
    whole = [p.name for p in term.effect.parameters if p.whole]
    best: dict[tuple[float, ...], int] = {}
    for i in sorted(_list_forms_of(here, term), key=lambda i: posterior.alone[i]):
        best[tuple(here.columns[i].values[name] for name in whole)] = i
    return [i for i in best.values() if posterior.alone[i] >= Prior().cost_of_effect]


def _list_forms_of(here: Linearisation, term: Term) -> list[int]:
    """Return the places of the columns of a term's strengths that are in no model yet."""
    return [i for i, c in enumerate(here.columns) if c.label == term.label and c.form != OF_MODEL and c.strength]


def _closer_to(
    term: Term, best: CandidateColumn, finer: tuple[float, float], *, jointly: bool = False
) -> list[tuple[dict[str, float], float]]:
    """Return constants and size [typical strength] of forms about one.

    Args:
        term: the candidate.
        best: the form.
        finer: as of `list_closer_forms`.
        jointly: move frequency and damping together too, and the frequency by half the width of the resonance at most:
            where it is, is found only with how wide it is.
    """
    constants = {p.name: p for p in term.effect.parameters if p.neutral is None}
    centre = {name: best.values[name] for name in constants}
    if is_lag(term.effect):
        size = _size_of(term, best)
        return [(centre, x) for x in (FULL_SIZES if abs(size) < 1.0 else (size / finer[1], size * finer[1]))]
    free = [p for p in constants.values() if not p.whole and p.name not in REFERENCES]
    steps = {p.name: finer[0] if p.unit == "Hz" or p.low < 0.0 < p.high else finer[1] for p in free}
    if jointly and "damping" in centre:
        steps |= {p.name: min(steps[p.name], 1.0 + centre["damping"]) for p in free if p.unit == "Hz"}
    moved = [{p: x} for p in free for x in (1.0 / steps[p.name], steps[p.name])]
    if jointly:
        pairs = [(p, q) for p in free for q in free if p.unit == "Hz" and q.name == "damping"]
        moved += [
            {p: x, q: y}
            for p, q in pairs
            for x in (1.0 / steps[p.name], steps[p.name])
            for y in (1.0 / steps[q.name], steps[q.name])
        ]
    out: list[tuple[dict[str, float], float]] = []
    for together in moved:
        values = centre | {p.name: float(np.clip(centre[p.name] * x, p.low, p.high)) for p, x in together.items()}
        if all(values[p.name] != centre[p.name] for p in together):
            out.append((values, 0.0))
    return out


def _size_of(term: Term, column: CandidateColumn) -> float:
    """Return the strength at which a column was taken [typical strength]."""
    p = term.effect.parameter(column.strength)
    return (column.values[p.name] - column.neutral) / (typical(term.effect, p) - column.neutral)
