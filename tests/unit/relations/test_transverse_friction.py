"""Friction across is held against the laws where pads have gauges for it."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.comparison.component_level import compute_component_errors
from slipwise.effects import catalogue
from slipwise.estimation.objective import make_objective
from slipwise.record import Record
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import fit_runs
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def campaign():
    return as_campaign(build_campaign(35002, effects=(), rich=True))


@pytest.mark.slow
def test_a_complete_model_leaves_noise_and_anisotropy_shows_there_only(campaign):
    fit = fit_base(campaign)
    objective = fit.objective
    assert "across" in objective.relations
    left = [part[part != 0.0] for part in fit.solution.residuals.of("across")]
    assert np.mean(np.concatenate(left) ** 2) == pytest.approx(1.0, abs=0.15)
    errors = [e for e in compute_component_errors(fit) if e.relation == "across"]
    assert len(errors) == 5 and all(0.9 < e.error < 1.1 and e.share < 0.1 for e in errors)
    term = Term(catalogue()["anisotropy"])
    moved = objective.adding(term).residuals({**fit.solution.values, f"{term.label}.ratio": 1.1})
    assert np.mean(np.concatenate(moved.of("across")) ** 2) > 5.0
    for run, part in enumerate(moved.of("pads")):
        assert part == pytest.approx(fit.solution.residuals.of("pads")[run])


def test_without_gauges_across_there_is_no_such_relation(campaign):
    def without(record: Record) -> Record:
        return Record(record.time, {n: v for n, v in record.channels.items() if not n.endswith("_Fy")})

    runs = tuple(replace(r, record=without(r.record)) for r in campaign.runs)
    plain = replace(campaign, runs=runs)
    assert "across" not in make_objective(fit_runs(plain), plain.specimen, ()).relations
