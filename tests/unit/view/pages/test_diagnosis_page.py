"""The page and the pictures of a diagnosis say no more than there is: rivals, held-out runs, steps."""

from dataclasses import replace

import numpy as np

from hypotheses import base, diagnosed, findings_of, left_by, on, searched
from slipwise.diagnosis.ladder import Ladder, LadderStep
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.unknown_surface import ResidualSurface
from slipwise.diagnosis.verdict import Verdict
from slipwise.effects import catalogue
from slipwise.estimation.intervals import Interval
from slipwise.preparation.data_corrections import DataCorrection
from slipwise.view.figures.diagnosis_figures import balances_figure, ladder_figure, loops_figure, surface_figure
from slipwise.view.figures.style import styled
from slipwise.view.pages.diagnosis_effects import size_rows
from slipwise.view.pages.diagnosis_page import diagnosis_page
from slipwise.view.words.diagnosis_words import four_answers
from slipwise.view.words.numbers import counted, in_words

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


def test_a_name_that_is_more_likely_wrong_than_right_is_no_instruction_to_build_on_it():
    sure = _found("heating", kind="named")
    doubtful = replace(sure, verdict=replace(sure.verdict, probability=0.1))
    assert "The model lacks heating" in sure.sentence and "--accept" in dict(four_answers(sure))["What next?"]
    said = doubtful.sentence
    assert said.startswith("Something is missing. The best account of it, heating, is more likely wrong")
    assert "(10 %)" in said and "slipwise next" in dict(four_answers(doubtful))["What next?"]
    assert "Something is missing; nearest: heating<" in diagnosis_page(doubtful)
    gauge = replace(doubtful, verdict=replace(doubtful.verdict, kind="instrument"))
    assert gauge.sentence.startswith(
        "Something is missing, or a gauge is at fault. The best account of it, heating, is"
    )
    assert "slipwise next" in dict(four_answers(gauge))["What next?"] and "at fault; nearest" in diagnosis_page(gauge)


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
    assert axes.get_xlabel() == "candidates compared: 102, hypotheses refitted: 13; no further effect is worth a step"


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
        (legend,) = balances_figure(unknown).legends
    assert {t.get_text() for t in legend.get_texts()} == {"base model", "noise floor"}


def test_where_nothing_is_added_one_loop_is_drawn_and_long_names_are_counted():
    with styled():
        unknown = replace(_found("heating"), verdict=Verdict("unknown", (), (), 0.8, "unknown", 0.4, None, (), ()))
        (axes,) = loops_figure(unknown).axes
        assert axes.get_title("left") == "base model"
        of = base(pads=9.0)
        many = diagnosed(searched(of, left_by("heating", "buffer_hardening", "buffer_hysteresis", of=of)))
        assert loops_figure(many).axes[1].get_title("left") == "with the three effects that were found"


def test_a_missing_force_is_drawn_over_millimetres():
    edges = (np.array([-0.2, 0.0, 0.2]),)
    mean, band = np.array([-3e3, 3e3]), np.array([10.0, 10.0])
    with styled():
        (axes,) = surface_figure(ResidualSurface("pads", ("velocity",), edges, mean, band, "N", 0.9, 2.0)).axes
    assert axes.get_xlabel() == "slip velocity [mm/s]" and axes.get_ylabel() == "pads [kN]"
    line = axes.lines[0]
    assert np.allclose(line.get_xdata(), [-100.0, 100.0]) and np.allclose(line.get_ydata(), [-3.0, 3.0])


def test_the_page_says_what_each_effect_changes_and_what_is_minor():
    of = base(pads=9.0, girder=3.0)
    state = searched(of, left_by("heating", "table_pitch", of=of))
    text = diagnosis_page(diagnosed(state, material={"table_pitch": 0.5}))
    assert "An effect is missing: heating<" in text and "<td>minor</td>" in text
    assert "There, but most likely immaterial: table_pitch;" in text and "+5.0 % (+4.0 to +6.0)" in text
    small = diagnosis_page(diagnosed(state, material={"heating": 0.5, "table_pitch": 0.5}))
    assert "Nothing that matters is missing<" in small
    assert "What each effect changes" not in diagnosis_page(diagnosed(searched(base())))


def test_a_page_of_a_gauge_tells_of_its_channel_only():
    of = base(pads=9.0)
    text = diagnosis_page(diagnosed(searched(of, left_by(on("channel_gain", "pad_B_N"), of=of))))
    told = text.split('<section id="what-each-effect-changes">')[1].split("</table>")[0]
    assert "replayed from the measured table motion" in told
    assert "channel_gain" in told and "Peak slip" not in told and "95 %" not in told


def test_several_effects_are_counted():
    of = base(pads=9.0, girder=3.0)
    text = diagnosis_page(diagnosed(searched(of, left_by("heating", "table_pitch", of=of))))
    assert "Two effects are missing: heating, table_pitch<" in text


def test_a_number_without_an_interval_is_not_written_as_one():
    end = Interval("run_in.distance", 2.0, NAN, NAN, 1.0, "m", "upper")
    least = Interval("run_in.rise", 0.03, 0.0, 0.0512, 0.1, "1", "", "upper")
    other = Interval("run_in.tail", 0.5, NAN, NAN, 0.5, "1", "")
    whole = Interval("girder_bending.midspan", 0.0, NAN, NAN, 0.5, "1", "lower")
    absent = Interval("girder_bending.share", 0.0, NAN, NAN, 0.05, "1", "lower")
    sizes = {i.key: i for i in (end, least, other, whole, absent)}
    rows = {row["parameter"]: row["95 % interval"] for row in size_rows(catalogue(), sizes)}
    assert rows["run_in: distance"] == "none: it ended on its upper bound"
    assert rows["run_in: rise"] == "at most 0.0512" and rows["run_in: tail"] == ""
    assert rows["girder_bending: midspan"] == "none: whole numbers only"
    assert rows["girder_bending: share"] == "none: this part is absent"
    found = _found("run_in", kind="named")
    found = diagnosed(found.search, found.verdict, [0.99])
    text = diagnosis_page(replace(found, candidates=(replace(found.candidates[0], parameters=sizes),)))
    assert "none: it ended on its upper bound" in text
    assert "may be absent" not in text and ">nan<" not in text and "nan to" not in text


def test_what_was_wrong_before_any_fit_stands_at_the_top():
    dead = DataCorrection("dead", ("pad_B_Fx",), "pad_B_Fx: dead in quake; left out there")
    text = diagnosis_page(replace(_found("heating", kind="named"), corrections=(dead,)))
    assert text.index("Before anything was fitted") < text.index("<nav") and dead.words in text


def test_the_smallest_sizes_are_in_units_that_people_read():
    found = replace(_found("heating"), least={"key_clearance": (2e-4, "m")})
    assert "<td>key_clearance</td><td>0.2</td><td>mm</td>" in diagnosis_page(found)


def test_counts_are_written_as_people_say_them():
    assert (counted(1, "run"), counted(4, "run"), counted(13, "run")) == ("one run", "four runs", "13 runs")
    assert (in_words(0), in_words(12)) == ("no", "twelve")
