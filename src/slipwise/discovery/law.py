"""A law of the data: its states, form and constants, what it explains, and what cannot be told apart from it."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.discovery.curve_shape import CurveShape, describe_curve
from slipwise.discovery.form import FUNCTIONS, Form
from slipwise.discovery.law_objective import STRENGTH, FittedLaw
from slipwise.discovery.matching import name_of, product_at
from slipwise.estimation.intervals import compute_halfwidth
from slipwise.residual_map.states import WORDS
from slipwise.short_repr import short_repr

#: Points of a curve with its band.
_POINTS = 41


@dataclass(frozen=True)
class LawConstant:
    """One number of a law, with its 95 % interval [SI]; a reference, which is chosen, has none (NaN).

    Where the fit ran to a bound, `bound` is "lower" or "upper": the data leave it open, and it is no constant.
    """

    name: str
    value: float
    low: float
    high: float
    unit: str
    bound: str = ""


@short_repr
@dataclass(frozen=True)
class TiedForm:
    """A form that cannot be told apart from the one that was chosen, as it was fitted.

    Attributes:
        forms: one per state.
        values: its numbers by name, strength first.
    """

    forms: tuple[Form, ...]
    values: Mapping[str, float]


@short_repr
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
    def shape(self) -> CurveShape | None:
        """Its curve described without a form; None over two states."""
        candidate = self.fitted.law.match.candidate
        return describe_curve(candidate.curve, candidate.states[0])

    @property
    def alike(self) -> Mapping[str, float]:
        """Effect of the catalogue -> share of the curve that it could explain alone [1]."""
        return self.fitted.law.match.candidate.alike

    @property
    def undetermined(self) -> dict[str, str]:
        """Name of every constant that ran to a bound of its fit -> "lower" or "upper"."""
        return {c.name: c.bound for c in self.constants if c.bound}

    def band(self) -> dict[str, list[float]]:
        """Return the law over its state with a 95 % band, in which the forms that tie with it lie too; {} over two."""
        match = self.fitted.law.match
        if len(match.forms) > 1:
            return {}
        curve, (low, high) = match.candidate.curve, self.valid[self.states[0]]
        over = np.linspace(low, high, _POINTS)
        every = [(match.forms, self.fitted.values), *((t.forms, t.values) for t in self.tied_forms)]
        drawn = np.array([values[STRENGTH] * product_at(forms, [over], values) for forms, values in every])
        half = compute_halfwidth(1.0) * np.interp(over, curve.knots[0], curve.errors())
        return {
            "state": over.tolist(),
            "value": drawn[0].tolist(),
            "low": np.minimum(drawn[0] - half, drawn.min(axis=0)).tolist(),
            "high": np.maximum(drawn[0] + half, drawn.max(axis=0)).tolist(),
        }

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


@short_repr
@dataclass(frozen=True)
class Origin:
    """Where a law comes from, as its effect file states it.

    Attributes:
        campaign: its name.
        beside: effects that the fit held before the search for a law began.
        relation: that the laws act on.
        before: its error on what no fit has seen, without laws [floors].
        after: the same with them [floors].
    """

    campaign: str
    beside: tuple[str, ...]
    relation: str
    before: float
    after: float
