"""The documentation says what the library is: made pages are current, cited sections exist, the README is short."""

import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
THEORY = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_made_pages_are_current() -> None:
    pages = runpy.run_path(str(ROOT / "scripts" / "make_docs.py"))["committed_pages"]()
    for path, text in pages.items():
        assert path.read_text(encoding="utf-8") == text, f"{path.name}: run `python scripts/make_docs.py`"


def test_every_section_that_a_docstring_cites_exists() -> None:
    cited = set()
    for path in (ROOT / "src").rglob("*.py"):
        for words in re.findall(r"docs/theory\.md, sections? ([^;:\n]*)", path.read_text(encoding="utf-8")):
            cited |= {(path.name, number) for number in re.findall(r"\d\.\d", words)}
    assert cited
    for name, number in sorted(cited):
        assert f"\n### {number} " in THEORY, f"{name} cites section {number} of docs/theory.md, which is not there"


@pytest.mark.parametrize("pattern", [r"physics\.md", r"methods\.md", r"naming\.md", r"design\.md"])
def test_no_docstring_cites_what_is_not_in_the_repository(pattern: str) -> None:
    for path in (ROOT / "src").rglob("*.py"):
        assert not re.search(pattern, path.read_text(encoding="utf-8")), path


def test_the_readme_is_read_in_minutes() -> None:
    assert len(README.split()) <= 900


def test_files_that_the_readme_names_exist() -> None:
    for target in re.findall(r"\]\((?!http)([^)#]+)", README):
        assert (ROOT / target).exists(), target
