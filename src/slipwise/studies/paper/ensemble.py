"""Many replays at once: on all cores or on somebody else's, resumable, each member run once.

Every finished member is one line of `members.jsonl`, written by one process, flushed to the disk before the next. After
a kill or on a full disk the lines that are whole count, a torn last line is cut off, and only what is missing is run.
"""

import json
import os
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, as_completed
from contextlib import closing
from pathlib import Path
from typing import Any

from slipwise.errors import InputError, SlipwiseError, cannot_write
from slipwise.studies.paper.member import Member, run_member
from slipwise.studies.paper.workers import finished

Numbers = dict[str, Any]
Answers = Generator[tuple[str, Numbers], None, None]


def run_ensemble(
    members: Sequence[Member],
    folder: Path,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> list[Numbers]:
    """Run what has not been run yet and give the numbers of all members in their order.

    Args:
        members: the replays; equal ones are run once.
        folder: of `members.jsonl`; made if absent.
        executor: any of `concurrent.futures`, also a cluster's, e.g. `dask.distributed.Client(...).get_executor()`; it
            is left running. Processes on this machine when not given.
        workers: processes when no executor is given; as many as there are cores when not given.
        progress: called with the fraction done.

    Returns:
        For every member what `run_member` gives; it does not depend on executor, workers or interruptions.

    Raises:
        InputError: `members.jsonl` was not written by an ensemble.
        OutputError: it cannot be written.
        SlipwiseError: processes were killed. What is finished is kept.
    """
    keys = [member.key() for member in members]
    path = folder / "members.jsonl"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise cannot_write(folder, error) from error
    done = _kept(path)
    wanted = dict(zip(keys, members, strict=True))
    missing = {key: member for key, member in wanted.items() if key not in done}
    count = len(wanted)

    def tell() -> None:
        if progress is not None and count:
            progress(1.0 - len(missing.keys() - done.keys()) / count)

    tell()
    if missing:
        cores = min(workers or os.cpu_count() or 1, len(missing))
        answers = finished(run_member, missing, cores) if executor is None else _lent(executor, missing)
        with closing(answers):
            for key, numbers in answers:
                _keep(path, {"key": key, "numbers": numbers})
                done[key] = numbers
                tell()
    return [done[key] for key in keys]


def _lent(executor: Executor, members: Mapping[str, Member]) -> Answers:
    """Let somebody else's executor run the members; it is left running.

    Raises:
        SlipwiseError: one of its processes was killed.
    """
    futures: dict[Future[Numbers], str] = {executor.submit(run_member, m): key for key, m in members.items()}
    try:
        for future in as_completed(futures):
            yield futures[future], future.result()
    except BrokenExecutor as error:
        raise SlipwiseError(
            f"the executor that runs the ensemble has broken ({error}): a process of it may have been out of memory. "
            "What is finished is kept; give a new executor, and the same call goes on from there"
        ) from error
    finally:
        for future in futures:
            future.cancel()


def _keep(path: Path, entry: dict[str, Any]) -> None:
    """Write a finished member to the disk, all of its line or nothing.

    Raises:
        OutputError: it cannot be written.
    """
    line = json.dumps(entry, allow_nan=False).encode() + b"\n"
    try:
        with path.open("ab", buffering=0) as stream:
            whole = stream.tell()
            try:
                while line:
                    line = line[stream.write(line) :]
                os.fsync(stream.fileno())
            except BaseException:
                stream.truncate(whole)
                raise
    except OSError as error:
        raise cannot_write(path, error) from error


def _kept(path: Path) -> dict[str, Numbers]:
    """Read what is finished; cut off a last line that a kill has torn."""
    if not path.exists():
        return {}
    whole, newline, torn = path.read_bytes().rpartition(b"\n")
    if torn:
        with path.open("r+b") as stream:
            stream.truncate(len(whole) + len(newline))
    done = {}
    for line in whole.splitlines():
        try:
            entry = json.loads(line)
            done[entry["key"]] = entry["numbers"]
        except (ValueError, KeyError, TypeError):
            raise InputError(f"{path}: this is no file of an ensemble; remove it or choose another --out") from None
    return done
