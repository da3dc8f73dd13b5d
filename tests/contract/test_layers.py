"""A file imports only what stands before it: between packages, between all files, and numerics from no pictures."""

import ast
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "src" / "slipwise"
#: Package or file -> what it may import, from the inside out. Nothing else is allowed.
ARROWS: dict[str, str] = {
    "arrays": "",
    "errors": "",
    "short_repr": "",
    "regression": "arrays",
    "text_encoding": "",
    "channels": "errors",
    "display": "errors",
    "input_file": "errors",
    "jobs": "errors input_file",
    "signals": "arrays errors jobs",
    "units": "errors jobs",
    "data_files": "arrays channels errors input_file jobs text_encoding units",
    "params": "errors units",
    "record": "arrays channels display errors input_file jobs units",
    "motion": "arrays channels data_files display errors input_file signals text_encoding units",
    "noise": "arrays record signals",
    "rig": "arrays errors input_file record units",
    "campaign": "arrays channels data_files display errors input_file noise record rig signals units",
    "effects": "arrays channels display errors input_file jobs params record rig signals",
    "model": "channels display effects errors input_file params record rig units",
    "simulation": "arrays display effects errors jobs model motion record rig",
    "testing": "effects errors model record rig simulation units",
    "relations": (
        "arrays campaign channels effects errors jobs model noise params record regression rig signals simulation"
    ),
    "estimation": "arrays campaign effects errors jobs model noise regression relations rig",
    "evidence": "arrays estimation jobs noise relations rig",
    "residual_map": "arrays campaign effects estimation regression relations simulation",
    "preparation": "arrays campaign channels effects errors estimation jobs model record relations rig signals units",
    "instruments": (
        "arrays campaign channels display effects errors evidence noise preparation record regression relations rig"
        " signals"
    ),
    "comparison": (
        "arrays campaign channels display effects errors estimation instruments jobs model motion noise preparation"
        " record relations residual_map rig signals simulation"
    ),
    "export": "arrays campaign display effects errors model motion preparation record rig simulation",
    "bearings": ("arrays campaign display errors estimation jobs model preparation relations rig signals"),
    "selection": (
        "arrays campaign comparison effects errors estimation evidence jobs model motion params preparation relations"
        " rig simulation"
    ),
    "diagnosis": (
        "arrays campaign channels comparison display effects errors estimation evidence instruments jobs model noise"
        " preparation record regression relations residual_map rig selection simulation units"
    ),
    "specimens": "arrays diagnosis display errors estimation evidence jobs relations selection",
    "discovery": (
        "arrays campaign diagnosis display effects errors estimation evidence jobs model noise params preparation"
        " relations residual_map selection signals"
    ),
    "studies": (
        "arrays campaign channels diagnosis display effects errors estimation input_file jobs model motion record"
        " relations rig signals simulation units"
    ),
    "design": (
        "campaign comparison diagnosis discovery display effects errors estimation evidence jobs model motion"
        " preparation record relations selection signals simulation units"
    ),
    "planning": (
        "arrays campaign channels comparison display effects errors estimation evidence jobs model motion preparation"
        " record relations rig selection signals simulation"
    ),
    "monitoring": (
        "campaign comparison data_files design diagnosis effects errors instruments model preparation record"
    ),
    "prediction": (
        "arrays campaign comparison data_files diagnosis display effects errors estimation evidence jobs model noise"
        " params preparation record rig signals"
    ),
    "session": (
        "arrays campaign comparison diagnosis discovery display effects errors estimation jobs model preparation record"
        " relations rig selection simulation units"
    ),
    "view": (
        "arrays bearings channels comparison diagnosis discovery effects errors estimation export jobs monitoring noise"
        " params planning prediction record relations residual_map rig selection signals specimens studies units"
    ),
    "cli": "errors jobs view",
    "workbench": (
        "campaign channels comparison design diagnosis discovery effects errors jobs model noise preparation"
        " relations selection session units view"
    ),
    "__main__": "cli jobs",
}
#: What any file may import: what data show of themselves, whatever they are of.
EVERYWHERE = {"short_repr"}
#: Folder of the view -> what it may import of the others.
IN_VIEW = {"words": "", "figures": "words", "pages": "words figures", "recordings": "words figures"}
#: No file is longer, and one that is shorter has a second importer or a reason, in lines.
LONGEST, SHORTEST = 400, 40
#: Folders that are walked at run time, one effect, form, format or command a file.
WALKED = ("effects", "discovery/forms", "motion/formats", "cli")
#: Short files of one importer -> why they are files of their own.
REASONS = {
    "effects/_by_pad.py": "reached through the package",
    "effects/_prandtl.py": "compiled code, out of an effect's file, which is read as an example",
    "effects/_trust.py": "reached through the package",
    "regression/projection.py": "the projection that tests hold columns against",
    "jobs/stage_clock.py": "measures long work of any package",
    "simulation/kernel/prescribed_table.py": "a correction of MuJoCo's step, with its derivation",
    "simulation/kernel/rig_motion.py": "what laws are told of the rig, as campaign/rig_motion.py has it measured",
    "view/replay_files.py": "decides what is loaded: it loads nothing that draws until something is drawn",
    "workbench/folder_watch.py": "a task of its own, which runs beside the hub",
    "workbench/frames.py": "the binary format that the page reads",
}
FILES = sorted(PACKAGE.rglob("*.py"))
#: All but the door, which leads to everything by name.
INNER = [path for path in FILES if path != PACKAGE / "__init__.py"]


