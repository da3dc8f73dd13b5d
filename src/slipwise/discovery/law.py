"""What a discovery answers: laws with their constants, what they explain, and what may be said of them."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from slipwise.discovery.candidate import Candidate
from slipwise.discovery.form import FUNCTIONS, Form
from slipwise.discovery.law_objective import FittedLaw
from slipwise.discovery.matching import name_of
from slipwise.discovery.states import WORDS
from slipwise.display import Drawn, Tabular
from slipwise.estimation.base_fit import BaseFit


@dataclass(frozen=True)
class LawConstant:
    """One number of a law, with its 95 % interval [SI]; a reference, which is chosen, has none (NaN)."""

    name: str
    value: float
    low: float
    high: float
    unit: str


@dataclass(frozen=True)
class TiedForm:
    """A form that cannot be told apart from the one that was chosen, as it was fitted.

    Attributes:
        forms: one per state.
        values: its numbers by name, strength first.
    """

    forms: tuple[Form, ...]
    values: Mapping[str, float]


@dataclass(frozen=True)
class Law:
    """A law that was found.

    Attributes:
        name: of its effect and file.
        states: names of the states that drive it.
        port: how it enters.
        where: on which pads, or which way of sliding; "all".
        parity: "odd" where its force turns with the velocity, else "even".
        form: its name; factors of a product joined by " x ".
        tied: other forms of the same state that cannot be told apart.
        rivals: other states or ports that explain as much, in words.
        constants: strength first.
        share: of the error above noise that it explains, everything else fitted again [1].
        other_states: whether one of the rivals has another state.
        at_buffers: whether a force on the girder acts at the buffers: it shows in the girder's pitch too.
        valid: state -> range of the data [SI].
        fitted: the fit behind it.
        tied_forms: those of `tied`, to be drawn.
        alternatives: every law that explains as much, of its form or of another state or port, best first.
    """

    name: str
    states: tuple[str, ...]
    port: str
    where: str
    parity: str
    form: str
    tied: tuple[str, ...]
    rivals: tuple[str, ...]
    constants: tuple[LawConstant, ...]
    share: float
    other_states: bool
    at_buffers: bool
    valid: Mapping[str, tuple[float, float]]
    fitted: FittedLaw
    tied_forms: tuple[TiedForm, ...]
    alternatives: tuple["Law", ...] = ()

    @property
    def driver(self) -> str:
        """What it depends on, in words."""
        return " and ".join(WORDS[s] for s in self.states)

    @property
    def acts_on(self) -> str:
        """Its port for a program to read: "one pad" for some pads, and for a force on the girder where it acts."""
        if self.where.startswith(("pad", "side")):
            return "one pad"
        if self.port in ("girder", "girder by place", "multiplies buffers"):
            return "buffer" if self.at_buffers else "girder"
        return self.port

    @property
    def equation(self) -> str:
        """The law in one line, with the names of its constants."""
        return equation_of(self.port, [f.value for f in self.fitted.law.match.forms], self.states)


def equation_of(port: str, values: list[str], states: tuple[str, ...]) -> str:
    """Write how a law enters, its form left as the text of its file with the state by its name."""
    shown = []
    for place, (text, state) in enumerate(zip(values, states, strict=True)):
        shown.append(with_names(text, state, place))
    form = " * ".join(f"({t})" if len(shown) > 1 else t for t in shown)
    return {
        "adds to mu": f"mu += strength * {form}",
        "multiplies mu": f"mu *= 1 + strength * {form}",
        "adds to friction": f"F += strength * N_0 * {form}",
        "even force on pads": f"F_x += strength * N * {form}",
        "girder": f"F_girder += strength * {form}, against the motion",
        "girder by place": f"F_girder += strength * {form}, whichever way it moves",
        "load": f"F_z += strength * {form}, upwards on the girder",
        "multiplies buffers": f"F_buffers *= 1 + strength * {form}",
    }[port]


def with_names(text: str, state: str, place: int) -> str:
    """Put a state's name, and for a second factor the constants' names, into the text of a form."""

    def name(found: "re.Match[str]") -> str:
        word = found.group(0)
        if word == "s":
            return state
        return word if word in FUNCTIONS else name_of(word, place)

    return re.sub(r"[A-Za-z_]\w*", name, text)


@dataclass(frozen=True, repr=False)
class Discovery(Drawn, Tabular):
    """The answer.

    Attributes:
        campaign: its name.
        evidence: what may be said: "law", "state", "organised", "unknown" or "nothing".
        laws: in the order in which they were found; empty where nothing may be called one.
        organised: what explains most, whether or not it may be called a law; None where nothing does.
        looked_at: what explains most in the first screen, one of each state and port, best first.
        share: of the error above noise that all laws, or that, explain [1].
        relations: relation -> held-out error in floors before and after; of the fitted runs where none is held out.
        worst: relation that the laws act on.
        cannot_judge: states that could not be judged, and why.
        base: the fit from which the search began, with its slopes.
        files: of the effects that were written.
        seconds: it took.
        beside: effects that the diagnosis had added to the user's model before the search for a law began.
    """

    campaign: str
    evidence: str
    laws: tuple[Law, ...]
    organised: Candidate | None
    looked_at: tuple[Candidate, ...]
    share: float
    relations: Mapping[str, tuple[float, float]]
    worst: str
    cannot_judge: tuple[str, ...]
    base: BaseFit
    files: tuple[Path, ...]
    seconds: float
    beside: tuple[str, ...] = ()

    @property
    def sentence(self) -> str:
        """The answer in words."""
        from slipwise.discovery.words import sentence

        return sentence(self)

    def written(self, folder: Path, name: str, date: str) -> "Discovery":
        """Write its laws as effect files; see `effect_file.write_discovered`."""
        from slipwise.discovery.effect_file import write_discovered

        return write_discovered(self, folder, name, date)

    @property
    def proposal(self) -> dict[str, Any] | None:
        """The first law in short, for a diagnosis whose verdict is unknown; None where no law and no state is told."""
        if self.evidence not in ("law", "state"):
            return None
        law = self.laws[0]
        return {
            "state": list(law.states),
            "port": law.acts_on,
            "form": law.form,
            "file": str(self.files[0]) if self.files else None,
            "share": self.share,
            "words": self.sentence,
        }

    def as_json(self) -> dict[str, Any]:
        """Return the answer for a program to read."""
        before, after = self.relations.get(self.worst, (float("nan"),) * 2)
        return {
            "campaign": self.campaign,
            "evidence": self.evidence,
            "words": self.sentence,
            "laws": [
                {
                    "name": law.name,
                    "states": list(law.states),
                    "port": law.acts_on,
                    "enters": law.port,
                    "where": law.where,
                    "parity": law.parity,
                    "form": law.form,
                    "equation": law.equation,
                    "tied": list(law.tied),
                    "rivals": list(law.rivals),
                    "constants": {
                        c.name: {"value": c.value, "low": _known(c.low), "high": _known(c.high), "unit": c.unit}
                        for c in law.constants
                    },
                    "share": law.share,
                    "valid": {state: list(ends) for state, ends in law.valid.items()},
                }
                for law in self.laws
            ],
            "beside": list(self.beside),
            "organised": None if self.organised is None else self.organised.label,
            "share": self.share,
            "held_out": {"before": _known(before), "after": _known(after)},
            "relations": {name: [_known(error) for error in errors] for name, errors in self.relations.items()},
            "cannot_judge": list(self.cannot_judge),
            "file": str(self.files[0]) if self.files else None,
            "files": [str(path) for path in self.files],
            "seconds": self.seconds,
        }

    def _headline(self) -> str:
        return f"{self.campaign}: {self.sentence}"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"law": law.name, "form": law.form, "constant": c.name, "value": c.value, "low": c.low, "high": c.high,
             "unit": c.unit}
            for law in self.laws
            for c in law.constants
        ]  # fmt: skip


def _known(value: float) -> float | None:
    """Return a number for JSON, which has none that is not known."""
    return value if isfinite(value) else None
