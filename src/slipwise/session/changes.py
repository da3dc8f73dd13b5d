"""One step of a session from another: an effect in or out, a number changed, what a diagnosis suggests taken over."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from slipwise.effects import Effect
from slipwise.errors import SettingError, unknown_name
from slipwise.model import Model
from slipwise.preparation.gauge_groups import find_places_of_gauges
from slipwise.relations.parameters import Free, Term, make_terms
from slipwise.session.evaluation import Evaluator
from slipwise.session.state import SessionState


def toggled(ready: Evaluator, state: SessionState, effect: Effect, target: str = "") -> SessionState:
    """Return a state with an effect, or without it where it has it.

    Args:
        ready: the campaign.
        state: as it is.
        effect: with the bounds that it has in this campaign.
        target: the channel or card ("pad_*_N") on which it acts, for effects that need one.

    Raises:
        SettingError: effects that cannot act together, or a target that is missing or is none.
    """
    found = [t for t in state.terms if t.effect.name == effect.name and target in ("", t.group)]
    if len(found) > 1:
        raise SettingError(f"{effect.name} acts on several channels; say which: {', '.join(t.group for t in found)}")
    if found:
        terms = tuple(t for t in state.terms if t.label != found[0].label)
        return _having(ready, state, terms, {}, f"{found[0].label} taken out")
    term = _aimed(ready, effect, target)
    return with_terms(ready, state, [(term, effect.typical())], f"{term.label} added")


def with_terms(
    ready: Evaluator, state: SessionState, added: Sequence[tuple[Term, Mapping[str, float]]], words: str
) -> SessionState:
    """Return a state with more effects: with the numbers that they had before they were taken out, or with these.

    Args:
        ready: the campaign.
        state: as it is.
        added: effects with the values of their parameters.
        words: what is done.

    Raises:
        SettingError: effects that cannot act together.
    """
    new = [(term, values) for term, values in added if state.term(term.label) is None]
    numbers = {f"{term.label}.{name}": value for term, values in new for name, value in values.items()}
    return _having(ready, state, (*state.terms, *(term for term, _ in new)), numbers, words)


def with_number(ready: Evaluator, state: SessionState, key: str, value: float | str) -> SessionState:
    """Return a state with one other number.

    Args:
        ready: the campaign.
        state: as it is.
        key: "rig.mass", "heating.share" ...
        value: SI, or a text with its unit.

    Raises:
        UnknownNameError: the model has no such number.
        SettingError: a value out of bounds.
        UnitError: a unit of the wrong dimension, or none.
    """
    known = {f.key: f for f in ready.free(state)}
    if key not in known:
        raise unknown_name("number of this model", key, known)
    found = _read(known[key], value)
    edited = f"{key} changed"
    return replace(state, values={**state.values, key: found}, fitted=False, words=edited, edit=key)


def removed(ready: Evaluator, state: SessionState, effect: str) -> SessionState:
    """Return a state without an effect.

    Args:
        ready: the campaign.
        state: as it is.
        effect: its name, or its label ("channel_gain[pad_A_N]").

    Raises:
        SettingError: the model does not hold it, or cannot do without it.
    """
    ready.model_of(state).without(effect)  # says what it holds
    terms = tuple(t for t in state.terms if effect not in (t.label, t.effect.name))
    return _having(ready, state, terms, {}, f"{effect} removed")


def without_additions(ready: Evaluator, state: SessionState) -> SessionState:
    """Return a state without the effects that have no role in the base model, all other numbers as they are."""
    terms = tuple(t for t in state.terms if t.effect.base)
    return state if terms == state.terms else _having(ready, state, terms, {}, "without what was added")


def as_stated(ready: Evaluator, state: SessionState, model: Model) -> SessionState:
    """Return the state of another model, as it was stated: its effects and rated values, all else as it is.

    Args:
        ready: the campaign.
        state: whose noise, and whose numbers of the rig that no model file holds, are kept.
        model: with the bounds that its effects have in this campaign.
    """
    specimen, terms = model.specimen, make_terms(model)
    rated = {
        "rig.mass": specimen.mass,
        "rig.centre_height": specimen.centre_height,
        "rig.shear_strength": specimen.shear_strength,
        "rig.buffer_stiffness": sum(specimen.buffer_stiffness),
    }
    kept = {k: rated.get(k, v) for k, v in state.values.items()}
    numbers = {f"{u.label}.{n}": v for u in model.uses for n, v in u.numbers.items()}
    return _having(ready, replace(state, values={**kept, **numbers}), terms, {}, "another model")


def _having(
    ready: Evaluator, state: SessionState, terms: tuple[Term, ...], numbers: Mapping[str, float], words: str
) -> SessionState:
    """Return a state with other effects, and with the numbers of the rig that belong to these."""
    typical = {f"{t.label}.{n}": v for t in terms for n, v in t.effect.typical().items()}
    values = {**typical, **numbers, **state.values}
    Model(ready.model.specimen, tuple(u for t in terms for u in t.uses(values)))  # refuses what cannot act together
    there = replace(state, terms=terms, values=values, fitted=False, words=words, edit="")
    free = {f.key: f.start for f in ready.free(there)}
    kept = {k: v for k, v in values.items() if not k.startswith("rig.") or k in free}
    return replace(there, values={**free, **kept})


def _aimed(ready: Evaluator, effect: Effect, target: str) -> Term:
    if effect.single and target in {f"pad_{pad}_N" for pad in ready.model.specimen.pads}:
        return Term(effect, (target,), target)
    if not effect.target:
        if target:
            raise SettingError(f"{effect.name} acts everywhere; it takes no target ({target!r} was given)")
        return Term(effect)
    places = find_places_of_gauges(effect, ready.runs[0].record)
    if target not in places:
        raise SettingError(
            f"{effect.name} acts on one gauge or card; say which ({target or 'nothing'!r} was given): "
            f"{', '.join(places) or 'none was recorded here'}"
        )
    return Term(effect, places[target], target)


def _read(free: Free, value: float | str) -> float:
    if isinstance(value, str):
        from slipwise.units import quantity  # pint takes a while to load

        value = quantity(value, free.unit, free.key)
    if not free.low <= value <= free.high:
        raise SettingError(
            f"{free.key} = {value:g} {free.unit} is out of bounds: {free.low:g} to {free.high:g} {free.unit}"
        )
    return float(value)
