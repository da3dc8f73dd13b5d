"""Processes on this machine for many jobs: one that is killed is no loss but of time.

When a process is killed, its pool ends, and which job it had in hand is not known, nor which were begun at all. So no
more jobs are handed out than there are processes; those in hand are each tried again in a process of their own, twice
if need be, and one that kills both is named.
"""

import multiprocessing
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice
from multiprocessing import resource_tracker
from typing import Any, TypeVar

from slipwise.errors import SlipwiseError
from slipwise.jobs.interruption import unheard_by_children
from slipwise.jobs.parallel import begin_worker

Job = TypeVar("Job")
#: (key, job) of each job that a pool had in hand when one of its processes was killed.
_InHand = list[tuple[str, Any]]


def finished(
    work: Callable[[Job], Any], jobs: Iterator[tuple[str, Job]], workers: int
) -> Generator[tuple[str, Any], None, None]:
    """Yield (key, work(job)) for every job, as soon as it is finished.

    Args:
        work: stands at the top of a module.
        jobs: (key, job), taken one by one, when a process is free for it.
        workers: processes.

    Raises:
        SlipwiseError: a job has killed two processes that had nothing else to do.
        Exception: what `work` raises.
    """
    while in_hand := (yield from _until_one_is_killed(work, jobs, workers)):
        for key, job in in_hand:
            yield key, _alone(work, key, job)


def _until_one_is_killed(
    work: Callable[[Job], Any], jobs: Iterator[tuple[str, Job]], workers: int
) -> Generator[tuple[str, Any], None, _InHand]:
    """Take jobs until there is none; give those in hand when a process was killed."""
    in_hand: dict[Future[Any], tuple[str, Job]] = {}
    with _pool(workers) as pool:
        while True:
            for key, job in islice(jobs, workers - len(in_hand)):
                try:
                    with unheard_by_children():
                        in_hand[pool.submit(work, job)] = (key, job)
                except BrokenProcessPool:
                    return [*in_hand.values(), (key, job)]
            if not in_hand:
                return []
            for future in wait(in_hand, return_when=FIRST_COMPLETED).done:
                if isinstance(future.exception(), BrokenProcessPool):
                    return list(in_hand.values())
                yield in_hand.pop(future)[0], future.result()


def _alone(work: Callable[[Job], Any], key: str, job: Job) -> Any:
    """Do one job in a process of its own, in a second one if the first is killed.

    Raises:
        SlipwiseError: that was killed too.
    """
    for _ in range(2):
        try:
            with _pool(1) as pool:
                with unheard_by_children():
                    future = pool.submit(work, job)
                return future.result()
        except BrokenProcessPool:
            continue
    raise SlipwiseError(
        f"job {key} ({str(job):.200}) has ended two processes before it was done: it may have been out of memory. "
        "What is finished is kept; close other programs or take fewer processes (--workers 1), and the same "
        "command goes on from there"
    )


@contextmanager
def _pool(workers: int) -> Iterator[ProcessPoolExecutor]:
    """Make processes that end with this block, at once if it fails, and with their parent, even if that is killed."""
    others = set(multiprocessing.active_children())
    context = multiprocessing.get_context("spawn")
    with unheard_by_children():  # the first process would start it, and it lets all signals through again
        resource_tracker.ensure_running()
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=begin_worker)
    try:
        yield pool
    except BaseException:
        for child in set(multiprocessing.active_children()) - others:
            child.kill()
        raise
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
