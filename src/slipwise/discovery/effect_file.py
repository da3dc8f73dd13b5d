"""A law as an effect file: read, edited and added by its user like any effect of the catalogue."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import slipwise
from slipwise.discovery.form import FUNCTIONS
from slipwise.discovery.law import Law, LawConstant, Origin, with_names
from slipwise.discovery.law_objective import STRENGTH, TIME_CONSTANT
from slipwise.discovery.matching import constants_of
from slipwise.effects import LAGGING, WrittenEffect, WrittenHook, write_effect
from slipwise.params import Parameter
from slipwise.residual_map.states import UNITS

#: State -> argument of a pad's hook; others are called alike. Of a buffer, rate and deflection stand for both.
_OF_PADS = {"slip": "slip_x"}
_OF_BUFFERS = {"slip": "deflection", "speed": "abs(rate)"}
#: States that a force at the centre of the girder knows.
_OF_GIRDER = {"speed", "slip"}
#: What whole arrays take in the place of what a form may call.
_OF_ARRAYS = {"abs": "np.abs", "max": "np.maximum", "min": "np.minimum", "pi": "np.pi"}
#: What a further fit may make of a number: this many times its value [1].
_ROOM = 10.0
#: A strength is looked for up to this many times its value [1].
_STRONGEST = 10.0


def can_be_written(law: Law) -> bool:
    """Return whether an effect can be a law: a force that lifts the girder knows its speed and place only."""
    return law.port != "load" or set(law.states) <= _OF_GIRDER


def write_law(law: Law, origin: Origin, folder: Path, name: str, date: str, *, replace: bool = False) -> Path:
    """Write a law's effect file, FOLDER/NAME.py.

    Args:
        law: of the discovery.
        origin: where it comes from.
        folder: is made where it is not there.
        name: of the effect.
        date: of the discovery, as text.
        replace: write over a file of that name.

    Raises:
        SettingError: the name cannot be that of an effect, or the file is there already.
    """
    return write_effect(written_law(law, origin, name, date), folder, replace=replace)


def written_law(law: Law, origin: Origin, name: str, date: str) -> WrittenEffect:
    """Return a law as an effect to be written; arguments as `write_law`."""
    ranges = ", ".join(f"{s} {low:.3g} to {high:.3g} {UNITS.get(s, 'm')}" for s, (low, high) in law.valid.items())
    rivals = [f"form {f}" for f in law.tied] + list(law.rivals)
    tied = f" Cannot be told apart from it: {'; '.join(rivals)}." if rivals else ""
    explained = f"explains {100.0 * law.share:.1f} % of what the model left above noise"
    errors = f"from {origin.before:.2f} to {origin.after:.2f} floors on what no fit has seen"
    fell = f"the error of {origin.relation} fell {errors}"
    beside = f" beside {', '.join(origin.beside)}" if origin.beside else ""
    about = (
        f"Found in the data of {origin.campaign}{beside}: it {explained}; {fell}.{tied}",
        "It is a law of the data. No mechanism is claimed.",
    )
    port, component, hooks = _hooks(law)
    if port == "buffer" and not law.at_buffers and law.port != "multiplies buffers":
        about = (
            *about,
            "The data put the force at the girder's centre. Here the buffers carry it: only pitch differs.",
        )
    subject = "a force" if port in ("buffer", "girder") else "friction"
    return WrittenEffect(
        name=name,
        title=f"Law of {origin.campaign}: {subject} that goes with {law.driver}.",
        equation=law.equation,
        about=about,
        valid=f"{ranges}: the range of the data.",
        source=f"{origin.campaign}, {date}, Slipwise {slipwise.__version__}; share explained {law.share:.3f}.",
        port=port,
        component=component,
        hooks=hooks,
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
    """Return the mean load where a force goes with it, which is stated and not fitted."""
    if law.port != "adds to friction":
        return ()
    load = law.fitted.rated_load
    return (Parameter("rated", "N", load, load / _ROOM, load * _ROOM, None, "mean load of the campaign", "N_0", "kN"),)


def _at_centre(law: Law) -> bool:
    """Return whether a law is a force at the girder's centre that an effect of the girder can be."""
    return law.port in ("girder", "girder by place") and not law.at_buffers and set(law.states) <= _OF_GIRDER


def _hooks(law: Law) -> tuple[str, str, tuple[WrittenHook, ...]]:
    """Return port, component and hooks of a law."""
    own = [c.name for c in law.constants if c.name != TIME_CONSTANT or set(law.states) & LAGGING]
    if law.port == "load" or _at_centre(law):
        return _on_girder(law, own)
    if law.port in ("girder", "girder by place", "multiplies buffers"):
        return "buffer", "buffer", (_at_buffers(law, own),)
    if law.port == "even force on pads":
        gate, more = _gate_lines(law, "0.0, 0.0")
        lines, arguments = _form_lines(law, _OF_PADS)
        last = "return strength * form * load, 0.0"
        names = _once([*more, "load", *arguments, *own])
        return "pad", "pad friction", (WrittenHook("pad", names, "Push along x [N]", (*gate, *lines, last)),)
    gate, more = _gate_lines(law, "coefficient")
    lines, arguments = _form_lines(law, _OF_PADS)
    last = {
        "adds to mu": "return coefficient + strength * form",
        "multiplies mu": "return coefficient * (1.0 + strength * form)",
        "adds to friction": "return coefficient + strength * form * rated / load",
    }[law.port]
    rated = ["load", "rated"] if law.port == "adds to friction" else []
    names = _once(["coefficient", *more, *arguments, *rated, *own])
    words = "Change the coefficient of friction [1]"
    return "shear", "pad friction", (WrittenHook("coefficient", names, words, (*gate, *lines, last)),)


