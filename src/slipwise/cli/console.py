"""What commands share: printing, progress, and the folder that takes the results."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console

from slipwise.errors import InputError, visible
from slipwise.view.patient_console import PatientConsole, write_out

OUT = PatientConsole()
ERR = PatientConsole(stderr=True)


def say(words: str, console: Console = OUT) -> None:
    """Print a sentence as it is, in one line; brackets are no markup, and control characters are shown."""
    console.print(visible(words), markup=False, highlight=False, soft_wrap=True)


def print_json(content: object) -> None:
    """Print JSON for a program to read."""
    write_out(json.dumps(content, indent=1, allow_nan=False) + "\n")


def out_folder(path: Path) -> Path:
    """Make the folder for the results.

    Raises:
        InputError: there is a file of that name, or it cannot be made.
    """
    if path.exists() and not path.is_dir():
        raise InputError(f"--out {path}: a file of this name exists; give a folder")
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {path}: the folder cannot be made ({error.strerror})") from None
    return path


@contextmanager
def progress(words: str) -> Iterator[Callable[[float], None]]:
    """Show the progress of long work on the terminal; call what it gives with the fraction done."""
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=ERR, transient=True, disable=not ERR.is_terminal) as bar:
        task = bar.add_task(words, total=1.0)
        yield lambda fraction: bar.update(task, completed=fraction)


@contextmanager
def steps() -> Iterator[Callable[[str, float], None]]:
    """Show what is being done, and how far it is."""
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description:32s}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=ERR, transient=True, disable=not ERR.is_terminal) as bar:
        task = bar.add_task("reading", total=1.0)
        yield lambda words, share: bar.update(task, description=words, completed=share)
