"""A girder on six pads of which one stands higher: all three warps show it, and which pad it is."""

from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from recover.own_replay import campaign_of
from slipwise.estimation.base_fit import fit_base
from slipwise.model import EffectUse, Model, base_model, use

HIGH = "pad_E_N"
HEIGHT = 0.02e-3


def one_pad_high(rig: str = "six_pads", target: str = HIGH) -> Model:
    seat = use("uneven_seating", warp=HEIGHT)
    return base_model(rig).adding(EffectUse(seat.effect, seat.values, target))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return campaign_of(tmp_path_factory.mktemp("six") / "uneven", "six_pads", 100.0, model=one_pad_high())


def test_every_warp_of_six_pads_is_fitted_and_shows_the_pad_that_stands_high(folder: Path) -> None:
    campaign = sw.load_campaign(folder)
    plain = fit_base(campaign, base_model(campaign.specimen))
    assert [r for r in plain.problem.relations if r.startswith("warp")] == ["warp", "warp_2", "warp_3"]
    with_it = fit_base(campaign, one_pad_high())
    for name in ("warp", "warp_2", "warp_3"):
        left, rest = (
            float(np.sqrt(np.mean(np.concatenate(f.solution.residuals.parts[name]) ** 2))) for f in (plain, with_it)
        )
        assert rest < 1.1, name
        assert name == "warp" or left > 3.0, name
    assert with_it.solution.values[f"uneven_seating[{HIGH}].warp"] == pytest.approx(HEIGHT, rel=0.02)


@pytest.mark.slow
def test_the_diagnosis_names_the_pad_that_stands_high(folder: Path) -> None:
    found = sw.diagnose(folder)
    assert found.verdict.kind == "named" and found.verdict.effects == ("uneven_seating",), found.sentence
    assert [t.label for t in found.search.best.terms] == [f"uneven_seating[{HIGH}]"], found.sentence


def test_the_audit_compares_every_warp_and_accuses_no_cell_for_a_pad_that_stands_high(folder: Path) -> None:
    report = sw.audit(folder)
    assert not report.accused, report.findings
