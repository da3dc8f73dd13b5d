"""Independent work on every core: children are forked, so they have what is there, and only answers come back.

The slopes of a fit are tens of megabytes. Through a pipe they took as long as a third of a short fit, so answers come
back through files in memory. Whoever asks works too: its own answers need no way back. What a child has left undone
that was killed, most often for lack of memory, another one does alone.
"""

import multiprocessing
import os
import pickle
import signal
import sys
import tempfile
import threading
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from io import BufferedRandom
from mmap import mmap
from multiprocessing.context import ForkProcess
from multiprocessing.process import BaseProcess
from typing import Any, TypeVar, cast

import numpy.linalg  # noqa: F401  of a library that is not loaded yet no threads can be taken away
import scipy.linalg  # noqa: F401
from threadpoolctl import ThreadpoolController, threadpool_limits

from slipwise.errors import CacheWarning, SlipwiseError
from slipwise.jobs.interruption import Stopped, let_parent_hear, stoppable, unheard_by_children

Answer = TypeVar("Answer")
#: Bytes that pieces of work may take side by side.
ROOM = 512 * 2**20
#: Bytes in which a place is written.
_PLACE = 4
#: Time in which a child that is asked to end removes what it has half written, before it is killed [s].
_GRACE = 2.0
#: Set while this process does its share: what that asks to be done on every core is done on this one.
_AT_WORK = threading.Event()
#: Set in a process that was started to do heavy work for one that only waits: the cores are its own.
_OWN_CORES = threading.Event()
#: Whose threads are taken away and given back: to look for them takes longer than many a piece of work.
_LIBRARIES = ThreadpoolController()


@contextmanager
def one_thread_algebra() -> Iterator[None]:
    """Let linear algebra use the thread that asks only, as a context or a decorator.

    The matrices of a fit are small: a second thread that another program keeps from its core makes the first one spin,
    and a diagnosis of 30 s took 57 to 111 s beside a busy program.
    """
    with _LIBRARIES.limit(limits=1):
        yield


@dataclass(frozen=True)
class _Outcome:
    """What became of one piece of work."""

    answer: Any = None
    error: Exception | None = None


@dataclass(frozen=True)
class _Shared:
    """What a process and its children have in common while they work.

    Attributes:
        left: places that nobody has taken; they share how far it was read, so that each is taken once.
        outcomes: a file for each place.
        done: a byte for each place, 1 where what a child has written is whole.
    """

    left: BufferedRandom
    outcomes: list[BufferedRandom]
    done: mmap

    def places(self) -> Iterator[int]:
        """Take one place after another until none is left."""
        while taken := os.read(self.left.fileno(), _PLACE):
            yield int.from_bytes(taken, "big")

    def put(self, place: int, outcome: _Outcome) -> None:
        """Write an outcome: what it is without its arrays, then those."""
        arrays: list[pickle.PickleBuffer] = []
        said = pickle.dumps(outcome, protocol=5, buffer_callback=arrays.append)
        file = self.outcomes[place]
        file.seek(0)  # a child that was killed may have begun to write here
        file.truncate()
        raws = [array.raw() for array in arrays]
        pickle.dump((said, [raw.nbytes for raw in raws]), file)
        for raw in raws:
            file.write(raw)
        file.flush()
        self.done[place] = 1

    def read(self, place: int) -> _Outcome:
        """Read what a child has written; arrays are one's own and may be written to."""
        file = self.outcomes[place]
        file.seek(0)
        said, sizes = pickle.load(file)
        arrays = [bytearray(size) for size in sizes]
        for array in arrays:
            file.readinto(array)
        return pickle.loads(said, buffers=arrays)


