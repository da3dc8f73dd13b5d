"""The second simulator on rigs of other pads: any number, of any kind, flat or on spheres, against closed forms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from slipwise_benchmarks.drawn_rigs import as_built, draw_rig
from slipwise_benchmarks.motions import STEP, Motion, draw_quake
from slipwise_benchmarks.parts import Buffer, Pad
from slipwise_benchmarks.rig_ode import simulate
from slipwise_benchmarks.settings import GRAVITY, Settings, buffers_of, pad_names, pads_of, rated


def strong_part(seed: int, across: bool = False) -> Motion:
    whole = draw_quake(np.random.default_rng(seed), across)
    return Motion(whole.ax[1600:6000], whole.ay[1600:6000], whole.az[1600:6000])


def kick(speed: float, seconds: float) -> Motion:
    """A table that is kicked backwards within 5 ms, so that the girder slips forwards at `speed`."""
    time = np.arange(0.0, seconds, STEP)
    ax = np.where(time < 5.0e-3, -speed / 5.0e-3, 0.0)
    return Motion(ax, np.zeros_like(ax), np.zeros_like(ax))


def of_pads(base: Settings, pads: list[Pad], buffers: tuple[Buffer, ...], **changes: float) -> Settings:
    n = len(pads)
    each = {"seating": (0.0,) * n, "patch": (0.0,) * n, "pad_factor": (1.0,) * n, "law_pads": (1.0,) * n}
    return base.changed(pads=pads, buffers=buffers, **each, **changes)


def test_the_girder_on_four_pads_is_one_rig_among_others():
    base = rated("bridge2").changed(centre_y=0.05)
    own = of_pads(base, list(pads_of(base)), buffers_of(base))
    motion = strong_part(3, across=True)
    there, again = simulate(base, motion), simulate(own, motion)
    assert list(there) == list(again)
    assert all(np.array_equal(values, again[name]) for name, values in there.items())


def test_pads_cut_in_two_and_buffers_in_three_change_nothing():
    base = rated("bridge1")
    a, b, c, d = pads_of(base)
    half = {name: 0.5 * getattr(a, name) for name in ("area", "stiffness", "damping")}
    pads = [
        a._replace(name="A", **half),
        b,
        a._replace(name="E", **half),
        c,
        d._replace(**half),
        d._replace(name="F", **half),
    ]
    third = [
        one._replace(stiffness_x=one.stiffness_x / 1.5, stiffness_y=one.stiffness_y / 1.5) for one in buffers_of(base)
    ]
    middle = third[0]._replace(name="3", y=0.0)
    wide = np.sqrt(1.5)  # so that the outer two resist yaw as the pair did
    buffers = (*(one._replace(y=wide * one.y) for one in third), middle)
    motion = strong_part(4, across=True)
    whole, cut = simulate(base, motion), simulate(of_pads(base, pads, buffers), motion)
    assert cut["slip_x"] == pytest.approx(whole["slip_x"], abs=1e-7)
    assert cut["slip_y"] == pytest.approx(whole["slip_y"], abs=1e-7)
    assert cut["pad_A_N"] + cut["pad_E_N"] == pytest.approx(whole["pad_A_N"], abs=0.5)
    assert cut["pad_D_Fx"] == pytest.approx(cut["pad_F_Fx"], abs=1e-6)


def test_three_pads_carry_what_statics_says():
    kind = (1.0e-3, 2.0e8, 4.0e4)
    places = {"A": (1.5, 1.0), "B": (-1.0, 0.6), "C": (0.2, -1.4)}
    rig = of_pads(rated("block"), [Pad(name, *xy, *kind) for name, xy in places.items()], (), centre_x=0.1)
    run = simulate(rig, strong_part(5).scaled(0.0, 0.0))
    arms = np.array([(1.0, x - 0.1, y) for x, y in places.values()]).T
    shares = np.linalg.solve(arms, [rig.mass * GRAVITY, 0.0, 0.0])
    assert [run[f"pad_{pad}_N"][-1] for pad in "ABC"] == pytest.approx(shares, rel=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_drawn_rig_balances_and_follows_its_law_on_every_pad(seed):
    rig = as_built(draw_rig(np.random.default_rng(seed)), np.random.default_rng(seed)).changed(yaw_known=1)
    motion = strong_part(6, across=True).scaled(0.5, 0.5)
    run = simulate(rig, motion)
    names = pad_names(rig)
    load, force = (sum(run[f"pad_{pad}_{part}"] for pad in names) for part in ("N", "Fx"))
    spring = sum(run[f"buffer_{b.name}_Fx"] for b in rig.buffers)
    assert load == pytest.approx(rig.mass * (GRAVITY + run["girder_az"]), rel=1e-9)
    assert rig.mass * run["girder_ax"] == pytest.approx(-force - spring, abs=1e-9 * rig.mass * GRAVITY)
    for pad in names:
        assert run[f"pad_{pad}_Fx"] == pytest.approx(run[f"pad_{pad}_Fx_base"], abs=1e-9 * rig.mass * GRAVITY)


def pendulum(radius: float, friction: float) -> Settings:
    """A rigid mass on four spheres, which nothing but its pads holds; friction is Coulomb's."""
    base = rated("block").changed(height=0.3, s1=0.0, alpha=friction, stick_length=1.0e-7, stick_damping=1.0)
    pads = [pad._replace(curvature=1.0 / radius) for pad in pads_of(base)]
    return of_pads(base, pads, ())


