"""The catalogue: finds every effect there is, in this folder, in packages that offer some, and in users' files."""

import hashlib
import importlib
import importlib.util
import pkgutil
import sys
from collections.abc import Collection
from functools import cache
from importlib.machinery import SourceFileLoader
from importlib.metadata import entry_points
from pathlib import Path

from slipwise.effects._contract_check import line_of
from slipwise.effects._effect import Effect
from slipwise.effects._read import read_effect
from slipwise.errors import InputError, SettingError, SlipwiseError, unknown_name
from slipwise.input_file import read_input

#: Packages offer effects by an entry point of this group whose value is a module.
ENTRY_POINT_GROUP = "slipwise.effects"
#: For who left something out.
_PARAMETER = "Parameter takes name, unit, typical, low, high, neutral, source and meaning"


@cache
def catalogue() -> dict[str, Effect]:
    """Read every effect of this folder and of installed packages, by name in alphabetical order.

    Raises:
        SettingError: a file breaks the contract, or two effects share a name.
        UnknownNameError: an effect names another that does not exist.
    """
    found: dict[str, Effect] = {}
    folder = Path(__file__).parent
    for entry in pkgutil.iter_modules([str(folder)]):
        if not entry.name.startswith("_"):
            module = importlib.import_module(f"slipwise.effects.{entry.name}")
            found[entry.name] = read_effect(module, folder / f"{entry.name}.py")
    for point in entry_points(group=ENTRY_POINT_GROUP):
        module = point.load()
        effect = read_effect(module, Path(str(module.__file__)))
        if effect.name in found:
            raise SettingError(
                f"package {point.value!r} offers an effect {effect.name!r}, which exists already; rename its file"
            )
        found[effect.name] = effect
    for effect in found.values():
        _check_others(effect, found)
    return dict(sorted(found.items()))


def _check_others(effect: Effect, known: Collection[str]) -> None:
    """Refuse names of other effects that do not exist: neither known, nor a file beside this one.

    Raises:
        UnknownNameError: with the names that exist.
    """
    for place, names in (
        ("confused_with", effect.confused_with),
        ("same_unless", effect.same_unless),
        ("plainer", (effect.plainer,) if effect.plainer else ()),
    ):
        for name in names:
            if name not in known and not effect.path.with_name(f"{name}.py").is_file():
                raise unknown_name(f"effect (in {place!r} of {effect.path.name})", name, known)


def base_effects(role: str) -> tuple[Effect, ...]:
    """Return the effects with a role in the base model: "law", "springs" or "stick".

    Args:
        role: "law", "springs" or "stick".
    """
    return tuple(e for e in catalogue().values() if e.base == role)


def load_effect(path: Path | str) -> Effect:
    """Read a user's effect file.

    Args:
        path: of the file ("./mine.py").

    Raises:
        InputError: no such file, or Python cannot import it.
        SettingError: it breaks the contract.
        UnknownNameError: it names something that does not exist, such as a port or another effect.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(f"{path}: no such effect file")
    place = hashlib.sha256(str(path.resolve()).encode()).hexdigest()[:8]
    name = f"slipwise_user_effect_{path.stem}_{place}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"{path}: an effect is a Python file (.py)")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        # Not `exec_module`: that runs what lies in a __pycache__ beside the file, which nobody can look at first.
        exec(SourceFileLoader(name, str(path)).source_to_code(read_input(path), str(path)), vars(module))
    except SlipwiseError as error:
        del sys.modules[name]
        raise type(error)(f"{path.name}: {error}") from None
    except Exception as error:
        del sys.modules[name]
        raise InputError(_not_imported(path, error)) from error
    effect = read_effect(module, path.resolve())
    if effect.name in catalogue():
        raise SettingError(f"{path}: an effect called {effect.name!r} exists already; rename the file")
    _check_others(effect, catalogue())
    return effect


def _not_imported(path: Path, error: Exception) -> str:
    """Say why Python cannot import a file, where, and what to do."""
    if isinstance(error, SyntaxError):
        return (
            f"{path.name} cannot be imported: {error.msg} in line {error.lineno}: {(error.text or '').strip()!r}; mend "
            "that line, or the one before it"
        )
    what = _PARAMETER if str(error).startswith("Parameter.") else f"{type(error).__name__}: {error}"
    return f"{path.name} cannot be imported: {what}; mend{line_of(error, path) or ' it'}"


def find_effect(name: str) -> Effect:
    """Look an effect up: of the catalogue by its name, a user's own by the path of its file ("./mine.py").

    Args:
        name: of the catalogue ("run_in"), or the path of a file ("./mine.py").

    Raises:
        UnknownNameError: no such effect.
        InputError: no such file, or Python cannot import it.
        SettingError: the file breaks the contract.
    """
    if name.endswith(".py"):
        return load_effect(name)
    known = catalogue()
    if name not in known:
        raise unknown_name("effect", name, known, "`slipwise effects` lists them; your own is given as ./mine.py.")
    return known[name]
