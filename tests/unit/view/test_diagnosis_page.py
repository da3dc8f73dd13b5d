"""The page and the pictures of a diagnosis say no more than there is: rivals, held-out runs, steps."""

from dataclasses import replace

from hypotheses import base, diagnosed, findings_of, left_by, searched
from slipwise.diagnosis.ladder import Ladder, LadderStep
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.verdict import Verdict
from slipwise.effects import catalogue
from slipwise.view.diagnosis_figures import balances_figure, ladder_figure
from slipwise.view.diagnosis_page import diagnosis_page
from slipwise.view.numbers import counted, in_words
from slipwise.view.style import styled

NAN = float("nan")


def _step(*effects: str, fit: float = 2.0, held: float = 2.0, replay: float = NAN) -> LadderStep:
    return LadderStep(effects, fit, held, replay, 1.0, {})


def _ladder(*steps: LadderStep, stopped: str = "nothing above the noise floor is left") -> Ladder:
    return Ladder("made up", steps, (102, 13), stopped, (), 1.0)


def _found(*names: str, kind: str = "ambiguous", held_out: bool = True) -> Diagnosis:
    """A diagnosis in which each name is an explanation of its own."""
    of = base(held_out=held_out, pads=9.0)
    best, *others = (left_by(name, of=of) for name in names)
    rivals = tuple(others) if kind == "ambiguous" else ()
    state = searched(of, best, *others)
    verdict = Verdict(kind, names, (), 0.5, "none", 1.0, None, rivals, tuple(findings_of(state)))
    found = diagnosed(state, verdict)
    return replace(found, system={"base": 4.0, "final": 1.1})


def test_the_headline_counts_the_rivals():
    text = diagnosis_page(_found("heating", "run_in", "channel_drift"))
    assert "Three explanations, one measurement: heating or run_in or channel_drift<" in text
    assert "Either heating or run_in or channel_drift:" in text


def test_what_parts_the_rivals_comes_first_and_once():
    text = diagnosis_page(_found("heating", "run_in"))
    assert "Two explanations, one measurement: heating or run_in<" in text
    parts = "run_in instead of heating: "
    first = text.split('<section id="what-would-change-our-mind">')[1].split("<li>")[1]
    assert first.startswith(parts) and text.count(parts) == 1
    assert "heating instead of run_in" not in text
    assert catalogue()["run_in"].confused_with["buffer_softening"] in text


def test_nothing_is_called_held_out_where_every_run_was_fitted():
    seen = _ladder(_step(), _step("heating"))
    assert "held-out" in diagnosis_page(_found("heating", kind="named"), seen) and "no fit has seen" in diagnosis_page(
        _found("heating")
    )
    unseen = _ladder(_step(held=NAN, replay=4.0), _step("heating", held=NAN, replay=1.1))
    found = _found("heating", kind="named", held_out=False)
    for text in (diagnosis_page(found, unseen), found.sentence):
        assert "held-out" not in text.lower() and "no fit has seen" not in text
        assert "the runs that were fitted" in text


def test_a_rung_says_what_it_takes_away_and_what_it_adds():
    with styled():
        (axes,) = ladder_figure(
            _ladder(
                _step(),
                _step("heating"),
                _step("heating", "guide_drag"),
                _step("run_in", "guide_drag"),
                _step("run_in"),
            )
        ).axes
    labels = [label.get_text() for label in axes.get_xticklabels()]
    assert labels == ["base model", "+ heating", "+ guide_drag", "− heating\n+ run_in", "− guide_drag"]


def test_the_last_rungs_of_a_ladder_that_begins_far_up_are_told_apart():
    def heights(first: float) -> tuple[float, float]:
        steps = _ladder(_step(fit=first, held=first), _step("heating", held=4.0), _step("heating", "run_in", held=1.0))
        with styled():
            figure = ladder_figure(steps)
        figure.canvas.draw()
        (axes,) = figure.axes
        low, high = (axes.transData.transform((0.0, error))[1] for error in (1.0, 4.0))
        assert axes.transData.transform((0.0, first))[1] < axes.bbox.y1
        return (high - low) / axes.bbox.height, axes.get_ylim()[0]

    assert heights(300.0)[0] > 0.15
    assert heights(8.0)[1] == 0.0


def test_a_ladder_says_how_much_was_tried_and_why_it_stops():
    with styled():
        (axes,) = ladder_figure(_ladder(_step(), stopped="no further effect is worth a step")).axes
    assert axes.get_xlabel() == "102 candidates screened, 13 hypotheses refitted; no further effect is worth a step"


def test_a_long_reason_stays_inside_the_picture_and_so_does_a_single_rung():
    reason = "no further effect of the catalogue is worth a step; 11 floors are left"
    with styled():
        figure = ladder_figure(_ladder(_step(fit=1.007, held=1.023), stopped=reason))
    (axes,) = figure.axes
    figure.canvas.draw()
    label = axes.xaxis.label.get_window_extent()
    assert 0.0 <= label.x0 and label.x1 <= figure.bbox.width
    assert axes.get_ylim()[1] > 1.05


def test_what_is_not_named_is_not_drawn_as_added():
    unknown = replace(_found("slide_tilt"), verdict=Verdict("unknown", (), (), 0.8, "unknown", 0.4, None, (), ()))
    assert unknown.search.best.names == ("slide_tilt",) and unknown.added == ()
    with styled():
        (axes,) = balances_figure(unknown).axes
    assert [t.get_text() for t in axes.get_legend().get_texts()] == ["base model"]


def test_counts_are_written_as_people_say_them():
    assert (counted(1, "run"), counted(4, "run"), counted(13, "run")) == ("one run", "four runs", "13 runs")
    assert (in_words(0), in_words(12)) == ("no", "twelve")
