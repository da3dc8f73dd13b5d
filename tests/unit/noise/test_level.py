"""One level says when an error is at the noise floor: how well the noise itself is known from the fewest rests."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import detrend
from scipy.stats import norm

import slipwise
from slipwise.noise.gauges import ENOUGH
from slipwise.noise.level import AT_FLOOR, is_at_floor

SOURCE = Path(slipwise.__file__).parent


def test_the_level_is_how_far_noise_may_exceed_what_the_fewest_samples_at_rest_show_of_it():
    assert pytest.approx(1.0 + norm.ppf(0.95) / np.sqrt(2.0 * (ENOUGH - 2)), abs=0.005) == AT_FLOOR


def test_a_perfect_model_is_above_it_in_one_case_of_twenty_where_rests_are_as_short_as_they_may_be():
    rests = detrend(np.random.default_rng(1).standard_normal((4000, ENOUGH)), axis=1)
    measured = np.sqrt(np.sum(rests**2, axis=1) / (ENOUGH - 2))
    above = np.mean([not is_at_floor(1.0 / level) for level in measured])
    assert 0.03 < above < 0.09


def test_an_unknown_error_is_not_at_the_floor():
    assert not is_at_floor(float("nan"))


def test_the_page_has_no_level_of_its_own():
    typed = re.compile(rf"(?<![\d.]){AT_FLOOR:g}(?!\d)")
    pages = [p for p in (SOURCE / "workbench" / "static").glob("*.js") if not p.name.endswith(".min.js")]
    assert pages and not [p.name for p in pages if typed.search(p.read_text(encoding="utf-8"))]
