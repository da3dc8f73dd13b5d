"""A process of an ensemble that is killed costs time, no replay, and no replay that was finished."""

import os
import resource
import signal
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest

from slipwise.errors import OutputError, SlipwiseError
from slipwise.studies.paper import ensemble
from slipwise.studies.paper.ensemble import _keep, run_ensemble
from slipwise.studies.paper.member import Member
from slipwise.studies.paper.settings import PaperSettings
from slipwise.studies.paper.workers import finished


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


def jobs(folder: Path, deaths: Mapping[int, int], count: int = 8) -> dict[str, Job]:
    return {f"key {n}": Job(n, folder, deaths.get(n, 0)) for n in range(count)}


@pytest.mark.slow
def test_a_process_that_is_killed_costs_no_job(tmp_path: Path) -> None:
    asked = jobs(tmp_path, {2: 1, 5: 1})
    assert dict(finished(work, asked, 2)) == {key: job.number**2 for key, job in asked.items()}


@pytest.mark.slow
def test_a_job_that_kills_two_processes_is_named_and_the_others_are_kept(tmp_path: Path) -> None:
    kept = {}
    with pytest.raises(SlipwiseError, match="job 3 has ended two processes.*memory.*--workers 1.*goes on"):
        for key, answer in finished(work, jobs(tmp_path, {3: 2}), 2):
            kept[key] = answer
    assert {"key 0", "key 1"} <= kept.keys()


@pytest.mark.slow
def test_an_error_of_a_job_ends_its_processes_at_once(tmp_path: Path) -> None:
    began = time.monotonic()
    answers = finished(work, {"long": Job(13, tmp_path), "short": Job(1, tmp_path)}, 2)
    assert next(answers) == ("short", 1)
    answers.close()
    assert time.monotonic() - began < 60.0


def test_an_ensemble_goes_on_where_a_killed_process_has_ended_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    members = [Member("bridge1", seed, 7.0, 5.0, 1.0, 2.8, PaperSettings()) for seed in range(4)]

    def until_killed(work, missing, workers):
        for number, key in enumerate(missing):
            if number == 2:
                raise SlipwiseError("killed")
            yield key, {"number": number}

    monkeypatch.setattr(ensemble, "finished", until_killed)
    with pytest.raises(SlipwiseError, match="killed"):
        run_ensemble(members, tmp_path)
    assert [numbers["number"] for numbers in run_ensemble(members, tmp_path)] == [0, 1, 0, 1]


def test_a_line_for_which_there_is_no_room_is_not_begun(tmp_path: Path) -> None:
    path = tmp_path / "members.jsonl"
    _keep(path, {"key": "first"})
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
    try:
        with pytest.raises(OutputError, match="members.jsonl: file too large; free some space"):
            _keep(path, {"key": "second" * 100})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert path.read_text() == '{"key": "first"}\n'