def part_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def allowed(path: Path) -> set[str]:
    return EVERYWHERE | set(ARROWS[part_of(path)].split())


@cache
def imports(path: Path) -> set[str]:
    """Modules of slipwise that a file imports, at its top, inside its functions and for its types."""
    out: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "slipwise":
            names = [f"{node.module}.{a.name}" for a in node.names]
            out |= {name if _is_module(name) else node.module for name in names}
        elif isinstance(node, ast.Import):
            out |= {a.name for a in node.names if a.name.startswith("slipwise.")}
    return out


def module_of(path: Path) -> str:
    return ".".join(("slipwise", *path.relative_to(PACKAGE).with_suffix("").parts)).removesuffix(".__init__")


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


def test_a_file_imports_only_what_its_package_may():
    others = {path: {name.split(".")[1] for name in imports(path)} - {part_of(path)} for path in INNER}
    assert not {path: more for path, found in others.items() if (more := found - allowed(path))}


def test_no_file_leads_back_to_itself_by_whatever_import():
    assert not circles({module_of(path): imports(path) for path in INNER})


def test_words_need_no_figure_and_figures_need_no_page():
    ahead = {}
    for path in PACKAGE.glob("view/*/*.py"):
        folders = {name.split(".")[2] for name in imports(path) if name.startswith("slipwise.view.")}
        ahead[path] = folders & set(IN_VIEW) - {path.parent.name, *IN_VIEW[path.parent.name].split()}
    assert ahead and not {path: folders for path, folders in ahead.items() if folders}


def test_a_file_is_no_longer_than_is_read_at_once():
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in FILES}
    assert not {path: lines for path, lines in lengths.items() if lines > LONGEST}


def test_a_short_file_has_a_second_importer_or_a_reason():
    importers = Counter(name for path in FILES for name in imports(path))
    short = {
        str(path.relative_to(PACKAGE))
        for path in FILES
        if path.name not in ("__init__.py", "__main__.py")
        and len(path.read_text(encoding="utf-8").splitlines()) < SHORTEST
        and importers[module_of(path)] < 2
    }
    walked = {name for name in short if name.rpartition("/")[0] in WALKED and not Path(name).name.startswith("_")}
    assert short - walked == set(REASONS)


def test_numerics_pull_in_neither_matplotlib_nor_rerun():
    numerics = [name for name in ARROWS if name not in ("view", "workbench", "cli")]
    wanted = sorted(module_of(path) for path in INNER if part_of(path) in numerics)
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
