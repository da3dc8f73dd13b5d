"""Candidates whose column is the change of a whole fit: one slider that a bristle holds, far from the base law."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.campaign.materiality import Materiality
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.evidence.prior import OF_MODEL
from slipwise.selection.averaged_rows import make_averaged_rows
from slipwise.selection.candidates import at_odds, list_candidates, list_exclusions
from slipwise.selection.columns import make_column
from slipwise.selection.proposals import values_of_form
from slipwise.selection.units import compute_units_of_fits
from slipwise.selection.whole_fits import compute_columns_of_fits, fit_whole, make_fit_without
from unit.campaign.slider import HEADER, RUNS, text

LENGTH = 2.0  # mm


def held_by_a_bristle(frequency: float) -> np.ndarray:
    """Give time [s], slip [mm], load [kN] and friction [kN] that turns round over `LENGTH`, (n, 4)."""
    time = np.arange(0.0, 4.0, 0.005)
    slip = 15.0 * np.sin(2.0 * np.pi * frequency * time)
    share = np.zeros(len(time))
    for i, step in enumerate(np.diff(slip), start=1):
        share[i] = np.sign(step) + (share[i - 1] - np.sign(step)) * np.exp(-abs(step) / LENGTH)
    noise = np.random.default_rng(3).standard_normal((3, len(time)))
    return np.stack([time, slip + 0.005 * noise[2], 10.0 + 0.02 * noise[0], 1.2 * share + 0.005 * noise[1]], axis=1)


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> BaseFit:
    folder: Path = tmp_path_factory.mktemp("slider")
    (folder / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{RUNS}')
    for name, frequency in (("one", 0.5), ("two", 0.7)):
        (folder / f"{name}.csv").write_text(text(held_by_a_bristle(frequency), HEADER))
    return fit_base(load_campaign(folder))


def test_what_a_small_step_does_not_show_a_whole_fit_does(base: BaseFit) -> None:
    terms = [t for t in list_candidates(base)[0] if t.label in ("presliding", "restrainer")]
    fits = {h.terms[0].label: h for h in fit_whole(base, terms)}
    length = fits["presliding"].solution.values["presliding.length"]
    assert length == pytest.approx(1e-3 * LENGTH, rel=0.05)
    rows = make_averaged_rows(base.objective)
    left = rows.average(base.solution.residuals.stacked(base.objective.fitted))
    columns = {c.label: c for c in compute_columns_of_fits(base, list(fits.values()), rows)}
    explained = {n: 1.0 - np.sum((left + c.column) ** 2) / np.sum(left**2) for n, c in columns.items()}
    assert explained["presliding"] > 0.98 > explained["restrainer"]
    assert columns["presliding"].numbers > columns["restrainer"].numbers > 0
    units = compute_units_of_fits(base, list(fits.values()), Materiality())
    assert units["presliding", ""].share > 10.0, "it matters many times over"


def test_sizes_of_a_form_stay_inside_the_bounds(base: BaseFit) -> None:
    [term] = [t for t in list_candidates(base)[0] if t.label == "slide_curvature"]
    p = term.effect.parameter("curvature")
    column = make_column(term, OF_MODEL, None, {"curvature": p.high}, 1.0, np.ones(3))
    assert values_of_form([column], np.array([0.5]), term, OF_MODEL)["curvature"] == pytest.approx(0.5 * p.high)
    assert values_of_form([column], np.array([3.0]), term, OF_MODEL)["curvature"] == p.high


def test_a_model_without_a_term_is_the_base_fit_again(base: BaseFit) -> None:
    [term] = [t for t in list_candidates(base)[0] if t.label == "slide_curvature"]
    [found] = fit_whole(base, [term])
    stacked = make_fit_without(base, found, term).solution.residuals.stacked(base.objective.fitted)
    assert np.allclose(stacked, base.solution.residuals.stacked(base.objective.fitted))


def test_two_laws_over_which_friction_turns_round_exclude_each_other(base: BaseFit) -> None:
    terms = {t.label: t for t in list_candidates(base)[0]}
    assert at_odds(terms["presliding"], terms["backlash"])
    assert not at_odds(terms["presliding"], terms["breakaway"])
    pairs = list_exclusions(list(terms.values()))
    assert {("presliding", "backlash"), ("backlash", "presliding")} <= pairs
    assert ("presliding", "breakaway") not in pairs


def test_faults_in_spans_go_with_the_sliders_own_scales(base: BaseFit) -> None:
    of = {t.label: t.effect.parameter("offset") for t in list_candidates(base)[0] if t.effect.name == "channel_offset"}
    scales = base.objective.scales
    assert of["channel_offset[slip_x]"].high == pytest.approx(0.2 * scales.length)
    assert of["channel_offset[pad_A_Fx]"].high == pytest.approx(0.2 * scales.load)
