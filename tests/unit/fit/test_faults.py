"""A fault of a cell that shows in load and friction is taken out of both."""

import numpy as np
import pytest

from bench import build_campaign
from measured import as_campaign
from slipwise.effects import catalogue
from slipwise.fit.data import fit_runs
from slipwise.fit.faults import without
from slipwise.fit.terms import Term


@pytest.fixture(scope="module")
def run():
    return fit_runs(as_campaign(build_campaign(31, effects=(), rig="bridge1")))[0]


def test_the_inertia_of_a_plate_is_taken_out_of_load_and_friction(run):
    term = Term(catalogue()["cell_inertia"], tuple(f"pad_{p}_N" for p in "ABCD"), "pad_*")
    mended = without(
        term, {f"{term.label}.mass": 40.0, f"{term.label}.horizontal": 1.0, f"{term.label}.weighed": 0.0}, run
    )
    vertical, along = run.record["table_az"], run.record["table_ax"]
    assert mended.load - run.load == pytest.approx(np.repeat(-40.0 * vertical[:, None], 4, axis=1))
    assert mended.force - run.force == pytest.approx(np.repeat(40.0 * along[:, None], 4, axis=1))
