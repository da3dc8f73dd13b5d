"""A law as an effect file: read, edited and added by its user like any effect of the catalogue."""

import dataclasses
import re
from collections.abc import Sequence
from pathlib import Path

import slipwise
from slipwise.discovery.form import FUNCTIONS
from slipwise.discovery.law import Discovery, Law, LawConstant
from slipwise.discovery.law_problem import STRENGTH, TIME_CONSTANT
from slipwise.discovery.matching import constants_of
from slipwise.discovery.states import UNITS
from slipwise.effects import LAGGING
from slipwise.effects._written import WrittenEffect, write_effect
from slipwise.effects._written_hook import WrittenHook
from slipwise.params import Parameter

#: State -> argument of a pad's hook; others are called alike. Of a buffer, rate and deflection stand for both.
_OF_PADS = {"slip": "slip_x"}
_OF_BUFFERS = {"slip_size": "abs(deflection)", "speed": "abs(rate)"}
#: What a further fit may make of a number: this many times its value [1].
_ROOM = 10.0
#: A strength is looked for up to this many times its value [1].
_STRONGEST = 10.0


def write_discovered(found: Discovery, folder: Path, name: str, date: str) -> Discovery:
    """Write the effect files of a discovery's laws, over those of an earlier one; where no law is claimed, none.

    Args:
        found: the discovery.
        folder: is made where it is not there.
        name: of the first law's effect; further ones get a number.
        date: of the discovery, as text.

    Returns:
        The discovery with the files.

    Raises:
        SettingError: the name cannot be that of an effect.
    """
    if found.evidence not in ("law", "state"):
        return found
    files = []
    for number, law in enumerate(found.laws, start=1):
        own = name if number == 1 else f"{name}_{number}"
        files.append(write_law(law, found, folder, own, date, replace=True))
    return dataclasses.replace(found, files=tuple(files))


def write_law(law: Law, found: Discovery, folder: Path, name: str, date: str, *, replace: bool = False) -> Path:
    """Write a law's effect file, FOLDER/NAME.py.

    Args:
        law: of the discovery.
        found: where it comes from.
        folder: is made where it is not there.
        name: of the effect.
        date: of the discovery, as text.
        replace: write over a file of that name.

    Raises:
        SettingError: the name cannot be that of an effect, or the file is there already.
    """
    return write_effect(written_law(law, found, name, date), folder, replace=replace)


def written_law(law: Law, found: Discovery, name: str, date: str) -> WrittenEffect:
    """Give a law as an effect to be written; arguments as `write_law`."""
    before, after = found.relations.get(found.worst, (float("nan"),) * 2)
    ranges = ", ".join(f"{s} {low:.3g} to {high:.3g} {UNITS.get(s, 'm')}" for s, (low, high) in law.valid.items())
    rivals = [f"form {f}" for f in law.tied] + list(law.rivals)
    tied = f" Cannot be told apart from it: {'; '.join(rivals)}." if rivals else ""
    explained = f"explains {100.0 * law.share:.1f} % of what the model left above noise"
    fell = f"the error of {found.worst} fell from {before:.2f} to {after:.2f} floors on what no fit has seen"
    about = (
        f"Found in the data of {found.campaign}: it {explained}; {fell}.{tied}",
        "It is a law of the data. No mechanism is claimed.",
    )
    port, component, hook = _hook(law)
    return WrittenEffect(
        name=name,
        title=f"Law of {found.campaign}: {'friction' if port != 'buffer' else 'a force'} that goes with {law.driver}.",
        equation=law.equation,
        about=about,
        valid=f"{ranges}: the range of the data.",
        source=f"{found.campaign}, {date}, Slipwise {slipwise.__version__}; share explained {law.share:.3f}.",
        port=port,
        component=component,
        hooks=(hook,),
        parameters=tuple(_parameter(c, law) for c in law.constants) + _rated(law),
        signature=f"goes with {law.driver}",
        confused_with={},
    )


def _parameter(c: LawConstant, law: Law) -> Parameter:
    size = abs(c.value) or 1.0
    interval = f"95 %: {c.low:.4g} to {c.high:.4g}" if c.low == c.low else "a choice"
    if c.name == STRENGTH:
        return Parameter(c.name, c.unit, c.value, -_STRONGEST * size, _STRONGEST * size, 0.0, interval, "of the law")
    words = "at which the strength is told" if "reference" in c.name else "of the form"
    kind = TIME_CONSTANT if c.name == TIME_CONSTANT else constants_of(law.fitted.law.match.forms)[c.name].kind
    if kind in ("place", "number"):
        low, high = c.value - _ROOM * size, c.value + _ROOM * size
    else:
        low, high = c.value / _ROOM, c.value * _ROOM
    if c.name == TIME_CONSTANT:
        words = "of the lag"
    return Parameter(c.name, c.unit, c.value, low, high, None, interval, words)


