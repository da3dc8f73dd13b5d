"""Processes on this machine for the replays of an ensemble: one that is killed is no loss but of time.

When a process is killed, its pool ends, and which replay it had in hand is not known. So no more replays are handed out
than there are processes; those in hand are each tried again in a process of their own, and one that kills this too is
named.
"""

import multiprocessing
from collections.abc import Callable, Generator, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from itertools import islice
from multiprocessing import resource_tracker
from typing import Any, TypeVar

from slipwise.errors import SlipwiseError
from slipwise.interruption import unheard_by_children
from slipwise.parallel import begin_worker

Job = TypeVar("Job")
Answers = Generator[tuple[str, Any], None, None]


def finished(work: Callable[[Job], Any], jobs: Mapping[str, Job], workers: int) -> Answers:
    """Give (key, work(job)) for every job, as soon as it is finished.

    Raises:
        SlipwiseError: a job has killed two processes.
        Exception: what `work` raises.
    """
    left = dict(jobs)
    while left:
        in_hand = yield from _until_one_is_killed(work, left, workers)
        for key in in_hand:
            yield key, _alone(work, left.pop(key))


def _until_one_is_killed(
    work: Callable[[Job], Any], left: dict[str, Job], workers: int
) -> Generator[tuple[str, Any], None, list[str]]:
    """Take what is finished from `left`; give the keys of those in hand when a process was killed."""
    waiting = iter(list(left.items()))
    in_hand: dict[Future[Any], str] = {}
    with _pool(min(workers, len(left))) as pool:
        while True:
            with suppress(BrokenProcessPool), unheard_by_children():  # those in hand will say so too
                for key, job in islice(waiting, workers - len(in_hand)):
                    in_hand[pool.submit(work, job)] = key
            if not in_hand:
                return []
            for future in wait(in_hand, return_when=FIRST_COMPLETED).done:
                if isinstance(future.exception(), BrokenProcessPool):
                    return list(in_hand.values())
                key = in_hand.pop(future)
                del left[key]
                yield key, future.result()


def _alone(work: Callable[[Job], Any], job: Job) -> Any:
    """Do one job in a process of its own.

    Raises:
        SlipwiseError: that was killed too.
    """
    try:
        with _pool(1) as pool:
            with unheard_by_children():
                future = pool.submit(work, job)
            return future.result()
    except BrokenProcessPool:
        raise SlipwiseError(
            f"the replay of {job} has ended two processes before it was done: it may have been out of memory. "
            "What is finished is kept; close other programs or take fewer processes (--workers 1), and the same "
            "command goes on from there"
        ) from None


@contextmanager
def _pool(workers: int) -> Iterator[ProcessPoolExecutor]:
    """Make processes that end with this block, at once if it fails, and with their parent, even if that is killed."""
    others = set(multiprocessing.active_children())
    context = multiprocessing.get_context("spawn")
    resource_tracker.ensure_running()  # the first process would start it, and it lets all signals through again
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=begin_worker)
    try:
        yield pool
    except BaseException:
        for child in set(multiprocessing.active_children()) - others:
            child.kill()
        raise
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
