"""A discovered law as an effect file: what it says, and that it acts as the law does in the fit that found it."""

import dataclasses
import json
import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.effect_file import can_be_written, write_law
from slipwise.discovery.form import forms
from slipwise.discovery.law import Law, LawConstant
from slipwise.discovery.law_objective import FittedLaw, LawObjective, PlacedLaw
from slipwise.discovery.matching import Match, constants_of, product_at
from slipwise.discovery.result import Discovery
from slipwise.effects import LAGGING, load_effect
from slipwise.errors import SettingError
from slipwise.residual_map.curve import ResidualCurve
from slipwise.residual_map.ports import EVERYWHERE, Gate, Port
from slipwise.residual_map.splines import SplineBasis
from slipwise.residual_map.states import UNITS, DrivingState

NAN = math.nan


class Fitted(FittedLaw):
    """A fit of which only the match counts."""

    rated_load = 2e4  # pyright: ignore[reportAssignmentType]
    buffers = 2  # pyright: ignore[reportAssignmentType]

    @property
    def values(self) -> dict[str, float]:
        return {**self.law.match.constants, "strength": 0.2}


def curve_over(count: int) -> ResidualCurve:
    splines = SplineBasis((np.linspace(0.0, 1.0, 5),) * count, 1)
    size = 5**count
    ones = np.ones(size)
    return ResidualCurve(splines, np.eye(size)[None], ones[None], np.ones(1), np.ones(size, dtype=np.int64), ones)


def law_of(port: str, states: tuple[str, ...], form_names: tuple[str, ...], gate: Gate = EVERYWHERE) -> Law:
    chosen = tuple(forms()[name] for name in form_names)
    numbers = {name: 0.7 + 0.1 * i for i, name in enumerate(constants_of(chosen))}
    lag = 0.05 if set(states) & LAGGING else 0.0
    kept = tuple(DrivingState(s, lag if s in LAGGING else 0.0, ()) for s in states)
    where = Port(port, "pads", "odd", "1", ())
    match = Match(CurveCandidate(kept, where, gate, curve_over(len(kept)), 1.0), chosen, numbers, 1.0, 0.2)
    constants = [LawConstant("strength", 0.2, 0.1, 0.3, "1")]
    constants += [LawConstant(n, v, NAN, NAN, "1") for n, v in numbers.items()]
    constants += [LawConstant("time_constant", lag, NAN, NAN, "s")] if lag else []
    fitted = Fitted(PlacedLaw("law", match, ()), LawObjective(None, None, ()), None)  # pyright: ignore[reportArgumentType]
    return Law(
        "law", states, port, gate.name, "odd", " x ".join(form_names), (), (), tuple(constants), 0.97, False, False,
        {s: (0.0, 1.0) for s in states}, fitted, (),
    )  # fmt: skip


def discovery(law: Law) -> Discovery:
    return Discovery("march", "law", (law,), None, (), 0.97, {"pads": (7.0, 1.01)}, "pads", (), None, (), 1.0)  # pyright: ignore[reportArgumentType]


CASES = [
    ("adds to mu", ("speed",), ("bump",)),
    ("multiplies mu", ("slip",), ("sine",)),
    ("multiplies mu", ("time_since_reversal",), ("decay",)),
    ("adds to friction", ("last_peak_speed",), ("saturation",)),
    ("multiplies mu", ("load_rate",), ("saturation",)),
    ("adds to mu", ("heat", "speed"), ("linear", "linear")),
    ("even force on pads", ("slip",), ("saturation",)),
    ("girder", ("speed",), ("cube",)),
    ("girder", ("distance_since_reversal",), ("bump",)),
    ("girder by place", ("slip",), ("hinge",)),
    ("multiplies buffers", ("last_stroke",), ("power",)),
    ("load", ("slip",), ("bump",)),
    ("load", ("speed",), ("square",)),
]


@pytest.mark.parametrize(("port", "states", "names"), CASES, ids=lambda x: str(x))
def test_a_file_is_written_read_and_says_where_it_comes_from(port, states, names, tmp_path: Path) -> None:
    law = law_of(port, states, names)
    effect = load_effect(write_law(law, discovery(law).origin, tmp_path, "found", "2026-11-27"))
    assert "march" in effect.text and "No mechanism is claimed" in effect.text and "2026-11-27" in effect.text
    assert {c.name for c in law.constants} <= set(effect.parameter_names)
    assert effect.neutral()["strength"] == 0.0
    assert effect.typical()["strength"] == pytest.approx(0.2)


