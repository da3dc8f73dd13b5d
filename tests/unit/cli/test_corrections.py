"""`--correct` mends what the audit found and the user named; nothing else, and never in silence."""

import json
import shutil

import pytest

from slipwise.effects import find_effect
from slipwise_benchmarks import Fault, build_campaign, with_faults
from slipwise_benchmarks.write import write_campaign


@pytest.fixture(scope="module")
def late(tmp_path_factory):
    """A folder in which slip_x comes 4 ms late."""
    made = with_faults(build_campaign(51, effects=(), rig="bridge1"), [Fault("channel_delay", ("slip_x",), 4e-3)], 7)
    folder = tmp_path_factory.mktemp("late") / "march"
    write_campaign(folder, made.truth.rig, made.truth.logger, made.recorded)
    return folder


def test_the_audit_names_the_fault_with_interval_rivals_and_what_would_settle_it(slipwise, late):
    code, words, _ = slipwise("audit", late, "--json")
    report = json.loads(words)
    assert code == 0 and report["accused"] is True
    (finding,) = report["findings"]
    assert (finding["what"], finding["channel"]) == ("channel_delay", "slip_x")
    assert finding["low"] < 4e-3 < finding["high"]
    assert "hammer" in finding["settle_by"] and finding["mistaken_for"]


@pytest.mark.long
def test_compare_with_the_named_correction_is_held_against_mended_records_and_says_so(slipwise, late, tmp_path):
    options = ("--no-system", "--no-recording", "--json", "--out", tmp_path / "out")
    errors = {}
    for words in ((), ("--correct", "channel_delay:slip_x")):
        code, printed, _ = slipwise("compare", late, *words, *options)
        assert code == 0
        report = json.loads(printed)
        assert report["audit"]["accused"] is not bool(words)
        assert any("corrected" in note and "slip_x" in note for note in report["notes"]) is bool(words)
        errors[bool(words)] = report["components"]["girder"]["holdout"]
    assert errors[True] < 1.2 < errors[False]


def test_a_fault_of_ones_own_competes_in_the_audit(slipwise, late, tmp_path):
    mine = tmp_path / "my_delay.py"
    shutil.copy(find_effect("channel_delay").path, mine)
    code, words, _ = slipwise("audit", late, "--effect", mine, "--json")
    (finding,) = json.loads(words)["findings"]
    rivals = {name.split()[0] for name in finding["mistaken_for"].split(", ")}
    assert code == 0 and {"channel_delay", "my_delay"} <= {finding["what"], *rivals}
    code, _, error = slipwise("audit", late, "--effect", tmp_path / "nowhere.py")
    assert code == 2 and "no such effect file" in error


def test_a_misspelt_correction_is_answered_with_the_findings_there_are(slipwise, late):
    code, _, error = slipwise("audit", late, "--correct", "channel_delay:slip_y")
    assert code == 2
    assert "did you mean channel_delay:slip_x" in error and "Traceback" not in error
