"""What every effect would change in a planned test, as products motion by motion: all that twins are drawn from."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.campaign import Campaign
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.estimation.objective import make_objective
from slipwise.evidence.statistics import Statistics
from slipwise.model import Model
from slipwise.relations.parameters import Term, make_terms
from slipwise.relations.run_data import fit_runs
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.candidates import list_candidates
from slipwise.selection.columns import CandidateColumn, compute_raw_columns, is_curved, list_forms
from slipwise.selection.columns_at_limits import compute_columns_at_limits
from slipwise.selection.hypothesis import make_base_hypothesis
from slipwise.selection.linearisation import Linearisation, linearise
from slipwise.selection.proposals import bring_to_units, find_runs_of_most
from slipwise.selection.statistics import compute_statistics
from slipwise.selection.units import compute_units


@dataclass(frozen=True)
class PlannedColumns:
    """A planned test with all gauges that are considered.

    Attributes:
        base: the fit of the model to what it would record.
        relations: names, in the order of the products.
        terms: what may be missing.
        columns: of these, in units of materiality; without their rows.
        by_motion: products of every motion.
        tolerances: of base numbers, as for `compute_posterior`.
        untestable: effect -> why these motions and gauges cannot test it.
    """

    base: BaseFit
    relations: tuple[str, ...]
    terms: tuple[Term, ...]
    columns: tuple[CandidateColumn, ...]
    by_motion: tuple[Statistics, ...]
    tolerances: Mapping[int, tuple[float, float]]
    untestable: Mapping[str, str]


def compute_planned_columns(campaign: Campaign, model: Model, tell: Callable[[str, float], None]) -> PlannedColumns:
    """Fit a planned test and hold every effect against it, at the size that is one limit of materiality.

    Args:
        campaign: of `replay_planned`.
        model: that was replayed.
        tell: called with what is being done and the share done.

    Raises:
        InputError: the gauges or the motions are not enough for a fit.
    """
    tell("fitting what would be recorded", 0.0)
    base = fit_base(campaign, model)
    terms, untestable = list_candidates(base)
    rows = make_averaged_rows(base.objective)
    tell("putting in every effect", 0.2)
    forms = list_forms(base, terms)
    raw = compute_raw_columns(base, forms, rows)
    tell("replaying every effect at the limit of materiality", 0.5)
    most = find_runs_of_most(raw, rows)
    units = compute_units(base, terms, (), campaign.materiality, most)
    curved = {t.label: t for t in terms if is_curved(base, t)}
    at_limits, moved = compute_columns_at_limits(base, [*curved.values()], units, rows, campaign.materiality, most)
    raw, units = [*(c for c in raw if c.label not in curved), *at_limits], {**units, **moved}
    tell("products", 0.9)
    here = linearise(base, make_base_hypothesis(base), rows, bring_to_units(raw, units, rows), campaign.materiality)
    bare = tuple(replace(c, column=c.column[:0]) for c in here.columns)
    known = {c.label for c in here.columns}
    silent = {t.effect.name for t in terms} - {t.effect.name for t in terms if t.label in known}
    untestable = {**untestable, **dict.fromkeys(sorted(silent), "changes nothing in these motions")}
    return PlannedColumns(base, rows.relations, tuple(terms), bare, _split_by_motion(here), here.tolerances, untestable)


def _split_by_motion(here: Linearisation) -> tuple[Statistics, ...]:
    """Return the products of every run by itself."""
    rows, out = here.rows, []
    whole = np.maximum(np.bincount(rows.relation, minlength=len(rows.relations)), 1)
    for run in np.unique(rows.run):
        at = np.flatnonzero(rows.run == run)
        share = np.bincount(rows.relation[at], minlength=len(rows.relations)) / whole
        own = replace(
            rows, relation=rows.relation[at], run=rows.run[at], sigma=rows.sigma[at], samples=rows.samples * share
        )
        columns = [replace(c, column=c.column[at]) for c in here.columns]
        out.append(compute_statistics(own, here.left[at], here.fitted[at], here.slopes[at], here.of_base, columns))
    return tuple(out)


def add_motions(parts: Sequence[Statistics]) -> Statistics:
    """Return the products of several motions together."""
    first = parts[0]
    return replace(
        first,
        products=sum(p.products for p in parts),
        pulls=sum(p.pulls for p in parts),
        squares=sum(p.squares for p in parts),
        fitted=sum(p.fitted for p in parts),
        rows=sum(p.rows for p in parts),
        samples=sum(p.samples for p in parts),
    )


@dataclass(frozen=True)
class Allowed:
    """What some of the gauges allow.

    Attributes:
        relations: places of the relations.
        columns: places of the columns.
    """

    relations: tuple[int, ...]
    columns: tuple[int, ...]


def find_allowed(planned: PlannedColumns, channels: Sequence[str]) -> Allowed:
    """Return which relations and columns some of the gauges allow.

    What they would lose beside whole relations, such as a slip velocity that is made without accelerometers, is not
    counted.

    Args:
        planned: with all gauges that are considered.
        channels: of those that are bolted on.

    Raises:
        InputError: they are not enough for a fit.
    """
    base = planned.base
    run = base.campaign.runs[-1]
    kept = {c: values for c, values in run.record.channels.items() if c in channels}
    campaign = replace(base.campaign, runs=(replace(run, record=replace(run.record, channels=kept)),))
    objective = make_objective(fit_runs(campaign), base.model.specimen, make_terms(base.model))
    allowed = {t.label for t in list_candidates(replace(base, campaign=campaign, objective=objective))[0]}
    relations = (k for k, name in enumerate(planned.relations) if name in objective.relations)
    return Allowed(tuple(relations), tuple(k for k, c in enumerate(planned.columns) if c.label in allowed))
