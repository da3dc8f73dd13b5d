"""What a release is: numbers of its files' forms, what sdist and wheel hold, and one version everywhere."""

import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FORMATS = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
#: File -> the module that writes its schema number.
WRITERS = {
    "`summary.json` of `replay`": "simulation/result.py",
    "`audit --json`": "instruments/checks.py",
    "`compare.json`": "comparison/tables.py",
    "`bearing.json`": "bearings/result.py",
    "`diagnosis.json`": "diagnosis/result.py",
    "`discovery.json`": "discovery/result.py",
    "`laws --json`": "discovery/law_list.py",
    "`holds.json`": "discovery/law_test.py",
    "`next.json`": "design/result.py",
    "`summary.json` of several campaigns": "view/words/campaign_tables.py",
    "`bench.json`": "cli/bench.py",
    "`ensemble.json`": "view/words/ensemble_tables.py",
    "`paper.json`": "studies/paper/reenact.py",
    "`plan.json`": "planning/result.py",
    "`export opensees --json`": "export/opensees.py",
    "`export sap2000 --json`": "export/sap2000.py",
    "`consequence.json`": "studies/consequence/result.py",
    "`predicted.json`": "prediction/result.py",
    "`specimens.json`": "specimens/result.py",
    "`watch.json`": "monitoring/step.py",
    "a session's file": "session/schema.py",
}
#: Written by the session's schema, in another file.
ELSEWHERE = {"session/snapshot.py"}
SOURCE = ROOT / "src" / "slipwise"


def number_in(text: str) -> str:
    """The number behind "schema", or of `SCHEMA`."""
    found = re.search(r'"schema": (\d+)', text) or re.search(r"^SCHEMA = (\d+)", text, re.M)
    return found[1] if found else ""


def test_the_formats_state_the_schema_number_of_every_json() -> None:
    table = FORMATS.partition("## Schema numbers")[2].partition("\n## ")[0]
    stated = dict(re.findall(r"^\| (.+?) \| (\d+) \|$", table, re.M))
    assert stated == {name: number_in((SOURCE / path).read_text(encoding="utf-8")) for name, path in WRITERS.items()}


def test_no_other_file_writes_a_schema_number() -> None:
    writing = {
        str(p.relative_to(SOURCE)) for p in SOURCE.rglob("*.py") if '"schema": ' in p.read_text(encoding="utf-8")
    }
    assert writing - ELSEWHERE <= set(WRITERS.values())


def test_citation_and_changelog_have_the_version_of_the_package() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    cited = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(rf"^version: \"?{re.escape(version)}\"?$", cited, re.M)
    changes = (ROOT / "docs" / "changelog.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (.+)$", changes, re.M)[0] == version
    kinds = re.findall(r"^### (.+)$", changes.partition(f"## {version}")[2].partition("\n## ")[0], re.M)
    assert kinds == ["Added", "Changed", "Fixed", "Removed"]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The sdist and the wheel."""
    pytest.importorskip("hatchling", reason="builds the package; `pip install hatchling`")
    folder = tmp_path_factory.mktemp("dist")
    subprocess.run([sys.executable, "-m", "hatchling", "build", "-d", str(folder)], cwd=ROOT, check=True)
    (sdist,), (wheel,) = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return sdist, wheel


@pytest.mark.slow
def test_an_index_would_take_sdist_and_wheel(built: tuple[Path, Path]) -> None:
    pytest.importorskip("twine", reason="checks them; `pip install twine`")
    done = subprocess.run([sys.executable, "-m", "twine", "check", "--strict", *built], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_sdist_and_wheel_hold_what_they_should_and_nothing_else(built: tuple[Path, Path]) -> None:
    sdist, wheel = built
    with tarfile.open(sdist) as archive:
        inside = {name.split("/")[1] for name in archive.getnames() if "/" in name}
    assert inside == {
        "src", "models", "tests", "scripts", "benchmarks", "docs", "README.md", "CONTRIBUTING.md", "LICENSE",
        "CITATION.cff", "pyproject.toml", "PKG-INFO", ".gitignore",
    }  # fmt: skip
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    assert {name.split("/")[0] for name in names} == {"slipwise", wheel.name.rsplit("-", 3)[0] + ".dist-info"}
    kinds = {Path(name).suffix for name in names if name.startswith("slipwise/")}
    assert kinds <= {
        ".py",
        ".toml",
        ".json",
        ".parquet",
        ".xml",
        ".html",
        ".css",
        ".js",
        ".svg",
        ".txt",
        ".typed",
        ".md",
    }
    assert {"slipwise/demo_data/campaign.toml", "slipwise/effects/run_in.py"} <= set(names)
