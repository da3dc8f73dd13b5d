"""`slipwise ensemble`: tables for people, files for programs; a kill or another number of workers changes nothing."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

SINE = "sine:2Hz,0.2g,cycles=9"


def words_for(folder, *more):
    return ("ensemble", SINE, "--vary", "rig.mass=9..11t", "--members", "4", "--out", folder, *more)


def test_an_ensemble_leaves_members_and_tables(slipwise, tmp_path):
    code, out, _ = slipwise(*words_for(tmp_path, "--scale", "1:2:1", "--workers", "1", "--limit", "slip_x=1mm"))
    assert code == 0
    assert "Quantiles of largest slip" in out and "8 replays, 8 of them now" in out and "Limits exceeded" in out
    rows = list(csv.DictReader((tmp_path / "quantiles.csv").open()))
    slips = [row for row in rows if row["response"] == "slip"]
    assert [row["scale"] for row in slips] == ["1.0", "2.0"] and {row["unit"] for row in slips} == {"mm"}
    assert float(slips[0]["5 %"]) <= float(slips[0]["50 %"]) <= float(slips[0]["95 %"])
    assert 1.0 < float(slips[0]["50 %"]) < 100.0
    over = list(csv.DictReader((tmp_path / "exceedance.csv").open()))
    assert [row["share"] for row in over] == ["1.0", "1.0"]
    again = json.loads(slipwise(*words_for(tmp_path, "--scale", "1:2:1", "--workers", "1", "--json"))[1])
    assert again["run"] == 0 and again["members"] == 4


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--vary", "rig.mass=9..11"), "no unit"),
        (("--scale", "3:1:1"), "--scale"),
        (("--sampling", "halton"), "latin"),
        (("--limit", "slip=3t"), "wrong dimension"),
        (("--rig", "bridg1"), "bridge1"),
        (("--workers", "0"), "0 workers"),
        ((SINE,), "given twice"),
    ],
)
def test_bad_input_is_one_clear_message_and_exit_2(slipwise, tmp_path, more, message):
    code, _, err = slipwise("ensemble", SINE, "--members", "2", "--out", tmp_path, *more)
    assert code == 2 and message in err and "Traceback" not in err
    assert not (tmp_path / "members.parquet").exists()


@pytest.mark.long
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs signals")
def test_a_killed_ensemble_goes_on_and_any_number_of_workers_gives_the_same_bytes(slipwise, tmp_path):
    killed, whole = tmp_path / "killed", tmp_path / "whole"
    code = "from slipwise.cli import main; main()"
    command = [sys.executable, "-c", code, *map(str, words_for(killed, "--workers", "2", "--members", "24"))]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    lines, deadline = killed / "members.jsonl", time.monotonic() + 120
    while (not lines.exists() or lines.read_bytes().count(b"\n") < 4) and time.monotonic() < deadline:
        assert process.poll() is None, "it ended before it could be killed"
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    before = lines.read_bytes().count(b"\n")
    assert 4 <= before < 24
    resumed = json.loads(slipwise(*words_for(killed, "--workers", "1", "--members", "24", "--json"))[1])
    assert resumed["run"] == 24 - before
    slipwise(*words_for(whole, "--workers", "1", "--members", "24"))
    assert (killed / "members.parquet").read_bytes() == (whole / "members.parquet").read_bytes()
