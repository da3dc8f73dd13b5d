"""A signal ends the program wherever it comes, also while Python tidies up after an object."""

import os
import signal
import time

import pytest

from slipwise.jobs.interruption import Stopped, stoppable


class Finalised:
    """Is sent a signal while its finaliser is at work."""

    def __del__(self) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.001)


def test_a_signal_while_a_finaliser_is_at_work_is_not_lost():
    """Without a second try one of eleven was: Python ignores what is raised in a finaliser."""
    ignored = signal.signal(signal.SIGINT, signal.default_int_handler)  # as it is where a shell runs this behind itself
    for _ in range(5):
        with pytest.raises(Stopped) as stop, stoppable():
            one = Finalised()
            del one
            time.sleep(5.0)
        assert stop.value.code == 130
    signal.signal(signal.SIGINT, ignored)


def test_what_else_a_finaliser_raises_is_told_as_ever(monkeypatch):
    told = []
    monkeypatch.setattr("sys.unraisablehook", told.append)

    class Broken:
        def __del__(self) -> None:
            raise ValueError("broken")

    with stoppable():
        one = Broken()
        del one
    assert [type(what.exc_value) for what in told] == [ValueError]
