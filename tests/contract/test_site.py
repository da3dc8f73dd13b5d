"""The site's sources are whole before a builder sees them: navigation, links to effects, heads in wide tables."""

import importlib
import re
from pathlib import Path
from types import ModuleType

import pytest

from slipwise.effects import catalogue

ROOT = Path(__file__).parents[2]
WIDE = """\
| field | meaning | unit | default |
|---|---|---|---|
| `a \\| b` | a bar in code, and {braces} | | 1 |

| two | columns |
|---|---|
| stay | as they are |

```
| a | table | in | a fence |
|---|---|---|---|
| stays | as | it | is |
```
"""


@pytest.fixture
def site(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    return importlib.import_module("make_site")


def test_cells_of_a_wide_table_carry_the_head_of_their_column(site: ModuleType) -> None:
    lines = site.with_heads(WIDE).splitlines()
    assert lines[2] == (
        '| `a \\| b` { data-head="field" } | a bar in code, and &#123;braces} { data-head="meaning" } | '
        ' | 1 { data-head="default" } |'
    )
    assert [*lines[:2], *lines[3:]] == [*WIDE.splitlines()[:2], *WIDE.splitlines()[3:]]


def test_every_effect_of_the_list_leads_to_its_page(site: ModuleType) -> None:
    text = site.linked((ROOT / "docs" / "effects" / "index.md").read_text(encoding="utf-8"))
    assert set(re.findall(r"\((\w+)\.md\)", text)) == set(catalogue())


def test_the_navigation_names_every_page_and_no_other(site: ModuleType) -> None:
    named = set(re.findall(r"[\w/]+\.md", (ROOT / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:")[2]))
    assert named == {str(path) for path in site.read_pages()}


def test_no_builder_needs_a_hook() -> None:
    assert "hooks:" not in (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
