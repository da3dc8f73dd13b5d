"""Independent work on every core: children are forked, so they have what is there, and only answers come back."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import Any, TypeVar

import numpy.linalg  # noqa: F401  of a library that is not loaded yet no threads can be taken away
import scipy.linalg  # noqa: F401
from threadpoolctl import threadpool_limits

Answer = TypeVar("Answer")
#: What the children of this moment are to do: a function that was made here cannot be sent to them.
_WORK: list[Callable[[int], Any]] = []


def on_every_core(work: Callable[[int], Answer], count: int) -> Iterator[Answer]:
    """Give work(0), work(1), ... in order; each answer must be one that can be pickled.

    Work is done here, one after another, where there is one core, where a process cannot be forked safely (Windows,
    macOS), and in a process that another has started: that one keeps its cores busy itself.

    Raises:
        Exception: what `work` raises.
    """
    workers = min(_cores(), count)
    if workers < 2:
        yield from map(work, range(count))
        return
    _WORK.append(work)
    forked = multiprocessing.get_context("fork")
    try:
        with ProcessPoolExecutor(workers, mp_context=forked, initializer=_begin_as_child) as pool:
            yield from pool.map(_at, range(count))
    finally:
        _WORK.pop()


def begin_worker() -> None:
    """Keep to one core, and leave when the parent is gone.

    A worker's linear algebra would take a thread for each core too, and wait for the others': a diagnosis took up to
    three times as long. One whose parent was killed would wait for ever.
    """
    threadpool_limits(1)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=lambda: (parent.join(), os._exit(1)), daemon=True).start()


def _begin_as_child() -> None:
    """Finish at Ctrl-C what was begun, without a traceback."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    begin_worker()


def _at(place: int) -> Any:
    return _WORK[-1](place)


def _cores() -> int:
    if multiprocessing.parent_process() is not None or not sys.platform.startswith("linux"):
        return 1
    return len(os.sched_getaffinity(0))
