"""Structure can be predicted on motions that it was not made from; noise, and one early reversal, cannot."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base, left_by
from slipwise.diagnosis.unknown_surface import above_noise, leftover, structured
from slipwise.record import Record
from slipwise.selection.hypothesis import Hypothesis


def with_left(found: Hypothesis, relation: str, left: list[np.ndarray]) -> Hypothesis:
    """The hypothesis with another residual of one relation in every run."""
    of = found.solution.residuals
    more = {relation: [before - now for before, now in zip(of.of(relation), left, strict=True)]}
    return replace(found, solution=replace(found.solution, residuals=of.less(more)))


#: These pads slide to one side of where they began: outward is the sign of their velocity.
VELOCITY = {"velocity", "outward"}


@pytest.mark.parametrize(("state", "same"), [("velocity", VELOCITY), ("slip", {"slip"})])
def test_a_force_is_found_over_the_state_on_which_it_depends(state: str, same: set[str]) -> None:
    of = base(held_out=False, pads=6.0)  # of one sine, slip and acceleration are one
    found = leftover(left_by("heating", of=of, pads=5.0, over=lambda run: getattr(run, state)))
    assert structured(found)
    assert found is not None and found.relation == "pads" and same & set(found.states)


@pytest.mark.parametrize("held_out", [True, False])
def test_noise_is_no_structure_however_loud(held_out: bool) -> None:
    of = base(held_out=held_out, pads=6.0)
    found = leftover(left_by("heating", of=of, pads=6.0))
    assert found is not None and not structured(found)


def test_a_force_is_found_where_every_run_was_fitted() -> None:
    of = base(held_out=False, pads=6.0)
    found = leftover(left_by("heating", of=of, pads=5.0, over=lambda run: run.velocity))
    assert structured(found)
    assert found is not None and VELOCITY & set(found.states)


def slowed(found: Hypothesis, factor: float) -> Hypothesis:
    """The hypothesis of a test that was run so many times slower on a rig that is as slow."""
    objective, left = found.objective, found.solution.residuals
    runs = []
    for run in objective.runs:
        record = Record(run.record.time * factor, run.record.channels)
        scales = replace(run.scales, speed=run.scales.speed / factor)
        runs.append(replace(run, states=replace(run.states, record=record, scales=scales)))
    table = tuple(replace(b, time=b.time * factor, dt=b.dt * factor) for b in left.table)
    slower = replace(objective, measurements=replace(objective.measurements, runs=tuple(runs)))
    solution = replace(found.solution, residuals=replace(left, table=table))
    return replace(found, objective=slower, solution=solution)


def test_what_is_left_above_the_noise_does_not_change_with_the_unit_of_time() -> None:
    found = left_by("heating", of=base(pads=4.0), pads=4.0)
    assert above_noise(slowed(found, 20.0), {}) == pytest.approx(above_noise(found, {}))


def test_one_early_reversal_in_each_run_is_no_structure() -> None:
    of = base(pads=1.5)
    noise = left_by(of=of)
    left = [part.copy() for part in noise.solution.residuals.of("pads")]
    for part, run in zip(left, of.objective.runs, strict=True):
        first = np.flatnonzero(run.judged["pads"][:, 0])[:6]
        part[first] = 90.0
    assert not structured(leftover(with_left(left_by(of=of, pads=1.5), "pads", left)))


def test_the_noise_of_the_vertical_accelerometer_does_not_predict_itself_in_heave() -> None:
    of = base(heave=2.0)
    left = []
    for run in of.objective.runs:
        gauge = run.states.girder_acceleration[:, 2]
        around = np.convolve(gauge, np.ones(5) / 5.0, mode="same")
        left.append(np.where(run.judged["heave"], -(gauge - around) / np.std(gauge - around), 0.0))
    assert not structured(leftover(with_left(left_by(of=of, heave=2.0), "heave", left)))
