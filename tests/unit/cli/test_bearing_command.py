"""`slipwise bearing` writes a page, a table, a workbook and JSON that say the same."""

import csv
import json

import openpyxl
import pytest
from typer.testing import CliRunner

from slipwise.cli import app
from unit.campaign.slider import HEADER, slider, text


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """Run the command on one slider; give its output and its folder."""
    folder = tmp_path_factory.mktemp("bearing")
    (folder / "one.csv").write_text(text(slider(1, 1000), HEADER))
    (folder / "campaign.toml").write_text('name = "slider"\nrig = "pad"\n[[run]]\nfile = "one.csv"\nrole = "fit"\n')
    done = CliRunner().invoke(app, ["bearing", str(folder), "--out", str(folder / "out")])
    assert done.exit_code == 0, done.output
    return done.output, folder / "out"


def test_table_workbook_and_json_hold_the_same_energy(report):
    _, out = report
    content = json.loads((out / "bearing.json").read_text())
    assert content["schema"] == 1
    (mean,) = (row for row in content["rows"] if row["part"] == "mean of cycles")
    energy = mean["values"]["energy"]["measured"]
    with (out / "bearing.csv").open() as stream:
        (row,) = (row for row in csv.DictReader(stream) if row["part"] == "mean of cycles")
    assert 10.0 * float(row["energy dissipated [kN cm]"]) == pytest.approx(energy)
    sheet = openpyxl.load_workbook(out / "bearing.xlsx")["Series of cycles"]
    head = [cell.value for cell in sheet[1]]
    assert 10.0 * sheet.cell(2, head.index("energy dissipated [kN cm]") + 1).value == pytest.approx(energy)


def test_the_page_and_the_terminal_name_what_the_standards_name(report):
    said, out = report
    page = (out / "bearing.html").read_text()
    for words in ("lambda_test,max", "Q_d", "K_eff", "UBDP", "dynamic coefficient"):
        assert words in page
    assert "Whole runs, pad A" in said and "K_eff [kN/mm]" in said and "ageing and environment" in said
