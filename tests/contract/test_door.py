"""`import slipwise` costs nothing, and the command line goes through it."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import slipwise as sw

COMMANDS = sorted((Path(__file__).parents[2] / "src" / "slipwise" / "cli").glob("*.py"))
HEAVY = ("mujoco", "numba", "matplotlib", "scipy", "numpy", "pint", "pyarrow", "rerun")
#: What a command may use: the door, pictures and pages of finished results, errors, what a signal does, and other files
#: of the package.
OPEN = ("slipwise.view", "slipwise.errors", "slipwise.jobs.interruption", "slipwise.cli")


def loaded_by(code: str) -> list[str]:
    show = f"import sys; print([name for name in {HEAVY} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", f"{code}\n{show}"], capture_output=True, text=True, check=True)
    return ast.literal_eval(done.stdout.splitlines()[-1])


def test_the_import_loads_nothing_heavy():
    assert loaded_by("import slipwise; dir(slipwise); slipwise.__version__") == []


@pytest.mark.parametrize("option", ["--help", "--version"])
def test_help_and_version_load_nothing_heavy(option):
    code = f"""
import sys
from slipwise.cli import main
sys.argv = ["slipwise", {option!r}]
try:
    main()
except SystemExit as ended:
    assert ended.code == 0
"""
    assert loaded_by(code) == []


@pytest.mark.parametrize("path", COMMANDS, ids=lambda path: path.stem)
def test_a_command_calls_only_the_door(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            ours = [a for a in node.names if a.name.split(".")[0] == "slipwise"]
            assert all((a.name, a.asname) == ("slipwise", "sw") for a in ours), f"{path.name} imports {ours[0].name}"
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "slipwise":
            assert str(node.module).startswith(OPEN), f"{path.name} imports {node.module}"
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "sw":
            assert node.attr in sw.__all__, f"{path.name} uses sw.{node.attr}, which the door does not give"
