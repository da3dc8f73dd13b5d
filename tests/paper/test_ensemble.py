"""Ensembles: the same on any number of workers, and nothing lost or repeated after a kill."""

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from slipwise.errors import InputError
from slipwise.studies.paper import Member, PaperSettings, run_ensemble, run_member
from slipwise.studies.paper.member import _CLOSE

pytestmark = pytest.mark.slow

SETTINGS = PaperSettings()
#: Short earthquakes: 1.7 s each.
MEMBERS = [
    Member("bridge1", seed, 7.0, 5.0, 1.0, vertical, SETTINGS) for seed in range(1, 6) for vertical in (0.0, 2.8)
]
TESTS = Path(__file__).parents[1]


class Counting(Executor):
    """Runs at once, in this process, and remembers what it ran."""

    def __init__(self):
        self.ran = []

    def submit(self, fn, /, *args, **kwargs):
        self.ran.append(args[0])
        future = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def lines(folder):
    return [json.loads(line) for line in (folder / "members.jsonl").read_text().splitlines()]


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    return run_ensemble(MEMBERS, tmp_path_factory.mktemp("alone"), executor=Counting())


@pytest.mark.parametrize("workers", [1, 2])
def test_results_do_not_depend_on_the_number_of_workers(workers, alone, tmp_path):
    assert run_ensemble(MEMBERS, tmp_path, workers=workers) == alone


def test_threads_are_an_executor_too(alone, tmp_path):
    with ThreadPoolExecutor(3) as pool:
        assert run_ensemble(MEMBERS[:4], tmp_path, executor=pool) == alone[:4]


def test_what_is_finished_is_not_run_again(alone, tmp_path):
    first, second, third = Counting(), Counting(), Counting()
    run_ensemble(MEMBERS[:4], tmp_path, executor=first)
    assert run_ensemble(MEMBERS, tmp_path, executor=second) == alone
    assert run_ensemble(MEMBERS, tmp_path, executor=third) == alone
    assert (first.ran, second.ran, third.ran) == (MEMBERS[:4], MEMBERS[4:], [])


def test_equal_members_are_run_once(tmp_path):
    counting = Counting()
    one, other = run_ensemble([MEMBERS[0], MEMBERS[0]], tmp_path, executor=counting)
    assert one == other
    assert len(counting.ran) == 1


def test_a_line_torn_by_a_kill_is_cut_off_and_run_again(alone, tmp_path):
    run_ensemble(MEMBERS[:3], tmp_path, executor=Counting())
    path = tmp_path / "members.jsonl"
    torn = lines(tmp_path)[-1]["key"]
    path.write_bytes(path.read_bytes()[:-20])
    counting = Counting()
    assert run_ensemble(MEMBERS[:3], tmp_path, executor=counting) == alone[:3]
    assert [member.key() for member in counting.ran] == [torn]
    assert len(lines(tmp_path)) == 3


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="looks for left-over processes in /proc")
def test_a_killed_ensemble_goes_on_with_nothing_lost_and_nothing_run_twice(tmp_path):
    members = [replace(MEMBERS[1], seed=seed) for seed in range(1, 25)]
    code = (
        "from pathlib import Path; from dataclasses import replace\n"
        "from slipwise.studies.paper import Member, PaperSettings, run_ensemble\n"
        f"base = Member('bridge1', 1, 7.0, 5.0, 1.0, 2.8, PaperSettings())\n"
        f"run_ensemble([replace(base, seed=s) for s in range(1, 25)], Path({str(tmp_path)!r}), workers=2)\n"
    )
    script = tmp_path / "run.py"
    script.write_text("if __name__ == '__main__':\n" + "".join(f"    {line}\n" for line in code.splitlines()))
    path = tmp_path / "members.jsonl"
    process = subprocess.Popen([sys.executable, str(script)])
    deadline = time.monotonic() + 120
    while (not path.exists() or path.read_bytes().count(b"\n") < 5) and time.monotonic() < deadline:
        assert process.poll() is None, "it ended before it could be killed"
        time.sleep(0.01)
    children = [int(c) for c in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    finished = path.read_bytes().count(b"\n")
    assert 5 <= finished < 24
    before = {line["key"] for line in map(json.loads, path.read_bytes().split(b"\n")[:finished])}

    counting = Counting()
    resumed = run_ensemble(members, tmp_path, executor=counting)
    assert not {m.key() for m in counting.ran} & before
    assert len(counting.ran) == 24 - finished
    keys = [line["key"] for line in lines(tmp_path)]
    assert len(keys) == len(set(keys)) == 24
    assert resumed[::9] == [run_member(m) for m in members[::9]]

    deadline = time.monotonic() + 30
    while any(Path(f"/proc/{child}").exists() for child in children) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not [child for child in children if Path(f"/proc/{child}").exists()], "workers outlived their parent"


def test_progress_counts_up_to_all(tmp_path):
    seen = []
    run_ensemble(MEMBERS[:4], tmp_path, executor=Counting(), progress=lambda done, of: seen.append((done, of)))
    assert seen == [(done, 4) for done in range(5)]


def test_a_file_that_is_no_ensembles_is_refused(tmp_path):
    (tmp_path / "members.jsonl").write_text("my notes\n")
    with pytest.raises(InputError, match="no file of finished jobs"):
        run_ensemble(MEMBERS[:1], tmp_path, executor=Counting())


def test_the_key_changes_with_everything_that_decides_the_result():
    base = MEMBERS[1]
    others = [
        replace(base, seed=9),
        replace(base, peak=7.1),
        replace(base, vertical=0.0),
        replace(base, bridge="bridge2"),
        replace(base, slenderness=0.3),
        replace(base, effects=("run_in",)),
        replace(base, settings=PaperSettings(n_unit="s/mm")),
        replace(base, target=5000.0),
    ]
    assert len({member.key() for member in [base, *others]}) == 9
    assert replace(base, settings=PaperSettings(members=77)).key() == base.key()


def test_a_searched_motion_reaches_its_energy():
    found = run_member(replace(MEMBERS[1], target=900.0))
    assert found["energy"] == pytest.approx(900.0, rel=_CLOSE)
    assert found["energy_without"] == pytest.approx(900.0, rel=0.1)


def test_an_energy_out_of_reach_is_said_so():
    assert "kN cm" in run_member(replace(MEMBERS[0], peak=0.5, target=1e9))["failed"]


@pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None, reason='needs dask: pip install "slipwise[cluster]"'
)
def test_a_cluster_gives_the_same(alone, tmp_path):
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        assert run_ensemble(MEMBERS, tmp_path, executor=client.get_executor()) == alone
