"""Hide an effect with the second simulator, and name it from the records alone."""

import json
from pathlib import Path

import numpy as np
import pytest

from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.ladder import ladder
from slipwise_benchmarks import make_campaign

pytestmark = pytest.mark.slow


def test_a_complete_model_is_not_accused(tmp_path: Path) -> None:
    make_campaign(tmp_path / "made", 7001, effects=())
    found = diagnose(tmp_path / "made")
    assert found.verdict.kind == "complete", found.sentence
    assert found.final_error < 1.15


@pytest.mark.long
@pytest.mark.parametrize(
    ("effect", "seed", "kind"),
    [("heating", 7002, "named"), ("buffer_hysteresis", 7003, "named"), ("load_crosstalk", 7004, "instrument")],
)
def test_a_hidden_effect_is_named(tmp_path: Path, effect: str, seed: int, kind: str) -> None:
    make_campaign(tmp_path / "made", seed, effects=(effect,), size="medium")
    found = diagnose(tmp_path / "made")
    assert (found.verdict.kind, found.verdict.effects) == (kind, (effect,)), found.sentence
    assert found.final_error < found.base_error
    written = json.loads(json.dumps(found.as_json(), allow_nan=False))
    assert written["candidates"][0]["effect"].startswith(effect)


@pytest.mark.long
@pytest.mark.parametrize(
    ("effect", "seed"),
    [
        ("channel_delay", 50151),  # 0.87 ms: a filter of that lag takes nothing that the logger's 100 Hz let through
        ("channel_filter", 53009),  # 75 Hz, below the logger's 80 Hz: it takes something
    ],
)
def test_a_small_lag_is_called_a_filter_only_where_something_was_taken(tmp_path: Path, effect: str, seed: int) -> None:
    make_campaign(tmp_path / "made", seed, effects=(effect,), size="small")
    found = diagnose(tmp_path / "made", system=False)
    assert found.verdict.effects == (effect,), found.sentence


@pytest.mark.long
@pytest.mark.parametrize(("seed", "size"), [(930122, "large"), (931005, "medium")])
def test_a_girder_that_bends_is_named_and_no_gauge_beside_it(tmp_path: Path, seed: int, size: str) -> None:
    """Half a girder that swings at 9 Hz was called a gain, a filter and a delay; that all cells read 9 % too little."""
    make_campaign(tmp_path / "made", seed, effects=("girder_bending",), size=size)
    found = diagnose(tmp_path / "made")
    assert found.verdict.effects == ("girder_bending",), found.sentence
    assert found.final_error < 1.15


@pytest.mark.long
def test_what_explains_everything_alone_is_told_though_it_does_not_matter(tmp_path: Path) -> None:
    make_campaign(tmp_path / "made", 930106, effects=("direction_asymmetry",))
    found = diagnose(tmp_path / "made")
    assert (found.verdict.kind, found.verdict.minor) == ("complete", ("direction_asymmetry",)), found.sentence
    assert found.base_error > 1.5 and "present, but not material" in found.sentence


@pytest.mark.long
def test_the_ladder_falls_on_runs_that_the_fit_has_not_seen(tmp_path: Path) -> None:
    make_campaign(tmp_path / "made", 7005, effects=("run_in",), size="medium")
    found = ladder(tmp_path / "made", add=("run_in",))
    first, last = found.steps
    assert (first.effects, last.effects) == ((), ("run_in",))
    assert last.holdout_error < 0.5 * first.holdout_error
    assert np.isnan(last.system_holdout_error)
    steps = json.loads(json.dumps(found.as_json(), allow_nan=False))
    keys = ["effects", "fit_error", "holdout_error", "system_holdout_error", "floor", "screened", "refitted", "stopped"]
    assert [list(step) for step in steps] == [keys, keys], "a list of steps is the contract"
    assert [step["stopped"] for step in steps] == ["", "these effects were asked for"]
