"""What a session holds at one step: effects, numbers, the noise they are judged by, and what a fit said of them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from slipwise.effects import Effect, catalogue
from slipwise.relations.parameters import Term
from slipwise.short_repr import short_repr

#: Name or file of an effect -> the effect, with the bounds that it has in this campaign.
EffectOf = Callable[[str], Effect]


@short_repr
@dataclass(frozen=True)
class Weights:
    """The model by which noise was weighed: errors in floors compare only where this is the same, or each its own.

    Attributes:
        terms: of that model.
        values: its numbers.
        finer: whether the laws were evaluated at as many instants as what is reported needs.
        yaw: whether the girder's yaw is made from the measured forces.
        fitted: whether a fit has found the numbers, and not the model as it is stated.
    """

    terms: tuple[Term, ...]
    values: Mapping[str, float]
    finer: bool
    yaw: bool = False
    fitted: bool = False


@dataclass(frozen=True)
class Known:
    """What a fit said of one number.

    Attributes:
        low: lower end of the 95 % interval [SI]; None where the fit ended on a bound.
        high: upper end.
        bound: "", or "lower" or "upper" where the fit ended there.
        limit: "", or "upper" for a strength that may be absent: `high` is what it is at most.
    """

    low: float | None
    high: float | None
    bound: str
    limit: str


@short_repr
@dataclass(frozen=True)
class SessionState:
    """One step of a session.

    Attributes:
        terms: effects of the model in order.
        values: key -> number [SI], "rig.mass", "heating.share" ...; numbers of effects that were taken out stay, so
            that an effect comes back as it was.
        weights: how noise was weighed.
        fitted: whether these are numbers that a fit has found.
        known: key -> what that fit said of it.
        words: what was done to come here.
        edit: key of the number that was changed, "" for any other step: changes of one number are one step.
    """

    terms: tuple[Term, ...]
    values: Mapping[str, float]
    weights: Weights
    fitted: bool = False
    known: Mapping[str, Known] = field(default_factory=dict[str, Known])
    words: str = "opened"
    edit: str = ""

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of its effects."""
        return tuple(t.label for t in self.terms)

    def term(self, label: str) -> Term | None:
        """Return the effect of this label, None where the model has none."""
        return next((t for t in self.terms if t.label == label), None)


def as_json(state: SessionState) -> dict[str, Any]:
    """Return a state as JSON holds it."""
    return {
        "terms": terms_json(state.terms),
        "values": dict(state.values),
        "weights": {
            "terms": terms_json(state.weights.terms),
            "values": dict(state.weights.values),
            "finer": state.weights.finer,
            "yaw": state.weights.yaw,
            "fitted": state.weights.fitted,
        },
        "fitted": state.fitted,
        "known": {k: [v.low, v.high, v.bound, v.limit] for k, v in state.known.items()},
        "words": state.words,
        "edit": state.edit,
    }


def from_json(content: Mapping[str, Any], effect_of: EffectOf) -> SessionState:
    """Return the state that `as_json` wrote.

    Args:
        content: what it wrote.
        effect_of: finds effects; it refuses a file that may not be run.
    """
    weights, known = content["weights"], content["known"].items()
    return SessionState(
        terms_from_json(content["terms"], effect_of),
        dict(content["values"]),
        Weights(
            terms_from_json(weights["terms"], effect_of),
            dict(weights["values"]),
            weights["finer"],
            weights["yaw"],
            weights["fitted"],
        ),
        content["fitted"],
        {key: Known(*of) for key, of in known},
        content["words"],
        content["edit"],
    )


def terms_json(terms: Sequence[Term]) -> list[dict[str, Any]]:
    """Return effects with the channels on which they act; a user's own by its file."""
    return [
        {
            "effect": named(t.effect),
            "targets": list(t.targets),
            "group": t.group,
            "own": list(t.own),
            "unused": dict(t.unused),
        }
        for t in terms
    ]


def terms_from_json(content: Sequence[Mapping[str, Any]], effect_of: EffectOf) -> tuple[Term, ...]:
    """Return the effects that `terms_json` wrote."""
    return tuple(
        Term(
            effect_of(one["effect"]),
            tuple(one["targets"]),
            one["group"],
            tuple(one.get("own", ())),
            dict(one.get("unused", {})),
        )
        for one in content
    )


def named(effect: Effect) -> str:
    """Return what an effect is found by: its name in the catalogue, else its file."""
    return effect.name if effect.name in catalogue() else str(effect.path)
