"""A terminal that may be closed: `slipwise demo | head -1` still writes its files."""

import os
import sys
from typing import IO

from rich.console import Console


class PatientConsole(Console):
    """A console that goes on when nobody reads it any more: the files that a command writes are wanted all the same."""

    def on_broken_pipe(self) -> None:
        """Print into nothing from now on, where rich would exit with 1."""
        to_nobody(self.file)


def write_out(text: str) -> None:
    """Write a text as it is to the output, for a program to read."""
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        to_nobody(sys.stdout)


def to_nobody(stream: IO[str]) -> None:
    """Let what a stream still holds and what is written to it later disappear."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)
