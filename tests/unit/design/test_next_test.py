"""What the next test is chosen from: which rivals, which motions, and what is said where none tells them apart."""

import sys
from dataclasses import replace

import pytest

from hypotheses import base, diagnosed, left_by, searched
from slipwise.cli import main
from slipwise.comparison.measured_replay import choose_simulation_step
from slipwise.design import next_test as module
from slipwise.design.motions import LIBRARY, Limits
from slipwise.design.next_test import next_test, rivals
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.verdict import Verdict
from slipwise.errors import SettingError, SimulationError, SlipwiseError
from slipwise.motion import displacement_peak, parse_motion, velocity_peak
from slipwise.rig import largest_step, load_specimen
from slipwise.selection.hypothesis import Hypothesis

SMALL = Limits(stroke=0.02, speed=0.2, acceleration=2.0)


def fitted(names: tuple[str, ...], pads: float) -> Hypothesis:
    """A hypothesis that leaves this mean squared residual in the pads."""
    return left_by(*names, of=base(pads=9.0), pads=pads)


def diagnosis(kind: str, *tried: Hypothesis, near: tuple[Hypothesis, ...] = (), probability: float = 0.9) -> Diagnosis:
    """A finished search whose best is the first that was tried; for a complete verdict the base."""
    state = searched(base(pads=9.0), *tried)
    if kind == "complete":
        state = replace(state, path=state.path[:1])
    effects = () if kind == "complete" or not tried else tried[0].names
    left = "unknown" if kind == "unknown" else "none"
    verdict = Verdict(kind, effects, (), probability, left, 1.0, None, near, ())
    chances = [0.9, 0.06, 0.04] if kind != "complete" else [0.06, 0.04, 0.0]
    return diagnosed(state, verdict, chances)


def separate_by(monkeypatch: pytest.MonkeyPatch, separation: float, failed: str = "") -> None:
    """Let every motion separate the rivals by this much, or fail: no motion is shaken."""
    monkeypatch.setattr(module, "_as_shaken", lambda *_: None)
    monkeypatch.setattr(module, "_separation", lambda *_: (separation, "pads", failed))


@pytest.mark.parametrize("wrong", [-0.1, 0.0, float("nan"), float("inf")])
def test_a_table_without_a_stroke_cannot_be(wrong: float) -> None:
    with pytest.raises(SettingError, match="stroke"):
        Limits(stroke=wrong)


@pytest.mark.parametrize("option", ["--stroke=-10 mm", "--speed=0 m/s", "--acceleration=-1 g", "--stroke=30"])
def test_a_limit_that_cannot_be_ends_the_command_before_any_work(option, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["slipwise", "next", str(tmp_path), option])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert option.split("=")[0].strip("-") in capsys.readouterr().err


def test_rivals_of_an_ambiguous_verdict_come_before_what_fits_better():
    best, rival, stranger = fitted(("heating",), 1.0), fitted(("run_in",), 1.2), fitted(("breakaway",), 1.1)
    assert rivals(diagnosis("ambiguous", best, stranger, rival, near=(rival,))) == (best, rival)


def test_the_same_effects_in_another_order_are_no_rival():
    best, again = fitted(("heating", "run_in"), 1.0), fitted(("run_in", "heating"), 1.0)
    other = fitted(("heating", "breakaway"), 1.1)
    assert rivals(diagnosis("ambiguous", best, again, other, near=(again, other))) == (best, other)


def test_what_was_named_is_held_against_the_strongest_other_effects():
    best, more = fitted(("heating",), 1.0), fitted(("heating", "run_in"), 0.9)
    weak, strong = fitted(("breakaway",), 5.0), fitted(("run_in",), 3.0)
    assert rivals(diagnosis("named", best, more, weak, strong)) == (best, strong)


def test_a_complete_model_is_held_against_the_effect_that_came_nearest():
    near, far = fitted(("run_in",), 8.95), fitted(("heating",), 9.1)
    base, rival = rivals(diagnosis("complete", far, near))
    assert base.names == () and rival is near


def test_an_effect_that_is_one_thing_with_the_best_is_its_rival_though_others_fit_better():
    best, other, partner = fitted(("guide_drag",), 1.0), fitted(("heating",), 2.0), fitted(("buffer_damping",), 4.0)
    assert rivals(diagnosis("ambiguous", best, other, partner)) == (best, partner)


def test_where_no_effect_can_be_tested_there_is_nothing_to_tell_apart():
    with pytest.raises(SlipwiseError, match="nothing to tell apart"):
        rivals(diagnosis("complete"))


@pytest.mark.parametrize(("count", "now"), [(1, 0.45), (2, 0.3), (3, 0.225)])
def test_rivals_of_an_ambiguous_verdict_share_its_probability(monkeypatch, count: int, now: float) -> None:
    best, *others = (fitted((n,), 1.0) for n in ("heating", "run_in", "breakaway", "presliding"))
    separate_by(monkeypatch, 5.0)
    ranked = next_test(diagnosis("ambiguous", best, near=tuple(others[:count])), library=LIBRARY[:1])
    assert ranked.chances == pytest.approx((now,) * min(count + 1, 3))
    # the one that is right gets what those that were held against it had; that none is right stays as likely
    assert ranked.proposals[0].probability == pytest.approx(now * min(count + 1, 3))


def test_a_motion_that_tells_nothing_leaves_the_probability_as_it_is(monkeypatch):
    separate_by(monkeypatch, 0.0)
    ranked = next_test(diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0)), library=LIBRARY[:1])
    assert ranked.chances == (0.9, 0.06)
    assert ranked.proposals[0].probability == pytest.approx(0.9)


