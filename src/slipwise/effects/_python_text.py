"""Pieces of Python text that keep to the width of a page, and words that can only be read, never run."""

import re
import textwrap
from collections.abc import Iterable, Iterator
from unicodedata import category, east_asian_width

#: Width of a line [columns].
WIDTH = 120
#: Behind a statement whose lines are broken where a formatter would not break them.
AS_IT_IS = "  # fmt: skip"
#: Statements whose value may be broken into lines.
_ASSIGNED = re.compile(r"(?P<head>return|[^\s=]+(, [^\s=]+)* [-+*/]?=) (?P<value>.+)")


def words(text: str) -> str:
    """Return a text as one line that no quotation can end and no reader mistake for a heading of an effect's docstring.

    Any white space becomes one blank, a backslash a slash, a double quotation mark a single one, and what cannot be
    seen a question mark: names and paths from elsewhere may hold all of these.
    """
    line = " ".join(text.split()).replace("\\", "/").replace('"', "'")
    line = "".join("?" if category(c).startswith("C") else c for c in line)
    return line.replace("Valid:", "Valid,").replace("Source:", "Source,")


def sentence(text: str, most: int) -> str:
    """Return words as one sentence of at most so many columns: a capital at its begin, a full stop at its end."""
    line = words(text)
    parts = list(pieces(line, most - 1))
    if len(parts) > 1:
        line = f"{next(pieces(line, most - 4)).rstrip()} ..."
    return line[:1].upper() + line[1:] + ("" if line.endswith((".", "!", "?")) else ".")


def pieces(text: str, most: int) -> Iterator[str]:
    """Yield a text in pieces of at most so many columns, cut behind blanks where there are some; joined they are it."""
    while (cut := _fitting(text, most)) < len(text):
        blank = text.rfind(" ", 0, cut + 1) + 1
        cut = min(blank, cut) if text[:blank].strip() else cut
        yield text[:cut]
        text = text[cut:]
    yield text


def block(text: str, indent: str = "") -> str:
    """Return a paragraph as lines of the page."""
    return "\n".join(f"{indent}{part.strip()}" for part in pieces(text, WIDTH - len(indent)))


def entry(head: str, text: str) -> list[str]:
    """Return the lines of an entry of a call or a dictionary: a string constant behind `head`, a comma behind it."""
    if columns(f'{head}"{text}",') <= WIDTH:
        return [f'{head}"{text}",']
    indent = head[: len(head) - len(head.lstrip())]
    return [f"{head}(", f"{indent}    {quoted(text, f'{indent}    ')}", f"{indent}),"]


def quoted(text: str, indent: str) -> str:
    """Return a string constant; one that fills more than a line of that indent goes on in the next."""
    return '"{}"'.format(f'"\n{indent}"'.join(pieces(text, WIDTH - len(indent) - 3)))


def packed(items: Iterable[str], indent: str) -> list[str]:
    """Return items with a comma behind each, as many on a line as it holds."""
    lines: list[str] = []
    for item in items:
        if lines and columns(f"{lines[-1]} {item},") <= WIDTH:
            lines[-1] += f" {item},"
        else:
            lines.append(f"{indent}{item},")
    return lines


def statement(line: str) -> list[str]:
    """Return a statement of a body, which stands four columns in; a value that is too long stands in brackets."""
    indent, long = line[: len(line) - len(line.lstrip())], _ASSIGNED.fullmatch(line.strip())
    if columns(line) <= WIDTH - 4 or long is None:
        return [line]
    room = WIDTH - len(indent) - 8
    parts = textwrap.wrap(long["value"], room, break_long_words=False, break_on_hyphens=False)
    return [f"{indent}{long['head']} (", *(f"{indent}    {part}" for part in parts), f"{indent}){AS_IT_IS}"]


def columns(text: str) -> int:
    """Return how many columns a line takes: Chinese and Japanese characters take two."""
    return sum(2 if east_asian_width(c) in "WF" else 1 for c in text)


def _fitting(text: str, most: int) -> int:
    """Return how many characters of a text fit into so many columns."""
    room = most
    for count, character in enumerate(text):
        room -= columns(character)
        if room < 0:
            return count
    return len(text)
