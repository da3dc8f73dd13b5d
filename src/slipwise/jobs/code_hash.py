"""A hash of the code that decides a result: results of older code must not be taken for those of the present one."""

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import slipwise

_PACKAGE = Path(slipwise.__file__).parent


@cache
def hash_of_files(*patterns: str) -> str:
    """Return a hash of files of this package.

    Args:
        patterns: as `Path.glob` reads them, from the package's folder.
    """
    return _hash(path for pattern in patterns for path in _PACKAGE.glob(pattern))


@cache
def hash_of_imports(module: str, *found_by_name: str) -> str:
    """Return a hash of a module and of all of this package that it imports, directly or through others.

    The text of the files is read and nothing is imported: what is imported inside a function counts, what is imported
    for types alone does not. `slipwise/__init__.py` leads to everything by name and decides nothing.

    Args:
        module: its name, "slipwise.simulation.replay".
        found_by_name: patterns of files that are loaded by their names at run time, such as "effects/*.py"; what these
            import counts too.
    """
    left = [_file_of(module), *(path for pattern in found_by_name for path in _PACKAGE.glob(pattern))]
    seen: set[Path] = set()
    while left:
        path = left.pop()
        if path is not None and path not in seen:
            seen.add(path)
            left += map(_file_of, _imported(ast.parse(path.read_bytes())))
    return _hash(seen)


def _hash(paths: Iterable[Path]) -> str:
    """Return a hash of names and contents, in the order of the names."""
    digest = hashlib.sha256()
    for path in sorted(set(paths)):
        digest.update(path.relative_to(_PACKAGE).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def _imported(tree: ast.AST) -> Iterator[str]:
    """Yield the names of modules that are imported at run time, and of what is taken from them: it may be one too."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            continue
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from _with_packages(node.module)
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (name for alias in node.names for name in _with_packages(alias.name))
        else:
            yield from _imported(node)


def _with_packages(name: str) -> Iterator[str]:
    """Yield a module's name and those of the packages that are loaded before it."""
    parts = name.split(".")
    return (".".join(parts[:count]) for count in range(1, len(parts) + 1))


def _file_of(module: str) -> Path | None:
    """Return the file of a module of this package; None for another name."""
    package, *parts = module.split(".")
    if package != "slipwise" or not parts:
        return None
    path = _PACKAGE.joinpath(*parts)
    files = (path.with_suffix(".py"), path / "__init__.py")
    return next((file for file in files if file.is_file()), None)
