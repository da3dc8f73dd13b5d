"""Write the README's table of effects anew, from the effects' own files.

python scripts/update_readme.py            writes README.md
python scripts/update_readme.py --check    writes nothing; exit 1 if the table is not current
"""

import sys
from pathlib import Path

from slipwise.errors import InputError
from slipwise.record import write_text
from slipwise.view.effects import readme_table

BEGIN, END = "<!-- effects:begin -->", "<!-- effects:end -->"


def updated(text: str) -> str:
    """Give the README's text with a current table between its two marks.

    Raises:
        InputError: a mark is missing.
    """
    if BEGIN not in text or END not in text:
        raise InputError(f"README.md needs the lines {BEGIN} and {END}; the table is written between them")
    before, _, rest = text.partition(BEGIN)
    return f"{before}{BEGIN}\n{readme_table()}{END}{rest.partition(END)[2]}"


def main() -> int:
    """Update README.md, or check it."""
    path = Path(__file__).parents[1] / "README.md"
    text = path.read_text(encoding="utf-8")
    new = updated(text)
    if "--check" not in sys.argv:
        write_text(path, new)
    return int("--check" in sys.argv and new != text)


if __name__ == "__main__":
    raise SystemExit(main())