@pytest.mark.parametrize("gate", [EVERYWHERE, Gate("pad B", -1, 1), Gate("sliding back", way=-1)], ids=lambda g: g.name)
@pytest.mark.parametrize("port", ["adds to mu", "multiplies mu", "adds to friction"])
def test_the_hook_is_the_law(port: str, gate: Gate, tmp_path: Path) -> None:
    law = law_of(port, ("heat", "speed"), ("saturation", "linear"), gate)
    effect = load_effect(write_law(law, discovery(law).origin, tmp_path, "found", "2026-11-27"))
    given = {
        "heat": 0.4,
        "speed": 0.3,
        "load": 1.5e4,
        "side_x": -1.0,
        "side_y": 1.0,
        "velocity_x": 0.3,
        **effect.typical(),
    }
    hook = effect.hooks["coefficient"]
    asked = hook.__code__.co_varnames[: hook.__code__.co_argcount]
    got = hook(**{name: {**given, "coefficient": 0.1}[name] for name in asked})
    match = law.fitted.law.match
    form = product_at(match.forms, [np.array([0.4]), np.array([0.3])], match.constants)[0]
    open_here = 0.0 if gate.way < 0 else 1.0
    expected = {
        "adds to mu": 0.1 + open_here * 0.2 * form,
        "multiplies mu": 0.1 * (1.0 + open_here * 0.2 * form),
        "adds to friction": 0.1 + open_here * 0.2 * form * 2e4 / 1.5e4,
    }[port]
    assert got == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("port", "sign"), [("girder", -1.0), ("girder by place", 1.0)])
def test_a_force_at_the_centre_is_the_same_in_a_replay_and_in_the_balances(
    port: str, sign: float, tmp_path: Path
) -> None:
    law = law_of(port, ("slip",), ("sine",))
    effect = load_effect(write_law(law, discovery(law).origin, tmp_path, "found", "2026-11-27"))
    match = law.fitted.law.match
    expected = sign * 0.2 * product_at(match.forms, [np.array([0.004])], match.constants)[0]
    given = {"velocity_x": -0.3, "velocity_y": 0.0, "slip_x": 0.004, **effect.typical()}
    drag = effect.hooks["drag"]
    asked = drag.__code__.co_varnames[: drag.__code__.co_argcount]
    assert drag(**{name: given[name] for name in asked}) == (pytest.approx(expected, rel=1e-9), 0.0)
    states = SimpleNamespace(slip=np.array([[0.004, 0.0]]), velocity=np.array([[-0.3, 0.0]]))
    assert effect.hooks["balance"](states, **effect.typical())["girder"] == pytest.approx(expected, rel=1e-9)


def test_a_force_that_tips_the_girder_is_written_at_its_buffers(tmp_path: Path) -> None:
    law = dataclasses.replace(law_of("girder by place", ("slip",), ("bump",)), at_buffers=True)
    assert "spring" in load_effect(write_law(law, discovery(law).origin, tmp_path, "found", "2026-11-27")).hooks


def test_a_lift_that_no_hook_can_know_is_not_written() -> None:
    assert not can_be_written(law_of("load", ("time_since_reversal",), ("decay",)))
    assert can_be_written(law_of("load", ("speed",), ("square",)))


def test_words_from_a_campaign_stay_words(tmp_path: Path) -> None:
    law = law_of("adds to mu", ("speed",), ("bump",))
    hostile = dataclasses.replace(discovery(law), campaign='x"""\nimport os\n"""')
    effect = load_effect(write_law(law, hostile.origin, tmp_path, "found", "2026-11-27"))
    assert "os" not in vars(__import__("sys").modules[effect.hooks["coefficient"].__module__])


def test_a_name_of_the_catalogue_is_refused(tmp_path: Path) -> None:
    law = law_of("adds to mu", ("speed",), ("bump",))
    with pytest.raises(SettingError, match="run_in"):
        write_law(law, discovery(law).origin, tmp_path, "run_in", "2026-11-27")


def test_units_are_known_for_every_state() -> None:
    assert all(state in UNITS for _, states, _ in CASES for state in states)


def test_what_is_not_known_of_a_constant_is_null_in_json() -> None:
    told = discovery(law_of("adds to mu", ("speed",), ("bump",)))
    told = dataclasses.replace(told, relations={"pads": (7.0, NAN)})
    read = json.loads(json.dumps(told.as_json(), allow_nan=False))
    assert read["laws"][0]["constants"]["width"]["low"] is None
    assert read["held_out"] == {"before": 7.0, "after": None}


def test_a_constant_that_ran_to_its_bound_is_no_constant() -> None:
    law = law_of("adds to mu", ("speed",), ("bump",))
    open_ended = [dataclasses.replace(c, bound="upper") if c.name == "width" else c for c in law.constants]
    read = discovery(dataclasses.replace(law, constants=tuple(open_ended))).as_json()["laws"][0]
    assert "width" not in read["constants"] and read["undetermined"] == {"width": "upper"}
