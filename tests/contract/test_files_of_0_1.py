"""What 0.1 wrote is read, or is told and kept: records, a model, a verdict and a session."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from slipwise.errors import SlipwiseWarning
from slipwise.studies.consequence.diagnosed import list_intervals, read_diagnosis

FILES = Path(__file__).parents[1] / "files_of_0_1"


@pytest.fixture
def campaign(tmp_path: Path) -> Path:
    return Path(shutil.copytree(FILES / "campaign", tmp_path / "campaign"))


def test_records_keep_their_channels_units_and_provenance() -> None:
    record = sw.read_record(FILES / "campaign" / "sine.parquet")
    assert record.provenance["made_by"] == "slipwise replay" and record.provenance["model"]["run_in"]["rise"] == 0.8
    assert record.dt == pytest.approx(8e-3)
    assert sum(record[f"pad_{pad}_N"][:20].mean() for pad in "ABCD") == pytest.approx(98e3, rel=0.02)
    assert 0.1 < np.ptp(record["slip_x"]) < 0.3


def test_a_campaign_of_records_is_read_with_its_roles() -> None:
    runs = sw.load_campaign(FILES / "campaign").runs
    assert [(run.name, run.role) for run in runs] == [("sine", "fit"), ("quake", "fit"), ("held", "holdout")]


def test_a_model_has_its_effects_at_the_sizes_that_were_stated() -> None:
    model = sw.load_model(FILES / "campaign" / "model.toml")
    assert {"contact_area", "shear_rate", "run_in"} == {use.effect.name for use in model.uses}
    assert model["run_in"].values == {"rise": 0.8, "distance": 0.2, "tail": 0.0}


def test_a_verdict_says_what_was_named_and_how_large_it_may_be() -> None:
    found = read_diagnosis(FILES)
    assert found.effects == ("run_in",)
    model = sw.base_model("bridge1").adding(sw.use("run_in", rise=found.sizes["run_in.rise"][0]))
    drawn, _ = list_intervals(found, model, found.effects)
    assert "run_in.rise" in {each.key for each in drawn}


def test_a_session_that_cannot_be_taken_up_is_told_and_kept_and_the_model_is_read(campaign: Path) -> None:
    (campaign / ".slipwise").mkdir(mode=0o700)
    shutil.copy(FILES / "session.json", campaign / ".slipwise")
    with pytest.warns(SlipwiseWarning, match="not taken up again, and is kept as .*schema 1"):
        session = sw.Session(campaign)
    try:
        assert session.model["run_in"].values["rise"] == 0.8
        kept = json.loads((campaign / ".slipwise" / "session-1.json").read_text(encoding="utf-8"))
        assert kept == json.loads((FILES / "session.json").read_text(encoding="utf-8"))
    finally:
        session.close()
