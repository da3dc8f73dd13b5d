"""A process that is killed costs time, no job, and no job that was finished."""

import os
import resource
import signal
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest

from slipwise.errors import InputError, OutputError, SlipwiseError, SlipwiseWarning
from slipwise.jobs.executors import run_all
from slipwise.jobs.job_log import add_line, read_places
from slipwise.jobs.worker_processes import finished


@dataclass(frozen=True)
class Job:
    """A piece of work that kills its process the first `deaths` times."""

    number: int
    folder: Path
    deaths: int = 0

    def __str__(self) -> str:
        return f"job {self.number}"


def work(job: Job) -> int:
    if job.number == 13:
        time.sleep(600.0)
    tries = len(list(job.folder.glob(f"{job.number}.*")))
    (job.folder / f"{job.number}.{tries}").touch()
    if tries < job.deaths:
        os.kill(os.getpid(), signal.SIGKILL)
    return job.number**2


def numbers(job: Job) -> dict[str, int]:
    return {"number": work(job)}


def jobs(folder: Path, deaths: Mapping[int, int], count: int = 8) -> dict[str, Job]:
    return {f"key {n}": Job(n, folder, deaths.get(n, 0)) for n in range(count)}


@pytest.mark.slow
def test_a_process_that_is_killed_costs_no_job(tmp_path: Path) -> None:
    asked = jobs(tmp_path, {2: 1, 5: 1})
    assert dict(finished(work, iter(asked.items()), 2)) == {key: job.number**2 for key, job in asked.items()}


@pytest.mark.slow
def test_a_job_that_was_killed_once_in_a_process_of_its_own_is_tried_in_a_second_one(tmp_path: Path) -> None:
    asked = jobs(tmp_path, {5: 2})
    assert dict(finished(work, iter(asked.items()), 1)) == {key: job.number**2 for key, job in asked.items()}


@pytest.mark.slow
def test_a_job_that_kills_two_processes_is_named_and_the_others_are_kept(tmp_path: Path) -> None:
    kept = {}
    with pytest.raises(SlipwiseError, match="job key 3 .job 3. has ended two processes.*memory.*--workers 1.*goes on"):
        for key, answer in finished(work, iter(jobs(tmp_path, {3: 3}).items()), 2):
            kept[key] = answer
    assert {"key 0", "key 1"} <= kept.keys()


@pytest.mark.slow
def test_an_error_of_a_job_ends_its_processes_at_once(tmp_path: Path) -> None:
    began = time.monotonic()
    answers = finished(work, iter([("long", Job(13, tmp_path)), ("short", Job(1, tmp_path))]), 2)
    assert next(answers) == ("short", 1)
    answers.close()
    assert time.monotonic() - began < 60.0


@pytest.mark.slow
def test_work_that_a_killed_process_has_ended_goes_on_where_it_was(tmp_path: Path) -> None:
    asked = jobs(tmp_path, {3: 3})
    keys = list(asked)

    def run() -> list[int]:
        done = run_all(numbers, keys, lambda i: asked[keys[i]], tmp_path / "jobs.jsonl", workers=2)
        return [entry["number"] for entry in done.numbers(keys)]

    with pytest.raises(SlipwiseError, match="has ended two processes"):
        run()
    tried = len(list(tmp_path.glob("0.*")))
    assert run() == [number**2 for number in range(8)]
    assert len(list(tmp_path.glob("0.*"))) == tried


def test_a_line_for_which_there_is_no_room_is_not_begun(tmp_path: Path) -> None:
    path = tmp_path / "members.jsonl"
    with path.open("ab", buffering=0) as stream:
        add_line(stream, "first", {})
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
        try:
            with pytest.raises(OutputError, match="members.jsonl: file too large; free some space"):
                add_line(stream, "second" * 100, {})
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert path.read_text().count("\n") == 1 and list(read_places(path)) == ["first"]


def test_a_line_that_a_disk_has_damaged_is_told_and_its_job_is_run_again_and_no_other(tmp_path: Path) -> None:
    asked = jobs(tmp_path, {})
    keys, path = list(asked), tmp_path / "jobs.jsonl"

    def run() -> tuple[int, list[int]]:
        done = run_all(numbers, keys, lambda i: asked[keys[i]], path, workers=1)
        return done.run, [entry["number"] for entry in done.numbers(keys)]

    answers = [number**2 for number in range(8)]
    assert run() == (8, answers)
    whole = path.read_bytes()
    for damage in (b'"number": NaN', b'"number": 10', b'"number": [9]', b"\x00\xff", b"[" * 30_000):
        path.write_bytes(whole.replace(b'"number": 9', damage))
        with pytest.warns(SlipwiseWarning, match="jobs.jsonl: 1 of its lines were damaged; the jobs .* run again"):
            assert run() == (1, answers)
        assert run() == (0, answers)


def test_a_folder_of_the_name_of_the_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "jobs.jsonl").mkdir()
    with pytest.raises(InputError, match="jobs.jsonl is a folder.*choose another --out"):
        run_all(numbers, ["a"], lambda i: Job(1, tmp_path), tmp_path / "jobs.jsonl", workers=1)


def test_finished_jobs_of_an_earlier_version_have_no_checksum_and_are_taken_as_they_are(tmp_path: Path) -> None:
    path = tmp_path / "jobs.jsonl"
    path.write_text('{"key": "first", "numbers": {"slip": 0.1}}\n{"key": "second", "numbers": {}}\n')
    before = path.read_bytes()
    assert list(read_places(path)) == ["first", "second"] and path.read_bytes() == before
    with path.open("ab", buffering=0) as stream:
        add_line(stream, "third", {"slip": 0.2})
    assert list(read_places(path)) == ["first", "second", "third"]


@pytest.mark.parametrize(
    "line",
    [
        '{"key": "second", "numbers": {"slip": NaN}}',
        '{"key": "second", "numbers": {"slip": 1e999}}',
        '{"key": "second", "numbers": [1]}',
        '{"key": 2, "numbers": {}}',
        '{"key": "second", "numbers": {}, "tum": "0123456789abcdef"}',
    ],
)
def test_a_line_without_a_checksum_that_no_version_has_written_is_taken_out(tmp_path: Path, line: str) -> None:
    path = tmp_path / "jobs.jsonl"
    path.write_text('{"key": "first", "numbers": {}}\n' + line + "\n")
    with pytest.warns(SlipwiseWarning, match="1 of its lines were damaged"):
        assert list(read_places(path)) == ["first"]
