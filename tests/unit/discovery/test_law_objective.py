"""What a law adds to a fit: a force on the girder tips it, and a law that a later one makes needless is dropped."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from hypotheses import table_of
from slipwise.discovery.discover import _without_needless
from slipwise.discovery.law_objective import LawObjective, PlacedLaw
from slipwise.estimation.least_squares import Solution, solve, with_slopes
from slipwise.relations.parameters import Free
from slipwise.relations.setting import Weighing
from slipwise.relations.stages import Evaluation, Memo, Stage
from slipwise.relations.table import Residuals
from slipwise.signals.pitch import pass_through_pitch

TIME = np.arange(400) * 0.005
FORCE = 3e3 * np.sin(2.0 * np.pi * TIME)
VALUES = {"rig.mass": 2e3, "rig.pitch_frequency": 20.0, "rig.pitch_damping": 0.1}


def tipped(lever: float, longest: float = 0.0, values: Mapping[str, float] = VALUES) -> dict[str, list[np.ndarray]]:
    """Columns of a force on the girder at a lever, with noise of 0.1 m/s^2 and 50 N."""
    run = SimpleNamespace(dt=0.005, fine=1, judged={r: np.ones(400, dtype=bool) for r in ("girder", "pitch")})
    specimen = SimpleNamespace(mass=1e3, half_spacing=(1.5, 1.0))
    weighing = Weighing({"girder": (np.full(400, 0.1),), "pitch": (np.full(400, 50.0),)})
    measurements: Any = SimpleNamespace(runs=(run,), specimen=specimen)
    plain: Any = SimpleNamespace(run=lambda place: run, relations=("pads", "girder", "pitch"))
    port = SimpleNamespace(relation="girder", carrier=(np.full((400, 1), -1.0 / values["rig.mass"]),))
    state = SimpleNamespace(time_constant=0.0, values=(np.ones((400, 1)),))
    form = SimpleNamespace(constants=(), at=lambda s, c: FORCE[:, None])
    match: Any = SimpleNamespace(candidate=SimpleNamespace(port=port, states=(state,)), forms=(form,), constants={})
    law = PlacedLaw("law", match, (np.ones((400, 1)),), lever, longest)
    every: Any = None
    objective = LawObjective(every, plain, (law,))
    here = {**values, "law.strength": 1.0}
    evaluation = Evaluation(measurements, weighing, (), here, 1, False, None, Memo(1))
    return evaluation.of(Stage("law", lambda inputs: objective.columns(law, inputs)))


def test_a_force_at_the_centre_does_not_tip_the_girder() -> None:
    columns = tipped(0.0)
    np.testing.assert_allclose(columns["girder"][0], -FORCE / 2e3 / 0.1)
    assert "pitch" not in columns


def test_a_force_below_the_centre_tips_the_girder_by_its_lever_whatever_its_mass() -> None:
    expected = pass_through_pitch(FORCE * 0.4 / 1.5, 0.005, 20.0, 0.1) / 50.0
    np.testing.assert_allclose(tipped(0.4)["pitch"][0], expected, rtol=1e-9, atol=1e-9)
    heavier = tipped(0.4, values={**VALUES, "rig.mass": 5e3})
    np.testing.assert_allclose(heavier["pitch"][0], expected, rtol=1e-9, atol=1e-9)


@dataclass(frozen=True)
class Lines:
    """An objective whose laws are lines: their strengths times columns, held against a measured vector."""

    measured: np.ndarray
    laws: tuple[Any, ...]
    fitted = [0]
    relations = ("pads",)
    balanced = False

    def near(self, values: Mapping[str, float]) -> "Lines":
        return self

    def without_results(self) -> "Lines":
        return self

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        left = self.measured - sum(values[f"{law.label}.strength"] * law.column for law in self.laws)
        return table_of({"pads": [left]})


@dataclass(frozen=True)
class Fitted:
    law: Any
    objective: Any
    solution: Solution


def fitted(objective: Lines) -> Solution:
    keys = [f"{law.label}.strength" for law in objective.laws]
    free = [Free(k, 0.1, -10.0, 10.0, 1.0, "1") for k in keys]
    return with_slopes(objective, solve(objective, dict.fromkeys(keys, 0.1), free))


@pytest.mark.parametrize(("share", "kept"), [(0.0, ["second"]), (1.0, ["first", "second"])])
def test_a_law_that_a_later_one_makes_needless_is_dropped(share: float, kept: list[str]) -> None:
    rng = np.random.default_rng(5)
    one, other = rng.normal(size=(2, 500))
    first = SimpleNamespace(label="first", column=one + 0.7 * other)
    second = SimpleNamespace(label="second", column=other)
    measured = 8.0 * (share * one + other)
    before = Lines(measured, (first,))
    after = Lines(measured, (first, second))
    leaders: Any = [
        (Fitted(first, before, fitted(before)), [], 0.4), (Fitted(second, after, fitted(after)), [], 0.6)
    ]  # fmt: skip
    left = _without_needless(leaders, float(measured @ measured))
    assert [leader.law.label for leader, _, _ in left] == kept
    if kept == ["second"]:
        assert left[0][2] == pytest.approx(1.0)
        assert left[0][0].solution.values["second.strength"] == pytest.approx(8.0, rel=1e-3)


def test_a_law_has_a_lever_to_fit_only_where_something_tells_it() -> None:
    candidate = SimpleNamespace(port=SimpleNamespace(unit="N"), states=(SimpleNamespace(time_constant=0.0),))
    match: Any = SimpleNamespace(candidate=candidate, forms=(), constants={})
    law = PlacedLaw("law", match, (), longest_lever=1.2)
    assert [f.key for f in law.free(5.0)] == ["law.strength", "law.lever"]
    assert [f.key for f in replace(law, longest_lever=0.0).free(5.0)] == ["law.strength"]
