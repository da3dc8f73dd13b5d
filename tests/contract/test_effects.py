"""What every effect of the catalogue keeps, so that adding one needs nothing but its file."""

import fnmatch
import re
from statistics import median

import numpy as np
import pytest

from driven import TARGET, answers, arrays, base_of, bridge, motion, record, with_effect
from slipwise.effects import COMPONENTS, PORTS, Effect, catalogue, moved_channels
from slipwise.model import EffectUse
from slipwise.simulation.kernel import kernel, places
from slipwise.simulation.predict import predictor
from slipwise.units import parse_unit

EFFECTS = list(catalogue().values())
OPTIONAL = [e for e in EFFECTS if not e.replaces]
every_effect = pytest.mark.parametrize("effect", EFFECTS, ids=lambda e: e.name)
every_optional_effect = pytest.mark.parametrize("effect", OPTIONAL, ids=lambda e: e.name)
#: What an effect may change at component level, by the hooks it has.
REACH = {
    "area": {"pads"}, "shear": {"pads"}, "stick": {"pads"}, "pad": {"pads"}, "face": {"pads"}, "stretch": {"pads"},
    "advance": set(), "rest": set(), "begin": set(), "flat": set(), "corner": set(),
    "deflection": {"buffers", "balance heave"},
    "spring": {"buffers", "balance heave"},
    "settle": {"buffers"}, "lift": {"lift"}, "drag": {"drag"}, "rig": {"specimen"}, "table": {"table"},
    "balance": {"balance *"}, "gauge": {"channels *"}, "undo": set(), "sharpen": set(), "disturb": set(),
}  # fmt: skip

#: These names are a contract: users write them in model.toml, and diagnosis.json gives them.
NAMES = """
contact_area shear_rate breakaway presliding heating run_in rate_and_state pressure_law direction_asymmetry anisotropy
position_patch pad_spread slide_tilt slide_curvature
pad_compliance uneven_seating mass_eccentricity
buffer_damping buffer_hysteresis buffer_hardening buffer_softening buffer_mismatch buffer_height key_clearance
key_friction
girder_bending guide_drag table_pitch table_cross_axis table_gain
channel_delay channel_gain channel_sign channel_offset channel_drift channel_filter channel_clipping dropped_samples
clock_skew load_crosstalk cell_inertia
machine_compliance backlash restrainer superstructure
""".split()


def test_the_catalogue_holds_the_names_of_the_contract() -> None:
    assert sorted(catalogue()) == sorted(NAMES)


@every_effect
def test_a_reader_finds_equation_range_and_source_in_the_docstring(effect: Effect) -> None:
    title, blank, *rest = effect.text.splitlines()
    assert title.endswith(".") and not blank
    assert any(re.match(r"    \S.*=", line) for line in rest), "an indented equation"
    assert any(line and not line.startswith((" ", "Valid:", "Source:")) for line in rest), "plain words"
    assert re.search(r"^Valid: .*\.", effect.text, re.M | re.S) and re.search(
        r"^Source: .*\.", effect.text, re.M | re.S
    )
    assert "=" in effect.equation or "~" in effect.equation


@every_effect
def test_every_number_has_a_unit_bounds_and_a_source(effect: Effect) -> None:
    assert effect.component in COMPONENTS and effect.port in PORTS
    for parameter in effect.parameters:
        assert parse_unit(parameter.shown_in or parameter.unit, parameter.unit, parameter.name) > 0.0
        assert parameter.low < parameter.typical < parameter.high or parameter.typical in (
            parameter.low,
            parameter.high,
        )
        assert np.isfinite([parameter.low, parameter.high]).all()
        # A bare measure without a reference is called assumed, in writing.
        assert re.search(r"assumed|[A-Z][a-z]+|paper|definition|\d", parameter.source)


@every_effect
def test_rivals_are_effects_with_a_test_that_tells_them_apart(effect: Effect) -> None:
    assert effect.signature
    assert effect.confused_with, "every effect looks like something else somewhere"
    for rival, test in effect.confused_with.items():
        assert rival in catalogue() and rival != effect.name and len(test) > 10


@every_effect
def test_an_effect_fits_on_a_page(effect: Effect) -> None:
    assert len(effect.path.read_text().splitlines()) <= 100


def test_the_median_effect_has_at_most_sixty_lines() -> None:
    assert median(len(e.path.read_text().splitlines()) for e in EFFECTS) <= 60


def _tried(effect: Effect, count: int = 24) -> list[dict[str, float]]:
    """All corners of one parameter at a time and random points of the whole box."""
    rng = np.random.default_rng(sum(map(ord, effect.name)))
    found = [{**effect.typical(), p.name: bound} for p in effect.parameters for bound in (p.low, p.high)]
    found += [{p.name: p.low for p in effect.parameters}, {p.name: p.high for p in effect.parameters}]
    found += [{p.name: float(rng.uniform(p.low, p.high)) for p in effect.parameters} for _ in range(count)]
    return found


