"""What is said of a model follows from what it lacks and from its numbers that are off, in units that people read."""

from dataclasses import replace

from hypotheses import base, diagnosed, searched
from slipwise.diagnosis.verdict import Verdict
from slipwise.prediction.friction_families import FAMILIES, ReadLaw
from slipwise.prediction.result import RUNGS, ComparedNumber, ComparedRun, PredictionReport
from slipwise.view.pages.prediction_section import prediction_section, prediction_verdict
from slipwise.view.words.prediction_words import number_rows, prediction_answers

NOTHING = diagnosed(searched(base(pads=1.0)), Verdict("complete", (), (), 0.9, "none", 1.0, None, (), ()), [])
MASS = ComparedNumber("rig.mass", 11000.0, 9974.0, 9972.0, 9976.0, "kg", 80.0, True)
GAP = ComparedNumber("key_clearance.clearance", 0.002, 0.001, 0.00098, 0.00102, "m", 60.0, True)
RIGHT = PredictionReport(
    campaign="march",
    law=ReadLaw(FAMILIES[0], {"coefficient": 0.1}, 0.0),
    effects=("key_clearance",),
    loads="Its loads change by 16 % (rms), those of the test by 16 %; friction follows the load.",
    lacks={},
    surplus=(),
    numbers=(replace(MASS, theirs=9974.5, costs=0.0, off=False),),
    runs=(ComparedRun("quake", (0.012, 0.0115), 0.1, 0.2, (0.16, 0.16)),),
    errors=dict(zip(RUNGS, ({"pads": 1.02}, {"pads": 1.01}, {"pads": 1.0}), strict=True)),
    beyond=(),
    notes=(),
    read=NOTHING,
    found=NOTHING,
    seconds=1.0,
)
FAR = dict(zip(RUNGS, ({"pads": 28.0, "girder": 2.0}, {"pads": 18.0, "girder": 1.0}, {"pads": 1.0}), strict=True))


def test_a_model_that_lacks_nothing_and_whose_numbers_are_right_is_said_to_be_so():
    assert RIGHT.sentence == "The model holds all that matters in this campaign, and its numbers are right."
    assert RIGHT.off == ()


def test_what_it_lacks_and_what_is_off_stand_in_the_sentence_with_the_fall_of_its_error():
    wrong = replace(RIGHT, lacks={"speed dependence": "why"}, numbers=(MASS,), errors=FAR)
    assert wrong.sentence == (
        "It lacks speed dependence, and the mass of the girder is off; its error of 28 noise floors becomes 18 with "
        "the best numbers that it can have, and 1 with what it lacks."
    )
    assert wrong.as_json()["off"] == ["rig.mass"]


def test_the_number_that_costs_most_is_told_first_in_the_unit_that_people_read():
    answer = dict(prediction_answers(replace(RIGHT, numbers=(GAP, MASS))))["Which of its numbers are off?"]
    assert answer.startswith("Mass of the girder: 11000 kg in the model, 9974 (9972 to 9976) kg in the campaign.")
    assert "Clearance of key_clearance: 2 mm in the model, 1 (0.98 to 1.02) mm in the campaign." in answer
    assert [row["off"] for row in number_rows((GAP, *RIGHT.numbers))] == ["yes", ""]


def test_the_page_says_what_the_terminal_says():
    wrong = replace(RIGHT, numbers=(GAP,), errors=FAR, surplus=("heating",))
    section = prediction_section(wrong)
    text = prediction_verdict(wrong).text + "".join(str(getattr(piece, "text", piece)) for piece in section.pieces)
    for words in ("A number of the model is off", "clearance of key_clearance", "does not show: heating", "12", "28"):
        assert words in text
