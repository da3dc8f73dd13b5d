"""A slider whose slip is read by a gauge and in coarse steps: its law is followed as well as the place is known."""

from pathlib import Path

import numpy as np

from slipwise.campaign import load_campaign
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import fit_base
from slipwise.estimation.least_squares import solve
from slipwise.relations.parameters import Term
from unit.campaign.slider import RUNS, text

#: Way over which friction turns round, noise of the slip gauge [mm]; steps of the path between two samples.
LENGTH, NOISE, FINE = 0.025, 0.0008, 40
#: Force at full sliding, noise of its gauge [kN].
FRICTION, GAUGE = 1.2, 0.002


def sampled_at_50_hertz(seed: int, speed: float) -> np.ndarray:
    """Give time [s], slip [mm], load [kN] and Dahl's friction [kN] of a triangle wave with round corners, (n, 4)."""
    period = 4.0 * 2.5 / speed
    time = np.arange(0.0, 3.2 * period, 0.02 / FINE)
    slip = 2.5 * np.arcsin(0.98 * np.sin(2.0 * np.pi * time / period)) / np.arcsin(0.98)
    share = np.zeros(len(time))
    for i, way in enumerate(np.diff(slip), start=1):
        share[i] = np.sign(way) + (share[i - 1] - np.sign(way)) * np.exp(-abs(way) / LENGTH)
    taken = slice(None, None, FINE)
    noise = np.random.default_rng(seed).standard_normal((3, len(time[taken])))
    load, force = 10.0 + 0.01 * noise[0], FRICTION * share[taken] + GAUGE * noise[1]
    return np.stack([time[taken], slip[taken] + NOISE * noise[2], load, force], axis=1)


def test_the_true_law_leaves_what_gauge_and_sampling_explain(tmp_path: Path) -> None:
    """Ten times the gauge's noise, and at a turning between two samples a hundred times, is no other law."""
    (tmp_path / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n[logger]\nlowpass = "none"\n{RUNS}')
    for name, seed, speed in (("one", 1, 3.0), ("two", 2, 12.0)):
        (tmp_path / f"{name}.csv").write_text(text(sampled_at_50_hertz(seed, speed)))
    base = fit_base(load_campaign(tmp_path))
    term = Term(catalogue()["presliding"])
    true = {**term.effect.typical(), "length": 1e-3 * LENGTH, "rated": 1e3 * FRICTION}
    at = {**base.solution.values, **{f"presliding.{name}": value for name, value in true.items()}}
    objective = base.objective.adding(term)
    for _ in range(2):  # the base model's friction stood in for the law
        objective = objective.weigh(at, finer=True)
        at = dict(solve(objective, at, base.free, most=10).values)
    residuals = objective.residuals(at)
    for i in range(2):
        left = residuals.stacked([i])
        assert 0.3 < np.sqrt(np.mean(left**2)) < 1.5
        assert np.abs(left).max() < 6.0
        in_gauges = np.abs(left * objective.weighing.sigmas["pads"][i].ravel()[-len(left) :]) / (1e3 * GAUGE)
        assert in_gauges.max() > 10.0, "the gauge of the force alone does not explain it"
