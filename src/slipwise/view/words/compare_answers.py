"""A comparison in words: what everybody asks first, and the answers in a sentence each."""

from typing import Any

from slipwise.comparison.component_level import NAMES
from slipwise.comparison.result import Comparison
from slipwise.noise.level import is_at_floor
from slipwise.view.colours import Tone


def headline(found: Comparison) -> tuple[str, str, Tone]:
    """Return the answer in a few words, in a sentence, and its tone."""
    relation, error = found.worst
    where = "on the held-out runs" if found.base.objective.held_out else "on the fitted runs (none is held out)"
    if not found.places:
        return (
            "Nothing above the noise floor is left",
            f"The largest error of any balance is {error:.2f} floors {where} ({NAMES[relation][0]}).",
            "good",
        )
    words = f"{capital(NAMES[relation][0])} errs by {error:.3g} times the noise floor {where}."
    if is_at_floor(error):
        place = NAMES[found.places[0].relation][0]
        return "Every balance is at its noise floor", f"{words} What is left has some structure in {place}.", "good"
    return f"The model fails in {NAMES[found.places[0].relation][0]}", words, "bad" if error > 3.0 else "warn"


def one_minute(found: Comparison) -> list[tuple[str, str]]:
    """Return the questions that everybody asks first, with their answers: of bearings without gauges what they did."""
    layer = [("What did the bearings do together?", _layer_words(found))] if found.layer else []
    return [
        *layer,
        ("Are the instruments telling the truth?", found.checks.words),
        ("What is the noise floor?", _floor_words(found)),
        ("How well does the model do?", _error_words(found)),
        ("Exactly where does it fail?", place_words(found)),
    ]


def error_rows(found: Comparison) -> list[dict[str, Any]]:
    """Return the error of every balance in floors as rows of a table."""
    return [
        {"balance": NAMES[r][0], "fitted": found.error(r, held_out=False), "held out": found.error(r, held_out=True)}
        for r in found.relations
    ]


def tones(found: Comparison) -> tuple[Tone, ...]:
    """Return the tones of the answers."""
    tone = headline(found)[2]
    checked: Tone = "bad" if found.checks.accused else "good" if found.checks.words.startswith("Yes") else "warn"
    first: tuple[Tone, ...] = ("plain",) if found.layer else ()
    return *first, checked, "plain", tone, tone


def roles(found: Comparison) -> str:
    """Say how many runs were fitted, repeated and held out."""
    roles = [run.role for run in found.campaign.runs]
    named = {"fit": "fitted", "repeat": "repeated", "holdout": "held out"}
    return ", ".join(f"{roles.count(r)} {w}" for r, w in named.items() if r in roles)


def _layer_words(found: Comparison) -> str:
    """Say what all bearings did in the run that moved them most: held-out runs before others."""
    held = [one for one in found.layer if one.role == "holdout"]
    one = max(held or found.layer, key=lambda layer: layer.peak_slip)
    return (
        f"In {one.run}, from the inertia of what they carry: period {one.period:.3g} s, {one.damping:.1%} of critical, "
        f"{one.energy / 1e3:.3g} kJ taken, {one.peak_force:.1%} of the weight at {1e3 * one.peak_slip:.3g} mm. The "
        f"linear layer nearest to it leaves {one.linear_left:.1%} of the force, the model {one.model_left:.1%}."
    )


def _floor_words(found: Comparison) -> str:
    rows = {row["relation"]: row for row in found.rows("floor")}
    row = rows.get("pads") or next(iter(rows.values()))
    words = size(row["floor"], row["unit"])
    if row["near_reversals"] is not None:
        words += f" and {size(row['near_reversals'], row['unit'])} near reversals"
    of = "On the friction of one pad" if row["relation"] == "pads" else f"On the {NAMES[row['relation']][0]}"
    words = f"{of} {words}, from the noise of gauges and velocity"
    again = row["repeated_runs"]
    if again is None:
        return words + "; no repeated run confirms it."
    return words + f"; a repeated run shows {again:.2f} times that."


def _error_words(found: Comparison) -> str:
    held = bool(found.base.objective.held_out)
    errors = {r: found.error(r, held_out=held) for r in found.relations}
    known = {r: e for r, e in errors.items() if e is not None}
    good = [r for r, e in known.items() if is_at_floor(e)]
    bad = sorted((r for r in known if r not in good), key=lambda r: -known[r])
    words = f"{len(good)} of {len(known)} balances {'is' if len(good) == 1 else 'are'} at the floor"
    if bad:
        words += "; above it: " + ", ".join(f"{NAMES[r][0]} {known[r]:.3g}" for r in bad)
    if found.system:
        channels = found.system_errors
        worst = max(channels, key=lambda c: channels[c])
        words += f". Replayed from the table motion, slip errs by {channels['slip_x']:.3g} floors"
        words += f", the worst channel ({worst}) by {channels[worst]:.3g}"
    share = [e.share for e in found.components if e.relation == "pads" and (e.role == "holdout") == held]
    if share:
        words += f". Friction of the pads errs by {max(share):.2%} of its rms"
    layer = [one.model_left for one in found.layer if (one.role == "holdout") == held]
    if layer:
        words += f". The force of all bearings errs by {max(layer):.2%} of its rms"
    return words + "."


def place_words(found: Comparison) -> str:
    """Say where the model fails."""
    if not found.places:
        return "Nowhere: no state of motion, pad, speed, pressure or run stands above the floor."
    first = found.places[0].words
    more = len(found.places) - 1
    return capital(first) + (f". And {more} more balance{'s' if more > 1 else ''}, below." if more else ".")


def size(value: float | None, unit: str) -> str:
    """Write a value with its unit as a reader would."""
    if value is None:
        return "unknown"
    shown = {"N": ("kN", 1e-3) if value >= 1000.0 else ("N", 1.0), "m/s^2": ("m/s²", 1.0), "1": ("", 1.0)}
    name, factor = shown.get(unit, (unit, 1.0))
    return f"{value * factor:.3g} {name}".strip()


def capital(words: str) -> str:
    """Begin a sentence."""
    return words[:1].upper() + words[1:]