def turns(run: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Give times and places at which slip turns round."""
    velocity = run["slip_vx"]
    at = np.flatnonzero((velocity[:-1] * velocity[1:] < 0.0) & (np.abs(run["slip_x"][1:]) > 5e-3))
    share = velocity[at] / (velocity[at] - velocity[at + 1])
    return run["time"][at] + share * np.diff(run["time"])[0], run["slip_x"][at]


@pytest.mark.parametrize(("radius", "speed"), [(1.0, 0.1), (2.0, 0.8), (0.5, 0.9)])
def test_a_pendulum_swings_with_the_closed_forms_period_however_far(radius, speed):
    run = simulate(pendulum(radius, 0.002), kick(speed, 4.0))
    when, where = turns(run)
    half = np.diff(when)[0]
    reach = 0.5 * (abs(where[0]) + abs(where[1]))
    angle = np.arcsin(reach / radius)
    assert half == pytest.approx(2.0 * np.sqrt(radius / GRAVITY) * ellipk(np.sin(angle / 2.0) ** 2), rel=2e-3)
    height = radius - np.sqrt(radius**2 - where[0] ** 2)
    lost = 0.002 * GRAVITY * radius * np.arcsin(where[0] / radius)
    start = run["slip_vx"][np.searchsorted(run["time"], 6.0e-3)]
    assert GRAVITY * height + lost == pytest.approx(0.5 * start**2, rel=0.01)


@pytest.mark.parametrize("radius", [0.5, 2.0])
def test_a_pendulum_with_friction_goes_as_far_as_a_point_on_a_sphere(radius):
    friction = 0.06
    motion = kick(0.8, 1.5)
    run = simulate(pendulum(radius, friction), motion)
    start = np.searchsorted(run["time"], 6.0e-3)

    def along(_: float, state: np.ndarray) -> list[float]:
        angle, rate = state
        press = GRAVITY * np.cos(angle) + radius * rate**2
        return [rate, -(GRAVITY * np.sin(angle) + np.sign(rate) * friction * press) / radius]

    angle = np.arcsin(run["slip_x"][start] / radius)
    state = [angle, run["slip_vx"][start] / (radius * np.cos(angle))]
    stop = lambda _, state: state[1]  # noqa: E731
    stop.terminal = True
    own = solve_ivp(along, (0.0, 2.0), state, events=stop, rtol=1e-9, atol=1e-12)
    assert run["slip_x"].max() == pytest.approx(radius * np.sin(own.y[0, -1]), rel=5e-3)
    last = run["slip_x"][-1]
    assert abs(last) <= friction * radius / np.sqrt(1.0 + friction**2) * 1.01  # where friction holds it
