"""Kept results are known by the code that made them: a change of anything that they rest on, and of nothing else."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from slipwise.jobs import code_hash

PACKAGE = Path(code_hash.__file__).parents[1]


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A copy of the package whose files can be changed."""
    copy = tmp_path / "slipwise"
    shutil.copytree(PACKAGE, copy, ignore=lambda _, names: {n for n in names if "." in n and not n.endswith(".py")})
    monkeypatch.setattr(code_hash, "_PACKAGE", copy)
    code_hash.hash_of_imports.cache_clear()
    yield copy
    code_hash.hash_of_imports.cache_clear()


def changed(file: Path, module: str) -> bool:
    """Whether a change of a file changes the hash of a module."""

    def key() -> str:
        code_hash.hash_of_imports.cache_clear()
        return code_hash.hash_of_imports(module, "effects/*.py")

    before = key()
    file.write_text(file.read_text(encoding="utf-8") + "\n_CHANGED = True\n", encoding="utf-8")
    return key() != before


@pytest.mark.parametrize("module", ["slipwise.studies.ensemble.member", "slipwise.studies.paper.member"])
@pytest.mark.parametrize(
    ("file", "decides"),
    [
        ("signals/filters.py", True),
        ("record.py", True),
        ("channels.py", True),
        ("params.py", True),
        ("effects/heating.py", True),
        ("simulation/kernel/step.py", True),
        ("rig/__init__.py", True),
        ("view/figures/style.py", False),
        ("diagnosis/diagnose.py", False),
        ("cli/replay.py", False),
        ("__init__.py", False),
    ],
)
def test_a_replay_is_run_again_where_the_code_that_decides_it_has_changed(
    module: str, file: str, decides: bool, package: Path
) -> None:
    assert changed(package / file, module) is decides


def test_a_module_that_is_imported_inside_a_function_decides_too(package: Path) -> None:
    (package / "late.py").write_text("VALUE = 1\n")
    (package / "early.py").write_text("def value():\n    from slipwise.late import VALUE\n    return VALUE\n")
    assert changed(package / "late.py", "slipwise.early")


def test_what_is_imported_for_types_alone_decides_nothing(package: Path) -> None:
    (package / "late.py").write_text("class Kind: ...\n")
    (package / "early.py").write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from slipwise.late import Kind\n"
    )
    assert not changed(package / "late.py", "slipwise.early")


def test_files_are_known_by_name_and_content(package: Path) -> None:
    for name in ("one", "other"):
        (package / f"{name}.py").write_text("VALUE = 1\n")
    assert len({code_hash.hash_of_files(f"{names}.py") for names in ("one", "other", "o*")}) == 3
