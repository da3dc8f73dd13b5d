"""Words from elsewhere as text of a Python file: they can only be read, never run."""

import keyword
import textwrap
from unicodedata import category

#: Width of a line of words [characters].
WIDTH = 120


def is_name(text: str) -> bool:
    """Return whether a text can be a name in Python."""
    return text.isidentifier() and not keyword.iskeyword(text)


def words(text: str) -> str:
    """Return a text as one line that no quotation can end and no reader mistake for a heading of an effect's docstring.

    Any white space becomes one blank, a backslash a slash, a double quotation mark a single one, and what cannot be
    seen a question mark: names and paths from elsewhere may hold all of these.
    """
    line = " ".join(text.split()).replace("\\", "/").replace('"', "'")
    line = "".join("?" if category(c).startswith("C") else c for c in line)
    return line.replace("Valid:", "Valid,").replace("Source:", "Source,")


def sentence(text: str, most: int) -> str:
    """Return words as one sentence of at most so many characters: a capital at its begin, a full stop at its end."""
    line = textwrap.shorten(words(text), most - 1, placeholder=" ...")
    return line[:1].upper() + line[1:] + ("" if line.endswith((".", "!", "?")) else ".")


def paragraph(text: str, indent: str = "") -> str:
    """Return words as lines of a docstring or a comment."""
    return textwrap.fill(text, WIDTH, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False)