def _rough(seed: int, dt: float) -> dict[str, np.ndarray]:
    """States beyond anything measured: jumps, standstill, lifted pads, eight times the rated load."""
    rng = np.random.default_rng(seed)
    n = 120
    speed = rng.choice([0.0, 1e-12, 1e-6, 1e-3, 0.1, 3.0], n) * rng.choice([-1.0, 1.0], n)
    slip = np.cumsum(speed) * dt
    both = np.stack([slip, 0.3 * np.roll(slip, 3)], axis=1)
    rate = np.stack([speed, 0.3 * np.roll(speed, 3)], axis=1)
    return {
        "time": np.arange(n) * dt,
        "slip": np.repeat(both[:, None], 4, axis=1),
        "velocity": np.repeat(rate[:, None], 4, axis=1),
        "load": rng.choice([0.0, 1e-9, 1.0, 5e3, 24.5e3, 200e3], (n, 4)),
        "girder": rng.normal(0.0, 20.0, (n, 3)),
        "table": rng.normal(0.0, 20.0, (n, 3)),
    }


@every_effect
def test_answers_are_finite_over_all_bounds_and_states_beyond_the_measured(effect: Effect) -> None:
    for seed, values in enumerate(_tried(effect)):
        answer = arrays(answers(with_effect(effect, values), moving=_rough(seed, (0.0005, 0.002)[seed % 2])))
        for name, array in answer.items():
            assert np.isfinite(array).all(), f"{name} at {values}"


@every_effect
def test_friction_never_drives(effect: Effect) -> None:
    """A bound below zero would be friction that pushes along the motion."""
    for seed, values in enumerate(_tried(effect, 4)):
        rough = _rough(seed, 0.002)
        forces = predictor(with_effect(effect, values)).pads(*(rough[k] for k in ("time", "load", "velocity", "slip")))
        assert (forces.bound >= 0.0).all()
        assert (forces.bound[rough["load"] <= 0.0] == 0.0).all(), "a lifted pad rubs on nothing"


@every_effect
def test_both_engines_answer_alike(effect: Effect) -> None:
    compiled, python = arrays(answers(with_effect(effect))), arrays(answers(with_effect(effect), "python"))
    for name, array in compiled.items():
        np.testing.assert_allclose(array, python[name], rtol=1e-12, atol=1e-12 * max(np.abs(array).max(), 1e-30))


