"""A girder on six pads of which one stands higher: all three warps show it, and which pad it is."""

from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from measured import fit_base
from recover.own_replay import campaign_of
from slipwise.estimation.objective import make_objective
from slipwise.model import EffectUse, Model, base_model, use
from slipwise.relations.parameters import list_base_numbers, make_terms
from slipwise.relations.run_data import fit_runs

HIGH = "pad_E_N"
HEIGHT = 0.02e-3


def one_pad_high(rig: str = "six_pads", target: str = HIGH) -> Model:
    seat = use("uneven_seating", warp=HEIGHT)
    return base_model(rig).adding(EffectUse(seat.effect, seat.values, target))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return campaign_of(tmp_path_factory.mktemp("six") / "uneven", "six_pads", 100.0, model=one_pad_high())


def test_every_warp_of_six_pads_is_fitted_and_shows_the_pad_that_stands_high(folder: Path) -> None:
    runs = fit_runs(sw.load_campaign(folder))
    level = {}
    for model in (base_model("six_pads"), one_pad_high()):
        objective = make_objective(runs, model.specimen, make_terms(model))
        values = {f.key: f.start for f in list_base_numbers(model, balances=True)}
        left = objective.weigh(values).residuals(values)
        warps = [name for name in left.relations if "warp" in name]
        level[len(model.uses)] = {n: np.sqrt(np.mean(np.concatenate(left.of(n)) ** 2)) for n in warps}
    plain, with_it = level[min(level)], level[max(level)]
    assert list(plain) == ["warp", "warp_2", "warp_3"]
    assert min(plain["warp_2"], plain["warp_3"]) > 3.0 and max(with_it.values()) < 1.1, (plain, with_it)


@pytest.mark.slow
def test_a_fit_finds_how_high_it_stands(folder: Path) -> None:
    found = fit_base(sw.load_campaign(folder), one_pad_high()).solution.values
    assert found[f"uneven_seating[{HIGH}].warp"] == pytest.approx(HEIGHT, rel=0.02)


@pytest.mark.long
def test_the_diagnosis_names_the_pad_that_stands_high(folder: Path) -> None:
    found = sw.diagnose(folder)
    assert found.verdict.kind == "named" and found.verdict.effects == ("uneven_seating",), found.sentence
    assert [t.label for t in found.search.best.terms] == [f"uneven_seating[{HIGH}]"], found.sentence


@pytest.mark.slow
def test_the_audit_compares_every_warp_and_accuses_no_cell_for_a_pad_that_stands_high(folder: Path) -> None:
    report = sw.audit(folder)
    assert not report.accused, report.report.findings
