"""Runs of a few samples: the audit says what it cannot test, and every fit is refused in a sentence."""

import shutil
from importlib import resources

import pyarrow.parquet as pq
import pytest

import slipwise as sw
from slipwise.errors import InputError

_TOO_FEW = "numbers are to be fitted, .* by 0 samples of the runs"
#: Samples of every run, and what a fit is refused with; the first and last 8 of a run do not count, and what is left of
#: 18 and of 20 is too little of a run to tell anything.
REFUSED = {16: "a law can be judged by no sample of it", 18: _TOO_FEW, 20: _TOO_FEW}


@pytest.fixture(params=REFUSED)
def campaign(request, tmp_path):
    """The demo's runs, cut off after a few samples."""
    with resources.as_file(resources.files("slipwise") / "demo_data") as data:
        shutil.copytree(data, tmp_path / "campaign")
    for path in (tmp_path / "campaign").glob("*.parquet"):
        pq.write_table(pq.read_table(path).slice(0, request.param), path)
    return request.param, sw.load_campaign(tmp_path / "campaign")


def test_an_audit_of_short_runs_says_that_no_balance_could_be_tested(campaign):
    said = [words for words in sw.audit(campaign[1]).report.cannot if words.startswith("balances: no run has a sample")]
    assert said == [
        "balances: no run has a sample at which they hold; the runs are too short, or the rig is at rest in them"
    ]


@pytest.mark.parametrize("asked", [sw.compare, sw.diagnose, sw.discover, sw.ladder, sw.next_test])
def test_a_fit_of_short_runs_is_refused_in_a_sentence(campaign, asked):
    samples, measured = campaign
    with pytest.raises(InputError, match=f"{REFUSED[samples]}.*near the ends of a run"):
        asked(measured)
