"""The logger's filter, where nobody knows it, is read from the reversals."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bench import build_campaign
from bench.truth import Truth
from bench.write import write_campaign
from slipwise.campaign import load_campaign
from slipwise.diagnosis.selection import _speaks_at_reversals
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import fit_base
from slipwise.estimation.logger_filter import _frequencies, _levelled
from slipwise.estimation.parameters import Term
from slipwise.estimation.run_data import fit_runs
from slipwise.signals import LowPass


def heard_and_true(folder: Path, seed: int, effect: str, size: str, rig: str) -> tuple[LowPass, Truth]:
    """Give the filter that is found in a campaign that does not say its own, and what it was."""
    made = build_campaign(seed, effects=(effect,), size=size, rig=rig)
    write_campaign(folder, made.truth.rig, replace(made.truth.logger, stated=False), made.recorded)
    found = fit_base(load_campaign(folder)).campaign.logger.every
    assert found is not None
    return found, made.truth


@pytest.mark.slow
def test_an_unknown_filter_is_found_within_ten_percent(tmp_path):
    found, truth = heard_and_true(tmp_path, 71002, "buffer_hardening", "medium", "bridge2")
    assert found.frequency == pytest.approx(truth.logger.lowpass, rel=0.10)
    assert found.phase.replace("aligned", "causal") == truth.logger.phase


@pytest.mark.slow
def test_friction_that_heats_up_does_not_bend_the_filter_that_is_heard(tmp_path):
    found, truth = heard_and_true(tmp_path, 71021, "heating", "large", "bridge1")
    assert found.frequency == pytest.approx(truth.logger.lowpass, rel=0.10)


def test_a_gain_that_wanders_and_an_offset_are_levelled_away(tmp_path):
    made = build_campaign(71002, size="medium", rig="bridge1")
    write_campaign(tmp_path, made.truth.rig, made.truth.logger, made.recorded)
    run = fit_runs(load_campaign(tmp_path))[0]
    wandering = 1.0 + 0.2 * run.time[:, None] / run.time[-1]
    level = _levelled(replace(run, force=wandering * run.force + 500.0), run.force)
    kept = run.judged["pads"]
    assert np.std((level.force - run.force)[kept]) < 0.02 * np.std(run.force[kept])


def test_what_goes_by_speed_or_lags_speaks_at_reversals_and_what_only_wanders_does_not():
    said = {name for name, effect in catalogue().items() if _speaks_at_reversals(Term(effect))}
    assert {"breakaway", "rate_and_state", "presliding", "channel_delay", "channel_filter", "clock_skew"} <= said
    assert not {"heating", "run_in", "uneven_seating", "buffer_damping", "channel_gain", "girder_bending"} & said


@pytest.mark.parametrize("rate", [50.0, 100.0, 200.0, 500.0])
def test_there_are_filters_to_begin_with_at_every_rate_of_sampling(rate):
    begun = _frequencies(0.48 * rate)
    assert len(begun) > 1 and max(begun) < 0.48 * rate
