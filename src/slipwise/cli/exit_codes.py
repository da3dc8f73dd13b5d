"""How a command ends: one line on what went wrong, and an exit code that a shell understands.

0 done, also where nobody reads the output any more (`| head`); 2 something that a user can mend, with `--json` also as
an object that holds `error`; 128 + n ended by the signal n: 130 by Ctrl-C, 143 by `kill`.
"""

import json
import os
import sys
import tempfile
import warnings
from collections.abc import Callable
from contextlib import suppress
from errno import EACCES, EIO, EMFILE, ENOMEM, EPERM, EROFS

import typer

from slipwise.errors import FULL, SlipwiseError, SlipwiseWarning, cannot_write, visible
from slipwise.jobs.interruption import Stopped, end_children, stoppable
from slipwise.view.pipe_safe_console import to_nobody, write_out

#: What the system says and a user can mend; any other error of the system is one of ours.
_OF_THE_MACHINE = FULL | {EACCES, EIO, EMFILE, ENOMEM, EPERM, EROFS}
_MEMORY = "/dev/shm"


def run_to_its_end(command: Callable[[], object]) -> int:
    """Run a command and give its exit code.

    Args:
        command: gives its exit code, or something else for 0.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("always", SlipwiseWarning)
        warnings.showwarning = _show_warning
        try:
            with stoppable():
                return _said(command)
        except Stopped as stop:
            end_children()
            _say(str(stop))
            return stop.code


def _said(command: Callable[[], object]) -> int:
    try:
        code = command()
        sys.stdout.flush()
    except typer.TyperException as error:
        words = getattr(error, "format_message", error.__str__)() or "no command is given"
        return _refused(f"{words.rstrip('.')}; `slipwise --help` shows what is possible")
    except SlipwiseError as error:
        return _refused(str(error))
    except typer.Abort:
        _say("interrupted: nothing was changed")
        return 130
    except BrokenPipeError:
        to_nobody(sys.stdout)
        return 0
    except SystemExit as left:
        if left.code != 1:
            raise
        to_nobody(sys.stdout)  # typer's console leaves so where nobody reads its help
        return 0
    except MemoryError:
        return _refused("out of memory; close other programs, or keep to one core with `taskset -c 0 slipwise ...`")
    except OSError as error:
        if error.filename is None and (lacking := _lacking_folder()):
            return _refused(lacking)
        if error.errno not in _OF_THE_MACHINE:
            raise
        to_nobody(sys.stdout)  # it may be what cannot be written, and is written again at the exit
        return _refused(str(cannot_write(error.filename or "the output", error)))
    return code if isinstance(code, int) else 0


def _lacking_folder() -> str:
    """Say which folder this program and its libraries need and cannot write to, or nothing."""
    try:
        tempfile.gettempdir()
    except FileNotFoundError:
        return "there is no folder for temporary files, which are needed for this; TMPDIR=FOLDER names one"
    if sys.platform == "linux" and not os.access(_MEMORY, os.W_OK):
        return f"{_MEMORY}, through which processes share memory, cannot be written to; take one process (--workers 1)"
    return ""


def _refused(words: str) -> int:
    """Say why a command cannot do what was asked, as JSON too where JSON was asked for; gives its exit code."""
    if "--json" in sys.argv:
        with suppress(OSError):
            write_out(json.dumps({"error": words}) + "\n")
    _say(f"error: {words}")
    return 2


def _say(words: str) -> None:
    """Print one line, if anybody still reads."""
    try:
        print(visible(words), file=sys.stderr, flush=True)
    except OSError:
        to_nobody(sys.stderr)


def _show_warning(message: Warning | str, category: type[Warning], *_: object, **__: object) -> None:
    if issubclass(category, SlipwiseWarning):
        _say(f"warning: {message}")
