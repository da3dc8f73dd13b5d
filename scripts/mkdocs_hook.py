"""What `mkdocs` does before it builds: write the site's own pages, list the effects, let wide tables fold up."""

import importlib.util
import re
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

#: A table with as many columns, or with one of this name, is folded into cards where the screen is narrow.
_WIDE, _FOLDED = 4, "default"


@cache
def _make_docs() -> ModuleType:
    """Load the script beside this file: mkdocs does not keep its folder on the path."""
    spec = importlib.util.spec_from_file_location("make_docs", Path(__file__).with_name("make_docs.py"))
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def on_config(config: Any) -> Any:
    """Make the pages of the effects, and let the navigation show them."""
    pages = _make_docs().write_site_pages()
    for part in config["nav"]:
        if "Effects" in part:
            part["Effects"] = ["effects/index.md", *pages]
    return config


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Let the list of effects lead to their pages."""
    return _make_docs().linked(markdown) if page.file.src_uri == "effects/index.md" else markdown


def on_page_content(html: str, **_: Any) -> str:
    """Write the head of its column beside every cell of a wide table, for the stylesheet to show on a narrow screen."""
    return re.sub(r"<table>.*?</table>", lambda found: _folding(found[0]), html, flags=re.DOTALL)


def _folding(table: str) -> str:
    heads = [re.sub(r"<[^>]+>", "", head) for head in re.findall(r"<th[^>]*>(.*?)</th>", table, re.DOTALL)]
    if len(heads) < _WIDE and _FOLDED not in heads:
        return table

    def row(found: re.Match[str]) -> str:
        names = iter(heads)
        return re.sub(r"<td", lambda _: f'<td data-head="{next(names)}"', found[0])

    return re.sub(r"<tr>.*?</tr>", row, table, flags=re.DOTALL).replace("<table>", "<table data-wide>", 1)
