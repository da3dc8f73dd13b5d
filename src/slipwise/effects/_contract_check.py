"""What a hook answers is looked at before a simulation runs on it: once when its file is read, or at each call."""

import dis
import inspect
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.effects._effect import Effect
from slipwise.errors import SettingError
from slipwise.record import Record
from slipwise.rig import Specimen

#: Hooks whose answer is not one number -> its kind, in words.
_ONE, _TWO = "one number: `return ...`", "two numbers: `return force_x, force_y`"
_NOTHING = "nothing: it changes memory[...]"
_ANSWERS: dict[str, str] = {
    **dict.fromkeys(("stick", "pad", "drag"), _TWO),
    "advance": _NOTHING,
    "rest": _NOTHING,
}
#: Hooks of whole arrays -> kind of their answer.
_KINDS: dict[str, type] = {
    "rig": Specimen, "table": np.ndarray, "gauge": Record, "undo": Record, "sharpen": Record, "balance": Mapping,
    "flat": Mapping, "disturb": Iterable,
}  # fmt: skip
#: What a hook is tried at where none of its own numbers is meant: a state that any law should bear [SI].
_STATE: dict[str, float] = {
    "load": 24.5e3, "pressure": 15e6, "true_pressure": 20e6, "apparent_area": 1.6e-3, "real_area": 1.2e-3,
    "shear": 2e6, "coefficient": 0.1, "bound": 2.5e3, "friction": 2e3, "speed": 0.1, "velocity_x": 0.08,
    "velocity_y": 0.06, "slip_x": 0.01, "slip_y": 0.005, "deflection": 0.01, "rate": 0.1, "stiffness": 1e6,
    "force": 1e3, "face": 0.0, "time": 1.0, "dt": 5e-4,
}  # fmt: skip


def try_instant(path: Path, effect: Effect, hook: str, function: Callable[..., Any]) -> None:
    """Call a hook of one instant once, and refuse what a simulation could not use.

    Raises:
        SettingError: it prints, uses a name that is not there, or answers something else than it should.
    """
    if any(i.opname.startswith("LOAD_GLOBAL") and i.argval == "print" for i in dis.get_instructions(function)):
        raise SettingError(
            f"{path.name}: {hook}() prints, which it would do at every step for every pad: take print out; "
            "`slipwise effects FILE --picture law.png` draws what the law does"
        )
    values = {**dict.fromkeys(inspect.signature(function).parameters, 1.0), **_STATE, **effect.typical()}
    given: dict[str, Any] = {name: values[name] for name in inspect.signature(function).parameters}
    if "memory" in given:
        given["memory"] = np.zeros(len(effect.memory))
    try:
        with np.errstate(all="ignore"):
            answer = function(**given)
    except (ArithmeticError, ValueError):
        return  # this state may be none that the law is made for
    except Exception as error:
        raise SettingError(
            f"{path.name}: {hook}() cannot be called: {type(error).__name__}: {error}; mend{line_of(error, path)}, ask "
            "for what it uses as an argument, or import it, as in `from math import exp`"
        ) from error
    wanted = _ANSWERS.get(hook, _ONE)
    numbers = answer if isinstance(answer, tuple) else () if answer is None else (answer,)
    count = {_TWO: 2, _NOTHING: 0}.get(wanted, 1)
    if len(numbers) != count or isinstance(answer, tuple) != (count == 2) or not all(map(_is_number, numbers)):
        raise SettingError(f"{path.name}: {hook}() returns {_shown(answer)}; it must return {wanted}")


def check_answer(path: Path, hook: str, answer: object) -> None:
    """Refuse an answer of a hook of whole arrays that is of another kind than it should be.

    Raises:
        SettingError: with what it must return.
    """
    kind = _KINDS.get(hook, object)
    if not isinstance(answer, kind):
        article = {np.ndarray: "an array", Mapping: "a dictionary", Iterable: "a list"}.get(kind, f"a {kind.__name__}")
        raise SettingError(f"{path.name}: {hook}() returns {_shown(answer)}; it must return {article}")


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | np.number) and not isinstance(value, complex)


def _shown(answer: object) -> str:
    if answer is None:
        return "nothing"
    if isinstance(answer, tuple):
        return f"{len(answer)} values"
    return f"a {type(answer).__name__}"


def line_of(error: Exception, path: Path) -> str:
    """Say in which line of a file an error arose, " line 12"; "" if it is not known."""
    at, line = error.__traceback__, 0
    while at is not None:
        if Path(at.tb_frame.f_code.co_filename).name == path.name:
            line = at.tb_lineno
        at = at.tb_next
    return f" line {line}" if line else ""
