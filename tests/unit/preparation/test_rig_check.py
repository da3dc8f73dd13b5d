"""The declared rig is held against what a fit found."""

from dataclasses import replace

import pytest

from hypotheses import base
from slipwise.estimation.base_fit import BaseFit
from slipwise.preparation.data_corrections import describe_corrections
from slipwise.preparation.rig_check import find_wrong_rig
from slipwise.rig import load_specimen


def _found(height: float, stiffness: float) -> BaseFit:
    """Bridge 1 is declared; the fit found so many times its height and its buffers' stiffness."""
    fit = base()
    values = dict(fit.solution.values)
    values["rig.centre_height"] *= height
    values["rig.buffer_stiffness"] *= stiffness
    return replace(fit, solution=replace(fit.solution, values=values))


@pytest.mark.parametrize(("height", "stiffness"), [(1.0, 1.0), (1.05, 0.9), (1.3, 0.8), (1.9, 1.0), (1.0, 0.6)])
def test_a_rig_that_is_off_is_no_other_rig(height, stiffness):
    assert find_wrong_rig(_found(height, stiffness)) is None


@pytest.mark.parametrize(("height", "stiffness"), [(2.0, 0.65), (1.9, 0.67), (2.1, 0.62)])
def test_the_numbers_of_bridge_2_are_recognised_and_told(height, stiffness):
    found = find_wrong_rig(_found(height, stiffness))
    assert found is not None and found.fitting == load_specimen("bridge2") and found.declared == "bridge1"
    (told,) = describe_corrections((), (), found)
    assert told.kind == "wrong_rig" and told.channels == ()
    assert "declares bridge1 (height 0.37 m, buffers 1.73 kN/mm)" in told.words and "fit bridge2" in told.words
