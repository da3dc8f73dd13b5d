"""What is finished of many jobs: one line of a file each, all of it on the disk or nothing, read back one by one.

After a kill or on a full disk the lines that are whole count, and a torn last line is cut off.
"""

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from slipwise.errors import InputError, cannot_write

Numbers = dict[str, Any]


@dataclass(frozen=True)
class Finished:
    """What is finished.

    Attributes:
        path: of the file that holds it.
        places: key of a job -> byte at which its line begins.
        run: jobs that were run now; the others had been finished before.
    """

    path: Path
    places: Mapping[str, int]
    run: int

    def numbers(self, keys: Iterable[str]) -> Iterator[Numbers]:
        """Give what became of these jobs, in this order, one after another."""
        with self.path.open("rb") as stream:
            for key in keys:
                stream.seek(self.places[key])
                yield json.loads(stream.readline())["numbers"]


def add_line(stream: IO[bytes], key: str, numbers: Numbers) -> int:
    """Write a finished job to the disk, all of its line or nothing, and give the byte at which it begins.

    Args:
        stream: open to append, without a buffer.
        key: of the job.
        numbers: that JSON holds exactly.

    Raises:
        OutputError: it cannot be written.
    """
    line = json.dumps({"key": key, "numbers": numbers}, allow_nan=False).encode() + b"\n"
    begin = stream.seek(0, os.SEEK_END)
    try:
        try:
            while line:
                line = line[stream.write(line) :]
            os.fsync(stream.fileno())
        except BaseException:
            stream.truncate(begin)
            raise
    except OSError as error:
        raise cannot_write(stream.name, error) from error
    return begin


def read_places(path: Path, lasting: Callable[[Numbers], bool] | None = None) -> dict[str, int]:
    """Read where each finished job stands; cut off a last line that a kill has torn.

    Args:
        path: of the file; it may be absent.
        lasting: tells whether numbers count as finished; all do when not given.

    Raises:
        InputError: the file was not written by such a run.
    """
    if not path.exists():
        return {}
    places: dict[str, int] = {}
    begin = 0
    with path.open("r+b") as stream:
        for line in stream:
            if not line.endswith(b"\n"):
                break
            try:
                entry = json.loads(line)
                key, numbers = entry["key"], entry["numbers"]
            except (ValueError, KeyError, TypeError):
                raise InputError(f"{path}: this is no file of an ensemble; remove it or choose another --out") from None
            if lasting is None or lasting(numbers):
                places[key] = begin
            begin += len(line)
        stream.truncate(begin)
    return places
