"""Why an effect was not named, in sentences."""

from math import isfinite

from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.why_not import Instant, WhyNot
from slipwise.view.words.diagnosis_words import floors

#: Standard errors from which on one model is told from another [1].
_TOLD = 2.0
#: Less than this share of what matters is nothing [1].
_NOTHING = 0.005


def why_not_words(found: WhyNot) -> list[str]:
    """Say what an effect can do at best, and what contradicts it, a sentence each."""
    name, named = found.effect, " and ".join(found.named)
    if found.reason:
        return [f"{name}: {found.reason}."]
    error = "on runs that no fit has seen" if found.unseen else "on the runs that were fitted"
    out: list[str] = []
    worst = found.worst
    if found.replaced:
        left = f"{floors(worst['instead'])} noise floors {error}"
        out.append(
            f"{name} in the place of {found.replaced} leaves {left}, where the model with {named} leaves "
            f"{floors(worst['named'])} and the base model {floors(worst['base'])}."
        )
        out.append(_behind_words(found))
        out += [f"What it leaves, {found.where}."] if found.where else []
        out += [instant_words(i, found) for i in found.instants]
        if isfinite(found.gain):
            out.append(f"Beside {named} it would be {_size_words(found)}, and {_gain_words(found)}.")
        elif found.apart:
            out.append(f"{name} and {named} cannot be in one model.")
    else:
        fall = f"from {floors(worst['base'])} to {floors(worst['instead'])} noise floors {error}"
        size = f" it would be {_size_words(found)}, and" if isfinite(found.size) else ""
        out.append(f"{name} alone takes the error {fall};{size} {_gain_words(found)}.")
    return out


def _behind_words(found: WhyNot) -> str:
    behind = found.behind
    if behind >= _TOLD:
        return f"It is {min(behind, 30.0):.1f} standard errors behind, over all motions that were fitted."
    if behind > -_TOLD:
        return "The motions that were fitted do not tell the two apart."
    return f"It leads by {min(-behind, 30.0):.1f} standard errors over the motions that were fitted."


def _size_words(found: WhyNot) -> str:
    if found.size < _NOTHING:
        return "nothing"
    return f"{found.size:.2g} times what matters"


def _gain_words(found: WhyNot) -> str:
    gain = found.gain
    if gain >= _TOLD:
        return f"the model would be better by {min(gain, 30.0):.1f} standard errors"
    return "the model would be no better" if gain > -_TOLD else "the model would predict left-out motions worse"


def instant_words(found: Instant, why: WhyNot) -> str:
    """Say where and when the measurement contradicts an effect."""
    where = NAMES[found.relation][0] + (f" of pad {found.pad}" if found.pad else "")
    state = f"{found.state}, {100.0 * found.speed:.2g} cm/s, pads at {_short(found.load / 1e3)} kN"
    errors = f"{floors(found.instead)} floors, with {why.replaced} {floors(found.named)}"
    return f"{found.run}, {found.start:.2f} to {found.end:.2f} s ({state}): {where} {errors}."


def _short(value: float) -> str:
    return f"{value:.3g}" if abs(value) < 1e3 else f"{value:.0f}"
