"""What is said of another program's model, in sentences and rows: what it is, what it lacks, which numbers are off."""

from collections.abc import Sequence

from slipwise.comparison.component_level import NAMES
from slipwise.effects import catalogue
from slipwise.prediction.result import ComparedNumber, PredictionReport
from slipwise.units import convert
from slipwise.view.words.diagnosis_words import floors
from slipwise.view.words.numbers import usual_unit


def prediction_answers(found: PredictionReport) -> list[tuple[str, str]]:
    """Return what an office asks of its model, with the answers in a sentence or two each."""
    holds = f"; it also holds {', '.join(found.effects)}" if found.effects else ""
    doubt = " (none of the laws known here: the nearest)" if found.law.is_foreign else ""
    lacks = " ".join(f"{name[0].upper()}{name[1:]}: {why}." for name, why in found.lacks.items())
    off = " ".join(number_words(n) for n in _by_cost(found.numbers) if n.off)
    worst = ", ".join(f"{rung} {floors(error)}" for rung, error in found.worst.items())
    beyond = " ".join(found.beyond) or "Nothing that this campaign shows."
    if found.surplus:
        beyond += f" It holds what the campaign does not show: {', '.join(found.surplus)}."
    return [
        ("Which model is it?", f"Friction is {found.law.family.words}{doubt}{holds}. {found.loads}"),
        ("What does it lack?", lacks or "Nothing that matters in this campaign."),
        ("Which of its numbers are off?", off or "None that matters."),
        ("How far does its error fall?", f"Worst balance, in noise floors: {worst}."),
        ("What is beyond its reach?", beyond),
    ]


def number_words(found: ComparedNumber) -> str:
    """Say what a number is in the model and in the campaign, with its unit."""
    row = _row(found)
    interval = f" ({row['95 %']})" if row["95 %"] else ""
    unit = f" {row['unit']}" if row["unit"] else ""
    words = f"{row['number']}: {row['model']}{unit} in the model, {row['campaign']}{interval}{unit} in the campaign"
    return f"{words[0].upper()}{words[1:]}."


def number_rows(numbers: Sequence[ComparedNumber]) -> list[dict[str, str]]:
    """Return the numbers as rows of a table, in the units that people read."""
    return [_row(one) for one in numbers]


def run_rows(found: PredictionReport) -> list[dict[str, str]]:
    """Return the runs as rows: peak slip of both, and how far the prediction is from the measurement."""
    return [
        {
            "run": run.run,
            "peak slip measured [mm]": _figures(1e3 * run.peak_slip[0]),
            "predicted [mm]": _figures(1e3 * run.peak_slip[1]),
            "slip errs by": _share(run.slip_error),
            "friction errs by": _share(run.force_error),
        }
        for run in found.runs
    ]


def error_rows(found: PredictionReport) -> list[dict[str, str]]:
    """Return the error of every balance at every rung as rows."""
    relations = dict.fromkeys(r for errors in found.errors.values() for r in errors)
    return [
        {"balance": NAMES[r][0]}
        | {rung: floors(errors[r]) if r in errors else "" for rung, errors in found.errors.items()}
        for r in relations
    ]


def _by_cost(numbers: Sequence[ComparedNumber]) -> list[ComparedNumber]:
    return sorted(numbers, key=lambda one: -one.costs)


def _row(found: ComparedNumber) -> dict[str, str]:
    effect, _, name = found.key.partition(".")
    known = catalogue().get(effect.partition("[")[0])
    parameter = known.parameter(name.partition("[")[0]) if known is not None and name else None
    shown = (parameter.shown_in if parameter is not None else "") or usual_unit(found.unit)
    values = (found.theirs, found.measured, found.low, found.high)
    model, campaign, low, high = ("" if v is None else _figures(convert(v, found.unit, shown)) for v in values)
    return {
        "number": found.name,
        "model": model,
        "campaign": campaign,
        "95 %": f"{low} to {high}" if low else "",
        "unit": "" if shown == "1" else shown,
        "off": "yes" if found.off else "",
    }


def _figures(value: float) -> str:
    if value != value:
        return "unknown"
    return f"{value:.0f}" if 1e3 <= abs(value) < 1e7 else f"{value:.4g}"


def _share(value: float) -> str:
    return f"{100.0 * value:.2g} %" if value == value else "unknown"
