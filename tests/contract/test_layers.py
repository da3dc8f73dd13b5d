"""A file imports only what stands above it, and numerics never see pictures."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "src" / "slipwise"
LAYERS: tuple[tuple[str, ...], ...] = (
    ("errors", "units", "params", "channels", "cores"),
    ("signals", "motion", "record"),
    ("rig",),
    ("effects",),
    ("model", "model_file"),
    ("kernel", "predict", "replay", "loops", "loads", "pier", "demonstration"),
    ("campaign", "audit", "floor", "system", "compare", "fit"),
    ("diagnose", "ladder", "next_motions", "next_test", "paper", "demo"),
    ("view",),
    ("cli",),
)
#: Within a layer the order in which files may see each other.
WITHIN = {
    "errors": 0, "units": 1, "params": 1, "channels": 1, "cores": 1,
    "signals": 1, "record": 0, "motion": 1,
    "kernel": 0, "predict": 1, "replay": 2, "loops": 0, "loads": 0, "pier": 0, "demonstration": 2,
    "campaign": 0, "audit": 1, "floor": 1, "system": 1, "fit": 2, "compare": 3,
}  # fmt: skip
FILES = sorted(PACKAGE.rglob("*.py"))


def place(part: str) -> int:
    found = [i for i, names in enumerate(LAYERS) if part in names]
    assert found, f"{part} has no layer; give it one in {Path(__file__).name}"
    return found[0]


def imported(path: Path) -> set[str]:
    """Parts of slipwise that a file imports at its top."""
    out = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        names = []
        if isinstance(node, ast.ImportFrom) and node.module:
            names = [node.module] if node.module != "slipwise" else [f"slipwise.{a.name}" for a in node.names]
        elif isinstance(node, ast.Import):
            names = [a.name for a in node.names]
        out |= {name.split(".")[1] for name in names if name.startswith("slipwise.")}
    return out


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_a_file_imports_only_what_stands_above_it(path):
    part = path.relative_to(PACKAGE).parts[0].removesuffix(".py")
    if part == "__init__":
        return
    own = place(part)
    for other in imported(path) - {part}:
        assert place(other) <= own, f"{path.name} (layer {own}) imports {other} (layer {place(other)})"
        if place(other) == own and part in WITHIN and other in WITHIN:
            assert WITHIN[other] <= WITHIN[part], f"{path.name} imports {other}, which stands below it"


def test_numerics_pull_in_neither_matplotlib_nor_rerun():
    numerics = sorted(
        name for names in LAYERS[:7] for name in names if (PACKAGE / name).exists() or (PACKAGE / f"{name}.py").exists()
    )
    code = ";".join(f"import slipwise.{name}" for name in numerics)
    code += ";import sys;print([m for m in ('matplotlib','rerun','typer') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
