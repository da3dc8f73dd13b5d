"""The page of a discovery: the law in a sentence, its numbers, the data under it, and what it takes away."""

from slipwise.comparison.component_level import NAMES
from slipwise.discovery.law import Law
from slipwise.discovery.result import Discovery
from slipwise.view.figures.discovery_errors import (
    errors,
    errors_figure,
    loop_words,
    loops_figure,
    shown_states,
    states_figure,
)
from slipwise.view.figures.discovery_figures import candidate_figure, law_figure
from slipwise.view.figures.style import styled
from slipwise.view.pages.html import Html, Section, bullets, callout, figure, page, paragraph, table, verdict
from slipwise.view.words.diagnosis_words import floors
from slipwise.view.words.discovery_words import (
    HEADLINES,
    looked_at_rows,
    meaning,
    number_rows,
    range_words,
    shape_lines,
    state_words,
    tied_words,
)

_TONES = {"law": "good", "state": "warn", "organised": "warn", "unknown": "bad", "nothing": "good"}
_NO_MECHANISM = (
    "No mechanism is claimed. A law here says how large a force was, over which state, in these data; it does not say "
    "why."
)


def discovery_page(found: Discovery) -> str:
    """Make the page: the text of a self-contained HTML file."""
    with styled():
        sections = [*_described(found), *_found(found), *_taken_away(found), _looked_at(found), _limits(found)]
        return page(f"What the model of {found.campaign} lacks", [s for s in sections if s], _summary(found))


def _summary(found: Discovery) -> list[Html]:
    before, after = found.relations[found.worst]
    held = bool(found.base.objective.held_out)
    facts = {"explained of what the model lacks": f"{100.0 * found.share:.0f} %"} if found.evidence != "nothing" else {}
    error = f"{'held-out error' if held else 'error of fitted runs'}, {found.worst} [noise floors]"
    facts[error] = f"{floors(before)} before, {floors(after)} with the law" if found.laws else floors(before)
    box = verdict(HEADLINES[found.evidence], found.sentence, _TONES[found.evidence], facts)  # type: ignore[arg-type]
    return [box, callout("What that means.", meaning(found.evidence))]


def _found(found: Discovery) -> list[Section]:
    """Show every law, or where there is none, the curve over the state that explains most."""
    claimed = found.evidence in ("law", "state")
    if found.laws:
        title = "The law" if claimed else "What describes it best"
        more = len(found.laws) > 1
        return [Section(f"{title}, part {i}" if more else title, _law(law)) for i, law in enumerate(found.laws, 1)]
    if found.organised is None:
        return []
    states = " and ".join(state_words(s.name) for s in found.organised.states)
    words = (
        f"Most, {100.0 * found.share:.0f} % of what the model leaves above noise, goes with {states}. No form is put "
        "over the curve."
        if found.explains_something
        else f"Likeliest is {states}, but each motion asks for another curve than the others, so that nothing of what "
        "the model leaves is explained."
    )
    caption = "What the model lacks, one point a sample, and a curve of straight pieces through it with its 95 % band."
    drawn = figure(candidate_figure(found.organised), caption)
    return [Section("What comes nearest", [paragraph(words), bullets(shape_lines(found)), drawn])]


def _described(found: Discovery) -> list[Section]:
    """Describe the curve without a form, where there is a law over it."""
    lines = shape_lines(found) if found.laws else []
    return [Section("The curve, without a form", [bullets(lines)])] if lines else []


def _law(law: Law) -> list[Html]:
    cloud = (
        "Points: what is left with the law, and the law itself, over what the law is multiplied by; one point a "
        "sample, thinned. Curve without a form: straight pieces through all the samples, with the 95 % band of the "
        "noise. Over it the form that was chosen, in the range of the data."
    )
    tied = " Dashed: forms that these data cannot tell from it." if law.tied else ""
    return [
        paragraph(f"`{law.equation}`"),
        table(number_rows(law)),
        paragraph(range_words(law)),
        bullets(tied_words(law)),
        figure(law_figure(law), cloud + tied),
    ]


def _taken_away(found: Discovery) -> list[Section]:
    levels = errors(found)
    rows: dict[str, dict[str, str]] = {}
    for runs, of in levels.items():
        for name, (before, later) in of.items():
            row = rows.setdefault(name, {"balance": NAMES[name][0]})
            row[f"{runs}, before"] = floors(before)
            row |= {} if later is None else {f"{runs}, with the law": floors(later)}
    pair = ", before and with the law" if found.laws else ""
    drawn = figure(
        errors_figure(found),
        f"Error of every balance{pair}; 1 is what a perfect model leaves.",
        narrow=errors_figure(found, narrow=True),
    )
    sections = [Section("The error of every balance", [drawn, table(list(rows.values()), "Error in noise floors")])]
    words = loop_words(found)
    caption = f"{words[0].upper()}{words[1:]} against slip: measured{pair}."
    sections.append(Section("Loops", [figure(loops_figure(found), caption)]))
    if shown_states(found):
        caption = (
            f"What is left of the balance of {found.worst} in the fitted runs, over the states that explain most. A "
            "model that lacks nothing is flat at the noise floor, whatever the state."
        )
        words = "What is left, over the states"
        sections.append(Section(words, [figure(states_figure(found), caption)]))
    return sections


def _looked_at(found: Discovery) -> Section | None:
    if not found.looked_at:
        return None
    words = (
        "Before any form was tried, a curve was put over every state, for every way in which a force may enter, beside "
        "the base numbers and every effect of the catalogue. Each motion was predicted by the curve that the other "
        "motions ask for. The likeliest:"
    )
    return Section("What else was looked at", [paragraph(words), table(looked_at_rows(found), marked=(0,))])


def _limits(found: Discovery) -> Section:
    pieces = [paragraph(_NO_MECHANISM)]
    if found.cannot_judge:
        pieces += [paragraph("This campaign cannot judge:"), bullets([f"{words}." for words in found.cannot_judge])]
    pieces += [
        paragraph(f"The law as an effect file that can be read, changed and added to a model: `{path.name}`.")
        for path in found.files
    ]
    return Section("What may be said of it", pieces)
