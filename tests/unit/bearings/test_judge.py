"""A campaign's bearing report: what is there is given, and what is not is said in one sentence."""

from pathlib import Path

import numpy as np
import pytest

import slipwise.rig
from slipwise.bearings.judge import judge_bearing
from slipwise.bearings.result import CYCLE, MEAN, RUN
from slipwise.errors import InputError
from unit.campaign.slider import HEADER, slider, text

WITHOUT_FORCE = "time [s],slip_x [mm],pad_A_N [kN],table_ax [m/s^2]"
WITHOUT_SLIP = "time [s],table_ax [m/s^2],pad_A_N [kN],pad_A_Fx [kN]"


def write(folder: Path, **runs: tuple[np.ndarray, str]) -> Path:
    """Write a campaign of one slider, each run with its own header."""
    entries = ""
    for name, (table, header) in runs.items():
        (folder / f"{name}.csv").write_text(text(table, header))
        entries += f'[[run]]\nfile = "{name}.csv"\nrole = "fit"\n'
    (folder / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{entries}')
    return folder


def test_a_slider_has_the_quantities_of_its_loop_and_the_law_agrees(tmp_path):
    found = judge_bearing(write(tmp_path, one=(slider(1, 1200), HEADER), two=(slider(2, 1200), HEADER)))
    assert found.total == "A"
    for row in found.of(MEAN):
        assert row.values["friction_mean"].measured == pytest.approx(0.12, rel=0.01)
        assert row.values["energy"].measured == pytest.approx(4.0 * 1200.0 * 0.02, rel=0.01)
        assert row.values["characteristic_strength"].measured == pytest.approx(1200.0, rel=0.01)
        law = row.values["energy"]
        assert law.low < law.law < law.high and law.law == pytest.approx(law.measured, rel=0.01)
    assert {row.cycle for row in found.of(CYCLE)} == {1, 2, 3, 4, 5}
    names = {(one.standard, one.name) for one in found.standards}
    assert ("ASCE/SEI 7", "lambda_max") in names and ("EN 15129", "upper bound (UBDP)") in names
    assert all(one.words for one in found.not_held)


def test_mirrored_signs_change_no_size(tmp_path):
    table = slider(1, 1200)
    (tmp_path / "as_it_is").mkdir()
    (tmp_path / "mirrored").mkdir()
    own = judge_bearing(write(tmp_path / "as_it_is", one=(table, HEADER)))
    other = judge_bearing(write(tmp_path / "mirrored", one=(table * [1.0, -1.0, 1.0, -1.0], HEADER)))
    for key in ("energy", "friction_mean", "effective_stiffness", "characteristic_strength"):
        values = [found.of(MEAN)[0].values[key].measured for found in (own, other)]
        assert values[0] == pytest.approx(values[1], rel=1e-3)


def test_one_cycle_has_its_quantities_and_no_degradation(tmp_path):
    found = judge_bearing(write(tmp_path, one=(slider(1, 203), HEADER)))
    assert len(found.of(CYCLE)) == 1 and not found.degradation
    assert any("degradation needs two or more" in words for words in found.cannot)


def test_a_run_without_slip_or_force_is_left_out_and_said(tmp_path):
    table = slider(1, 800)
    found = judge_bearing(
        write(tmp_path, good=(table, HEADER), blind=(table, WITHOUT_SLIP), forceless=(table, WITHOUT_FORCE))
    )
    assert {row.run for row in found.rows} == {"good"}
    assert [words for words in found.cannot if words.startswith("blind: slip was not measured")]
    assert [words for words in found.cannot if words.startswith("forceless: no friction force")]


@pytest.mark.parametrize(("header", "lacks"), [(WITHOUT_SLIP, "slip was not"), (WITHOUT_FORCE, "no friction force")])
def test_a_campaign_without_slip_or_forces_is_refused_in_a_sentence(tmp_path, header, lacks):
    with pytest.raises(InputError, match=lacks):
        judge_bearing(write(tmp_path, one=(slider(1), header)))


def test_a_run_that_never_slides_has_no_loop(tmp_path):
    still = slider(2, 800)
    still[:, 1] = 0.01 * np.random.default_rng(5).standard_normal(len(still))
    found = judge_bearing(write(tmp_path, good=(slider(1, 800), HEADER), still=(still, HEADER)))
    assert {row.run for row in found.rows} == {"good"}
    assert any(words.startswith("still: nothing slides") for words in found.cannot)


def test_a_campaign_that_never_slides_is_refused_in_a_sentence(tmp_path):
    still = slider(2, 800)
    still[:, 1] = 0.01 * np.random.default_rng(5).standard_normal(len(still))
    with pytest.raises(InputError, match="nothing slides"):
        judge_bearing(write(tmp_path, still=(still, HEADER)))


def test_a_pad_without_load_has_all_but_coefficients_and_no_law(tmp_path):
    found = judge_bearing(write(tmp_path, one=(slider(1, 800)[:, [0, 1, 3]], "time [s],slip_x [mm],pad_A_Fx [kN]")))
    row = found.of(MEAN)[0]
    assert row.values["energy"].measured > 0.0 and np.isnan(row.values["friction_mean"].measured)
    assert any("load was not measured" in words for words in found.cannot)
    assert any("fitted law" in words for words in found.cannot)


def test_an_earthquake_has_energy_and_friction_and_no_cycles(tmp_path):
    rng = np.random.default_rng(3)
    table = slider(1, 1500)
    phases, frequencies = rng.uniform(0.0, 2.0 * np.pi, 20), rng.uniform(0.2, 2.0, 20)
    slip = np.sum(np.sin(2.0 * np.pi * frequencies * table[:, :1] + phases) / frequencies, axis=1)
    table[:, 1] = 5.0 * slip * np.sin(np.pi * table[:, 0] / 15.0)
    table[:, 3] = 1.2 * np.sign(np.gradient(table[:, 1]))
    found = judge_bearing(write(tmp_path, one=(table, HEADER)))
    assert not found.of(CYCLE) and found.of(RUN)[0].values["friction_mean"].measured == pytest.approx(0.12, rel=0.02)
    assert any("need a cyclic motion" in words for words in found.cannot)


def test_runs_that_are_all_held_out_are_measured_and_not_fitted(tmp_path):
    folder = write(tmp_path, one=(slider(1, 800), HEADER))
    toml = folder / "campaign.toml"
    toml.write_text(toml.read_text().replace('"fit"', '"holdout"'))
    found = judge_bearing(folder)
    assert found.of(MEAN) and np.isnan(found.of(MEAN)[0].values["energy"].law)
    assert any("every run is held out" in words for words in found.cannot)


def test_energy_of_the_sum_is_that_of_the_pads_together(short_girder):
    for run in {row.run for row in short_girder.rows}:
        (total,) = (row for row in short_girder.of(RUN, "sum") if row.run == run)
        pads = [row for row in short_girder.of(RUN) if row.run == run and row.bearing != "sum"]
        assert len(pads) == 4
        together = sum(row.values["energy"].measured for row in pads)
        assert total.values["energy"].measured == pytest.approx(together, rel=1e-3)


def test_earthquakes_of_a_girder_are_no_cyclic_motion_and_its_sine_is(short_girder):
    cyclic = {row.run for row in short_girder.of(CYCLE)}
    assert cyclic == {"sine_hv"}


def test_a_report_shows_itself_as_a_line_a_table_and_a_picture(short_girder):
    assert repr(short_girder).startswith("<BearingReport: demo: ")
    assert "<table>" in short_girder._repr_html_()
    assert len(short_girder.plot().axes) == 6  # five runs in two rows


@pytest.fixture(scope="module")
def short_girder():
    """Judge the campaign that the package brings along."""
    return judge_bearing(Path(slipwise.rig.__file__).parents[1] / "demo_data")