def _rated(law: Law) -> tuple[Parameter, ...]:
    """Give the mean load where a force goes with it, which is stated and not fitted."""
    if law.port != "adds to friction":
        return ()
    load = law.fitted.rated_load
    return (Parameter("rated", "N", load, load / _ROOM, load * _ROOM, None, "mean load of the campaign", "N_0", "kN"),)


def _hook(law: Law) -> tuple[str, str, WrittenHook]:
    """Give port, component and hook of a law."""
    buffers = law.port in ("buffer", "multiplies buffers") or (law.port == "girder" and law.states != ("speed",))
    lines, arguments = _form_lines(law, buffers=buffers)
    own = [c.name for c in law.constants if c.name != TIME_CONSTANT]
    if set(law.states) & LAGGING:
        own.append(TIME_CONSTANT)
    form = "strength * form"
    if law.port in ("adds to mu", "multiplies mu", "adds to friction"):
        gate, more = _gate_lines(law, "coefficient")
        last = {
            "adds to mu": f"return coefficient + {form}",
            "multiplies mu": f"return coefficient * (1.0 + {form})",
            "adds to friction": f"return coefficient + {form} * rated / load",
        }[law.port]
        rated = ["load", "rated"] if law.port == "adds to friction" else []
        names = _once(["coefficient", *more, *arguments, *rated, *own])
        words = "Change the coefficient of friction [1]"
        return "shear", "pad friction", WrittenHook("coefficient", names, words, (*gate, *lines, last))
    if law.port == "even force on pads":
        gate, more = _gate_lines(law, "0.0, 0.0")
        names = _once([*more, "load", *arguments, *own])
        last = f"return {form} * load, 0.0"
        return "pad", "pad friction", WrittenHook("pad", names, "Push along x [N]", (*gate, *lines, last))
    if not buffers:
        lines = ["speed = max(sqrt(velocity_x * velocity_x + velocity_y * velocity_y), 1e-12)", *lines]
        last = f"return {form} * velocity_x / speed, {form} * velocity_y / speed"
        names = _once(["velocity_x", "velocity_y", *own])
        return "girder", "girder", WrittenHook("drag", names, "Hold the girder back [N]", (*lines, last))
    share = f"{form} / {law.fitted.buffers}"
    last, more = {
        "girder": (f"return force + copysign({share}, rate)", ["rate"]),
        "buffer": (f"return force + copysign({share}, deflection)", ["deflection"]),
        "multiplies buffers": (f"return force + {form} * stiffness * deflection", ["stiffness", "deflection"]),
    }[law.port]
    if law.port != "multiplies buffers":
        last = last.replace(f"copysign({share}, ", f"{share} * copysign(1.0, ")
    names = _once(["force", *more, *arguments, *own])
    return "buffer", "buffer", WrittenHook("spring", names, "Change the force of a buffer [N]", (*lines, last))


def _form_lines(law: Law, *, buffers: bool) -> tuple[list[str], list[str]]:
    """Give the lines that make `form`, and the arguments that they need."""
    lines: list[str] = []
    arguments: list[str] = []
    for place, (form, state) in enumerate(zip(law.fitted.law.match.forms, law.states, strict=True)):
        value = (_OF_BUFFERS if buffers else _OF_PADS).get(state, state)
        arguments += re.findall(r"\b(?:deflection|rate)\b", value) if buffers and state in _OF_BUFFERS else [value]
        if buffers and state in _OF_BUFFERS or value != state:
            lines.append(f"{state} = {value}")
        text = re.sub(r"[A-Za-z_]\w*", lambda m, i=place, s=state: _renamed(m.group(0), i, s), form.value)
        lines.append(f"form = {text}" if place == 0 else f"form = form * ({text})")
    if law.port == "girder" and law.states == ("speed",):
        arguments = []
    return lines, arguments


def _renamed(word: str, place: int, state: str) -> str:
    if word == "s":
        return state
    return word if word in FUNCTIONS or place == 0 else f"second_{word}"


def _gate_lines(law: Law, unchanged: str) -> tuple[list[str], list[str]]:
    """Give the lines by which a hook leaves other pads, or the other way, as they are, and what they ask for."""
    gate = law.fitted.law.match.candidate.gate
    lines, names = [], []
    for name, sign in (("side_x", gate.side_x), ("side_y", gate.side_y), ("velocity_x", gate.way)):
        if sign:
            lines += [f"if {name} {'<=' if sign > 0 else '>='} 0.0:", f"    return {unchanged}"]
            names.append(name)
    return lines, names


def _once(names: Sequence[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))
