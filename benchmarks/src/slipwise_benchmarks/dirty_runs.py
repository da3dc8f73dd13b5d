"""Runs of a dirty campaign: how many, which motions, how strong."""

import numpy as np

from slipwise_benchmarks.campaign import fit_amplitude
from slipwise_benchmarks.dirty_plan import Plan
from slipwise_benchmarks.motions import Motion, draw_sine
from slipwise_benchmarks.quakes import draw_pulse, draw_record, draw_sweep
from slipwise_benchmarks.settings import GRAVITY, Settings

#: Files in order of the runs, by how many there are; the name says what a file may hold, not what it does.
_ROLES: dict[int, tuple[tuple[str, str], ...]] = {
    2: (("run_1", "fit"), ("run_2", "holdout")),
    3: (("run_1", "fit"), ("run_2", "fit"), ("run_3", "holdout")),
    4: (("run_1", "fit"), ("run_2", "fit"), ("run_3", "fit"), ("run_4", "holdout")),
    5: (("run_1", "fit"), ("run_2", "fit"), ("run_3", "fit"), ("run_4", "repeat"), ("run_5", "holdout")),
}
#: Length of a run, of a short one and of a long one [s].
_LENGTH, _SHORT, _LONG = (6.5, 9.0), 4.0, (14.0, 20.0)
#: Vertical shaking that takes pads near zero load or off it, peak [m/s^2].
_LIFTING = (0.85 * GRAVITY, 1.15 * GRAVITY)


def draw_dirty_runs(
    natural: float, base: Settings, plan: Plan, rng: np.random.Generator
) -> tuple[dict[str, Motion], tuple[tuple[str, str], ...]]:
    """Draw motions whose slips of the base rig are about 8 to 32 mm.

    Args:
        natural: frequency round which a sine is drawn [Hz].
        base: the rig.
        plan: of the campaign.
        rng: generator.

    Returns:
        run -> motion, and (run, role) in order.
    """
    roles = _ROLES[plan.runs]
    motions: dict[str, Motion] = {}
    for number, (run, role) in enumerate(roles):
        if role == "repeat":
            motions[run] = motions[roles[number - 1][0]]
        elif number == 0 and len(roles) > 2:
            motions[run] = _steady(natural, base, plan, rng)
        else:
            motions[run] = _record(base, plan, rng, long=number == 1 and role == "fit")
    if len(roles) > 3 and rng.random() < 0.6:
        motions[roles[1][0]] = motions[roles[1][0]].without_vertical()
    if plan.uplift:
        last = [run for run, role in roles if role == "fit"][-1]
        peak = float(np.abs(motions[last].az).max())
        stronger = motions[last].scaled(1.0, rng.uniform(*_LIFTING) / peak)
        motions |= {run: stronger for run, motion in list(motions.items()) if motion is motions[last]}
    return motions, roles


def _length(plan: Plan, rng: np.random.Generator, long: bool = False) -> float:
    if plan.short:
        return _SHORT
    return float(rng.uniform(*(_LONG if long and rng.random() < 0.3 else _LENGTH)))


def _steady(natural: float, base: Settings, plan: Plan, rng: np.random.Generator) -> Motion:
    """Draw a sine or a sweep, or a record where a laboratory had no time for either."""
    kind = str(rng.choice(["sine", "sweep", "record"], p=[0.5, 0.25, 0.25]))
    if kind == "record" or plan.short:
        return _record(base, plan, rng)
    motion = draw_sine(natural, rng, plan.rich) if kind == "sine" else draw_sweep(rng, _length(plan, rng), plan.rich)
    return fit_amplitude(base, motion, rng.uniform(0.008, 0.022), 0.12 * GRAVITY, 0.5 * GRAVITY)


def _record(base: Settings, plan: Plan, rng: np.random.Generator, long: bool = False) -> Motion:
    """Draw a record, one time in four with a near-fault pulse."""
    length = _length(plan, rng, long)
    draw = draw_pulse if rng.random() < 0.25 else draw_record
    motion = draw(rng, length, plan.rich)
    return fit_amplitude(base, motion, rng.uniform(0.012, 0.032), 0.25 * GRAVITY, 1.0 * GRAVITY)
