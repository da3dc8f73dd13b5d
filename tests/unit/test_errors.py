"""Every error of the library can leave the process in which it was raised."""

import pickle

import numpy as np
import pytest

from slipwise.errors import SlipwiseError, SlipwiseWarning
from slipwise.model import base_model
from slipwise.simulation.simulator import SimulationDiverged, simulate


def kinds(base: type[Exception]) -> set[type[Exception]]:
    """Every error of a family that is imported here."""
    return {base}.union(*(kinds(kind) for kind in base.__subclasses__()))


PLAIN = sorted((kinds(SlipwiseError) | kinds(SlipwiseWarning)) - {SimulationDiverged}, key=lambda kind: kind.__name__)


@pytest.mark.parametrize("kind", PLAIN)
def test_an_error_leaves_a_process_with_its_words(kind: type[Exception]) -> None:
    back = pickle.loads(pickle.dumps(kind("a mass of 0 kg; give one above 0")))
    assert type(back) is kind and str(back) == "a mass of 0 kg; give one above 0"


def test_a_simulation_that_runs_away_leaves_a_process_with_its_record() -> None:
    shaking = np.zeros((10000, 3))
    shaking[1000:, 0] = 400.0
    with pytest.raises(SimulationDiverged) as caught:
        simulate(base_model("block"), shaking)
    back = pickle.loads(pickle.dumps(caught.value))
    assert type(back) is SimulationDiverged and str(back) == str(caught.value)
    kept, sent = back.replay.record, caught.value.replay.record
    assert list(kept.channels) == list(sent.channels)
    for name, values in sent.channels.items():
        np.testing.assert_array_equal(kept[name], values)
