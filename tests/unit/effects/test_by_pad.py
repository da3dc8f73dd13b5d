"""Strengths of single pads: for each pad of a rig that has not four at its corners, and never free for all at once."""

import numpy as np
import pytest

from slipwise.effects import catalogue, for_pads
from slipwise.model import base_model, use
from slipwise.relations.parameters import Term, list_base_numbers
from slipwise.rig import load_specimen
from slipwise.rig.load_basis import has_corners
from slipwise.simulation.predict import predictor


def on(rig: str, name: str):
    specimen = load_specimen(rig)
    return for_pads(catalogue()[name], specimen.pads, corners=has_corners(specimen))


def test_four_pads_at_the_corners_differ_by_side_and_others_each_for_itself():
    assert on("bridge1", "pad_spread").parameter_names == ("along", "across", "diagonal")
    assert on("three_pads", "pad_spread").parameter_names == ("level[B]", "level[C]")
    assert on("six_pads", "position_patch").parameter_names[:6] == tuple(f"rise[{p}]" for p in "ABCDEF")
    assert on("six_pads", "position_patch").parameter_names[6:] == ("place", "width", "edge")
    assert on("six_pads", "heating") is catalogue()["heating"]


def test_a_hypothesis_gives_the_model_each_pads_own_value():
    term = Term(on("six_pads", "pad_spread"))
    values = {f"pad_spread.level[{p}]": 0.01 * i for i, p in enumerate("BCDEF", 1)}
    (used,) = term.uses(values)
    assert used.effect is catalogue()["pad_spread"] and used.values["level"] == used.values["along"] == 0.0
    assert used.of_pad("A")["level"] == 0.0 and used.of_pad("F")["level"] == pytest.approx(0.05)
    moving = np.full((3, 6, 2), [0.1, 0.0])
    arguments = (0.01 * np.arange(3), np.full((3, 6), 2e4), moving, np.zeros((3, 6, 2)))
    base = base_model("six_pads")
    plain, spread = (predictor(m).pads(*arguments).bound[-1] for m in (base, base.adding(used)))
    assert spread / plain == pytest.approx([1.0, 1.01, 1.02, 1.03, 1.04, 1.05])


def test_what_only_single_pads_have_is_never_free_for_all():
    """It would be one with the law's own strength."""
    model = base_model("six_pads").adding(use("pad_spread", along=0.0, **{"level[E]": 0.04}))
    keys = [free.key for free in list_base_numbers(model, balances=True)]
    assert "pad_spread.level[E]" in keys and "pad_spread.level" not in keys


def test_corners_are_four_pads_one_in_each_quadrant():
    assert [has_corners(load_specimen(r)) for r in ("bridge1", "pendulum", "three_pads", "six_pads", "pad")] == [
        True, True, False, False, False,
    ]  # fmt: skip
