"""At a bound that an effect's file calls another effect it is that one: its forces are those of the plainer effect.

A slider goes to and fro under a load that stays, over strokes that are long or short beside the bound; what the plainer
effect and the base model's own friction cannot make of the force is left.
"""

import numpy as np
import pytest

from slipwise.effects import Effect, Limit, catalogue
from slipwise.model import Model
from slipwise.simulation.predict import predictor
from slipwise.testing.driven import base_of, with_effect

STEP, LOAD = 0.002, 24.5e3
LIMITS = [(e, limit) for e in catalogue().values() for limit in e.limits]
#: Strokes [m]: far beyond a rim and through a play; within a patch, a bristle, a play or the stretch of a machine.
STROKES = {
    "restrainer.limit": 0.05, "backlash.push": 0.02, "position_patch.width": 0.01, "presliding.length": 0.5e-3,
    "backlash.play": 2e-3, "machine_compliance.compliance": 1e-3,
}  # fmt: skip
#: Share of the force that the plainer one need not make where a bound lies a little short of the limit [1].
SHORT_OF_IT = 0.06


def forces(model: Model, stroke: float) -> np.ndarray:
    """Give the force along x of one pad over two strokes at two speeds, (n,) [N]."""
    time = np.arange(0.0, 4.0, STEP)
    still, pads = np.zeros(time.size), len(model.specimen.pads)
    out = []
    for share in (1.0, 0.7):
        along = share * stroke * np.sin(np.pi * time), share * np.pi * stroke * np.cos(np.pi * time)
        slip, velocity = (np.repeat(np.stack([x, still], axis=1)[:, None], pads, axis=1) for x in along)
        out.append(predictor(model).pads(time, np.full((time.size, pads), LOAD), velocity, slip).force[:, 0, 0])
    return np.concatenate(out)


def plainer(effect: Effect, limit: Limit) -> list[Model]:
    """Give the plainer effect on the base model; nothing where that is the base model itself."""
    if not limit.becomes:
        return []
    values = catalogue()[limit.becomes].typical()
    if limit.parameter == "push":  # it is no straight line in this, so its size must be the same
        play = effect.parameter("play").typical
        values["compliance"] = play / (2.0 * effect.parameter("push").high * LOAD)
    return [with_effect(catalogue()[limit.becomes], values)]


def test_every_declared_limit_is_an_effect_of_the_catalogue() -> None:
    assert {f"{e.name}.{limit.parameter}" for e, limit in LIMITS} == STROKES.keys()
    assert {limit.becomes for _, limit in LIMITS} - {""} <= catalogue().keys()


@pytest.mark.parametrize(("effect", "limit"), LIMITS, ids=[f"{e.name}.{m.parameter}" for e, m in LIMITS])
def test_at_its_limit_an_effect_does_what_the_plainer_one_does(effect: Effect, limit: Limit) -> None:
    stroke, bounds = STROKES[f"{effect.name}.{limit.parameter}"], effect.parameter(limit.parameter)
    base = forces(base_of(effect), stroke)
    ended = with_effect(effect, {**effect.typical(), limit.parameter: getattr(bounds, limit.end)})
    does = forces(ended, stroke)
    assert np.linalg.norm(does - base) > SHORT_OF_IT * np.linalg.norm(does), "it does something"
    others = np.stack([base, *(forces(m, stroke) for m in plainer(effect, limit))], axis=1)
    left = does - others @ np.linalg.lstsq(others, does, rcond=None)[0]
    assert np.linalg.norm(left) < SHORT_OF_IT * np.linalg.norm(does)
