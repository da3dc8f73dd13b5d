"""Many independent jobs through one interface: here, in processes of this machine, or on somebody else's cluster.

An executor is one of `concurrent.futures`. Every finished job is one line of a file, written by one process, flushed to
the disk before the next, and only what is missing is run. Few jobs are handed out ahead and results stay in the file,
so that memory does not grow with them.
"""

import os
import threading
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import closing, contextmanager
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Any

from slipwise.errors import InputError, SettingError, SlipwiseError, cannot_write
from slipwise.jobs.job_log import Finished, Numbers, add_line, read_places
from slipwise.jobs.worker_processes import finished

Answers = Generator[tuple[str, Numbers], None, None]
#: Jobs that are handed out before the first of them is back: enough for any cluster, few enough to be held.
_AHEAD = 1000
#: MuJoCo's callbacks are global to a process: an executor of threads gains nothing, but it works.
ONE_AT_A_TIME = threading.Lock()


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
        OutputError: it cannot be written.
        SettingError: no worker.
        SlipwiseError: processes were killed. What is finished is kept.
    """
    workers = checked_workers(workers)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise cannot_write(path.parent, error) from error
    places = read_places(path, lasting)
    missing: dict[str, int] = {}
    for place, key in enumerate(keys):
        if key not in places:
            missing.setdefault(key, place)
    total = len(set(keys))
    tell = progress or (lambda done, count: None)
    tell(total - len(missing), total)
    if not missing:
        return Finished(path, places, 0)
    jobs = ((key, job(place)) for key, place in missing.items())
    if executor is not None:
        answers = _lent(executor, work, jobs)
    elif (workers := min(workers, len(missing))) == 1:
        answers = ((key, work(one)) for key, one in jobs)
    else:
        answers = finished(work, jobs, workers)
    with closing(answers), path.open("ab", buffering=0) as stream:
        for number, (key, numbers) in enumerate(answers, start=1):
            places[key] = add_line(stream, key, numbers)
            tell(total - len(missing) + number, total)
    return Finished(path, places, len(missing))


def _lent(executor: Executor, work: Callable[[Any], Numbers], jobs: Iterator[tuple[str, Any]]) -> Answers:
    """Let somebody else's executor do the jobs; it is left running.

    Raises:
        SlipwiseError: one of its processes was killed.
    """
    in_hand: dict[Future[Numbers], str] = {}
    try:
        while True:
            for key, job in islice(jobs, _AHEAD - len(in_hand)):
                future = executor.submit(work, job)
                if future.done():
                    yield key, future.result()
                else:
                    in_hand[future] = key
            if not in_hand:
                return
            for future in wait(in_hand, return_when=FIRST_COMPLETED).done:
                yield in_hand.pop(future), future.result()
    except BrokenExecutor as error:
        raise SlipwiseError(
            f"the executor that runs the jobs has broken ({error}): a process of it may have been out of memory. "
            "What is finished is kept; give a new executor, and the same call goes on from there"
        ) from error
    finally:
        for future in in_hand:
            future.cancel()


def checked_workers(given: int | None) -> int:
    """Return the number of workers: as many as there are cores when not given.

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
