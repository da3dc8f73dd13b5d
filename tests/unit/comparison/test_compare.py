"""A model held against campaigns of a second simulator: a complete one leaves noise, a hidden effect is located."""

import builtins
import json
from dataclasses import replace

import numpy as np
import pytest

from measured import fit_base
from slipwise.comparison.compare import compare
from slipwise.comparison.component_level import compute_component_errors, pool_errors
from slipwise.comparison.tables import as_json
from slipwise.errors import InputError, UnknownNameError
from slipwise_benchmarks import build_campaign, make_campaign
from slipwise_benchmarks.in_memory import as_campaign
from slipwise_benchmarks.write import write_campaign


@pytest.fixture(scope="module")
def made():
    return build_campaign(11, effects=[])


@pytest.fixture(scope="module")
def complete(made, tmp_path_factory):
    folder = tmp_path_factory.mktemp("complete")
    write_campaign(folder, made.truth.rig, made.truth.logger, made.recorded)
    return compare(folder)


@pytest.fixture(scope="module")
def breaking_away(tmp_path_factory):
    folder = tmp_path_factory.mktemp("breaking")
    make_campaign(folder, 13, effects=["breakaway"], size="large")
    return compare(folder, system=False)


def test_a_complete_model_leaves_every_component_at_its_floor_on_the_run_it_has_not_seen(complete):
    errors = {r: complete.error(r, held_out=True) for r in complete.relations}
    assert set(errors) == {"pads", "girder", "heave", "pitch", "roll", "warp", "motion"}
    assert all(0.9 <= e <= 1.1 for e in errors.values()), errors


def test_where_rounded_loads_leave_nothing_they_are_judged_all_the_same(made):
    whole = as_campaign(made)
    loads = [f"pad_{pad}_N" for pad in "ABCD"]
    runs = tuple(
        replace(r, record=r.record.replaced(**{name: np.round(r.record[name], -2) for name in loads}))
        for r in (whole.runs[1], whole.runs[4])
    )
    fit = fit_base(replace(whole, runs=runs))
    left, held_out = fit.solution.residuals, fit.objective.held_out
    assert any(np.any(of.value[of.mask] == 0.0) for of in left.blocks("warp", held_out))
    for relation in fit.objective.relations:
        error = pool_errors(compute_component_errors(fit), relation, held_out=True)
        assert error == pytest.approx(left.level(relation, held_out), rel=1e-12), relation


def test_a_complete_model_fails_nowhere(complete):
    assert complete.places == ()


def test_a_repeated_run_confirms_the_floor(complete):
    assert all(0.85 <= again <= 1.15 for again in complete.repeats.values()), complete.repeats


def test_the_replay_of_a_complete_model_slips_as_measured(complete):
    assert complete.system_errors["slip_x"] <= 1.5


def test_the_floor_of_a_replay_is_no_less_than_each_of_its_parts(complete):
    for e in complete.system.errors:
        assert e.floor >= max(e.gauge, e.fed, e.step)
        assert e.error == pytest.approx(e.rms / e.floor)


def test_fitted_numbers_carry_intervals_of_sensible_width(complete):
    for entry in complete.intervals.entries:
        if entry.key.startswith(("shear_rate", "contact_area", "rig.mass", "rig.buffer")):
            assert entry.low < entry.value < entry.high
            assert entry.high - entry.low < 0.05 * entry.value
    band = complete.surface.deviation / complete.surface.friction
    assert np.all(band < 0.02)


@pytest.mark.slow
def test_a_hidden_breakaway_is_found_in_the_pads_and_not_in_the_girder(breaking_away):
    assert breaking_away.places[0].relation == "pads"
    assert breaking_away.error("pads", held_out=True) > 2.0
    assert breaking_away.error("girder", held_out=True) < 1.2
    assert {p.relation for p in breaking_away.places} <= {"pads", "pitch"}


def test_the_floor_that_is_printed_times_the_error_is_the_residual_in_newtons(complete):
    base = complete.base
    printed = {(row["relation"], row["run"]): row for row in complete.rows("components")}
    predicted = base.solution.residuals.pad_forces
    for run, force in zip(base.objective.runs, predicted, strict=True):
        left = (run.force - force)[run.judged["pads"]]
        row = printed["pads", run.name]
        assert row["floor"] * row["error"] == pytest.approx(np.sqrt(np.mean(left**2)), rel=1e-6)
    assert all(row["floor"] * row["error"] == pytest.approx(row["rms"]) for row in printed.values())


def test_the_floor_of_all_runs_lies_between_those_of_single_runs(complete):
    for row in complete.rows("floor"):
        single = [c["floor"] for c in complete.rows("components") if c["relation"] == row["relation"]]
        assert 0.999 * min(single) <= row["floor"] <= 1.001 * max(single)
    pads = next(row for row in complete.rows("floor") if row["relation"] == "pads")
    assert pads["near_reversals"] > pads["floor"]


def test_the_noise_of_a_gauge_that_is_printed_is_what_divides_and_what_was_planted(made, complete):
    noise = made.truth.logger.noise
    rows = {row["channel"]: row for row in complete.rows("noise")}
    assert all(run.noise[name] == row["level"] for run in complete.base.objective.runs for name, row in rows.items())
    for name, kind in (("slip_x", "slip"), ("girder_ax", "girder"), ("pad_C_N", "load"), ("pad_B_Fx", "force")):
        assert rows[name]["basis"] == "rest before the motion"
        assert rows[name]["level"] == pytest.approx(noise[kind], rel=0.15), name


def test_a_comparison_is_json_and_holds_what_the_tables_hold(complete):
    content = json.loads(json.dumps(as_json(complete), allow_nan=False))
    assert content["components"]["pads"]["holdout"] == pytest.approx(complete.error("pads", held_out=True))
    assert len(content["cells"]) == len(complete.rows("cells"))
    assert content["audit"]["accused"] is False
    assert {row["channel"] for row in content["noise"]["channels"]} >= {"slip_x", "pad_A_Fx"}


def test_tables_turn_into_pandas_frames(complete):
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    frame = complete.to_pandas("system")
    assert isinstance(frame, pandas.DataFrame)
    assert set(frame["role"]) == {"fit", "repeat", "holdout"}


def test_without_pandas_the_error_names_it_and_the_way_round(complete, monkeypatch):
    real = builtins.__import__

    def without(name, *rest, **more):
        if name == "pandas":
            raise ModuleNotFoundError(name)
        return real(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(InputError, match=r"slipwise\[notebook\]"):
        complete.to_pandas()


def test_a_table_that_does_not_exist_is_answered_with_those_that_do(complete):
    with pytest.raises(UnknownNameError, match="components"):
        complete.rows("component")