def on_every_core(work: Callable[[int], Answer], count: int, what: str = "", *, memory: int = 0) -> Iterator[Answer]:
    """Yield work(0), work(1), ... in order; each answer must be one that can be pickled.

    Work is done here, one after another, where there is one core, where a process cannot be forked safely (Windows,
    macOS), and in a process that another has started: that one keeps its cores busy itself.

    Args:
        work: what is done at a place.
        count: of places.
        what: the name of this work in an error; that of its module if not given.
        memory: that each piece of work takes [bytes]. Where all cores together would take more than `ROOM`, it is done
            one after another: a fit shares its columns out itself then.

    Raises:
        SlipwiseError: a child was killed, and so was the one that tried again.
        Exception: what `work` raises.
    """
    workers = min(_cores(), count)
    if workers < 2 or workers * memory > ROOM:
        yield from map(work, range(count))
        return
    with ExitStack() as ends:
        left, *outcomes = [ends.enter_context(_file()) for _ in range(count + 1)]
        left.write(b"".join(place.to_bytes(_PLACE, "big") for place in range(count)))
        left.seek(0)
        shared = _Shared(left, outcomes, ends.enter_context(mmap(-1, count)))
        children = [ends.enter_context(_child(work, shared, shared.places())) for _ in range(workers - 1)]
        own: dict[int, _Outcome] = {}
        given = 0
        for place in shared.places():
            own[place] = _alone(work, place)
            while given in own or (given < count and shared.done[given]):
                yield _answer(own.pop(given, None) or shared.read(given))
                given += 1
        for place in range(given, count):
            if place not in own and not shared.done[place]:
                for child in children:
                    child.join()
            if place not in own and not shared.done[place]:
                _again(work, shared, place, what or work.__module__.rpartition(".")[2])
            yield _answer(own.pop(place, None) or shared.read(place))


def _again(work: Callable[[int], Any], shared: _Shared, place: int, what: str) -> None:
    """Let a fresh child do what a child that was killed has left undone, when no other one takes memory.

    Raises:
        SlipwiseError: that child was killed too.
    """
    with _child(work, shared, iter([place])) as child:
        child.join()
    if not shared.done[place]:
        raise SlipwiseError(
            f"part {place + 1} of {len(shared.outcomes)} of the work on {what} was killed twice ({ended(child)}): "
            "it may have been out of memory; close other programs, or keep to one core with `taskset -c 0 slipwise ...`"
        )


def ended(child: BaseProcess) -> str:
    """Say how a process has ended, e.g. "by SIGKILL"."""
    code = child.exitcode or 0
    return f"by {signal.Signals(-code).name}" if code < 0 else f"with exit code {code}"


def _answer(outcome: _Outcome) -> Any:
    if outcome.error is not None:
        raise outcome.error
    return outcome.answer


def _alone(work: Callable[[int], Any], place: int) -> _Outcome:
    """Do one piece of work on this core alone, as each child does."""
    _AT_WORK.set()
    try:
        with one_thread_algebra():
            return _Outcome(work(place))
    except Exception as error:
        return _Outcome(error=error)
    finally:
        _AT_WORK.clear()


@contextmanager
def _child(work: Callable[[int], Any], shared: _Shared, places: Iterator[int]) -> Iterator[ForkProcess]:
    """Begin a child that takes its part of the work; end it, however far it has come."""
    child = multiprocessing.get_context("fork").Process(target=_as_child, args=(work, shared, places))
    with unheard_by_children():
        child.start()
    try:
        yield child
    finally:
        child.terminate()
        child.join(_GRACE)
        child.kill()
        child.join()


def _as_child(work: Callable[[int], Any], shared: _Shared, places: Iterator[int]) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # not what the parent does then
    begin_worker()
    try:
        with stoppable():  # a child that its parent ends removes a file that it has half written
            for place in places:
                _do(work, shared, place)
    except Stopped as asked:
        sys.exit(asked.code)


def _do(work: Callable[[int], Any], shared: _Shared, place: int) -> None:
    try:
        shared.put(place, _Outcome(work(place)))
    except Exception as error:
        error.add_note("".join(traceback.format_exception(error)))
        try:
            shared.put(place, _Outcome(error=error))
        except OSError:  # no room even for that: the place stays undone
            sys.exit(1)


def begin_worker(*, own_cores: bool = False) -> None:
    """Keep to one core, leave Ctrl-C to the parent, and end when it is gone.

    A worker's linear algebra would take a thread for each core too, and wait for the others': a diagnosis took up to
    three times as long. One whose parent was killed would wait for ever.

    Args:
        own_cores: share work out on every core after all, for the parent does none.
    """
    let_parent_hear()
    warnings.simplefilter("ignore", CacheWarning)  # the parent says it
    threadpool_limits(1)
    (_OWN_CORES.set if own_cores else _OWN_CORES.clear)()
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=lambda: (parent.join(), os._exit(1)), daemon=True).start()


def _file() -> BufferedRandom:
    """Return a file in memory, or an unnamed one on disk where a sandbox allows no such thing."""
    try:
        return open(os.memfd_create("work"), "w+b")
    except OSError:
        return cast(BufferedRandom, tempfile.TemporaryFile())


def _cores() -> int:
    started = multiprocessing.parent_process() is not None and not _OWN_CORES.is_set()
    if _AT_WORK.is_set() or started or not sys.platform.startswith("linux"):
        return 1
    return len(os.sched_getaffinity(0))
