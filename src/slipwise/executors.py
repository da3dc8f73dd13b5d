"""Many independent jobs through one interface: here, in processes of this machine, or on somebody else's cluster.

An executor is one of `concurrent.futures`. Every finished job is one line of a file, written by one process, flushed to
the disk before the next. After a kill the lines that are whole count, a torn last line is cut off, and only what is
missing is run. Few jobs are handed out ahead and results stay in the file, so that memory does not grow with them.
"""

import hashlib
import json
import multiprocessing
import os
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import slipwise
from slipwise.errors import InputError, SettingError
from slipwise.parallel import begin_worker

Numbers = dict[str, Any]
#: Jobs that are handed out before the first of them is back: enough for any cluster, few enough to be held.
_AHEAD = 1000
#: MuJoCo's callbacks are global to a process: an executor of threads gains nothing, but it works.
ONE_AT_A_TIME = threading.Lock()


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


class Here(Executor):
    """Runs each job at once in this process, which may use every core for it."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Run it; what it raises is raised here."""
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def run_all(
    work: Callable[[Any], Numbers],
    keys: Sequence[str],
    job: Callable[[int], Any],
    path: Path,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
    lasting: Callable[[Numbers], bool] | None = None,
) -> Finished:
    """Run the jobs that have not been run yet.

    Args:
        work: turns a job into numbers that JSON holds exactly; for processes it stands at the top of a module.
        keys: of the jobs, each a hash of everything that decides its result; jobs of one key are run once.
        job: gives the job at a place of `keys`.
        path: of the file with one line for each finished job; it and its folder are made if absent.
        executor: any of `concurrent.futures`, also a cluster's; it is left running. When not given: this process for
            one worker, processes of this machine for several.
        workers: when no executor is given; as many as there are cores when not given.
        progress: called with how many of how many are finished.
        lasting: tells whether numbers count as finished; others are run again by the next call. All do when not given.

    Raises:
        InputError: the file was not written by such a run.
        SettingError: no worker.
    """
    workers = checked_workers(workers)
    path.parent.mkdir(parents=True, exist_ok=True)
    places = _kept(path, lasting)
    missing: dict[str, int] = {}
    for place, key in enumerate(keys):
        if key not in places:
            missing.setdefault(key, place)
    total = len(set(keys))
    tell = progress or (lambda done, count: None)
    tell(total - len(missing), total)
    if not missing:
        return Finished(path, places, 0)
    running: dict[Future[Numbers], str] = {}
    with _pool(executor, min(workers, len(missing))) as pool, path.open("ab") as stream:
        finished = 0

        def write(done: Iterable[Future[Numbers]]) -> None:
            nonlocal finished
            for future in done:
                key = running.pop(future)
                line = json.dumps({"key": key, "numbers": future.result()}, allow_nan=False)
                places[key] = stream.tell()
                stream.write(line.encode() + b"\n")
                stream.flush()
                os.fsync(stream.fileno())
                finished += 1
                tell(total - len(missing) + finished, total)

        try:
            for key, place in missing.items():
                future = pool.submit(work, job(place))
                running[future] = key
                if future.done():
                    write([future])
                elif len(running) >= _AHEAD:
                    write(wait(running, return_when=FIRST_COMPLETED).done)
            while running:
                write(wait(running, return_when=FIRST_COMPLETED).done)
        finally:
            for future in running:
                future.cancel()
    return Finished(path, places, len(missing))


def checked_workers(given: int | None) -> int:
    """Give the number of workers: as many as there are cores when not given.

    Raises:
        SettingError: fewer than one.
    """
    if given is not None and given < 1:
        raise SettingError(f"{given} workers can do nothing; give 1 or more, or nothing for one on each core")
    return given or os.cpu_count() or 1


@contextmanager
def on_cluster(address: str) -> Iterator[Executor]:
    """Lend the executor of a dask scheduler, e.g. of "tcp://host:8786".

    Raises:
        InputError: dask is not installed, or nothing answers at the address.
    """
    try:
        distributed = import_module("distributed")
    except ModuleNotFoundError:
        raise InputError('--cluster needs dask: pip install "slipwise[cluster]"') from None
    try:
        client = distributed.Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise InputError(
            f"--cluster {address}: no scheduler answers there ({error}); `dask scheduler` prints the address of one"
        ) from None
    with client:
        yield client.get_executor()


@cache
def hash_of_code(*patterns: str) -> str:
    """Give a hash of files of this package: results of older code must not be taken for new ones.

    Args:
        patterns: as `Path.glob` reads them, from the package's folder.
    """
    package = Path(slipwise.__file__).parent
    files = sorted({path for pattern in patterns for path in package.glob(pattern)})
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:16]


def _kept(path: Path, lasting: Callable[[Numbers], bool] | None) -> dict[str, int]:
    """Read where each finished job stands; cut off a last line that a kill has torn."""
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


@contextmanager
def _pool(given: Executor | None, workers: int) -> Iterator[Executor]:
    """Lend the given executor, or make processes that end with their parent, even if that is killed."""
    if given is not None or workers == 1:
        yield given or Here()
        return
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=begin_worker)
    try:
        yield pool
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
