"""The part of a diagnosis' page on another program's model: what it is, what it lacks, which numbers are off."""

from slipwise.prediction.result import PredictionReport
from slipwise.view.colours import Tone
from slipwise.view.pages.html import Html, Section, bullets, details, paragraph, table, verdict
from slipwise.view.words.prediction_words import error_rows, number_rows, prediction_answers, run_rows


def prediction_section(found: PredictionReport) -> Section:
    """Make the section.

    Args:
        found: what a campaign shows of the model that predicted it.
    """
    off = [place for place, one in enumerate(found.numbers) if one.off]
    numbers = [
        paragraph("The numbers of the model beside those of the campaign, with their 95 % intervals."),
        table(number_rows(found.numbers), marked=off),
    ]
    runs = "As predicted and as measured, with no fit at all; errors are rms, over the rms of the measurement."
    read = f"The prediction by itself, read as if this campaign's gauges had recorded it: {found.read.sentence}"
    return Section(
        "The model, and what it lacks",
        [
            *(paragraph(f"{question} {answer}") for question, answer in prediction_answers(found)),
            table(error_rows(found), "Error of every balance of the rig, on measured states, in noise floors"),
            *numbers,
            table(run_rows(found), runs),
            details("How the model was read back", [paragraph(read), *([bullets(found.notes)] if found.notes else [])]),
        ],
    )


def prediction_verdict(found: PredictionReport) -> Html:
    """Make the box that says what is wrong with the model, and how its error falls."""
    rungs = list(found.worst.items())[: None if found.lacks else 2]  # where nothing is lacking, nothing is added
    return verdict(*_headline(found), {f"error {rung} [noise floors]": f"{error:.3g}" for rung, error in rungs})


def _headline(found: PredictionReport) -> tuple[str, str, Tone]:
    """Return what the model is in a few words, in a sentence, and its tone."""
    if found.lacks:
        return f"The model lacks {' and '.join(found.lacks)}", found.sentence, "bad"
    if found.off:
        return "A number of the model is off", found.sentence, "warn"
    return "The model is right as far as this campaign goes", found.sentence, "good"
