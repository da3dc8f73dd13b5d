"""A slider's friction gauge has a zero, which is nobody's effect while it is small."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.estimation.base_fit import fit_base
from slipwise.selection.candidates import list_candidates
from slipwise.selection.hypothesis import refit
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.importance import compute_importance
from slipwise_benchmarks.bearing import draw_bearing, drive_of, record, write_bearing

#: Of a friction gauge, by which offsets are told [N].
SPAN = 50e3


@pytest.mark.parametrize(("share", "matters"), [(0.01, False), (0.15, True)])
def test_beside_an_asymmetry_a_small_offset_does_not_matter(tmp_path: Path, share: float, matters: bool) -> None:
    drawn = replace(draw_bearing("flat", 4), mu_fast=0.08, mu_slow=0.024, rate=60.0)  # speed parts the two
    zero = share * drawn.mu_fast * drawn.load
    bearing = replace(drawn, zero=zero, hidden=(("direction_asymmetry", 0.06),))
    rng = np.random.default_rng(4)
    tests = {name: record(bearing, rng, drive_of(bearing, rng, 1.0, v)) for name, v in (("one", 0.01), ("two", 0.3))}
    write_bearing(tmp_path / "flat", bearing, {"one": "fit", "two": "fit"}, tests)
    base = fit_base(load_campaign(tmp_path / "flat"))
    starts = {"direction_asymmetry": {"difference": 0.06}, "channel_offset[pad_A_Fx]": {"offset": zero / SPAN}}
    terms = [t for t in list_candidates(base)[0] if t.label in starts]
    found = refit(base, terms, starts)
    importance = compute_importance(make_fit(base, found), terms, ())
    assert importance["direction_asymmetry"].channels["pad_A_Fx"] == pytest.approx(0.06, rel=0.2)
    assert bool(importance["channel_offset"].channels["pad_A_Fx"] > 0.01) == matters
