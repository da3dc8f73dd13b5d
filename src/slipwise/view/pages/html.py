"""Reports as one HTML file that needs nothing else: no network, no script, printable, readable on a phone.

Text is escaped here, once: pass plain text and the pieces that these functions return.
"""

import base64
import html as markup
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from slipwise.errors import visible
from slipwise.view.colours import Tone
from slipwise.view.figures.canvas import figure_svg
from slipwise.view.figures.figure_files import export
from slipwise.view.pages.html_style import STYLE
from slipwise.view.words.terminal import cell


@dataclass(frozen=True)
class Html:
    """A piece of finished HTML; everything in it is escaped already."""

    text: str


Piece = Html | str


@dataclass(frozen=True)
class Section:
    """A part of a page with its heading.

    Attributes:
        title: the heading; also makes the anchor.
        pieces: finished HTML, or plain text that becomes a paragraph.
    """

    title: str
    pieces: Sequence[Piece]


def page(title: str, sections: Sequence[Section], summary: Sequence[Piece] = (), *, every: int = 0) -> str:
    """Make a whole page with a table of contents.

    Args:
        title: of the page.
        sections: in order; equal titles get anchors of their own.
        summary: pieces before the table of contents, e.g. the verdict.
        every: time after which a browser reads the file again [s]; 0 for a page that is finished.

    Returns:
        The text of the file.
    """
    anchors = _anchors([section.title for section in sections])
    contents = "".join(
        f'<li><a href="#{anchor}">{escape(section.title)}</a></li>'
        for anchor, section in zip(anchors, sections, strict=True)
    )
    body = "".join(
        f'<section id="{anchor}"><h2>{escape(section.title)}</h2>{_join(section.pieces)}</section>\n'
        for anchor, section in zip(anchors, sections, strict=True)
    )
    again = f'<meta http-equiv="refresh" content="{every}">\n' if every else ""
    navigation = f'<nav aria-label="Contents"><ol>{contents}</ol></nav>' if len(sections) > 1 else ""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"{again}<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        f'<header><div><p class="brand">Slipwise</p><h1>{escape(title)}</h1></div></header>\n'
        f"<main>{_join(summary)}{navigation}\n{body}</main>\n</body>\n</html>\n"
    )


def paragraph(text: str) -> Html:
    """Make a paragraph of plain text; `code` between backticks is set as code."""
    return Html(f"<p>{_inline(text)}</p>")


def bullets(items: Sequence[str]) -> Html:
    """Make a list of plain texts."""
    return Html("<ul>" + "".join(f"<li>{_inline(item)}</li>" for item in items) + "</ul>")


def table(rows: Sequence[Mapping[str, Any]], caption: str = "", marked: Sequence[int] = ()) -> Html:
    """Make a table; a column is every key that a row has, numbers stand to the right.

    Args:
        rows: one mapping a row; values are plain text, numbers, or finished HTML such as a figure.
        caption: above the table.
        marked: numbers of rows to stand out.
    """
    columns = list(dict.fromkeys(key for row in rows for key in row))
    numeric = {key for key in columns if any(_is_number(row.get(key)) for row in rows)}
    head = "".join(f'<th scope="col"{_as_number(key in numeric)}>{_inline(key)}</th>' for key in columns)
    body = ""
    for number, row in enumerate(rows):
        cells = "".join(_table_cell(row.get(key)) for key in columns)
        body += f'<tr class="marked">{cells}</tr>' if number in marked else f"<tr>{cells}</tr>"
    title = f"<caption>{_inline(caption)}</caption>" if caption else ""
    whole = f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
    return Html(f'<div class="scroll" tabindex="0">{whole}</div>')


def figure(picture: Figure | bytes, caption: str, alternative: str = "", *, narrow: Figure | None = None) -> Html:
    """Make a figure with its caption.

    Args:
        picture: a matplotlib figure, which becomes SVG, or the bytes of a PNG file.
        caption: below the picture.
        alternative: what the picture shows, for those who cannot see it; the caption if not given.
        narrow: the same for a phone, where the other would have to be scrolled.
    """
    words = escape(alternative or caption, quote=True)
    if isinstance(picture, Figure):
        svg = figure_svg(picture)
        export(picture, svg, alternative or caption)
        drawn = _drawn(svg, words, "picture" if narrow is None else "picture wide")
        if narrow is not None:
            drawn += _drawn(figure_svg(narrow), words, "narrow")
    else:
        drawn = f'<img alt="{words}" src="data:image/png;base64,{base64.b64encode(picture).decode()}">'
    return Html(f"<figure>{drawn}<figcaption>{_inline(caption)}</figcaption></figure>")


def _drawn(svg: str, words: str, kind: str) -> str:
    return f'<div class="{kind}" role="img" aria-label="{words}">{svg}</div>'


def verdict(headline: str, words: str, tone: Tone, facts: Mapping[str, Any] | None = None) -> Html:
    """Make the box that answers the reader's question.

    Args:
        headline: the answer in a few words.
        words: the answer in a sentence or two.
        tone: its colour; the words carry the meaning without it.
        facts: numbers that back it, by name.
    """
    numbers = "".join(f"<div><dt>{_inline(k)}</dt><dd>{escape(cell(v))}</dd></div>" for k, v in (facts or {}).items())
    return Html(
        f'<div class="verdict {_tone(tone)}"><p class="headline">{_inline(headline)}</p><p>{_inline(words)}</p>'
        + (f"<dl>{numbers}</dl>" if numbers else "")
        + "</div>"
    )


def callout(title: str, words: str, tone: Tone = "plain") -> Html:
    """Make a note that stands out from the text."""
    return Html(f'<aside class="{_tone(tone)}"><strong>{_inline(title)}</strong> {_inline(words)}</aside>')


def details(title: str, pieces: Sequence[Piece], anchor: str = "") -> Html:
    """Make a part that opens on a click; when printed it is open.

    Args:
        title: of the part.
        pieces: in it.
        anchor: its name in an address; a browser opens the part for what is inside of it.
    """
    inside = f'<div id="{escape(anchor)}">{_join(pieces)}</div>' if anchor else _join(pieces)
    return Html(f"<details><summary>{_inline(title)}</summary>{inside}</details>")


def _tone(tone: str) -> str:
    return tone if tone in ("plain", "good", "warn", "bad") else "plain"


def _join(pieces: Sequence[Piece]) -> str:
    return "".join(piece.text if isinstance(piece, Html) else paragraph(piece).text for piece in pieces)


def escape(text: str, quote: bool = True) -> str:
    """Write plain text as HTML; control characters are shown."""
    return markup.escape(visible(text), quote=quote)


def _inline(text: str) -> str:
    """Escape plain text; `code` between backticks is set as code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(str(text)))


def _table_cell(value: Any) -> str:
    if isinstance(value, Html):
        return f"<td>{value.text}</td>"
    return f"<td{_as_number(_is_number(value))}>{_inline(cell(value))}</td>"


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _as_number(is_number: bool) -> str:
    return ' class="number"' if is_number else ""


def _anchors(titles: Sequence[str]) -> list[str]:
    """Make an anchor of every title; equal ones are numbered."""
    made: list[str] = []
    for title in titles:
        plain = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or "section"
        anchor, number = plain, 1
        while anchor in made:
            number += 1
            anchor = f"{plain}-{number}"
        made.append(anchor)
    return made
