"""Columns of effects that are no straight line from zero, taken at the size that is one limit of materiality.

A girder that friction holds until its buffers are unlike enough turns far less at half a size than half as much.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from slipwise.campaign.materiality import Materiality
from slipwise.estimation.base_fit import BaseFit
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn, CandidateForm, compute_raw_columns, is_curved
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.initial_grid import shapes, strengths
from slipwise.selection.proposals import bring_to_units, find_runs_of_most
from slipwise.selection.search_state import Search
from slipwise.selection.sensitivities import small, typical
from slipwise.selection.units import Moved, compute_moved_by_sizes
from slipwise.selection.weighed_model import WeighedModel, keep_weighed_model

#: Replays by which the size that is one limit is found, and by how much one of them may enlarge a size at most [1].
_STEPS_TO_LIMIT, _LARGEST_STEP = 2, 10.0


def compute_columns_at_limits(
    here: BaseFit,
    terms: Sequence[Term],
    units: Mapping[tuple[str, str], Moved],
    rows: AveragedRows,
    limits: Materiality,
    most: Mapping[str, int],
) -> tuple[list[CandidateColumn], dict[tuple[str, str], Moved]]:
    """Return the columns of effects by the step that is one limit, and what that step moves.

    Args:
        here: the fit from which the candidates depart.
        terms: these effects.
        units: (label, strength) -> what a small step moves.
        rows: how residuals are averaged.
        limits: what matters.
        most: as of `compute_units`.
    """
    asked = [(t, p, float(p.neutral or 0.0)) for t in terms for p in strengths(t.effect) if (t.label, p.name) in units]
    values = [small(t.effect, shapes(t.effect)[0], p) for t, p, _ in asked]
    found = [units[t.label, p.name] for t, p, _ in asked]
    for _ in range(_STEPS_TO_LIMIT):
        for (_, p, off), v, one in zip(asked, values, found, strict=True):
            step = (v[p.name] - off) / max(one.share, 1.0 / _LARGEST_STEP)
            v[p.name] = float(np.clip(off + step, p.low, p.high))
        found = compute_moved_by_sizes(here, [(t, v) for (t, _, _), v in zip(asked, values, strict=True)], limits, most)
    sizes = [(v[p.name] - off) / (typical(t.effect, p) - off) for (t, p, off), v in zip(asked, values, strict=True)]
    forms = [CandidateForm(t, k, shapes(t.effect)[0], sizes[k]) for k, (t, _, _) in enumerate(asked)]
    names = {(t.label, k): p.name for k, (t, p, _) in enumerate(asked)}
    own = [c for c in compute_raw_columns(here, forms, rows) if c.strength == names[c.label, c.form]]
    return [replace(c, form=0) for c in own], {
        (t.label, p.name): one for (t, p, _), one in zip(asked, found, strict=True)
    }


def plant_at_limits(state: Search) -> WeighedModel | None:
    """Return a campaign's weighed model with these columns before all others; None where nothing was weighed.

    Args:
        state: with the columns of all candidates.
    """
    here, weighed = state.linearisation, state.weighed
    if here is None or weighed is None:
        return None
    fit, limits = make_fit(state.base, here.hypothesis, with_slopes=False), state.base.campaign.materiality
    known = {c.label for c in here.beside}
    terms = [t for t in state.terms if t.label in known and is_curved(fit, t)]
    most = find_runs_of_most(here.beside, here.rows)
    raw, moved = compute_columns_at_limits(fit, terms, weighed.units, here.rows, limits, most)
    columns = bring_to_units(raw, moved, here.rows)
    return keep_weighed_model(
        here.with_columns([*columns, *here.beside]), weighed.posterior, weighed.units, weighed.apart, len(columns)
    )
