"""A table that moves along x alone: vertical accelerometers show next to nothing but their noise, and are no fault."""

from dataclasses import replace

import pytest

from slipwise.instruments.audit import audit
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.mark.parametrize(("seed", "rig"), [(7, "bridge2"), (13, "bridge2"), (34, "bridge1")])
def test_nobody_is_accused_and_gauges_that_show_only_noise_have_no_gain(seed: int, rig: str) -> None:
    made = as_campaign(build_campaign(seed, effects=("heating",), size="large", rig=rig))
    along = replace(made, runs=tuple(run for run in made.runs if run.name == "quake_h"))
    found = audit(along)
    assert not found.findings
    assert "gain of table_az, girder_az: in these runs there is more noise than signal in it" in found.cannot
    shaken = audit(replace(made, runs=tuple(run for run in made.runs if run.name == "quake_hv")))
    assert not any("noise" in words for words in shaken.cannot)
