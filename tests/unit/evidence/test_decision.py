"""From chances to what is said, with a calibration whose chances are the numbers that it is given."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.evidence.calibration import Calibration, Logistic, compute_log_odds
from slipwise.evidence.decision import decide, is_left

#: Chances whose log-odds are the evidence itself.
PLAIN = Calibration(
    present=Logistic(0.0, {"present": 1.0}),
    matters=Logistic(0.0, {"matters": 1.0}),
    right_family=Logistic(0.0, {"family": 1.0}),
    leads_rival=Logistic(0.0, {"lead": 1.0}),
    all_right=Logistic(0.0, {"product": 1.0}),
)
LEAST = 0.02
NOTHING = {"relative": np.log(0.001), "family": 0.0, "left": 0.0, "floors": 0.0}
SURE = 4.0


def effect(present: float = SURE, matters: float = SURE, gauge: float = 0.0, rival: float = SURE) -> dict[str, float]:
    """Give evidence whose posterior is as sure that the effect matters as the calibration."""
    return {"present": present, "matters": matters, "inclusion": matters, "gauge": gauge, "rival": rival}


def left(share: float, family: float) -> dict[str, float]:
    return {"relative": np.log(share), "family": family, "left": 0.0, "floors": 0.0}


def test_a_model_is_complete_where_nothing_is_found_and_nothing_is_left() -> None:
    said = decide({}, NOTHING, LEAST, PLAIN)
    assert (said.kind, said.named, said.minor, said.tied) == ("complete", (), (), ())
    assert said.probability == pytest.approx(0.99)


def test_what_matters_is_named_in_the_order_of_the_evidence() -> None:
    said = decide({"heating": effect(), "run_in": effect()}, NOTHING, LEAST, PLAIN)
    assert (said.kind, said.named, said.unknown_beside) == ("named", ("heating", "run_in"), False)


def test_what_is_there_and_does_not_matter_is_listed_and_not_named() -> None:
    said = decide({"heating": effect(matters=-SURE)}, NOTHING, LEAST, PLAIN)
    assert (said.kind, said.named, said.minor) == ("complete", (), ("heating",))
    doubtful = decide({"heating": effect(present=1.0, matters=-SURE)}, NOTHING, LEAST, PLAIN)
    assert doubtful.minor == ()


def test_faults_of_gauges_alone_accuse_the_instrument() -> None:
    gauge = effect(gauge=1.0)
    assert decide({"channel_gain": gauge}, NOTHING, LEAST, PLAIN).kind == "instrument"
    assert decide({"channel_gain": gauge, "run_in": effect()}, NOTHING, LEAST, PLAIN).kind == "named"


def test_a_rival_that_is_as_likely_makes_it_ambiguous() -> None:
    said = decide({"heating": effect(rival=-1.0), "run_in": effect()}, NOTHING, LEAST, PLAIN)
    assert (said.kind, said.tied) == ("ambiguous", ("heating",))


def test_what_is_left_is_unknown_alone_and_beside_a_name() -> None:
    alone = decide({}, left(0.5, -SURE), LEAST, PLAIN)
    assert alone.kind == "unknown" and alone.probability > 0.95
    assert decide({"run_in": effect()}, left(0.5, -SURE), LEAST, PLAIN).unknown_beside
    assert not decide({"run_in": effect()}, left(0.5, SURE), LEAST, PLAIN).unknown_beside


def test_what_is_left_matters_from_the_share_that_is_material() -> None:
    assert is_left(left(LEAST * 1.001, 0.0), LEAST) and not is_left(left(LEAST * 0.999, 0.0), LEAST)


def test_what_is_left_matters_from_what_a_law_of_one_limit_leaves() -> None:
    little = {**left(0.5 * LEAST, 0.0), "left": 0.3}
    assert is_left({**little, "limit": float(np.log(0.4 * LEAST))}, LEAST)
    assert not is_left({**little, "limit": float(np.log(0.6 * LEAST))}, LEAST)
    # no state organises it: no law leaves it
    assert not is_left({**little, "limit": float(np.log(0.4 * LEAST)), "left": 0.0}, LEAST)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_verdict_is_less_sure_the_nearer_an_effect_is_to_even_odds(way: float) -> None:
    sizes = (1.0, 2.0, 3.0, 4.0)  # named from 0.9 on
    sure = [decide({"run_in": effect(matters=way * size)}, NOTHING, LEAST, PLAIN).probability for size in sizes]
    assert sure == sorted(sure)


def test_two_doubts_are_worse_than_one() -> None:
    one = decide({"run_in": effect(matters=2.0)}, NOTHING, LEAST, PLAIN)
    two = decide({"run_in": effect(matters=2.0), "heating": effect(matters=2.0)}, NOTHING, LEAST, PLAIN)
    assert two.probability < one.probability


def test_the_probability_is_the_product_of_its_parts_where_they_are_independent() -> None:
    share = 1.0 / (1.0 + np.exp(-2.0))
    said = decide({"run_in": effect(matters=2.0)}, NOTHING, LEAST, PLAIN)
    assert said.probability == pytest.approx(share * share)
    flat = replace(PLAIN, all_right=Logistic(compute_log_odds(0.7), {}))
    assert decide({"run_in": effect(matters=2.0)}, NOTHING, LEAST, flat).probability == pytest.approx(0.7)
