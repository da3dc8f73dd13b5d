"""What a slider can test hangs on whether its load changes, be it only from one run to the next."""

from pathlib import Path

import pytest

from measured import fit_base
from slipwise.campaign import load_campaign
from slipwise.selection.candidates import list_candidates
from unit.campaign.slider import write_at_loads

OF_LOAD = {"pressure_law", "slide_tilt"}


@pytest.mark.parametrize(
    ("loads", "testable"),
    [
        ({"one": 5.0, "two": 20.0, "held_out": 10.0}, OF_LOAD),
        ({"one": 10.0, "two": 10.0, "held_out": 20.0}, set()),  # no fit sees the other load
    ],
)
def test_effects_of_load_are_candidates_where_fitted_runs_differ_in_load(
    tmp_path: Path, loads: dict[str, float], testable: set[str]
) -> None:
    write_at_loads(tmp_path, loads, power=0.5)
    terms, cannot = list_candidates(fit_base(load_campaign(tmp_path)))
    assert OF_LOAD & {t.effect.name for t in terms} == testable
    assert {name for name in OF_LOAD if "the load never changes" in cannot.get(name, "")} == OF_LOAD - testable
