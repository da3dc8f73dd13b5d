"""`slipwise` and `python -m slipwise`: signals are heard while the command line is still being loaded."""

import os
import sys

if __name__ == "__main__" and not sys.flags.safe_path:
    # `python -m` looks for modules in the current folder first: a stranger's folder may hold a numpy.py
    del sys.path[0]

from slipwise.jobs.interruption import Stopped, stoppable  # noqa: E402


def main() -> None:
    """Run the command line."""
    _open_standard_streams()
    try:
        with stoppable():
            from slipwise.cli import main as command_line

            command_line()
    except Stopped as stop:
        print(stop, file=sys.stderr)
        sys.exit(stop.code)


def _open_standard_streams() -> None:
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


if __name__ == "__main__":
    main()
