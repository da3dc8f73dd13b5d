"""Records that were logged far faster than anything moves: what is thinned out, and what predictions go through."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Logger, Run
from slipwise.preparation.decimation import decimate
from slipwise.record import Record
from slipwise.relations.pad_law import log_force
from slipwise.relations.run_data import fit_runs
from slipwise.rig import load_specimen
from slipwise.signals.filters import LowPass

DT, TURN = 5e-4, 4.0 * np.pi


def sharp(time: np.ndarray) -> np.ndarray:
    """Friction [N] that turns round in the middle between two samples."""
    return 2.7e3 * np.sign(np.sin(TURN * (time + 0.5 * DT)))


def logged(logger: Logger) -> Campaign:
    """A girder that slides to and fro, every channel sampled as it is; friction turns round at once."""
    specimen = load_specimen("bridge1")
    time = np.asarray(np.arange(4000) * DT, dtype=np.float64)
    slip = 0.02 * (1.0 - np.cos(TURN * time))
    friction = sharp(time)
    channels = {"slip_x": slip, "table_ax": 0.0 * time, "girder_ax": np.gradient(np.gradient(slip, DT), DT)}
    channels |= {f"pad_{p}_N": np.full(len(time), 24.5e3) for p in "ABCD"}
    channels |= {f"pad_{p}_Fx": friction for p in "ABCD"}
    run = Run("run", "fit", Record(time, channels), 1800.0, None, "run.csv", "1")
    return Campaign("fast", "bridge1", specimen, logger, (run,), Path())


def test_a_prediction_goes_through_the_filter_that_thinned_the_record() -> None:
    thinned, _ = decimate(logged(Logger(None, known=True)), {})
    (run,) = fit_runs(thinned)
    assert run.dt == pytest.approx(5 * DT) and run.filtered == thinned.logger.of("pad_A_Fx")
    fine = run.time[0] + np.arange(run.fine * (len(run.time) - 1) + 1) * run.dt / run.fine
    step = run.dt / run.fine
    # an instant stands for the mean of what is around it
    means = np.mean([sharp(fine + step * (k + 0.5 - 50) / 100) for k in range(100)], axis=0)[:, None]
    shown = log_force(means, run, None, averaged=True)[:, 0]
    turn = np.abs(np.sin(TURN * run.time)) < TURN * 1.5 * run.dt
    beside = ~turn & (run.time > 0.1) & (run.time < 1.9)
    left, without = (np.std((run.force[:, 0] - guess)[beside]) for guess in (shown, sharp(run.time)))
    assert without > 20.0, "beside a reversal the record rings by more than the noise of a gauge"
    assert left < 0.3 * without


@pytest.mark.parametrize(("corner", "kept"), [(100.0, True), (600.0, False)])
def test_of_two_filters_the_lower_one_counts(corner: float, kept: bool) -> None:
    thinned, _ = decimate(logged(Logger(LowPass(corner), known=True)), {})
    assert (thinned.logger.of("pad_A_Fx") == LowPass(corner)) is kept
    assert thinned.logger.unseen("pad_A_Fx") == 0.0


def test_nobody_knows_when_friction_jumped_between_samples_that_were_thinned_out() -> None:
    thinned, _ = decimate(logged(Logger(None, known=True)), {})
    assert thinned.logger.unseen("pad_A_Fx") == pytest.approx(DT)
    assert replace(thinned.logger, known=False).unseen("pad_A_Fx") == 0.0
    assert replace(thinned.logger, known=False).of("pad_A_Fx") is None
