"""`slipwise export` writes what another program reads, or says in a sentence why not."""

import csv
import json

from typer.testing import CliRunner

from slipwise.cli import app

SINE = "sine:2Hz,0.3g,cycles=9"


def test_links_are_written_in_kilonewtons_and_metres_with_what_they_cannot_follow(tmp_path):
    out = tmp_path / "links.csv"
    done = CliRunner().invoke(app, ["export", "sap2000", "bridge1", "--motion", SINE, "--out", str(out)])
    assert done.exit_code == 0, done.output
    with out.open() as stream:
        rows = list(csv.DictReader(stream))
    pad = rows[0]
    assert pad["U1 stiffness [kN/m]"] == "200000.0" and pad["load at rest [kN]"] == "24.52"
    assert 0.045 < float(pad["friction slow"]) < 0.047 and 0.10 < float(pad["friction fast"]) < 0.12
    assert float(pad["friction fast at the lower pressure"]) > float(pad["friction fast at the upper pressure"])
    assert [row["link"] for row in rows[4:]] == [f"buffer {n} along {axis}" for n in "12" for axis in "xy"]
    assert "one pair of coefficients" in done.output


def test_json_says_that_a_script_was_not_run(tmp_path):
    arguments = ["export", "opensees", "block", "--law", "coulomb", "--motion", SINE, "--no-run", "--json"]
    done = CliRunner().invoke(app, [*arguments, "--out", str(tmp_path / "rig.py")])
    content = json.loads(done.stdout)
    assert content["not_run"] == "not asked for" and content["friction"]["A"]["model"] == "Coulomb"
    assert content["responses"][0]["opensees"] is None and content["responses"][0]["replay"] > 0.0
    assert json.loads((tmp_path / "rig.json").read_text()) == content


def test_a_link_without_pressures_and_a_law_that_there_is_not_are_refused():
    neither = CliRunner().invoke(app, ["export", "sap2000", "bridge1"])
    assert neither.exit_code != 0 and "either a campaign" in str(neither.exception)
    law = CliRunner().invoke(app, ["export", "sap2000", "bridge1", "--law", "viscous", "--motion", SINE])
    assert law.exit_code != 0 and "paper and coulomb" in str(law.exception)
