"""An effect that is no straight line is put into twins at the size that is one limit."""

import pytest

from slipwise.estimation.base_fit import fit_base
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.candidates import list_candidates
from slipwise.selection.columns import compute_raw_columns, list_forms
from slipwise.selection.columns_at_limits import compute_columns_at_limits
from slipwise.selection.proposals import bring_to_units, find_runs_of_most
from slipwise.selection.units import compute_units
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.mark.slow
def test_unlike_buffers_are_taken_at_one_limit_where_a_straight_line_from_another_size_is_wrong() -> None:
    base = fit_base(as_campaign(build_campaign(48062, effects=(), rig="bridge1")))
    rows, limits = make_averaged_rows(base.objective), base.campaign.materiality
    term = next(t for t in list_candidates(base)[0] if t.effect.name == "buffer_mismatch")
    raw = compute_raw_columns(base, list_forms(base, [term]), rows)
    most = find_runs_of_most(raw, rows)
    units = compute_units(base, [term], (), limits, most)
    [at_limit], moved = compute_columns_at_limits(base, [term], units, rows, limits, most)
    assert moved[term.label, at_limit.strength].share == pytest.approx(1.0, rel=0.2)
    straight = bring_to_units(raw, units, rows)
    assert abs(at_limit.unit) != pytest.approx(abs(straight[0].unit), rel=0.05)
