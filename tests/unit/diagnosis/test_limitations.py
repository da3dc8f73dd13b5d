"""What a campaign cannot tell is found in the data, and a campaign that tells everything is not blamed."""

from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.campaign import Campaign, Logger, Run
from slipwise.diagnosis.identifiability import list_unidentified, separate_each
from slipwise.diagnosis.limitations import list_limitations
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import BaseFit
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import fit_prepared
from slipwise.record import Record
from slipwise.relations.parameters import Term
from slipwise.rig import load_specimen
from slipwise.selection.candidates import list_candidates
from slipwise.selection.explained_alone import ExplainedAlone
from slipwise.selection.hypothesis import make_base_hypothesis
from slipwise.selection.search_state import Search
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

FADES_AND_LASTS = [Term(catalogue()[name]) for name in ("heating", "run_in")]
RESTS = "heating"


@pytest.fixture(scope="module")
def whole() -> Campaign:
    return as_campaign(build_campaign(41041, effects=(), rig="bridge1"))


@pytest.fixture(scope="module")
def base(whole: Campaign) -> BaseFit:
    return fit_base(whole)


def slider(swing: float, speed: float = 0.1, noise: float = 5.0, *, pressure: bool = False) -> Campaign:
    """A pad under 25 kN that may swing, on the paper's law, with noise; its load or its pressure is measured."""
    rng, specimen = np.random.default_rng(3), load_specimen("pad")
    time = np.arange(4000) * 0.002
    moving = np.clip(time - 1.0, 0.0, None)  # it rests first: there the noise is seen
    turn = speed / 0.02
    slip, velocity = 0.02 * np.sin(turn * moving), speed * np.cos(turn * moving) * (time > 1.0)
    normal = 25e3 * (1.0 + swing * np.sin(2.0 * np.pi * 0.9 * moving))
    area = specimen.pad_area
    shear = 1.379e6 * -np.expm1(-19.7 * np.abs(velocity))
    force = np.sign(velocity) * (shear * area * -np.expm1(-0.102e-6 * normal / area) + 0.046 * normal)
    measured = {
        "slip_x": slip + rng.normal(0.0, 2e-5, time.size),
        "pad_A_Fx": force + rng.normal(0.0, noise, time.size),
        "pad_A_P" if pressure else "pad_A_N": normal / (area if pressure else 1.0),
    }
    run = Run("only", "fit", Record(time, measured), None, None, "only.csv", "")
    return Campaign("made", "pad", specimen, Logger(known=True), (run,), specimen.path.parent)


def reasons(base: BaseFit, terms: list[Term] = FADES_AND_LASTS, *, screened: bool = True) -> dict[str, str]:
    """Say what is cannot_tell after a selection that has seen something in every term, or in none."""
    found = [ExplainedAlone(t, {}, 0.0, 0.0, np.nan, "") for t in terms] if screened else []
    return dict(list_limitations(Search(base, {}, terms, (), (make_base_hypothesis(base),), found), base))


def test_cells_of_pads_of_any_name_are_told_as_one_card() -> None:
    (run,) = (made := slider(0.3)).runs
    more = {f"pad_{pad}_Fy": 0.1 * run.record["pad_A_Fx"] for pad in ("west", "east")}
    (told,) = (
        key
        for key in reasons(fit_base(made.with_records({run.name: run.record.replaced(**more)}, "")))
        if key.startswith("faults of")
    )
    assert "pad_*_Fy" in told and "west" not in told


@pytest.mark.slow
def test_what_a_dead_gauge_hides_is_told_with_the_effects_that_no_other_shows(whole: Campaign) -> None:
    runs = (whole.runs[1], whole.runs[4])
    dead = {run.name: run.record.replaced(pad_D_Fx=np.zeros(len(run.record))) for run in runs}
    ready = prepare(replace(whole, runs=runs).with_records(dead, ""))
    fit = fit_prepared(ready)
    hidden = [Term(catalogue()["buffer_hardening"])]
    state = Search(fit, {}, hidden, [], (make_base_hypothesis(fit),))
    told = dict(list_limitations(state, fit, ready.faults))
    assert told["balances"] == (
        "pad_D_Fx shows nothing, and without it no fitted run shows the balance of girder, pitch"
    )
    assert told["buffer_hardening"].endswith(told["balances"])


@pytest.mark.slow
def test_a_full_campaign_tells_every_number_and_heat_from_wear(base: BaseFit) -> None:
    assert list_unidentified(base, base) == []
    assert [key.partition(" ")[0] for key in reasons(base)] == ["faults"]


@pytest.mark.slow
def test_heat_looks_like_wear_where_nothing_is_repeated_after_a_pause(whole: Campaign) -> None:
    one = reasons(fit_base(replace(whole, runs=whole.runs[1:2])))
    assert "no run has the role repeat" in one["heating against run_in"]
    assert "repeat at once and after a long rest" in one["heating against run_in"]
    several = replace(whole, runs=tuple(replace(r, rest_before=None) for r in whole.runs[:2]))
    assert "no rest between runs is given" in reasons(fit_base(several))["heating against run_in"]


