"""What `mkdocs` does before it builds: write the site's own pages, and list the effects in the navigation."""

import importlib.util
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any


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
