"""Intervals of named effects are as wide as laws of another form ask for, and no wider than what can be."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.diagnosis.reported_sizes import list_named_sizes
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import compute_intervals
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis, polish, refit
from slipwise.selection.hypothesis_fit import make_fit
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def fitted() -> tuple[Hypothesis, BaseFit]:
    made = build_campaign(42016, effects=("buffer_height",), size="medium", rig="bridge1")
    base = fit_base(as_campaign(made))
    term = Term(catalogue()["buffer_height"])
    found = polish(refit(base, [term], {term.label: term.effect.typical()}))
    return found, make_fit(base, found)


def test_an_interval_is_wider_than_that_of_a_true_law(fitted: tuple[Hypothesis, BaseFit]) -> None:
    found, fit = fitted
    key = "buffer_height.height"
    true = next(i for i in compute_intervals(fit).entries if i.key == key)
    wide = list_named_sizes(found, compute_intervals(fit).entries)[key]
    half = np.hypot(1.5 * (true.high - true.value), 0.02 * true.value)
    assert wide.value == true.value
    assert wide.high - wide.value == pytest.approx(half) == wide.value - wide.low
    assert set(list_named_sizes(found, compute_intervals(fit).entries)) == {key}, "numbers of the rig are not named"


def test_an_interval_ends_where_a_parameter_does(fitted: tuple[Hypothesis, BaseFit]) -> None:
    found, fit = fitted
    value = found.solution.values["buffer_height.height"]
    close = tuple(replace(f, high=1.001 * value) if f.key.startswith("buffer_height") else f for f in fit.free)
    solution = replace(found.solution, free=close)
    narrowed = compute_intervals(replace(fit, solution=replace(fit.solution, free=close))).entries
    narrow = list_named_sizes(replace(found, solution=solution), narrowed)
    assert narrow["buffer_height.height"].high == pytest.approx(1.001 * value)


def test_without_a_fit_of_its_own_a_size_has_no_interval(fitted: tuple[Hypothesis, BaseFit]) -> None:
    only = list_named_sizes(fitted[0], ())["buffer_height.height"]
    assert np.isnan(only.low) and np.isnan(only.high) and only.value > 0.0
