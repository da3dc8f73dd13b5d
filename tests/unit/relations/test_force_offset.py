"""The zero of a slider's friction gauge is one number for all runs, or none."""

import numpy as np
import pytest

from measured import fit_base
from slipwise.campaign import load_campaign
from unit.campaign.slider import HEADER, slider, text


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
