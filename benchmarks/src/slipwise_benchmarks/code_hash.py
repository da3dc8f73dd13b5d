"""A hash of the code that something is made by: of modules and of all that they import of the bench or of the library.

Only imports at the top of a file count: what is imported in a function is for people to look at.
"""

import ast
import hashlib
from functools import cache
from importlib.util import find_spec
from pathlib import Path


def code_hash(modules: tuple[str, ...], packages: tuple[str, ...]) -> str:
    """Give a hash of the text of these modules and of all that they import of these packages.

    Args:
        modules: e.g. "slipwise_benchmarks.dirty".
        packages: "slipwise_benchmarks", "slipwise" or both.
    """
    text = b"".join(path.name.encode() + path.read_bytes() for path in reached(modules, packages))
    return hashlib.sha256(text).hexdigest()[:16]


def reached(modules: tuple[str, ...], packages: tuple[str, ...]) -> list[Path]:
    """Give the files that modules import, and theirs, of these packages."""
    seen: set[Path] = set()
    left = [file for module in modules for file in _files(module, packages)]
    while left:
        path = left.pop()
        if path not in seen:
            seen.add(path)
            left += [file for name in _imports(path) for file in _files(name, packages)]
    return sorted(seen)


def _files(module: str, packages: tuple[str, ...]) -> list[Path]:
    """Give the files of a module, or of all in a package, for a catalogue reads its folder."""
    first, *rest = module.split(".")
    if first not in packages or not rest:  # the names that a package's door lists are no part of anything
        return []
    place = _home(first).joinpath(*rest)
    if place.is_dir():
        return sorted(place.glob("*.py"))
    file = place.with_suffix(".py")
    return [file] if file.exists() else []


@cache
def _home(package: str) -> Path:
    """Give the folder of a package, which is not imported."""
    spec = find_spec(package)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(f"{package} is not installed, and `--maker replay` needs it; take `--maker ode`")
    return Path(spec.origin).parent


@cache
def _imports(path: Path) -> tuple[str, ...]:
    """Give the names of modules that a file imports at its top."""
    found: list[str] = []
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            found += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return tuple(found)
