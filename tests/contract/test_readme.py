"""The README's table of effects comes from the effects' own files."""

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_the_table_of_effects_is_current() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    updated = runpy.run_path(str(ROOT / "scripts" / "update_readme.py"))["updated"](text)
    assert text == updated, "run `python scripts/update_readme.py`"
