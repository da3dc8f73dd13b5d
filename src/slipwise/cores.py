"""Independent work on every core: children are forked, so they have what is there, and only answers come back.

The slopes of a fit are tens of megabytes. Through a pipe they took as long as a third of a short fit, so arrays come
back through files in memory.
"""

import multiprocessing
import os
import pickle
import signal
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from io import BufferedRandom
from typing import Any, TypeVar, cast

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
    forked = multiprocessing.get_context("fork")
    shared = [_file() for _ in range(count)]
    _WORK.append(lambda place: _put(work(place), shared[place]))
    try:
        with ProcessPoolExecutor(workers, mp_context=forked, initializer=_begin_as_child) as pool:
            for place, (said, sizes) in enumerate(pool.map(_at, range(count))):
                yield _taken(said, sizes, shared[place])
    finally:
        _WORK.pop()
        for file in shared:
            file.close()


def _file() -> BufferedRandom:
    """Give a file in memory, or an unnamed one on disk where a sandbox allows no such thing."""
    try:
        return open(os.memfd_create("answer"), "w+b")
    except OSError:
        return cast(BufferedRandom, tempfile.TemporaryFile())


def _put(answer: object, file: BufferedRandom) -> tuple[bytes, list[int]]:
    """Write an answer's arrays to a file; gives the rest of it, and the arrays' sizes [bytes]."""
    arrays: list[pickle.PickleBuffer] = []
    said = pickle.dumps(answer, protocol=5, buffer_callback=arrays.append)
    sizes = []
    for array in arrays:
        with array.raw() as raw:
            sizes.append(raw.nbytes)
            file.write(raw)
    file.flush()
    return said, sizes


def _taken(said: bytes, sizes: list[int], file: BufferedRandom) -> Any:
    """Read an answer back, its arrays from the file; they are one's own and may be written to."""
    arrays = [bytearray(size) for size in sizes]
    file.seek(0)
    for array in arrays:
        file.readinto(array)
    return pickle.loads(said, buffers=arrays)


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
