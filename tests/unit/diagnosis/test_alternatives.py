"""An ambiguous verdict as a list of explanations, and what would tell each two of them apart."""

import pytest

from hypotheses import base, left_by, searched
from slipwise.diagnosis.alternatives import list_discriminating_tests, list_explanations
from slipwise.diagnosis.verdict import Verdict
from slipwise.effects import catalogue
from slipwise.selection.search_state import Search


def _verdict(*effects: str, kind: str = "ambiguous", rivals: tuple[tuple[str, ...], ...] = ()) -> Verdict:
    near = tuple(left_by(*names, of=base()) for names in rivals)
    return Verdict(kind, effects, (), 0.5, "none", 1.0, None, near, ())


def _search(*best: str) -> Search:
    return searched(base(), *([left_by(*best, of=base())] if best else []))


def test_rivals_are_explanations_of_their_own_each_with_all_its_effects():
    pairs = _verdict("key_friction", "channel_filter", "channel_delay", rivals=(("key_friction", "channel_delay"),))
    best = ("key_friction", "channel_filter")
    assert list_explanations(pairs, _search(*best)) == (best, ("key_friction", "channel_delay"))
    three = _verdict("heating", "run_in", "breakaway", rivals=(("run_in",), ("breakaway",)))
    assert list_explanations(three, _search("heating")) == (("heating",), ("run_in",), ("breakaway",))


def test_the_same_effects_in_another_order_are_no_other_explanation():
    found = _verdict("heating", "run_in", "breakaway", rivals=(("run_in", "breakaway"), ("breakaway", "run_in")))
    assert list_explanations(found, _search("heating", "run_in")) == (("heating", "run_in"), ("run_in", "breakaway"))


def test_what_is_sure_belongs_to_every_explanation():
    found = _verdict("buffer_damping", "guide_drag", "dropped_samples")
    assert list_explanations(found, _search("guide_drag")) == (
        ("buffer_damping", "dropped_samples"),
        ("guide_drag", "dropped_samples"),
    )


@pytest.mark.parametrize("kind", ["named", "complete", "unknown", "instrument"])
def test_only_an_ambiguous_verdict_has_something_to_tell_apart(kind: str):
    effects = () if kind in ("complete", "unknown") else ("heating", "run_in")
    found = _verdict(*effects, kind=kind)
    assert list_explanations(found, _search(*effects)) == ((effects,) if effects else ())
    assert list_discriminating_tests(found, _search(*effects)) == ()


def test_each_two_of_three_are_told_apart_in_the_words_of_an_effects_own_file():
    found = _verdict("heating", "run_in", "breakaway", rivals=(("run_in",), ("breakaway",)))
    one, two, three = list_discriminating_tests(found, _search("heating"))
    assert one == f"run_in instead of heating: {catalogue()['heating'].confused_with['run_in']}"
    assert two.startswith("breakaway instead of heating: no effect's file names a test")
    # only the file of breakaway knows of the two
    assert three == f"run_in instead of breakaway: {catalogue()['breakaway'].confused_with['run_in']}"


def test_effects_that_two_explanations_share_are_not_told_apart():
    pairs = _verdict("key_friction", "channel_filter", "channel_delay", rivals=(("key_friction", "channel_delay"),))
    (words,) = list_discriminating_tests(pairs, _search("key_friction", "channel_filter"))
    assert words.startswith("channel_delay instead of channel_filter: ") and "key_friction" not in words
