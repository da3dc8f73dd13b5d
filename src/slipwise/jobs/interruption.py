"""Ctrl-C and the signals that ask a program to end, as an exception: what is half-done is tidied up on its way."""

import _thread
import ctypes
import multiprocessing
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from slipwise.jobs.child_processes import on_a_safe_path

#: Ctrl-C, `kill` and a terminal that is closed; not every system has all of them.
_ASKING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
#: A signal that follows another one so soon [s] is the same: it must not disturb the tidying up.
_SAME = 1.0
#: Time after which a signal that came while a finaliser was at work comes again [s].
_AGAIN = 0.02
#: Time in which a child that was asked to end has to [s].
_GRACE = 2.0


class Stopped(BaseException):
    """Somebody asked this program to end. No `Exception`, so that nobody takes it for a failure of the work.

    Attributes:
        number: of the signal.
    """

    def __init__(self, number: int) -> None:
        name = signal.Signals(number).name
        super().__init__(f"interrupted ({name}): finished files are kept, and nothing half-written is left")
        self.number = number

    @property
    def code(self) -> int:
        """Exit code by which a shell knows the signal: 130 for Ctrl-C, 143 for `kill`."""
        return 128 + self.number


@contextmanager
def stoppable() -> Iterator[None]:
    """Let signals raise `Stopped` in the main thread; what somebody told this program to ignore stays ignored.

    Python ignores what is raised while a finaliser is at work, and tells a hook of it: the signal is then sent again.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    last = -_SAME

    def stop(number: int, frame: FrameType | None) -> None:
        nonlocal last
        before, last = last, time.monotonic()
        if last - before >= _SAME:
            raise Stopped(number)

    def ignored(what: "sys.UnraisableHookArgs") -> None:
        nonlocal last
        if isinstance(what.exc_value, Stopped):
            last = -_SAME
            _thread.start_new_thread(_send_again, (signal.Signals(what.exc_value.number), stop))
        else:
            told(what)

    ordinary = (signal.SIG_DFL, signal.default_int_handler)
    before: dict[int, Any] = {n: signal.getsignal(n) for n in _ASKING if signal.getsignal(n) in ordinary}
    told, sys.unraisablehook = sys.unraisablehook, ignored
    try:
        for number in before:
            signal.signal(number, stop)
        yield
    finally:
        sys.unraisablehook = told
        for number, handler in before.items():
            signal.signal(number, handler)


def _send_again(number: signal.Signals, handler: Callable[[int, FrameType | None], None]) -> None:
    """Send the main thread a signal when a finaliser will be over; if it is not, the hook asks for this once more."""
    time.sleep(_AGAIN)
    if signal.getsignal(number) is not handler:  # the program is ending already
        return
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, number)
    else:
        _thread.interrupt_main(number)


class CalledOff(BaseException):
    """Raised inside the work of a thread that nobody waits for any more."""


def call_off_thread(thread: int) -> None:
    """Raise `CalledOff` in a thread at its next step; a finaliser that is at work there swallows it: then ask again.

    Args:
        thread: its identifier, as `threading.get_ident` gives it; nothing happens where it has ended.
    """
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(CalledOff))


@contextmanager
def unheard_by_children() -> Iterator[None]:
    """Start processes on which no signal breaks in before they are ready; each then calls `let_parent_hear`.

    They are on a safe path, as `child_processes` has it.
    """
    with on_a_safe_path(), _without_signals():
        yield


@contextmanager
def _without_signals() -> Iterator[None]:
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _ASKING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def let_parent_hear() -> None:
    """Leave Ctrl-C to the parent of this process, which ends it without a traceback; obey `kill` again."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ASKING)


def end_children() -> None:
    """End all processes that this one has started by `multiprocessing`, first by asking."""
    children = multiprocessing.active_children()
    for child in children:
        child.terminate()
    deadline = time.monotonic() + _GRACE
    for child in children:
        child.join(max(deadline - time.monotonic(), 0.0))
        child.kill()
        child.join()
