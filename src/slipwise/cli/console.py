"""What commands share: printing, progress, and the folder that takes the results."""

import json
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console

from slipwise.errors import InputError, visible
from slipwise.view.pipe_safe_console import PatientConsole, write_out

OUT = PatientConsole()
ERR = PatientConsole(stderr=True)
#: Without a terminal, progress is a line after at least so long: of one piece of work, and of many [s].
_STEP_EVERY, _SAID_EVERY = 5.0, 30.0


def say(words: str, console: Console = OUT) -> None:
    """Print a sentence as it is, in one line; brackets are no markup, and control characters are shown."""
    console.print(visible(words), markup=False, highlight=False, soft_wrap=True)


def say_next(*steps: str, console: Console = OUT) -> None:
    """Print the last line of a command: what to do now.

    Args:
        steps: commands or sentences, each possible by itself.
        console: where to print.
    """
    say(f"next: {', or '.join(steps)}", console)


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


def can_record(wanted: bool) -> bool:
    """Return whether a recording is to be written; one that is wanted and cannot be is said so, and left out."""
    from slipwise.view.recordings import WITHOUT_RERUN, is_rerun_installed

    if wanted and not is_rerun_installed():
        say(f"no recording: {WITHOUT_RERUN}, and --no-recording leaves recordings out", ERR)
        return False
    return wanted


def say_corrections(corrections: Iterable[Any]) -> None:
    """Say what was done about the data before any fit, a line each.

    Args:
        corrections: of a result, each with its `words`.
    """
    for one in corrections:
        say(f"before any fit: {one.words}")


@contextmanager
def steps() -> Iterator[Callable[[str, float], None]]:
    """Show what is being done, and how far it is; without a terminal (a batch job's log) by a line now and then."""
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description:32s}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=ERR, transient=True, disable=not ERR.is_terminal) as bar:
        task = bar.add_task("reading", total=1.0)
        begin = said = time.monotonic()

        def tell(words: str, share: float) -> None:
            nonlocal said
            now = time.monotonic()
            bar.update(task, description=words, completed=share)
            if not ERR.is_terminal and now - said > _STEP_EVERY:
                say(f"{now - begin:4.0f} s  {100 * share:3.0f} %  {words}", ERR)
                said = now

        yield tell


@contextmanager
def counting(words: str) -> Iterator[Callable[[int, int], None]]:
    """Show how many pieces of long work are finished, and how long the rest will take.

    Call what it gives with how many of how many; the first call tells what had been finished before. Without a terminal
    (a batch job's log) it is a line now and then.
    """
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.completed:.0f} of {task.total:.0f}"))
    with Progress(*columns, TextColumn("{task.fields[left]}"), console=ERR, transient=True,
                  disable=not ERR.is_terminal) as bar:  # fmt: skip
        task = bar.add_task(words, total=None, left="")
        begin: list[tuple[int, float]] = []
        said = time.monotonic()

        def tell(done: int, total: int) -> None:
            nonlocal said
            now = time.monotonic()
            begin.extend([] if begin else [(done, now)])
            left = _time_left(done - begin[0][0], total - done, now - begin[0][1])
            bar.update(task, completed=done, total=total, left=left)
            if not ERR.is_terminal and now - said > _SAID_EVERY:
                say(f"{words}: {done} of {total}{left and ', '}{left}", ERR)
                said = now

        yield tell


def _time_left(done: int, left: int, seconds: float) -> str:
    """Say how long it will take at the pace so far; nothing before there is one."""
    if not done or not left:
        return ""
    rest = seconds * left / done
    if rest < 90.0:
        return f"{rest:.0f} s left"
    return f"{rest / 60.0:.0f} min left" if rest < 5400.0 else f"{rest / 3600.0:.1f} h left"
