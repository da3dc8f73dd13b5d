"""Write the sources of the site, every page of it, for any builder of Markdown: mkdocs, zensical.

    python scripts/make_site.py && mkdocs build --strict
    python scripts/make_site.py && zensical build

build/docs is docs with what only the site has: a page and a picture for every effect, and the API reference. Cells of
wide tables carry the head of their column, by which docs/extra.css folds them on a narrow screen. The navigation stands
in mkdocs.yml.
"""

import re
import shutil
import textwrap
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from make_docs import DOCS, MADE, effect_page
from reference import PAGES, reference_page
from slipwise.effects import catalogue
from slipwise.record import write_text
from slipwise.view.figures.canvas import save_figure
from slipwise.view.figures.effect_picture import effect_picture
from slipwise.view.figures.style import styled
from slipwise.view.words.effects import effect_rows

SITE = DOCS.parent / "build" / "docs"
#: A table with as many columns, or with one of this name, is folded into cards where the screen is narrow.
_WIDE, _FOLDED = 4, "default"
#: What an effect adds counts as nothing below this share of what it is added to [1].
_NOTHING = 1e-6


def main() -> None:
    """Write build/docs; what is current there is left alone, and what is no longer a page is removed."""
    pages = read_pages()
    others = [path.relative_to(DOCS) for path in DOCS.rglob("*") if path.is_file() and path.suffix != ".md"]
    pictures = [Path(f"effects/pictures/{name}.png") for name in catalogue()]
    for path in [path for path in SITE.rglob("*") if path.is_file()]:
        if path.relative_to(SITE) not in {*pages, *others, *pictures}:
            path.unlink()
    for path, text in pages.items():
        _write(SITE / path, with_heads(text))
    for path in others:
        (SITE / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(DOCS / path, SITE / path)
    for picture in pictures:
        _draw(SITE / picture)
    print(f"wrote {len(pages)} pages to {SITE}")


def read_pages() -> dict[Path, str]:
    """Return every page: its path below the site's sources, and its text."""
    pages = {path.relative_to(DOCS): path.read_text(encoding="utf-8") for path in sorted(DOCS.rglob("*.md"))}
    pages[Path("effects/index.md")] = linked(pages[Path("effects/index.md")])
    pages |= {Path(f"reference/{page}.md"): f"{MADE}{reference_page(page)}" for page in PAGES}
    pages |= {Path(f"effects/{row['name']}.md"): effect_page(row) for row in effect_rows()}
    return pages


def linked(index: str) -> str:
    """Let every name in the list of effects lead to its page, and every component be a heading.

    Args:
        index: the page as it is committed, where a name has no page of its own.
    """
    index = re.sub(r"^\*\*(.+)\*\*$", r"## \1", index, flags=re.MULTILINE)
    for name in catalogue():
        index = index.replace(f"`{name}`", f"[`{name}`]({name}.md)")
    # the site's Markdown shows the backslash that GitHub's needs before a bar in code
    return re.sub(r"`[^`\n]*`", lambda found: found[0].replace("\\|", "|"), index)


def with_heads(markdown: str) -> str:
    """Write the head of its column into every cell of a wide table, as an attribute that Python's Markdown reads.

    Args:
        markdown: a page; what stands in fences is left alone.
    """
    heads: list[str] = []
    lines, fenced = markdown.split("\n"), False
    for i, line in enumerate(lines):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        if fenced or not line.startswith("|"):
            heads = []
        elif re.fullmatch(r"[|:\- ]+", line):
            named = [re.sub(r"[`*_{}\"]|\]\([^)]*\)|\[", "", cell).strip() for cell in _cells(lines[i - 1])]
            heads = named if len(named) >= _WIDE or _FOLDED in named else []
        elif heads:
            cells = zip(_cells(line), heads, strict=True)
            told = (_with_head(cell, head) if cell.strip() else cell for cell, head in cells)
            lines[i] = f"|{' |'.join(told)} |"
    return "\n".join(lines)


def _with_head(cell: str, head: str) -> str:
    """Return a cell with its head; a brace in its words would be taken for the begin of attributes."""
    words = cell if "`" in cell else cell.replace("{", "&#123;")
    return f'{words.rstrip()} {{ data-head="{head}" }}'


def _cells(row: str) -> list[str]:
    """Return the cells of a row; a bar within code, or behind a backslash, ends none."""
    return re.split(r"(?<!\\)\|(?=(?:[^`]*`[^`]*`)*[^`]*$)", row.strip()[1:-1])


def _draw(picture: Path) -> None:
    effect = catalogue()[picture.stem]
    newest = max(path.stat().st_mtime for path in (effect.path, Path(__file__)))
    if not picture.is_file() or picture.stat().st_mtime < newest:
        with styled():
            save_figure(_readable(effect_picture(effect)), picture)


def _readable(figure: Figure) -> Figure:
    """Keep the legend off the curves, and let an axis of what is constant, or nothing, be read."""
    above, below = figure.axes
    handles, labels = above.get_legend_handles_labels()
    legend = above.get_legend()
    if legend is not None:
        legend.remove()
    figure.legend(handles, labels, loc="outside lower center", ncols=2)
    added = np.asarray(below.lines[0].get_ydata(), dtype=float)
    largest, size = float(np.abs(added).max()), float(np.abs(np.asarray(above.lines[0].get_ydata(), dtype=float)).max())
    if largest < _NOTHING * size:
        below.lines[0].set_ydata(np.zeros_like(added))
        below.set_ylim(-0.01 * size, 0.01 * size)
    elif np.ptp(added) < _NOTHING * largest:
        below.set_ylim(min(0.0, 2.0 * added[0]), max(0.0, 2.0 * added[0]))
    below.ticklabel_format(axis="y", useOffset=False)
    above.set_title("")  # the equation stands above the picture already
    for axes, width in ((above, 26), (below, 20)):
        axes.set_ylabel(textwrap.fill(axes.get_ylabel(), width))
    return figure


def _write(path: Path, text: str) -> None:
    """Leave a file alone that is current: a server builds anew for every file that is written."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        write_text(path, text)


if __name__ == "__main__":
    main()
