"""The parts of a diagnosis' page about the effects that were found: what each changes, what it is, and how large."""

from collections.abc import Mapping, Sequence

from slipwise.diagnosis.findings import EffectFinding
from slipwise.diagnosis.indistinguishable import list_known_effects
from slipwise.diagnosis.result import Diagnosis
from slipwise.effects import Effect
from slipwise.estimation.intervals import Interval
from slipwise.units import convert
from slipwise.view.pages.html import Html, Section, callout, paragraph, table
from slipwise.view.words.diagnosis_words import limits_words, minor_words
from slipwise.view.words.importance_rows import importance_rows, replayed_run

#: So many standard errors are as good as any more.
_SUREST = 30.0


def importance_section(found: Diagnosis) -> Section | None:
    """Say what leaving each effect out changes; None where nothing was found."""
    rows = importance_rows(found)
    if not rows:
        return None
    replayed = any("peak_slip" in i.responses for i in found.importance.values())
    how = "replayed from the measured table motion" if replayed else "driven by the measured load and motion"
    words = (
        f"The fitted model, {how}, once with every effect that was found and once without the one in question, "
        "everything else as fitted. Of the measured channels the one that changes most is shown, in "
        f"{replayed_run(found)} or in the run in which the effect does most: rms of the difference over the "
        "channel's rms."
    )
    caption = "Change when an effect is left out"
    if "energy" in rows[0]:
        whose = "Peak slip, dissipated energy and largest pad load are" if replayed else "Dissipated energy is"
        words += f" {whose} of {replayed_run(found)}; a plus says that the model without the effect predicts more."
        caption += ", with 95 % intervals"
    marked = [place for place, row in enumerate(rows) if row["without"] in found.verdict.effects]
    pieces = [paragraph(words), table(rows, caption, marked)]
    pieces.append(paragraph(limits_words(found)))
    if minor := minor_words(found):
        pieces.append(paragraph(minor))
    unweighed = [name for name in found.verdict.effects if name not in found.importance]
    if unweighed:
        names = " and ".join(unweighed)
        pieces.append(paragraph(f"Not weighed in this way, for the fitted model is without it: {names}."))
    return Section("What each effect changes", pieces)


def sizes_section(found: Diagnosis) -> Section:
    """Say what the named effects are, and how large: fitted parameters with their intervals."""
    known = list_known_effects(found.search)
    pieces: list[Html] = []
    for name in found.verdict.effects:
        effect = known.get(name)
        if effect is None:
            continue
        pieces += [
            callout(name, f"{effect.summary} `{effect.equation}`"),
            paragraph(f"How it shows: {effect.signature}."),
        ]
    best = found.candidates[0] if found.candidates and found.added else None
    if best is not None and best.parameters:
        rows = size_rows(known, best.parameters)
        marked = [place for place, row in enumerate(rows) if "bound" in row["95 % interval"]]
        caption = "Fitted to the runs of role fit and repeat, with intervals that hold for correlated noise"
        pieces.append(table(rows, caption, marked))
    if not pieces:
        pieces.append(paragraph("No effect of the catalogue was worth a name."))
    return Section("What it is, and how large", pieces)


def size_rows(known: Mapping[str, Effect], sizes: Mapping[str, Interval]) -> list[dict[str, str]]:
    """Return one row a fitted parameter, in the unit in which people read it.

    Args:
        known: name -> effect.
        sizes: label.parameter -> interval [SI].
    """
    rows = []
    for key, interval in sizes.items():
        label, _, name = key.rpartition(".")
        parameter = known[label.partition("[")[0]].parameter(name)
        shown = parameter.shown_in or parameter.unit
        value, low, high = (
            f"{convert(x, parameter.unit, shown):.{interval.figures}g}" if x == x else ""
            for x in (interval.value, interval.low, interval.high)
        )
        if parameter.whole:
            reach = "none: whole numbers only"
        elif interval.bound and interval.value == parameter.neutral:
            reach = "none: this part is absent"
        elif interval.bound:
            reach = f"none: it ended on its {interval.bound} bound"
        elif interval.limit:
            reach = f"at most {high}"
        else:
            reach = f"{low} to {high}" if low and high else ""
        unit = "" if shown == "1" else shown
        rows.append(
            {"parameter": f"{label}: {name}", "value": value, "95 % interval": reach, "unit": unit,
             "meaning": parameter.meaning}
        )  # fmt: skip
    return rows


def evidence_rows(found: Diagnosis) -> list[dict[str, str]]:
    """Return one row for every effect that was found: how sure it is that the model is better with it."""
    shown = (*found.verdict.effects, *found.verdict.minor)
    return [_evidence_row(f, found.search.best.names) for f in found.verdict.findings if f.name in shown]


def _evidence_row(of: EffectFinding, final: Sequence[str]) -> dict[str, str]:
    rival = "none comes near"
    if of.rival is not None:
        names = " + ".join(n for n in of.rival.hypothesis.names if n not in final)
        behind = of.rival.behind
        rival = f"{names}, {_errors(behind)} standard errors behind" if behind > 0.0 else f"{names}, which does as well"
    return {
        "effect": of.name,
        "better with it by [standard errors]": _errors(of.lead),
        "error above the noise that comes back without it": f"{100.0 * of.share:.0f} %",
        "nearest in its place": rival,
        "on a bound": ", ".join(of.at_bound) or "-",
    }


def _errors(count: float) -> str:
    """Write a number of standard errors; none beyond `_SUREST` is told."""
    return f"{count:.1f}" if count < _SUREST else f"{_SUREST:.0f} or more"
