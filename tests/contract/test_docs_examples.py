"""What the documentation shows is what the library does: examples, commands, files, fields and the drawing."""

import ast
import re
import runpy
import shlex
import tomllib
from dataclasses import asdict
from pathlib import Path

import pytest
import typer

import slipwise as sw
from slipwise.campaign.materiality import Materiality
from slipwise.campaign.settings import read_settings
from slipwise.cli import app
from slipwise.effects import DERIVED, HOOKS, LAGGING, PORTS, RIG_MOTION, load_effect
from slipwise.model.file import load_model
from slipwise.rig.known import SPECIMEN_UNITS, SPECIMEN_WORDS
from slipwise.selection.importance import RESPONSES

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src" / "slipwise"
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FORMATS = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
CONTRACT = (ROOT / "docs" / "effect_contract.md").read_text(encoding="utf-8")
#: Section of formats.md -> files and functions that write it.
WRITTEN_BY = {
    "summary.json": {"simulation/result.py": ("summary",)},
    "Audit as JSON": {"instruments/checks.py": ("as_json",), "instruments/report.py": ("rows",)},
    "compare.json": {"comparison/tables.py": ()},
    "diagnosis.json": {
        "diagnosis/result.py": (
            "as_json",
            "_candidate",
            "_importance",
            "_predicted_friction",
            "_screened",
            "written",
            "_surface",
        ),
        "preparation/data_corrections.py": ("as_json",),
    },
    "ladder.json": {"diagnosis/ladder.py": ("as_json", "table")},
    "next.json": {"design/result.py": ("as_json", "_rows")},
    "Several campaigns as JSON": {
        "view/words/campaign_tables.py": ("summary_json",),
        "studies/campaigns/outcome.py": ("numbers_of",),
        "cli/batch.py": ("diagnose_folder",),
    },
    "bench.json": {"cli/bench.py": ("bench",)},
    "ensemble.json": {
        "view/words/ensemble_tables.py": ("ensemble_json", "exceedance_rows", "_row"),
        "studies/ensemble/member.py": ("_numbers",),
    },
    "consequence.json": {"studies/consequence/result.py": ("as_json", "_response")},
    "Export": {"export/opensees.py": ("as_json",), "export/sap2000.py": ("as_json",)},
    "paper.json": {"studies/paper/reenact.py": ("as_json", "assumptions")},
}