def _at_buffers(law: Law, own: Sequence[str]) -> WrittenHook:
    """Return the hook of a force on the girder at its buffers, which share it."""
    lines, arguments = _form_lines(law, _OF_BUFFERS)
    if law.port == "multiplies buffers":
        more, last = ["stiffness", "deflection"], "return force + strength * form * stiffness * deflection"
    elif law.port == "girder":
        more, last = ["rate"], f"return force + strength * form / {law.fitted.buffers} * copysign(1.0, rate)"
    else:
        more, last = [], f"return force + strength * form / {law.fitted.buffers}"
    names = _once(["force", *more, *arguments, *own])
    return WrittenHook("spring", names, "Change the force of a buffer [N]", (*lines, last))


def _on_girder(law: Law, own: Sequence[str]) -> tuple[str, str, tuple[WrittenHook, ...]]:
    """Return port, component and hooks of a force at the middle of the girder: in a simulation, and in the balances."""
    speed, speeds = "sqrt(velocity_x * velocity_x + velocity_y * velocity_y)", "np.hypot(*states.velocity.T)"
    scalar, _ = _form_lines(law, {"speed": speed, "slip": "slip_x"})
    arrays, _ = _form_lines(law, {"speed": speeds, "slip": "states.slip[:, 0]"}, arrays=True)
    asked = ["velocity_x", "velocity_y"] if law.port == "girder" or "speed" in law.states else []
    asked += ["slip_x"] if "slip" in law.states else []
    names, of_runs = _once([*asked, *own]), _once(["states", *own])
    if law.port == "load":
        lift = WrittenHook("lift", names, "Lift the girder [N]", (*scalar, "return strength * form"))
        less = (*arrays, 'return {"heave": -strength * form}')
        return (
            "girder",
            "pad load",
            (lift, WrittenHook("balance", of_runs, "Give what the pads carry more (n,) [N]", less)),
        )
    last, force = "return strength * form, 0.0", 'return {"girder": strength * form}'
    if law.port == "girder":
        if "speed" not in law.states:
            scalar, arrays = [*scalar, f"speed = {speed}"], [*arrays, f"speed = {speeds}"]
        scalar = [*scalar, "size = strength * form / max(speed, 1e-12)"]
        last = "return size * velocity_x, size * velocity_y"
        force = 'return {"girder": strength * form * states.velocity[:, 0] / np.maximum(speed, 1e-12)}'
    drag = WrittenHook("drag", names, "Hold the girder back [N]", (*scalar, last))
    balance = WrittenHook("balance", of_runs, "Give the force (n,) [N]", (*arrays, force))
    return "girder", "girder", (drag, balance)


def _form_lines(law: Law, names: Mapping[str, str], *, arrays: bool = False) -> tuple[list[str], list[str]]:
    """Return the lines that make `form`, and the arguments that they need.

    Args:
        law: whose form.
        names: state -> how the hook knows it, where that is not its name.
        arrays: whether it acts on whole arrays.
    """
    lines: list[str] = []
    arguments: list[str] = []
    for place, (form, state) in enumerate(zip(law.fitted.law.match.forms, law.states, strict=True)):
        value = names.get(state, state)
        arguments += [value] if value.isidentifier() else re.findall(r"\b(?:deflection|rate)\b", value)
        lines += [f"{state} = {value}"] if value != state else []
        text = with_names(form.value, state, place)
        if arrays:
            text = re.sub(r"[A-Za-z_]\w*", lambda m: _of_array(m.group(0)), text)
        lines.append(f"form = {text}" if place == 0 else f"form = form * ({text})")
    return lines, arguments


def _of_array(word: str) -> str:
    return _OF_ARRAYS.get(word, f"np.{word}") if word in FUNCTIONS else word


def _gate_lines(law: Law, unchanged: str) -> tuple[list[str], list[str]]:
    """Return the lines by which a hook leaves other pads, or the other way, as they are, and what they ask for."""
    gate = law.fitted.law.match.candidate.gate
    lines, names = [], []
    for name, sign in (("side_x", gate.side_x), ("side_y", gate.side_y), ("velocity_x", gate.way)):
        if sign:
            lines += [f"if {name} {'<=' if sign > 0 else '>='} 0.0:", f"    return {unchanged}"]
            names.append(name)
    return lines, names


def _once(names: Sequence[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))
