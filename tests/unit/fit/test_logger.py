"""The logger's filter, where nobody knows it, is read from the reversals."""

from dataclasses import replace

import pytest

from bench import build_campaign
from bench.write import write_campaign
from slipwise.campaign import load_campaign
from slipwise.fit.base import fit_base


def test_an_unknown_filter_is_found_within_ten_percent(tmp_path):
    made = build_campaign(71002, effects=("buffer_hardening",), size="medium", rig="bridge2")
    write_campaign(tmp_path, made.truth.rig, replace(made.truth.logger, stated=False), made.recorded)
    found = fit_base(load_campaign(tmp_path)).campaign.logger.every
    assert found is not None
    assert found.frequency == pytest.approx(made.truth.logger.lowpass, rel=0.10)
    assert found.phase.replace("aligned", "causal") == made.truth.logger.phase
