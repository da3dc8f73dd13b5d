"""The parts of a diagnosis' page about what was not named: how large it can be, whether it was seen, and why not."""

from math import isfinite

from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.indistinguishable import list_known_effects
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.why_not import WhyNot
from slipwise.selection.upper_limits import CHANCE
from slipwise.view.figures.why_not_figure import why_not_figure
from slipwise.view.pages.html import Piece, Section, bullets, details, figure, paragraph, table
from slipwise.view.words.diagnosis_words import floors
from slipwise.view.words.limit_words import limit_rows, limit_sentence, missed_words, power_rows, power_words
from slipwise.view.words.why_not_words import why_not_words

#: Rows of a table of errors: runs and balances in which an effect differs most.
_ROWS = 8
#: An error that differs by less is written alike [floors].
_APART = 0.01


def limits_section(found: Diagnosis) -> Section | None:
    """Say how large each effect that was not named can be, and which would have been seen; None where none is known."""
    rows = limit_rows(found)
    if not rows:
        return None
    words = (
        f"Each effect that was not named is at most so large ({100 * CHANCE:.0f} %), in the unit of its strength and "
        "in multiples of what matters in this campaign; beside that the change of the replayed run by an effect of "
        "that size. Where it says `not told`, the campaign says nothing of it."
    )
    brief = limit_rows(found, brief=True)
    if found.verdict.leftover == "unknown":
        words += " Something is missing here that has no name: the limits hold as far as it resembles none of these."
    pieces: list[Piece] = [paragraph(missed_words(found)), paragraph(words)]
    pieces += [table(brief, "May be there at a size that matters")] if brief else []
    pieces.append(details(f"All {len(rows)} effects that were not named", [table(rows)]))
    if found.power:
        pieces += [
            paragraph(power_words(found)),
            paragraph(
                "The campaign's own model, motions and noise, with one effect at the limit of what matters in it: how "
                "often it would be named or listed, named first, and what would be named in its place."
            ),
            table(power_rows(found), "Chance to be seen"),
        ]
    else:
        pieces.append(paragraph("`slipwise diagnose --power` says how often each would have been seen at that limit."))
    return Section("How large what was not named can be", pieces)


def why_not_pieces(found: Diagnosis) -> list[Piece]:
    """Return a part for each effect that was asked about, and for the nearest rivals, that opens on a click."""
    asked = {one.effect for one in found.why_not}
    every = [*found.why_not, *(one for one in found.explain_rivals() if one.effect not in asked)]
    known = list_known_effects(found.search)
    out: list[Piece] = []
    for one in every:
        words = why_not_words(one)
        if one.effect in found.limits:
            words.append(limit_sentence(known.get(one.effect), found.limits[one.effect].as_json()))
        out.append(details(f"Why not {one.effect}?", [bullets(words), *_pieces(one)], why_not_anchor(one.effect)))
    return out


def why_not_anchor(effect: str) -> str:
    """Return the name of the part of a page that says why an effect was not named."""
    return f"why-not-{effect}"


def _pieces(found: WhyNot) -> list[Piece]:
    pieces: list[Piece] = []
    picture = why_not_figure(found)
    if picture is not None:
        if found.instants:
            caption = (
                f"What {found.effect} leaves in the place of {found.replaced}, where the measurement contradicts it "
                "most; the band is what noise leaves."
            )
        else:
            caption = f"Error of every balance without {found.effect} and with it."
        pieces.append(figure(picture, caption, narrow=why_not_figure(found, narrow=True)))
    if rows := _error_rows(found):
        pieces.append(table(rows, "Error in noise floors, where it differs most"))
    return pieces


def _error_rows(found: WhyNot) -> list[dict[str, str]]:
    apart = [e for e in found.errors if abs(e.instead - e.named) >= _APART]
    ordered = sorted(apart, key=lambda e: -abs(e.instead - e.named))[:_ROWS]
    columns = {"base model": "base", "as named": "named", f"{found.effect} instead": "instead", "both": "beside"}
    if not found.replaced:
        columns = {"base model": "base", f"with {found.effect}": "instead"}
    kept = {head: key for head, key in columns.items() if any(isfinite(getattr(e, key)) for e in ordered)}
    return [
        {
            "run": f"{e.run} (held out)" if e.role == "holdout" else e.run,
            "balance": NAMES[e.relation][0],
            **{head: floors(getattr(e, key)) for head, key in kept.items()},
        }
        for e in ordered
    ]
