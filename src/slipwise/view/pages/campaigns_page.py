"""The page that leads to the pages of many campaigns."""

from collections.abc import Sequence
from urllib.parse import quote

from slipwise.specimens.result import SpecimensReport
from slipwise.studies.campaigns import Compared, Outcome
from slipwise.view.pages.html import Html, Section, bullets, details, escape, page, paragraph, table
from slipwise.view.words.campaign_tables import (
    campaign_rows,
    change_words,
    compared_sentences,
    failure_sentences,
    size_words,
    title,
)
from slipwise.view.words.specimen_words import effect_rows, effect_sentences, not_compared_words, number_rows

_NOTHING = "Nothing."


def campaigns_page(
    outcomes: Sequence[Outcome], found: Compared, together: SpecimensReport | None = None, reasons: Sequence[str] = ()
) -> str:
    """Make the page, to be put beside the folders of the campaigns.

    Args:
        outcomes: of the campaigns.
        found: what differs between them.
        together: one law over all of them.
        reasons: why a campaign is left out of that, or there is none.

    Returns:
        The text of a self-contained HTML file.
    """
    rows = [{**row, "campaign": _link(o)} for row, o in zip(campaign_rows(outcomes), outcomes, strict=True)]
    failed = [place for place, outcome in enumerate(outcomes) if outcome.failed]
    common, differs = compared_sentences(found)
    every = [change_words(change) for change in found.changes]
    sections = [
        Section("Campaigns", [table(rows, title(len(outcomes)), failed), *failure_sentences(outcomes)]),
        Section("Common to all", [bullets(common) if common else paragraph(_NOTHING)]),
        Section(
            "What differs",
            [
                bullets(differs) if differs else paragraph(_NOTHING),
                details(f"All {len(every)} numbers that two campaigns have", [bullets(every)]),
            ],
        ),
        *([Section("One law over all specimens", _together(together, reasons))] if together or reasons else []),
        Section("Base parameters", [_base(outcome) for outcome in outcomes if not outcome.failed]),
    ]
    return page(f"Diagnosis of {len(outcomes)} campaigns", sections)


def _together(found: SpecimensReport | None, reasons: Sequence[str]) -> list[Html]:
    parts = [bullets(reasons)] if reasons else []
    if found is None:
        return parts
    sentences = [*effect_sentences(found), *not_compared_words(found)]
    parts += [paragraph(found.sentence), *([bullets(sentences)] if sentences else [])]
    if rows := effect_rows(found):
        parts.append(table(rows, "Effects over all specimens"))
    if rows := number_rows(found):
        parts.append(table(rows, "Numbers of the law: mean over specimens, and spread between them (95 %)"))
    return parts


def _link(outcome: Outcome) -> Html:
    if outcome.failed:
        return Html(escape(outcome.name))
    return Html(f'<a href="{escape(quote(outcome.name))}/report.html">{escape(outcome.name)}</a>')


def _base(outcome: Outcome) -> Html:
    return details(outcome.name, [bullets([size_words(key, entry) for key, entry in outcome.base.items()])])
