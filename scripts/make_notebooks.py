"""Execute the notebooks of docs/notebooks and write them as .ipynb, and as pages of the documentation.

    python scripts/make_notebooks.py            # all of them, as they are committed
    python scripts/make_notebooks.py NAME ...   # some
    python scripts/make_notebooks.py --out DIR  # elsewhere, to see whether they still run

A notebook is written as a .py file: `# %%` begins a cell of Python, `# %% [markdown]` one of text. What is committed
beside it is made from that, so text and numbers stay true. Needs the extra `dev`.
"""

import argparse
import re
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbconvert import MarkdownExporter

SOURCES = Path(__file__).parents[1] / "docs" / "notebooks"
#: A cell may take so long [s], and a notebook be so large [bytes].
PATIENCE, LARGEST = 3600, 1_000_000


def notebook(source: str) -> nbformat.NotebookNode:
    """Make a notebook of its text.

    Args:
        source: cells behind `# %%`.
    """
    cells = []
    for number, (kind, text) in enumerate(re.findall(r"^# %%( \[markdown\])?\n(.*?)(?=^# %%|\Z)", source, re.M | re.S)):
        words = re.sub(r"^# ?", "", text, flags=re.M) if kind else text
        make = nbformat.v4.new_markdown_cell if kind else nbformat.v4.new_code_cell
        cells.append(make(words.strip(), id=f"cell-{number}"))
    return nbformat.v4.new_notebook(cells=cells)


def execute(source: Path) -> nbformat.NotebookNode:
    """Execute a notebook in an empty folder; an error in a cell is raised with its text."""
    made = notebook(source.read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(
            made, timeout=PATIENCE, kernel_name="python3", resources={"metadata": {"path": folder}}
        ).execute()
    for cell in made.cells:
        cell.metadata = {}  # when it ran is nobody's business, and differs every time
        if "outputs" in cell:  # warnings are of the machine that ran it, and hold its paths
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    return made


def write(made: nbformat.NotebookNode, name: str, folder: Path) -> list[Path]:
    """Write a notebook that was executed, and its page with the pictures beside.

    Raises:
        ValueError: it is too large to be shipped.
    """
    folder.mkdir(parents=True, exist_ok=True)
    whole = nbformat.writes(made)
    if len(whole) > LARGEST:
        raise ValueError(f"{name}: {len(whole)} bytes are too many; show fewer or smaller pictures")
    text, more = MarkdownExporter().from_notebook_node(made)
    pictures = {old: f"{name}_{old.removeprefix('output_')}" for old in more.get("outputs", {})}
    for old, new in pictures.items():
        text = text.replace(f"]({old})", f"]({new})")
    note = f"\n\n[This page as a notebook]({name}.ipynb), executed, for Jupyter.\n"
    files = {folder / f"{name}.ipynb": whole.encode(), folder / f"{name}.md": (text.strip() + note).encode()}
    files |= {folder / pictures[old]: content for old, content in more.get("outputs", {}).items()}
    for path, content in files.items():
        path.write_bytes(content)
    return list(files)


def main(arguments: list[str] | None = None) -> int:
    """Read the command line, execute and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="of notebooks; all if none is given")
    parser.add_argument("--out", type=Path, default=SOURCES, help="folder that takes what is made")
    chosen = parser.parse_args(arguments)
    for source in sorted(SOURCES.glob("*.py")):
        if not chosen.names or source.stem in chosen.names:
            for path in write(execute(source), source.stem, chosen.out):
                print(f"wrote {path}, {path.stat().st_size / 1e3:.0f} kB", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
