"""A logger that ran for an hour: two million rows fit into an ordinary machine."""

import subprocess
import sys

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import csv

#: A fifth of two million: reading takes the same share of time and memory.
ROWS = 400_000
READ = """
import sys
from slipwise.campaign import load_campaign
def peak():  # of this process alone: that of getrusage begins with its parent's
    lines = open("/proc/self/status").read().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 2**20
before = peak()
rows = len(load_campaign(sys.argv[1]).runs[0].record)
print(rows, before, peak())
"""


@pytest.mark.slow
def test_memory_grows_so_slowly_with_rows_that_two_million_need_less_than_two_gigabytes(tmp_path):
    values = np.random.default_rng(1).integers(-9999, 9999, ROWS) / 1000.0
    names = ["table_ax [m/s^2]", "table_az [m/s^2]", "girder_ax [m/s^2]", "girder_az [m/s^2]", "slip_x [mm]"]
    names += [f"pad_{pad}_{kind} [kN]" for pad in "ABCD" for kind in ("N", "Fx")]
    columns = {"time [s]": 0.002 * np.arange(ROWS), **dict.fromkeys(names, values)}
    csv.write_csv(pa.table(columns), tmp_path / "long.csv")
    (tmp_path / "campaign.toml").write_text('rig = "bridge1"\n[[run]]\nfile = "long.csv"\nrole = "fit"\n')
    done = subprocess.run([sys.executable, "-c", READ, tmp_path], capture_output=True, text=True, check=True)
    rows, before, after = map(float, done.stdout.split())
    assert rows == ROWS
    assert before + 5.0 * (after - before) < 2.0
