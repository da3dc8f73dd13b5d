"""Many jobs through one interface: run once, kept on disk, resumed, and never all held at once."""

import json
from concurrent.futures import Executor, Future, ThreadPoolExecutor

import pytest

from slipwise.errors import InputError, SettingError
from slipwise.jobs import executors
from slipwise.jobs.executors import run_all


class Noting(Executor):
    """Runs at once, and remembers what it ran."""

    def __init__(self):
        self.ran = []

    def submit(self, fn, /, *args, **kwargs):
        self.ran.append(args[0])
        future: Future = Future()
        future.set_result(fn(*args, **kwargs))
        return future


class Late(Executor):
    """Finishes the oldest job only when a certain number is waiting, and remembers how many ever were."""

    def __init__(self, patience):
        self.patience, self.waiting, self.most = patience, [], 0

    def submit(self, fn, /, *args, **kwargs):
        future: Future = Future()
        self.waiting.append((future, fn, args))
        self.most = max(self.most, len(self.waiting))
        if len(self.waiting) >= self.patience:
            self.finish()
        return future

    def finish(self):
        future, fn, args = self.waiting.pop(0)
        future.set_result(fn(*args))


def square(x):
    return {"square": x * x}


def run(values, folder, **given):
    keys = [f"k{x}" for x in values]
    finished = run_all(square, keys, values.__getitem__, folder / "jobs.jsonl", **given)
    return [numbers["square"] for numbers in finished.numbers(keys)], finished.run


def test_results_come_in_the_order_of_the_keys_and_equal_keys_are_run_once(tmp_path):
    noting = Noting()
    assert run([3, 1, 3, 2], tmp_path, executor=noting) == ([9, 1, 9, 4], 3)
    assert noting.ran == [3, 1, 2]


def test_what_is_finished_is_not_run_again(tmp_path):
    run([1, 2], tmp_path, executor=Noting())
    noting = Noting()
    assert run([2, 5, 1], tmp_path, executor=noting) == ([4, 25, 1], 1)
    assert noting.ran == [5]


def test_a_line_torn_by_a_kill_is_cut_off_and_run_again(tmp_path):
    run([1, 2, 3], tmp_path, executor=Noting())
    path = tmp_path / "jobs.jsonl"
    path.write_bytes(path.read_bytes()[:-4])
    noting = Noting()
    assert run([1, 2, 3], tmp_path, executor=noting)[0] == [1, 4, 9]
    assert noting.ran == [3] and len(path.read_bytes().splitlines()) == 3


def test_what_does_not_last_is_run_again_and_the_newest_counts(tmp_path):
    run([2], tmp_path, executor=Noting())
    noting = Noting()
    assert run([2], tmp_path, executor=noting, lasting=lambda numbers: numbers["square"] > 4) == ([4], 1)
    assert noting.ran == [2]


def test_every_result_is_on_disk_before_the_next_job_is_run(tmp_path):
    path = tmp_path / "jobs.jsonl"
    seen = []

    def work(x):
        seen.append(len(path.read_bytes().splitlines()))
        return square(x)

    run_all(work, ["a", "b", "c"], [1, 2, 3].__getitem__, path, executor=Noting())
    assert seen == [0, 1, 2]


def test_only_so_many_jobs_are_handed_out_ahead(tmp_path, monkeypatch):
    monkeypatch.setattr(executors, "_AHEAD", 5)
    late = Late(4)
    monkeypatch.setattr(executors, "wait", lambda running, **_: late.finish() or _done(running))
    assert run(list(range(40)), tmp_path, executor=late)[0] == [x * x for x in range(40)]
    assert late.most <= 5


def _done(running):
    class Waited:
        done = {future for future in running if future.done()}

    return Waited


def test_progress_begins_with_what_was_finished_before_and_ends_at_all(tmp_path):
    run([1, 2], tmp_path, executor=Noting())
    seen = []
    run([1, 2, 3, 4, 4], tmp_path, executor=Noting(), progress=lambda done, total: seen.append((done, total)))
    assert seen == [(2, 4), (3, 4), (4, 4)]


def test_threads_give_the_same(tmp_path):
    with ThreadPoolExecutor(3) as pool:
        assert run(list(range(20)), tmp_path, executor=pool)[0] == [x * x for x in range(20)]


def test_an_error_of_a_job_is_raised_and_what_was_finished_stays(tmp_path):
    def work(x):
        if x == 2:
            raise ValueError("no")
        return square(x)

    path = tmp_path / "jobs.jsonl"
    with pytest.raises(ValueError, match="no"):
        run_all(work, ["a", "b"], [1, 2].__getitem__, path, workers=1)
    assert [json.loads(line)["key"] for line in path.read_text().splitlines()] == ["a"]


def test_a_file_of_something_else_is_refused_and_kept(tmp_path):
    path = tmp_path / "jobs.jsonl"
    path.write_text("my notes\n")
    with pytest.raises(InputError, match="no file of finished jobs"):
        run([1], tmp_path)
    assert path.read_text() == "my notes\n"


def test_no_worker_is_refused(tmp_path):
    with pytest.raises(SettingError, match="0 workers"):
        run([1], tmp_path, workers=0)
