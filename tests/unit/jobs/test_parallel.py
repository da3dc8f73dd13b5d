"""Work on every core gives the answers of work on one, in order, and its errors."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from slipwise.errors import InputError, SlipwiseError
from slipwise.jobs import parallel as cores
from slipwise.jobs.atomic_write import written_beside
from slipwise.jobs.parallel import on_every_core
from slipwise.model import base_model
from slipwise.simulation.predict import predictor

FORKED = multiprocessing.get_context("fork")
#: Nobody waits so long unless something is wrong [s].
LONG = 60.0


@pytest.mark.parametrize("count", [1, 2, 4])
def test_answers_come_in_order_whatever_the_number_of_cores(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: count)
    seen = [10, 20, 30, 40, 50]
    assert list(on_every_core(lambda i: seen[i], len(seen))) == seen


@pytest.mark.parametrize("count", [2, 4])
def test_each_core_takes_its_part(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: count)
    meeting = FORKED.Barrier(count)

    def work(place: int) -> int:
        if place < count:
            meeting.wait(LONG)
        return os.getpid()

    processes = set(list(on_every_core(work, 3 * count))[:count])
    assert len(processes) == count and os.getpid() in processes


def test_work_that_takes_much_memory_is_done_one_after_another(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    meeting = FORKED.Barrier(2)
    beside = on_every_core(lambda _: (meeting.wait(LONG), os.getpid())[1], 2, memory=cores.ROOM // 2)
    after = on_every_core(lambda _: os.getpid(), 4, memory=cores.ROOM // 2 + 1)
    assert len(set(beside)) == 2 and set(after) == {os.getpid()}


def test_what_is_asked_of_work_at_work_is_done_where_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """Children of children would fight for the cores, and those of the one who asked would too."""
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1})
    inner = on_every_core(lambda i: (os.getpid(), set(on_every_core(lambda j: os.getpid(), 3))), 4)
    assert all(beside == {process} for process, beside in inner)


def test_work_of_a_child_that_was_killed_is_done_by_another_one(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    here, meeting = os.getpid(), FORKED.Barrier(2)

    def work(place: int) -> np.ndarray:
        if os.getpid() != here and not (tmp_path / "killed").exists():
            (tmp_path / "killed").touch()
            meeting.wait(LONG)
            os.kill(os.getpid(), signal.SIGKILL)
        if not (tmp_path / "met").exists():
            (tmp_path / "met").touch()
            meeting.wait(LONG)
        return np.full(1000, place)

    answers = list(on_every_core(work, 5))
    assert (tmp_path / "killed").exists()
    assert [answer.tolist() for answer in answers] == [[place] * 1000 for place in range(5)]


def test_work_that_kills_two_children_is_an_error_that_names_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    here, begun = os.getpid(), tmp_path / "begun"

    def work(place: int) -> int:
        if os.getpid() != here:
            begun.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        while not begun.exists():
            time.sleep(0.01)
        return place

    with pytest.raises(SlipwiseError, match=r"part [1-4] of 4 of the work on test_parallel .*SIGKILL.*memory.*taskset"):
        list(on_every_core(work, 4))
    begun.unlink()
    with pytest.raises(SlipwiseError, match="of the work on the pictures"):
        list(on_every_core(work, 4, "the pictures"))


class LongFinaliser:
    """Is at work on its finaliser while the process is asked to end: Python ignores what is raised there."""

    def __init__(self, begins: Callable[[float], object]) -> None:
        self.begins = begins

    def __del__(self) -> None:
        self.begins(LONG)
        time.sleep(0.5)


@pytest.mark.parametrize("finalises", [False, True])
def test_a_child_that_is_ended_tidies_up(
    finalises: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    here, meeting = os.getpid(), FORKED.Barrier(2)

    def work(place: int) -> None:
        if place > 1:
            return
        if os.getpid() == here:
            meeting.wait(LONG)
            return
        with written_beside(tmp_path / "picture.png"):
            if finalises:
                one = LongFinaliser(meeting.wait)
                del one
            else:
                meeting.wait(LONG)
            time.sleep(LONG)

    asked = on_every_core(work, 3)
    began = time.monotonic()
    monkeypatch.setattr(cores, "_alone", interrupted_after(cores._alone))
    with pytest.raises(KeyboardInterrupt):
        list(asked)
    assert time.monotonic() - began < cores._GRACE + LONG / 2
    assert list(tmp_path.iterdir()) == [] and not multiprocessing.active_children()
    assert capfd.readouterr().err == ""


def interrupted_after(do: Callable[..., object]) -> Callable[..., object]:
    def done_and_interrupted(*arguments: object) -> None:
        do(*arguments)
        raise KeyboardInterrupt

    return done_and_interrupted


def test_an_answer_that_cannot_be_sent_is_an_error_and_one_that_nobody_waits_for_leaves_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    here, meeting = os.getpid(), FORKED.Barrier(2)

    def work(place: int) -> object:
        meeting.wait(LONG)
        return place if os.getpid() == here else lambda: place

    with pytest.raises((AttributeError, pickle.PicklingError), match="lambda"):
        list(on_every_core(work, 2))
    before = len(os.listdir("/proc/self/fd"))
    again = FORKED.Barrier(2)

    def slow(place: int) -> None:
        if place < 2:
            again.wait(LONG)
        if place and os.getpid() != here:
            time.sleep(LONG)

    asked = on_every_core(slow, 3)
    next(asked)
    asked.close()
    assert not multiprocessing.active_children()
    assert len(os.listdir("/proc/self/fd")) <= before  # what another test has left may be closed meanwhile


def test_arrays_of_answers_are_whole_and_ones_own_however_large_and_however_they_lie(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    large = np.arange(300_000.0).reshape(1000, 300)

    def work(place: int) -> dict[str, object]:
        return {"rows": large + place, "columns": np.asfortranarray(large[:, place:]), "none": np.empty((0, 3)), "n": 3}

    before = len(os.listdir("/proc/self/fd"))
    for place, answer in enumerate(list(on_every_core(work, 4))):
        rows, columns, none = answer["rows"], answer["columns"], answer["none"]
        assert isinstance(rows, np.ndarray) and isinstance(columns, np.ndarray) and isinstance(none, np.ndarray)
        np.testing.assert_array_equal(rows, large + place)
        np.testing.assert_array_equal(columns, large[:, place:])
        rows[:] = 0.0
        columns *= 2.0
        np.testing.assert_array_equal(columns, 2.0 * large[:, place:])
        assert none.shape == (0, 3) and answer["n"] == 3
    assert len(os.listdir("/proc/self/fd")) <= before  # what another test has left may be closed meanwhile


def test_where_no_file_in_memory_is_allowed_one_on_disk_does(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(name: str) -> int:
        raise OSError("not here")

    monkeypatch.setattr(cores, "_cores", lambda: 2)
    monkeypatch.setattr(os, "memfd_create", refused)
    answers = list(on_every_core(lambda i: np.full(100_000, float(i)), 3))
    assert [(len(a), a[0], a[-1]) for a in answers] == [(100_000, float(i), float(i)) for i in range(3)]


def test_answers_without_arrays_and_with_empty_ones_come_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    answers = list(on_every_core(lambda i: (None, np.empty(0), "x" * i), 3))
    assert [(n, a.shape, t) for n, a, t in answers] == [(None, (0,), ""), (None, (0,), "x"), (None, (0,), "xx")]


def test_a_child_keeps_to_one_thread_of_linear_algebra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    with threadpool_limits(2):
        threads = on_every_core(lambda i: [library["num_threads"] for library in threadpool_info()], 2)
        assert all(set(each) == {1} for each in threads)


def test_a_worker_that_has_loaded_nothing_yet_keeps_to_one_thread_too() -> None:
    """A limit reaches only libraries that are there: workers that were limited first took two threads each later."""
    asked = (
        "from slipwise.jobs.parallel import begin_worker; begin_worker(); import slipwise.diagnosis.diagnose;"
        "import threadpoolctl;"
        "print({library['num_threads'] for library in threadpoolctl.threadpool_info()})"
    )
    # the variable would do it too
    free = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    done = subprocess.run([sys.executable, "-c", asked], env=free, capture_output=True, text=True, check=True)
    assert done.stdout == "{1}\n"


def test_an_error_of_a_child_is_an_error_here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_cores", lambda: 2)

    here, meeting = os.getpid(), FORKED.Barrier(2)

    def work(place: int) -> int:
        if place < 2:
            meeting.wait(LONG)
        if os.getpid() == here:
            return place
        raise InputError(f"no {place}: give another")

    with pytest.raises(InputError) as raised:
        list(on_every_core(work, 3))
    assert str(raised.value) in {f"no {place}: give another" for place in range(3)}
    assert "in work" in raised.value.__notes__[0]


def test_a_law_runs_in_a_child_although_its_parent_has_run_it_with_two_threads(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The second thread stays with the parent: a child that waited for it would wait for ever."""

    def force(scale: int) -> float:
        law = predictor(base_model("bridge1"))
        load, slip = np.full((50, 4), 5e4 * (scale + 1)), np.zeros((50, 4, 2))
        velocity = np.full((50, 4, 2), 0.1)
        return float(law.pads(np.linspace(0.0, 0.049, 50), load, velocity, slip).force.sum())

    here = [force(0), force(1)]
    monkeypatch.setattr(cores, "_cores", lambda: 2)
    assert list(on_every_core(force, 2)) == here
