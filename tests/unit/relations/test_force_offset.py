"""The zero of a slider's friction gauge is one number for all runs, or none."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from measured import fit_base
from slipwise.campaign import load_campaign
from slipwise.relations.force_offset import free_zero
from unit.campaign.slider import HEADER, slider, text

ZERO_FORCE = -200.0


def _campaign(folder, shifts, rows=slider):
    runs = []
    for seed, shift in enumerate(shifts):
        table = rows(seed)
        table[:, 3] += shift
        (folder / f"run{seed}.csv").write_text(text(table, HEADER))
        runs.append(f'[[run]]\nfile = "run{seed}.csv"\nrole = "fit"\n')
    (folder / "campaign.toml").write_text('name = "slider"\nrig = "pad"\n' + "".join(runs))
    return load_campaign(folder)


@pytest.mark.parametrize("shift", [-0.05, 0.0, 0.03])
def test_a_zero_that_all_runs_share_is_fitted(tmp_path, shift):
    base = fit_base(_campaign(tmp_path, (shift, shift)))
    assert base.solution.values["rig.zero_force"] == pytest.approx(1e3 * shift, abs=2.0)


def test_no_zero_is_fitted_where_runs_disagree(tmp_path):
    assert "rig.zero_force" not in fit_base(_campaign(tmp_path, (0.0, 0.2))).solution.values


def test_no_zero_is_fitted_where_the_slider_moves_one_way(tmp_path):
    def drawn(seed):
        table = slider(seed)
        table[:, 1] = np.abs(np.cumsum(np.abs(np.diff(table[:, 1], prepend=0.0))))
        table[:, 3] = np.abs(table[:, 3])
        return table

    assert "rig.zero_force" not in fit_base(_campaign(tmp_path, (0.0,), drawn)).solution.values


def run(rest: str, largest: float = 0.1) -> Any:
    """Give a run of a slider with 10 kN of friction, a gauge that is off, and something else."""
    time = np.arange(0.0, 8.0, 0.01)
    slip = largest * np.sin(2.0 * np.pi * 0.5 * time) * np.where(time < 3.0, 0.7, 1.0)
    velocity = np.gradient(slip, time)
    force = 1e4 * np.sign(velocity) + ZERO_FORCE
    if rest == "breakaway":
        force += np.where(time < 3.2, 4e3, 2.5e3) * np.sign(velocity) * np.exp(-((velocity / 0.02) ** 2)) * (slip > 0.0)
    elif rest == "spring":
        force += 3e5 * slip
    elif rest == "wall":
        force += 1e6 * np.sign(slip) * np.maximum(np.abs(slip) - 0.06, 0.0)
    sliding = np.abs(velocity) > 0.003
    return SimpleNamespace(time=time, slip=slip, velocity=velocity, force=force[:, None], sliding=sliding)


@pytest.mark.parametrize("rest", ["nothing", "breakaway", "spring", "wall"])
def test_a_zero_is_the_same_whatever_else_the_bearing_does(rest: str) -> None:
    zero = free_zero([run(rest), run(rest, 0.09)])
    assert zero is not None
    assert zero.start == pytest.approx(ZERO_FORCE, abs=20.0)