def blocks(page: Path, *languages: str) -> list[str]:
    """Text of the fenced blocks of these languages."""
    found = re.findall(r"^```(\w+)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    return [text for language, text in found if language in languages]


def examples(*languages: str) -> list:
    return [
        pytest.param(text, id=f"{page.name}-{i}") for page in PAGES for i, text in enumerate(blocks(page, *languages))
    ]


def commands() -> dict[str, set[str]]:
    """Command -> its options."""
    known = getattr(typer.main.get_command(app), "commands", {})
    return {
        name: {option for p in command.params for option in (*p.opts, *p.secondary_opts)} | {"--help"}
        for name, command in known.items()
    }


def section(title: str) -> str:
    found = re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", FORMATS, re.MULTILINE | re.DOTALL)
    assert found, f"formats.md has no section {title!r}"
    return found[1]


def keys_of(function: ast.AST) -> set[str]:
    """Keys of the dictionaries that a function writes out, and names that it collects in a `keys = (...)`."""
    found = set()
    for node in ast.walk(function):
        if isinstance(node, ast.Dict):
            found |= {k.value for k in node.keys if isinstance(k, ast.Constant) and isinstance(k.value, str)}
        if isinstance(node, ast.Assign) and [getattr(t, "id", "") for t in node.targets] == ["keys"]:
            found |= set(ast.literal_eval(node.value))
    return found


@pytest.mark.parametrize("text", examples("python"))
def test_python_examples_compile_and_use_names_that_exist(text):
    tree = ast.parse(text)
    used = {n.attr for n in ast.walk(tree) if isinstance(n, ast.Attribute) and getattr(n.value, "id", "") == "sw"}
    assert used <= set(sw.__all__)


def test_the_example_of_an_effect_is_one(tmp_path):
    (text,) = (t for t in blocks(ROOT / "docs" / "first_effect.md", "python") if "EFFECT" in t)
    (tmp_path / "mine.py").write_text(text, encoding="utf-8")
    effect = load_effect(tmp_path / "mine.py")
    assert effect.hooks["shear"](shear=1.0, true_pressure=2.0, speed=3.0, **effect.neutral()) == 1.0
    assert max(map(len, text.splitlines())) <= 88, "longer lines run out of the page"


@pytest.mark.parametrize("text", examples("sh"))
def test_shell_examples_call_commands_and_options_that_exist(text):
    known = commands()
    calls = [call for line in text.splitlines() for call in re.split(r"&&|\|", line) if "slipwise" in call.split()[:1]]
    for call in calls:
        words = shlex.split(call, comments=True)
        assert words[1] in known, call
        options = {w.partition("=")[0] for w in words[2:] if w.startswith("--")}
        assert options <= known[words[1]], call


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_commands_named_in_the_text_exist(page):
    known = commands()
    for call in re.findall(r"`slipwise ([^`]+)`", page.read_text(encoding="utf-8")):
        words = call.split()
        if words[0].islower():
            assert words[0] in known, call
            assert {w.partition("=")[0] for w in words if w.startswith("--")} <= known[words[0]], call


def test_the_campaign_of_the_formats_page_can_be_read(tmp_path):
    text = next(t for t in blocks(ROOT / "docs" / "formats.md", "toml") if "[[run]]" in t)
    (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
    assert read_settings(tmp_path / "campaign.toml").runs[0].role == "fit"


def test_the_model_of_the_formats_page_can_be_read(tmp_path):
    text = next(t for t in blocks(ROOT / "docs" / "formats.md", "toml") if "[[effect]]" in t)
    mine = next(t for t in blocks(ROOT / "docs" / "first_effect.md", "python") if "EFFECT" in t)
    (tmp_path / "model.toml").write_text(text, encoding="utf-8")
    (tmp_path / "mine.py").write_text(mine, encoding="utf-8")
    names = [u.effect.name for u in load_model(tmp_path / "model.toml", trust=[tmp_path / "mine.py"]).uses]
    assert names == ["shear_rate", "channel_gain", "mine"]


@pytest.mark.parametrize("text", examples("toml"))
def test_toml_examples_are_toml(text):
    assert tomllib.loads(text)


@pytest.mark.parametrize("title", WRITTEN_BY)
def test_every_field_that_is_written_is_explained(title):
    words = section(title)
    for name, wanted in WRITTEN_BY[title].items():
        tree = ast.parse((PACKAGE / name).read_text(encoding="utf-8"))
        functions = [n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef) and (not wanted or n.name in wanted)]
        assert {f.name for f in functions} >= set(wanted)
        for key in sorted({k for f in functions for k in keys_of(f)}):
            assert f"`{key}`" in words, f"{title}: {key!r} of {name} is not explained in docs/formats.md"


def test_every_value_of_a_specimen_is_explained():
    words = section("campaign.toml")
    for name in (*SPECIMEN_UNITS, *SPECIMEN_WORDS):
        assert f"`{name}`" in words, name


def test_what_matters_is_explained_with_its_defaults():
    words = section("campaign.toml")
    for key, share in asdict(Materiality()).items():
        assert f"| `{key}` | {100 * share:g} % |" in words, key


def test_every_response_of_an_importance_is_explained():
    words = section("diagnosis.json")
    assert all(f"`{name}`" in words for name in RESPONSES)


@pytest.mark.parametrize("name", ["architecture.md", "contributing.md", "effect_contract.md", "theory.md"])
def test_files_named_in_the_text_exist(name):
    for path in re.findall(r"`([\w./]+/[\w./]*\w\.py)`", (ROOT / "docs" / name).read_text(encoding="utf-8")):
        assert (ROOT / path).is_file() or (PACKAGE / path).is_file(), path


def test_every_port_is_explained_with_an_effect_on_it():
    rows = re.findall(r"^\| `(\w+)` \|.*\| `(\w+)` \|$", CONTRACT, re.MULTILINE)
    assert [port for port, _ in rows] == list(PORTS)
    for port, example in rows:
        assert sw.effects.catalogue()[example].port == port


def test_every_derived_state_is_explained_with_its_unit():
    rows = re.findall(r"^\| `(\w+)` \| (.*) \| ([^|]*) \| (yes)? *\|$", CONTRACT, re.MULTILINE)
    assert {name: f"{words} [{unit}]".replace("\\|", "|") for name, words, unit, _ in rows} == DERIVED
    assert {name for name, *_, buffers in rows if buffers} == DERIVED.keys() & HOOKS["spring"].inputs.keys()
    assert all(f"`{name}`" in CONTRACT.partition("What lags")[2].partition(" does so")[0] for name in LAGGING)


def test_every_motion_of_the_rig_is_explained_with_its_unit():
    assert all(f"`{name}`" in CONTRACT for name in RIG_MOTION)
    for name, words in RIG_MOTION.items():
        assert f"[{words.rpartition('[')[2]}" in CONTRACT.partition(f"`{name}`")[2].partition(".")[0]


def test_the_drawing_shows_every_package_after_those_that_it_may_import():
    arrows = runpy.run_path(str(Path(__file__).with_name("test_layers.py")))["ARROWS"]
    drawing = (ROOT / "docs" / "architecture.svg").read_text(encoding="utf-8")
    boxes = [set(text.split(" · ")) for text in re.findall(r'font-size="21"[^>]*>([^<]+)<', drawing)]
    row = {name: place for place, names in enumerate(boxes) for name in names}
    assert set(row) == set(arrows)
    for name, others in arrows.items():
        assert all(row[other] <= row[name] for other in others.split()), name
