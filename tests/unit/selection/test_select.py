"""From a campaign to what the posterior names, on sliders that take seconds."""

from pathlib import Path

import pytest

from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.diagnose import diagnose
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import fit_prepared
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.candidates import list_candidates
from slipwise.selection.columns import compute_raw_columns, list_forms
from slipwise.selection.importance import choose_shown
from slipwise.selection.units import compute_units
from slipwise_benchmarks import make_bearing


def test_nothing_is_named_where_nothing_is(tmp_path: Path) -> None:
    """A spring that meets a wall is named in tests/recover/test_rewritten_campaigns.py, however it is written."""
    make_bearing(tmp_path / "flat", "flat", 54303)
    found = diagnose(tmp_path / "flat")
    assert not found.verdict.effects
    assert found.final_error < 1.2


def test_units_are_shares_of_the_limit_and_columns_belong_to_them(tmp_path: Path) -> None:
    make_bearing(tmp_path / "pendulum", "pendulum", 54300)
    prepared = prepare(tmp_path / "pendulum")
    base = fit_prepared(prepared)
    terms = [t for t in list_candidates(base)[0] if not t.effect.replaces][:6]
    limits = prepared.recorded.materiality
    usual = compute_units(base, terms, [], limits, {})
    half = Materiality(limits.channel / 2.0, limits.response / 2.0, limits.gauge / 2.0)
    strict = compute_units(base, terms, [], half, {})
    assert usual.keys() == strict.keys()
    for key, moved in usual.items():
        assert strict[key].share == pytest.approx(2.0 * moved.share, rel=1e-6, abs=1e-12)
        assert strict[key].responses == moved.responses, "what a size moves does not depend on what matters"
    rows = make_averaged_rows(base.objective)
    columns = compute_raw_columns(base, list_forms(base, terms), rows)
    assert {c.label for c in columns} <= {t.label for t in terms}
    assert all(len(c.column) == len(rows.relation) for c in columns)
    assert choose_shown(base) in range(len(base.objective.runs))
