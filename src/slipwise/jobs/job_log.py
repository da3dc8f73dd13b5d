"""What is finished of many jobs: one line of a file each, all of it on the disk or nothing, read back one by one.

After a kill, on a full or on a failing disk the lines that are whole count; the others are taken out.
"""

import hashlib
import json
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from slipwise.errors import InputError, SlipwiseWarning, cannot_write
from slipwise.input_file import check_input
from slipwise.jobs.atomic_write import atomic

Numbers = dict[str, Any]
#: How a line begins.
_MARK = b'{"key": '


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
        """Yield what became of these jobs, in this order, one after another."""
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
    line = json.dumps({"key": key, "numbers": numbers, "sum": _sum(key, numbers)}, allow_nan=False).encode() + b"\n"
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
    """Read where each finished job stands; lines that a disk has damaged or a kill has torn are taken out.

    Args:
        path: of the file; it may be absent.
        lasting: tells whether numbers count as finished; all do when not given.

    Raises:
        InputError: it is no file, or was not written by such a run.
        OutputError: it cannot be mended.
    """
    if path.is_dir():
        raise InputError(f"{path} is a folder, and finished jobs are kept in a file of this name; choose another --out")
    if not path.exists():
        return {}
    places: dict[str, int] = {}
    begin = damaged = torn = 0
    with check_input(path).open("rb") as stream:
        for line in stream:
            try:
                key, numbers = _read_line(line)
            except ValueError:
                is_torn = not line.endswith(b"\n") and line[: len(_MARK)] == _MARK[: len(line)]
                damaged, torn = damaged + (not is_torn), torn + is_torn
                continue
            if lasting is None or lasting(numbers):
                places[key] = begin
            begin += len(line)
    if damaged and not begin:
        raise InputError(f"{path}: this is no file of finished jobs; remove it or choose another --out")
    if damaged or torn:
        _take_out_damaged(path)
    if damaged:
        words = f"{path}: {damaged} of its lines were damaged; the jobs that they held are run again"
        warnings.warn(words, SlipwiseWarning, stacklevel=2)
    return places


def _take_out_damaged(path: Path) -> None:
    with path.open("rb") as stream, atomic(path) as mended:
        for line in stream:
            with suppress(ValueError):
                _read_line(line)
                mended.write(line)


def _read_line(line: bytes) -> tuple[str, Numbers]:
    """Return key and numbers of a line; one without a checksum, as earlier versions wrote it, is taken as it is.

    Raises:
        ValueError: it is not as it was written.
    """
    try:
        entry = json.loads(line)
        key, numbers = entry["key"], entry["numbers"]
        of_earlier_version = entry.keys() == {"key", "numbers"} and isinstance(key, str) and isinstance(numbers, dict)
        checksum = _sum(key, numbers)
        if line.endswith(b"\n") and (of_earlier_version or entry["sum"] == checksum):
            return key, numbers
    except (AttributeError, KeyError, TypeError, RecursionError) as error:
        raise ValueError("this is no line of a finished job") from error
    raise ValueError("the line does not agree with its checksum")


def _sum(key: str, numbers: Numbers) -> str:
    """Return a checksum: a disk can turn a number into another one.

    Raises:
        ValueError: a number is not finite.
    """
    return hashlib.sha256(json.dumps([key, numbers], allow_nan=False).encode()).hexdigest()[:16]