def test_where_nothing_is_in_doubt_that_is_said_and_nothing_is_shaken(monkeypatch):
    monkeypatch.setattr("slipwise.design.next_test._separation", lambda *_: pytest.fail("shaken"))
    monkeypatch.setattr("slipwise.design.next_test._chances", lambda *_: (0.995, 0.004))
    ranked = next_test(diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0)))
    assert ranked.proposals == () and ranked.words.startswith("Nothing is in doubt")


def test_motions_beyond_the_table_are_refused_and_made_smaller_until_it_can_make_them(monkeypatch):
    separate_by(monkeypatch, 1.0)
    ranked = next_test(diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0)), SMALL)
    refused = {p.motion for p in ranked.proposals if p.refused}
    made = [p.motion for p in ranked.proposals if not p.refused]
    assert len(made) == len(LIBRARY) and refused <= set(LIBRARY) and not refused & set(made)
    for text in made:
        motion = parse_motion(text)
        reached = (displacement_peak(motion, "none").max(), velocity_peak(motion, "none").max(), motion.peaks.max())
        shares = [r / can for r, can in zip(reached, (0.02, 0.2, 2.0), strict=True)]
        assert max(shares) <= 1.0
        assert text in LIBRARY or max(shares) > 0.98, "no smaller than it must be"


def test_a_smaller_motion_keeps_its_frequencies_and_the_proportion_of_its_parts(monkeypatch):
    separate_by(monkeypatch, 1.0)
    found = diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0))
    text = "sine:4.2Hz,0.5g,cycles=24,vertical=6.5Hz,0.25g"
    smaller, refused = next_test(found, Limits(acceleration=1.0), library=(text,)).proposals
    assert refused.motion == text and refused.refused.startswith("acceleration 4.9 of 1 m/s^2")
    assert smaller.motion == "sine:4.2Hz,0.101g,cycles=24,vertical=6.5Hz,0.0507g"


def test_why_a_motion_failed_is_said_and_it_ranks_behind_those_that_tell_nothing(monkeypatch):
    separate_by(monkeypatch, 0.0)
    answers = iter([(0.0, "", "the slip grew beyond 5 m"), (0.0, "pads", ""), (2.0, "pads", "")])
    monkeypatch.setattr(module, "_separation", lambda *_: next(answers))
    found = diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0))
    ranked = next_test(found, library=LIBRARY[:3])
    assert [p.motion for p in ranked.proposals] == [LIBRARY[2], LIBRARY[1], LIBRARY[0]]
    assert [p.failed for p in ranked.proposals] == ["", "", "the slip grew beyond 5 m"]


def test_if_every_motion_fails_the_reason_is_an_error(monkeypatch):
    separate_by(monkeypatch, 0.0, "the slip grew beyond 5 m")
    with pytest.raises(SimulationError, match="none of 2 motions .* beyond 5 m"):
        next_test(diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0)), library=LIBRARY[:2])


@pytest.mark.parametrize("separation", [0.01, 0.5])
def test_where_no_motion_tells_the_catalogue_says_what_would(monkeypatch, separation: float) -> None:
    separate_by(monkeypatch, separation)
    best, partner = fitted(("buffer_damping",), 1.0), fitted(("guide_drag",), 1.01)
    words = next_test(diagnosis("ambiguous", best, partner), library=LIBRARY[:1]).words
    assert ("only yaw and pitch tell" in words) == (separation < 0.1)
    assert "tell them apart." not in words, "they leave the same"


def test_effects_that_are_one_thing_to_the_verdict_but_not_to_the_runs_are_named(monkeypatch):
    separate_by(monkeypatch, 0.01)
    best, partner = fitted(("buffer_damping",), 1.0), fitted(("guide_drag",), 4.0)
    words = next_test(diagnosis("ambiguous", best, partner), library=LIBRARY[:1]).words
    assert "buffer_damping leaves 75 % less of the mean squared residual in pads than guide_drag" in words


@pytest.mark.parametrize("sampling", [0.002, 0.001, 1.0 / 256.0, 1e-4, 0.01, 0.0020000000000000018])
def test_a_simulation_steps_no_coarser_than_usual_and_meets_every_sample(sampling: float) -> None:
    step = choose_simulation_step(sampling, load_specimen("bridge2"))
    assert step <= 0.0005 * (1.0 + 1e-9)
    assert sampling / step == pytest.approx(round(sampling / step), abs=1e-9)
    assert sampling / (round(sampling / step) - 0.999) > 0.0005, "no finer than it must be"


def test_a_simulation_steps_as_finely_as_stiff_pads_ask() -> None:
    rig = load_specimen("bridge2")
    stiff = replace(rig, places=tuple(replace(p, stiffness=30.0 * p.stiffness) for p in rig.places))
    step = choose_simulation_step(0.002, stiff)
    assert step < 0.0004
    assert step <= largest_step(stiff)
    assert 0.002 / step == pytest.approx(round(0.002 / step), abs=1e-9)


def test_an_unreadable_motion_is_refused_before_any_work():
    with pytest.raises(SlipwiseError, match="sinus"):
        next_test(diagnosis("complete"), library=("sinus:2Hz,0.3g",))


def test_one_slider_on_an_actuator_has_no_table_motion():
    found = diagnosis("named", fitted(("heating",), 1.0), fitted(("run_in",), 2.0))
    slider = replace(found.final.campaign, name="march", rig="pad", specimen=load_specimen("pad"))
    found = replace(found, final=replace(found.final, campaign=slider))
    with pytest.raises(SlipwiseError, match="march: the slip of rig .* is prescribed"):
        next_test(found)
