"""Many replays at once: on all cores or on somebody else's, resumable, each member run once.

Every finished member is one line of `members.jsonl`, written by one process, flushed to the disk before the next. After
a kill the lines that are whole count, a torn last line is cut off, and only what is missing is run.
"""

import json
import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from slipwise.errors import InputError
from slipwise.parallel import begin_worker
from slipwise.studies.paper.member import Member, run_member

Numbers = dict[str, Any]


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
    """
    keys = [member.key() for member in members]
    path = folder / "members.jsonl"
    folder.mkdir(parents=True, exist_ok=True)
    done = _kept(path)
    wanted = dict(zip(keys, members, strict=True))
    missing = {key: member for key, member in wanted.items() if key not in done}
    count = len(wanted)

    def tell() -> None:
        if progress is not None and count:
            progress(1.0 - len(missing.keys() - done.keys()) / count)

    tell()
    if missing:
        with _pool(executor, min(workers or os.cpu_count() or 1, len(missing))) as pool, path.open("a") as stream:
            futures: dict[Future[Numbers], str] = {pool.submit(run_member, m): key for key, m in missing.items()}
            try:
                for future in as_completed(futures):
                    key = futures[future]
                    done[key] = future.result()
                    stream.write(json.dumps({"key": key, "numbers": done[key]}, allow_nan=False) + "\n")
                    stream.flush()
                    os.fsync(stream.fileno())
                    tell()
            finally:
                for future in futures:
                    future.cancel()
    return [done[key] for key in keys]


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


@contextmanager
def _pool(given: Executor | None, workers: int) -> Iterator[Executor]:
    """Lend the given executor, or make processes that end with their parent, even if that is killed."""
    if given is not None:
        yield given
        return
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=begin_worker)
    try:
        yield pool
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
