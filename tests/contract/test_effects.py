"""What every effect of the catalogue keeps, so that adding one needs nothing but its file."""

from collections.abc import Callable
from statistics import median

import numpy as np
import pytest

from slipwise.effects import COMPONENTS, PORTS, Effect, catalogue
from slipwise.model import EffectUse
from slipwise.simulation.kernel import kernel, places
from slipwise.simulation.predict import predictor
from slipwise.testing import CHECKS
from slipwise.testing.driven import answers, arrays, bridge, motion, with_effect

EFFECTS = list(catalogue().values())
OPTIONAL = [e for e in EFFECTS if not e.replaces]
every_effect = pytest.mark.parametrize("effect", EFFECTS, ids=lambda e: e.name)
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


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
@every_effect
def test_an_effect_keeps_the_contract(effect: Effect, check: Callable[[Effect], None]) -> None:
    check(effect)


@every_effect
def test_port_component_and_rivals_exist(effect: Effect) -> None:
    assert effect.component in COMPONENTS and effect.port in PORTS
    assert set(effect.confused_with) <= set(catalogue())


@every_effect
def test_an_effect_fits_on_a_page(effect: Effect) -> None:
    assert len(effect.path.read_text().splitlines()) <= 100


def test_the_median_effect_has_at_most_sixty_lines() -> None:
    assert median(len(e.path.read_text().splitlines()) for e in EFFECTS) <= 60


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