@pytest.mark.parametrize("engine", ["compiled", "python"])
@pytest.mark.parametrize("effect", [e for e in EFFECTS if "face" not in e.hooks], ids=lambda e: e.name)
def test_one_instant_after_another_answers_as_the_whole_record(effect: Effect, engine: str) -> None:
    moving, model = motion(), with_effect(effect)
    arguments = [moving[key] for key in ("time", "load", "velocity", "slip")]
    whole = predictor(model, engine=engine).pads(*arguments)
    single = predictor(model, engine=engine)
    step = {n: single.law.functions[f"pad_{n}"] for n in ("bound", "explicit", "further", "advance")}
    train = single.law.functions["follow_train"]
    layout, u = single.law.layout, single.numbers
    z, dt, place = layout.first_pad + 2 * layout.pad_block, 0.002, (1.0, -1.0)  # pad C
    for i in range(0, 200):
        state = (*moving["velocity"][i, 2], *moving["slip"][i, 2], *place, moving["time"][i], dt)
        load = moving["load"][i, 2]
        bound = step["bound"](u, z, load, *state)
        speed = np.hypot(*moving["velocity"][i, 2])
        force = bound * moving["velocity"][i, 2] / speed if speed > 0.0 else np.zeros(2)
        if u[places.N_STICK] > 0.0:
            force = np.array(step["explicit"](u, z, bound, load, *state))
        velocity, mean = state[:2], 0.5 * (moving["velocity"][i, 2] + moving["velocity"][i + 1, 2])
        if u[places.N_TRAIN] > 0.0:
            *force, bound = train(u, z, load, *state)
            velocity = mean = u[z + places.TRAIN_VELOCITY : z + places.TRAIN_VELOCITY + 2].copy()
        friction = float(np.hypot(*force))
        state = (*velocity, *state[2:])
        more = step["further"](u, z, bound, friction, load, *state)
        step["advance"](u, z, bound, friction, load, *mean, *state[2:-1], moving["time"][i + 1] - moving["time"][i])
        np.testing.assert_allclose(np.add(force, more), whole.force[i, 2], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(bound, whole.bound[i, 2], rtol=1e-12, atol=1e-12)


@every_optional_effect
def test_at_its_neutral_value_an_effect_changes_no_bit(effect: Effect) -> None:
    base, neutral = answers(base_of(effect)), answers(with_effect(effect, effect.neutral()))
    assert neutral["specimen"] == base["specimen"]
    ours = arrays(neutral)
    for name, array in arrays(base).items():
        assert np.array_equal(array, ours[name]), name


@every_optional_effect
def test_shape_constants_alone_switch_nothing_on(effect: Effect) -> None:
    values = effect.neutral() | {p.name: p.high for p in effect.parameters if p.neutral is None}
    base, ours = arrays(answers(base_of(effect))), arrays(answers(with_effect(effect, values)))
    for name, array in base.items():
        assert np.array_equal(array, ours[name]), name


@every_effect
def test_an_effect_changes_what_it_should_and_nothing_else(effect: Effect) -> None:
    if effect.replaces:
        values = {p.name: 1.1 * p.typical for p in effect.parameters}
        base = answers(with_effect(effect))
    else:
        values, base = effect.typical(), answers(base_of(effect))
    ours = answers(with_effect(effect, values))
    changed = {n for n, a in arrays(base).items() if not np.array_equal(a, arrays(ours)[n])}
    changed |= {"specimen"} if ours["specimen"] != base["specimen"] else set()
    allowed = set().union(*(REACH[hook] for hook in effect.hooks))
    allowed |= {"channels pad_*_F?"} if "pads" in allowed else set()  # forces of the pads are channels too
    assert changed, "at its typical size it must do something"
    assert all(any(fnmatch.fnmatchcase(name, pattern) for pattern in allowed) for name in changed), changed
    if effect.target:
        pad = TARGET[:5]
        assert all(name.startswith(f"channels {pad}") for name in changed), changed
    moved = moved_channels(effect)
    for name in changed:
        if name.startswith("channels "):
            assert name.removeprefix("channels ") in moved or "*" in effect.moves


@pytest.mark.parametrize("effect", [e for e in EFFECTS if "undo" in e.hooks], ids=lambda e: e.name)
def test_undo_takes_back_what_the_gauge_did(effect: Effect) -> None:
    pads = answers(base_of(effect))["pads"][: motion()["time"].size * 8].reshape(-1, 4, 2)
    true = record(motion(), pads)
    target = TARGET if effect.name in ("load_crosstalk", "cell_inertia") else "slip_x"
    read = effect.hooks["gauge"](true, target, **effect.typical())
    back = effect.hooks["undo"](read, target, **effect.typical())
    inside = slice(60, -60)  # what a delay takes beyond the ends does not come back
    for name, values in true.channels.items():
        np.testing.assert_allclose(back[name][inside], values[inside], atol=2e-4 * np.abs(values).max(), err_msg=name)


def test_any_order_of_listing_keeps_the_paper_law_at_the_bottom() -> None:
    late = bridge().without("shear_rate").adding(EffectUse(catalogue()["run_in"], catalogue()["run_in"].typical()))
    late = late.adding(EffectUse(catalogue()["shear_rate"], catalogue()["shear_rate"].typical()))
    early = bridge().adding(EffectUse(catalogue()["run_in"], catalogue()["run_in"].typical()))
    assert np.array_equal(arrays(answers(late))["pads"], arrays(answers(early))["pads"])


@pytest.mark.parametrize("adding", ["breakaway", "rate_and_state"])
def test_what_scales_friction_scales_every_share_of_it_whichever_was_listed_first(adding: str) -> None:
    share, patch = (EffectUse(catalogue()[n], catalogue()[n].typical()) for n in (adding, "position_patch"))
    early, late = bridge().adding(share, patch), bridge().adding(patch, share)
    assert np.array_equal(arrays(answers(late))["pads"], arrays(answers(early))["pads"])
    alone = arrays(answers(bridge().adding(share)))["pads"]
    assert not np.array_equal(arrays(answers(early))["pads"], alone), "the patch must act"


def test_all_effects_of_one_instant_act_together() -> None:
    model = bridge()
    for effect in OPTIONAL:
        if effect.instant_hooks and effect.port != "train":  # presliding takes that place here
            model = model.adding(EffectUse(effect, effect.typical()))
    compiled, python = arrays(answers(model)), arrays(answers(model, "python"))
    for name, array in compiled.items():
        assert np.isfinite(array).all()
        np.testing.assert_allclose(array, python[name], rtol=1e-12, atol=1e-12 * max(np.abs(array).max(), 1e-30))


def test_one_kernel_serves_every_model() -> None:
    assert kernel("compiled") is kernel("compiled")
