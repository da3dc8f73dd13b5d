"""The input, the output and the errors of a program, also where a shell has closed them or knows few characters."""

import os
import sys


def open_standard_streams() -> None:
    """Put nothing in the place of a stream that is closed (`<&-`, `>&-`), and a `?` in that of unknown characters.

    Trap: the number of a closed stream is free. The next file that is opened would take it, and what is printed would
    be written into that file.
    """
    for number, (name, mode) in enumerate((("stdin", "r"), ("stdout", "w"), ("stderr", "w"))):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest free number, which is this one
        if getattr(sys, name) is None:
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115  for all that comes
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]
