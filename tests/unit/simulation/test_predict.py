"""A model's laws driven by records: a model that takes another's place brings its own memory."""

import numpy as np

from slipwise.model import base_model, use
from slipwise.simulation.predict import predictor


def test_a_share_of_the_girder_that_a_fit_has_led_to_nothing_is_none() -> None:
    """MuJoCo makes no body of 1e-13 kg: a diagnosis ended there."""
    straight = base_model("bridge1").adding(use("girder_bending", share=0.0))
    nearly = base_model("bridge1").adding(use("girder_bending", share=1e-17))
    assert nearly.built_specimen() == straight.built_specimen()


def test_a_girder_that_bends_no_more_takes_the_place_of_one_that_does() -> None:
    bends = base_model("bridge1").adding(use("girder_bending", share=0.4, frequency=12.0))
    straight = base_model("bridge1").adding(use("girder_bending", share=0.0, frequency=12.0))
    law = predictor(bends)
    law.model = straight
    law.reset()
    assert np.array_equal(law.numbers, predictor(straight).numbers)
