"""An evaluation uses again what would be made alike, and nothing else: no number that counts is forgotten."""

from collections.abc import Mapping
from dataclasses import FrozenInstanceError, replace
from typing import Any

import numpy as np
import pytest

from hypotheses import base, on
from slipwise.effects import catalogue
from slipwise.estimation.objective import Objective
from slipwise.relations import pad_stages
from slipwise.relations.kinematics import CORRECTED, STATES
from slipwise.relations.pad_stages import LAW_FORCES, is_on_pads
from slipwise.relations.parameters import PITCH_INERTIA, YAW_INERTIA, Term
from slipwise.relations.setting import Weighing
from slipwise.relations.stages import Evaluation, Inputs, Memo, Stage, make_memo
from slipwise.relations.table import Residuals


def values_of(objective: Objective, *terms: Term) -> dict[str, float]:
    """Start values of the base model, and typical ones of further terms a third of the way from their absence."""
    values = dict(base().solution.values)
    for term in terms:
        for key, p in term.parameters.items():
            off = p.typical if p.neutral is None else p.neutral
            values[key] = off + (p.typical - off) / 3.0
    inertias = {YAW_INERTIA: objective.specimen.inertia[2], PITCH_INERTIA: objective.specimen.inertia[1]}
    return values | {key: inertias[key] for key in objective.inertias}


def alike(one: Residuals, other: Residuals) -> bool:
    """Whether two tables hold the same numbers, bit by bit."""
    return all(np.array_equal(a.value, b.value) for a, b in zip(one.table, other.table, strict=True)) and all(
        np.array_equal(a, b) for a, b in zip(one.pad_forces, other.pad_forces, strict=True)
    )


def fresh(objective: Objective) -> Objective:
    """The same objective, which remembers nothing."""
    return replace(objective, memo=make_memo(objective.measurements))


TERMS = {
    "law": (Term(catalogue()["heating"]), Term(catalogue()["presliding"])),
    "buffers and yaw": (Term(catalogue()["buffer_damping"]), Term(catalogue()["buffer_mismatch"])),
    "rig": (Term(catalogue()["mass_eccentricity"]), Term(catalogue()["pad_compliance"])),
    "table": (Term(catalogue()["table_pitch"]),),
    "gauges": (on("channel_gain", "pad_A_Fx"), on("channel_delay", "girder_ax"), on("channel_filter", "pad_*_N")),
}


@pytest.mark.parametrize("kind", TERMS)
def test_residuals_are_those_of_an_objective_that_remembers_nothing_whatever_number_was_changed(kind: str) -> None:
    terms = TERMS[kind]
    objective = base().objective.adding(*terms)
    values = values_of(objective, *terms)
    objective = objective.weigh(values)
    rng, before = np.random.default_rng(7), fresh(objective).residuals(values, fitted_only=True)
    for key in rng.permutation(sorted(values)):
        changed = {**values, str(key): values[str(key)] * (1.0 - 0.01 * rng.random()) + 1e-9 * rng.random()}
        assert alike(objective.residuals(changed), fresh(objective).residuals(changed)), key
        assert alike(objective.residuals(values, fitted_only=True), before)


def test_another_noise_and_other_terms_are_not_answered_by_what_was_made_before() -> None:
    term = on("channel_gain", "pad_B_N")
    plain = base().objective
    values = values_of(plain, term)
    for objective in (plain.weigh(values), plain.adding(term).weigh(values), plain.with_yaw(), plain.near(values)):
        here = values | {YAW_INERTIA: objective.specimen.inertia[2]} if objective.makes_yaw else values
        assert alike(objective.residuals(here), fresh(objective).residuals(here))


def test_a_number_that_a_stage_begins_to_read_counts_from_then_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def stronger(inputs: Inputs) -> list[Any]:
        share = 1.0 + inputs.values.get("rig.new_number", 0.0)
        return [replace(f, force=share * f.force, bound=share * f.bound) for f in inputs.of(LAW_FORCES)]

    objective, values = base().objective, base().solution.values
    before = objective.residuals(values)
    monkeypatch.setattr(pad_stages, "LAW_FORCES", Stage("stronger law", stronger, is_on_pads))
    objective = fresh(objective)
    assert alike(objective.residuals(values), before)
    changed = objective.residuals({**values, "rig.new_number": 0.1})
    assert not np.allclose(changed.of("pads")[0], before.of("pads")[0])
    assert alike(objective.residuals(values), before)


def test_a_stage_is_not_made_anew_for_a_number_or_a_term_that_it_does_not_see() -> None:
    objective, values = base().objective, base().solution.values
    law, states = objective.evaluation(values).of(LAW_FORCES), objective.evaluation(values).of(STATES)
    heavier = {**values, "rig.mass": 1.1 * values["rig.mass"]}
    assert objective.evaluation(heavier).of(LAW_FORCES) is law
    of_law = next(key for key in values if not key.startswith("rig."))
    harder = {**values, of_law: 1.1 * values[of_law]}
    assert objective.evaluation(harder).of(STATES) is states
    assert objective.evaluation(harder).of(LAW_FORCES) is not law
    gain = on("channel_gain", "pad_A_Fx")
    assert objective.adding(gain).evaluation(values_of(objective, gain)).of(LAW_FORCES) is law


def test_what_a_stage_asks_another_one_counts_as_its_own_question_also_where_the_other_was_made_before() -> None:
    inner = Stage("inner", lambda inputs: inputs.values["a"])
    outer = Stage("outer", lambda inputs: 10.0 * inputs.of(inner))
    memo = Memo(2)

    def evaluation(values: Mapping[str, float]) -> Evaluation:
        return Evaluation(base().objective.measurements, Weighing(), (), values, 1, False, None, memo)

    assert evaluation({"a": 1.0}).of(inner) == 1.0
    assert evaluation({"a": 1.0}).of(outer) == 10.0
    assert evaluation({"a": 2.0}).of(outer) == 20.0


def test_a_stage_must_name_the_numbers_that_it_depends_on() -> None:
    greedy = Stage("greedy", lambda inputs: sum(inputs.values.values()))
    with pytest.raises(TypeError, match="by their keys"):
        base().objective.evaluation({"a": 1.0}).of(greedy)


def test_of_each_stage_the_last_few_results_are_kept() -> None:
    made: list[float] = []

    def make(inputs: Inputs) -> float:
        made.append(inputs.values["a"])
        return made[-1]

    stage, memo = Stage("a", make), Memo(2)
    for a in (1.0, 2.0, 1.0, 3.0, 1.0, 2.0):
        Evaluation(base().objective.measurements, Weighing(), (), {"a": a}, 1, False, None, memo).of(stage)
    assert made == [1.0, 2.0, 3.0, 2.0]


def test_weighing_gives_a_new_objective_and_leaves_the_first_as_it_is() -> None:
    objective, values = base().objective, base().solution.values
    before = objective.residuals(values)
    weighed = objective.weigh({**values, "rig.late_slip": 1e-4})
    assert alike(objective.residuals(values), before) and not alike(weighed.residuals(values), before)
    assert weighed.evaluation(values).of(CORRECTED).runs[0] is not objective.evaluation(values).of(CORRECTED).runs[0]
    with pytest.raises(FrozenInstanceError):
        objective.weighing = weighed.weighing  # pyright: ignore[reportAttributeAccessIssue]