def test_rests_that_are_not_given_are_named(base: BaseFit) -> None:
    def with_rests(*runs: Run) -> dict[str, str]:
        return reasons(replace(base, campaign=replace(base.campaign, runs=runs)))

    runs = [replace(r, rest_before=None) for r in base.campaign.runs]
    names = [r.name for r in runs]
    assert f"before {', '.join(names[1:4])} and 1 more is" in with_rests(*runs)[RESTS]
    given = [replace(r, rest_before=60.0) for r in runs]
    assert f"before {names[2]} is" in with_rests(*given[:2], runs[2], *given[3:])[RESTS]
    assert RESTS not in with_rests(runs[0], *given[1:])  # nothing was before the first


def test_two_windows_of_one_file_have_no_rest_between_them(base: BaseFit) -> None:
    first = base.campaign.runs[0]
    two = [replace(first, rest_before=None, window=w) for w in ((0.0, 4.0), (4.0, 8.0))]
    assert RESTS not in reasons(replace(base, campaign=replace(base.campaign, runs=tuple(two))))
    apart = (two[0], replace(two[1], window=(5.0, 8.0)))
    assert RESTS in reasons(replace(base, campaign=replace(base.campaign, runs=apart)))


def test_a_verdict_without_a_held_out_run_is_said_to_be_one(whole: Campaign, base: BaseFit) -> None:
    assert "verdict" not in reasons(base)
    assert "fitted" in reasons(fit_base(replace(whole, runs=whole.runs[:1])))["verdict"]


def test_gauges_on_which_no_fault_is_a_candidate_are_named_on_one_line(base: BaseFit) -> None:
    lines = [key for key in reasons(base, list_candidates(base)[0]) if key.startswith("faults of")]
    assert lines == ["faults of table_az"]
    lines = [key for key in reasons(base, []) if key.startswith("faults of")]
    assert len(lines) == 1 and "pad_*_N, pad_*_Fx" in lines[0]


def test_pressure_is_not_identified_under_a_load_that_stays() -> None:
    steady, swinging = (dict(list_unidentified(b, b)) for b in map(fit_base, (slider(0.0), slider(0.3))))
    assert "the load hardly changes (0 %)" in steady["contact_area.saturation (k)"]
    assert "contact_area.saturation (k)" not in swinging


def test_a_number_on_its_bound_is_not_identified() -> None:
    base = fit_base(slider(0.3))
    key = "shear_rate.strength"
    high = next(f.high for f in base.free if f.key == key)
    ended = replace(base, solution=replace(base.solution, values={**base.solution.values, key: high}))
    assert dict(list_unidentified(ended, base))[f"{key} (s')"].startswith("the fit ended on its upper bound, 139 MPa")


def test_a_column_that_others_can_make_is_not_identified_however_long_it_is() -> None:
    rng = np.random.default_rng(2)
    slopes = rng.normal(size=(400, 3))
    slopes[:, 2] = 5.0 * slopes[:, 0]
    own, tie = separate_each(slopes.T @ slopes)
    assert own[0] < 1e-4 and own[2] < 1e-3 and own[1] == pytest.approx(20.0, rel=0.1)
    assert tie[0, 2] == pytest.approx(-1.0) and abs(tie[0, 1]) < 0.5


def test_a_candidate_that_cannot_be_evaluated_is_said_with_the_error() -> None:
    base = fit_base(slider(0.3, pressure=True))
    terms = [t for t in list_candidates(base)[0] if t.effect.name == "slide_tilt"]
    unfit = Term(catalogue()["load_crosstalk"], ("pad_A_Fx",), "pad_A_Fx")
    found = reasons(base, [*terms, unfit], screened=False)
    assert found["load_crosstalk"].startswith("it could not be evaluated: ") and "pad_A_N" in found["load_crosstalk"]
    assert "slide_tilt" not in found


def test_cross_talk_is_not_tried_where_no_load_was_recorded() -> None:
    terms, cannot = list_candidates(fit_base(slider(0.3, pressure=True)))
    assert "load_crosstalk" not in {t.effect.name for t in terms}
    assert cannot["load_crosstalk"] == "no gauge was recorded on which it would show"


def test_an_effect_that_changes_nothing_that_was_measured_is_said() -> None:
    hot, cold = (reasons(fit_base(slider(0.3, *each)), screened=False) for each in ((0.1, 5.0), (1e-3, 500.0)))
    assert "heating" not in hot
    assert cold["heating"] == "at its usual size it changes nothing that was measured"


def test_faults_of_samples_are_not_looked_for_on_one_slider() -> None:
    _, cannot = list_candidates(fit_base(slider(0.3)))
    assert {"channel_sign", "channel_clipping", "dropped_samples"} <= cannot.keys()


def test_springs_off_the_middle_need_the_turning_that_they_bring(base: BaseFit) -> None:
    rig = base.campaign.specimen
    one, other = rig.buffers
    off = rig.changed(buffers=(replace(one, stiffness_x=2.0 * one.stiffness_x, x=0.4), other))
    assert not {"yaw", "slip_y"} & reasons(base).keys()
    told = reasons(replace(base, campaign=replace(base.campaign, specimen=off)))
    assert "so the girder turns" in told["yaw"] and "so the girder moves across" in told["slip_y"]
