"""The contract of effects at system level: what a simulation shows when they are off, and what they may move."""

from functools import cache

import numpy as np
import pytest

from shaking import shaken
from slipwise.effects import Effect, catalogue, moved_channels
from slipwise.model import base_model, use
from slipwise.record import Record
from slipwise.simulation.simulator import Replay
from slipwise.testing import driven
from slipwise.testing.driven import with_effect

EFFECTS = [e for e in catalogue().values() if not e.replaces]
every_effect = pytest.mark.parametrize("effect", EFFECTS, ids=lambda e: e.name)
TARGETS = ("pad_A_Fx",)


@cache
def shaking() -> np.ndarray:
    time = 5e-4 * np.arange(1600)
    out = np.zeros((len(time), 3))
    out[:, 0] = 4.0 * np.clip(time / 0.2, 0.0, 1.0) * np.sin(2 * np.pi * 2.5 * time)
    out[:, 1] = 1.0 * np.sin(2 * np.pi * 1.7 * time)
    out[:, 2] = 2.0 * np.clip(time / 0.2, 0.0, 1.0) * np.sin(2 * np.pi * 6.0 * time)
    return out


@cache
def base(framed: bool) -> Record:
    return shaken(driven.framed() if framed else driven.bridge(), shaking()).record


def base_of(effect: Effect) -> Record:
    return base("storeys" in effect.needs)


@every_effect
def test_a_simulation_with_the_neutral_effect_is_the_same_to_the_last_bit(effect: Effect) -> None:
    record = shaken(with_effect(effect, effect.neutral()), shaking()).record
    base = base_of(effect)
    assert set(record.channels) == set(base.channels)
    for name, values in base.channels.items():
        assert np.array_equal(record[name], values), name


def _same(name: str, values: np.ndarray, base: Record) -> bool:
    """To the bit; the girder pushes the table, whose inertia is 1e10 kg, by some nanometres."""
    allowed = 1e-7 if name.startswith("table_d") else 0.0
    return bool(np.abs(values - base[name]).max() <= allowed)


@every_effect
def test_a_simulation_moves_only_the_channels_that_the_effect_names(effect: Effect) -> None:
    record = shaken(with_effect(effect), shaking()).record
    base = base_of(effect)
    moved = {n for n, values in record.channels.items() if n not in base or not _same(n, values, base)}
    assert moved, "at its typical size it must do something"
    if effect.target:
        assert moved <= {n for n in record.channels if n[:5] in {t[:5] for t in TARGETS}}
    else:
        assert moved <= moved_channels(effect, record.channels)
    assert all(np.isfinite(values).all() for values in record.channels.values())


def _friction(answer: Replay) -> float:
    """Mean coefficient of pad A while it slides."""
    record = answer.record
    fast = np.abs(record["slip_vx"]) > 0.05
    return float(np.mean(np.abs(record["pad_A_Fx"][fast]) / record["pad_A_N"][fast]))


def test_what_pads_and_buffers_remember_goes_on_in_the_next_run() -> None:
    """Slid distance and the largest stroke stay; heat goes in a pause."""
    for name, kept in (("run_in", True), ("heating", False)):
        model = with_effect(catalogue()[name], {**catalogue()[name].typical(), **({"distance": 0.02} if kept else {})})
        first = shaken(model, shaking())
        at_once = shaken(model, shaking(), start=first.memory)
        later = shaken(model, shaking(), start=first.memory, rest=86400.0)
        assert _friction(at_once) < 0.97 * _friction(first), name
        back = abs(_friction(later) - _friction(first)) < 0.2 * abs(_friction(at_once) - _friction(first))
        assert back is not kept, name
    rubber = with_effect(catalogue()["buffer_softening"])
    first = shaken(rubber, shaking())
    again = shaken(rubber, shaking(), start=first.memory, rest=86400.0)
    stiff = [r.record["buffer_1_Fx"][200] / r.record["slip_x"][200] for r in (first, again)]
    assert stiff[1] < 0.95 * stiff[0]


def test_presliding_becomes_the_rigid_stick_as_its_length_vanishes() -> None:
    rigid = base(framed=False)["slip_x"]
    for length, error in ((1e-4, 0.05), (1e-5, 0.005), (1e-6, 1e-3)):
        for exponent in (0.0, 1.0):
            model = base_model("bridge1").adding(use("presliding", length=length, exponent=exponent))
            slip = shaken(model, shaking()).record["slip_x"]
            assert np.abs(slip - rigid).max() < error * np.ptp(rigid)


@pytest.mark.parametrize("name", ["presliding", "heating", "key_clearance", "buffer_hysteresis", "key_friction"])
def test_both_engines_replay_alike(name: str) -> None:
    model = with_effect(catalogue()[name])
    short = shaking()[:800]
    compiled, python = (shaken(model, short, engine=engine).record for engine in ("compiled", "python"))
    for channel, values in compiled.channels.items():
        scale = max(np.abs(values).max(), 1e-12)
        assert np.abs(python[channel] - values).max() < 1e-9 * scale, channel
