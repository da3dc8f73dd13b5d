"""Names and sentences keep to the field's words, so that an engineer understands each at once."""

import ast
import re
from collections import Counter
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "src" / "slipwise"
FILES = sorted(path for path in PACKAGE.rglob("*.py"))
#: Phrases that stood in outputs and that nobody in the field says.
BANNED = re.compile(
    r"so manieth|for want of|but immaterial|turned round before any fit|whatever the direction of sliding"
)
#: Classes of one name in two packages that both are public by that name: users and pages know them so.
TWICE = {"Channel", "Fit", "Finding", "Law", "Limit", "Report"}


def test_a_docstring_says_what_is_returned_and_no_sentence_is_odd() -> None:
    for path in FILES:
        text = path.read_text(encoding="utf-8")
        functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
        begun = {name.name: (ast.get_docstring(name) or "").split(" ")[0] for name in functions}
        assert not [name for name, word in begun.items() if word in ("Give", "Gives")], path
        assert not BANNED.search(text), path


def test_a_public_class_has_a_name_of_its_own() -> None:
    count: Counter[str] = Counter()
    for path in FILES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        count.update(n.name for n in tree.body if isinstance(n, ast.ClassDef) and not n.name.startswith("_"))
    assert {name for name, times in count.items() if times > 1} <= TWICE
