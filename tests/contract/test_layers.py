"""A file imports only what stands before it: between packages, between the files of a package, and from no pictures."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "src" / "slipwise"
#: Package or file -> what it may import, from the inside out. Nothing else is allowed.
ARROWS: dict[str, str] = {
    "errors": "",
    "text_encoding": "",
    "cache": "errors",
    "one_at_a_time": "",
    "input_file": "errors",
    "whole_file": "errors",
    "machine_code": "cache one_at_a_time whole_file",
    "units": "cache errors whole_file",
    "params": "errors units",
    "channels": "errors",
    "child_processes": "",
    "interruption": "child_processes",
    "standard_streams": "",
    "parallel": "errors interruption",
    "worker_processes": "errors interruption parallel",
    "finished_jobs": "errors input_file whole_file",
    "executors": "errors finished_jobs worker_processes",
    "shown": "errors",
    "signals": "errors machine_code",
    "statistics": "",
    "record": "channels errors input_file shown units whole_file",
    "data_files": "channels child_processes errors input_file text_encoding units",
    "motion": "channels data_files errors input_file shown signals text_encoding units",
    "rig": "channels errors input_file record units",
    "effects": "channels errors input_file machine_code params record rig shown signals",
    "unused_values": "effects errors rig",
    "model": "channels effects errors params rig shown unused_values",
    "model_entry": "effects errors model params units",
    "model_file": "effects errors input_file model model_entry params record rig units unused_values",
    "simulation": "channels effects errors machine_code model model_file motion record rig shown whole_file",
    "campaign": "channels data_files errors input_file record rig shown signals text_encoding units",
    "instruments": "campaign channels effects errors parallel record rig shown signals statistics units",
    "estimation": (
        "campaign channels effects errors instruments machine_code model parallel params record rig signals statistics"
        " simulation"
    ),
    "evidence": "campaign channels errors estimation record rig signals statistics",
    "comparison": (
        "campaign channels effects errors estimation evidence instruments model model_file motion parallel record"
        " rig shown signals statistics simulation"
    ),
    "diagnosis": (
        "campaign channels comparison effects errors estimation evidence instruments model model_file"
        " parallel params record rig shown signals simulation units"
    ),
    "discovery": (
        "campaign diagnosis effects errors estimation evidence model parallel params record rig shown signals"
        " simulation"
    ),
    "experiment": (
        "campaign comparison diagnosis discovery effects errors estimation evidence model motion parallel record shown"
        " signals simulation units"
    ),
    "studies": (
        "campaign channels diagnosis effects errors estimation executors finished_jobs model motion record rig"
        " signals simulation units"
    ),
    "session": (
        "cache campaign channels comparison diagnosis discovery effects errors estimation instruments model model_file"
        " parallel record rig shown simulation units whole_file"
    ),
    "view": (
        "cache channels child_processes comparison diagnosis discovery effects errors estimation evidence experiment"
        " instruments parallel params record rig signals studies units whole_file"
    ),
    "workbench": (
        "campaign channels comparison diagnosis discovery effects errors estimation experiment instruments"
        " interruption model parallel session units view whole_file"
    ),
    "cli": "errors interruption view",
    "__main__": "cli interruption standard_streams",
}
#: Results draw themselves when they are asked to: the only way from numbers to pictures, and never at import.
MAY_DRAW = frozenset({"__init__.py", "shown.py"})
#: No file is longer.
LONGEST = 300
FILES = sorted(PACKAGE.rglob("*.py"))


def part_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imports(path: Path, *, everywhere: bool) -> list[str]:
    """Modules of slipwise that a file imports, at its top or also inside its functions."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    nodes = ast.walk(tree) if everywhere else tree.body
    out = []
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "slipwise":
            names = [f"{node.module}.{a.name}" for a in node.names]
            out += [name if _is_module(name) else node.module for name in names]
        elif isinstance(node, ast.Import):
            out += [a.name for a in node.names if a.name.startswith("slipwise.")]
    return out


def _is_module(name: str) -> bool:
    place = PACKAGE.joinpath(*name.split(".")[1:])
    return place.with_suffix(".py").exists() or (place / "__init__.py").exists()


def circles(arrows: dict[str, set[str]]) -> list[list[str]]:
    """Names that lead back to themselves, each as the way that does."""
    done: set[str] = set()
    found: list[list[str]] = []

    def walk(name: str, way: list[str]) -> None:
        if name in way:
            found.append([*way[way.index(name) :], name])
        elif name not in done:
            for other in sorted(arrows.get(name, ())):
                walk(other, [*way, name])
            done.add(name)

    for name in sorted(arrows):
        walk(name, [])
    return found


def test_every_package_has_its_place():
    assert {part_of(path) for path in FILES} - {"__init__"} == set(ARROWS)


def test_no_package_leads_back_to_itself():
    assert not circles({name: set(others.split()) for name, others in ARROWS.items()})


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_a_file_imports_only_what_its_package_may(path):
    part = part_of(path)
    if path.name in MAY_DRAW and path.parent == PACKAGE:
        return
    others = {name.split(".")[1] for name in imports(path, everywhere=True)} - {part}
    assert others <= set(ARROWS[part].split())


@pytest.mark.parametrize("package", sorted(p.name for p in PACKAGE.iterdir() if (p / "__init__.py").exists()))
def test_no_file_of_a_package_leads_back_to_itself(package):
    arrows: dict[str, set[str]] = {}
    for path in sorted((PACKAGE / package).rglob("*.py")):
        own = "slipwise." + ".".join(path.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__")
        arrows[own] = set(imports(path, everywhere=False))
    assert not circles(arrows)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_a_file_holds_one_idea(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST


def test_numerics_pull_in_neither_matplotlib_nor_rerun():
    numerics = [name for name in ARROWS if name not in ("view", "workbench", "cli")]
    modules = [".".join(("slipwise", *p.relative_to(PACKAGE).with_suffix("").parts)) for p in FILES]
    wanted = sorted(m for m in modules if m.split(".")[1] in numerics and not m.endswith("__init__"))
    code = "\n".join(f"import {name}" for name in wanted)
    code += "\nimport sys\nprint([m for m in ('matplotlib', 'rerun', 'typer') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_processes_are_started_by_no_file_that_does_not_keep_the_current_folder_off_their_path():
    starts = re.compile(r"\b(subprocess\.\w+|ProcessPoolExecutor|\.Process|os\.(spawn|exec|popen|system)\w*)\(")
    # -P is the same switch for one command
    safe = ("with on_a_safe_path()", "with unheard_by_children()", '[sys.executable, "-P", ')
    texts = {path: path.read_text(encoding="utf-8") for path in FILES}
    starting = {path for path, text in texts.items() if starts.search(text)}
    assert starting
    assert not [path for path in starting if not any(words in texts[path] for words in safe)]


def test_compiled_code_is_kept_by_one_file_only():
    texts = {path: path.read_text(encoding="utf-8") for path in FILES}
    assert not [path for path, text in texts.items() if "cache=True" in text]
    assert [path.name for path, text in texts.items() if "pickle.loads" in text] == ["machine_code.py", "parallel.py"]
