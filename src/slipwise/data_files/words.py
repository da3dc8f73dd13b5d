"""The words by which headers state facts, from words.toml, as patterns for folded lines."""

import re
import tomllib
import unicodedata
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

#: What may stand between the words of a phrase.
_BETWEEN = r"[\s_.'’-]*"
_LETTER = "[A-Za-z]"  # lines are folded
_PLAIN = str.maketrans({"ı": "i", "ß": "ss", "Δ": "delta ", "、": ", ", "。": ". "})


@dataclass(frozen=True)
class Words:
    """Patterns for the facts of a header.

    Attributes:
        key: a fact's words; the name of the group that matched tells the fact and how its value may follow.
        behind: words that stand behind their number, likewise.
        links: words between a fact's words and its value.
        others: words that make the statement behind them one of something else.
        units: unit, folded and in lower case -> the SI unit that it is one of, and the factor to that.
        unit: a pattern for these units.
    """

    key: re.Pattern[str]
    behind: re.Pattern[str]
    links: str
    others: re.Pattern[str]
    units: dict[str, tuple[str, float]]
    unit: str

    def is_acceleration(self, word: str) -> bool:
        """Return whether a folded word is one for acceleration."""
        match = self.key.fullmatch(word)
        return match is not None and str(match.lastgroup).startswith("acceleration")


def folded(text: str) -> str:
    """Return a text without accents and with plain digits and signs; the case stays, for mg and Mg differ."""
    marks = unicodedata.normalize("NFKD", text.translate(_PLAIN))
    return "".join(c for c in marks if not unicodedata.combining(c))


@cache
def words() -> Words:
    """Return the patterns."""
    table = tomllib.loads(files("slipwise.data_files").joinpath("words.toml").read_text(encoding="utf-8"))
    keys: list[tuple[str, str]] = []
    behind: list[tuple[str, str]] = []
    for fact, lists in table.items():
        for how, phrases in lists.items():
            group = f"{fact.replace(' ', '_')}__{how}"
            if how in ("prose", "signed", "with_unit"):
                keys += [(phrase, group) for phrase in phrases]
            elif how == "after":
                behind += [(phrase, group) for phrase in phrases]
    units = {
        folded(name).lower(): (si, float(factor))
        for si, kind in (("s", "seconds"), ("Hz", "hertz"))
        for factor, names in table[kind].items()
        for name in names
    }
    return Words(
        key=re.compile(_alternatives(keys), re.IGNORECASE),
        behind=re.compile(_alternatives(behind), re.IGNORECASE),
        links="|".join(_bounded(re.escape(folded(word)), word) for word in table["links"]["words"]),
        others=re.compile(rf"(?:{'|'.join(map(_phrase, table['others']['words']))})[\s\w]{{0,12}}$", re.IGNORECASE),
        units=units,
        unit="|".join(_bounded(re.escape(name), name) for name in sorted(units, key=len, reverse=True)),
    )


def _alternatives(phrases: list[tuple[str, str]]) -> str:
    """Return one pattern with a named group a kind; longer phrases are tried before shorter ones."""
    # A group can only be named once: the phrases of a kind follow one another within each length.
    ordered = sorted(phrases, key=lambda pair: -len(folded(pair[0])))
    return "|".join(f"(?P<{group}__{k}>{_phrase(text)})" for k, (text, group) in enumerate(ordered))


def _phrase(text: str) -> str:
    parts = [re.escape(part) for part in re.split(r"[\s_]+", folded(text))]
    return _bounded(_BETWEEN.join(parts), text)


def _bounded(pattern: str, text: str) -> str:
    """Let words of letters stand alone; Japanese and Chinese have no blanks between words."""
    plain = folded(text)
    start = rf"(?<!{_LETTER})" if plain[0].isascii() and plain[0].isalpha() else ""
    end = rf"(?!{_LETTER})" if plain[-1].isascii() and plain[-1].isalpha() else ""
    return f"{start}{pattern}{end}"
