"""What programs of structural analysis write as text is read as columns: recorders, tables, a run in several files."""

import numpy as np
import pytest

from slipwise.data_files.table import open_table
from slipwise.errors import InputError

SAP2000 = """File out.$2k was saved on 11/28/26 at 14:03:20

TABLE:  "PROGRAM CONTROL"
   ProgramName=SAP2000   Version=24.0.0   CurrUnits="KN, m, C"

TABLE:  "ELEMENT FORCES - LINKS"
   Link=1   LinkElem=1   Station=I-End   OutputCase=TH1   CaseType=NonDirHist   StepType=Time   StepNum=0   P=-24.5 _
        V2=0   V3=0
   Link=1   LinkElem=1   Station=I-End   OutputCase=TH1   CaseType=NonDirHist   StepType=Time   StepNum=0.01   P=-24 _
        V2=1.3   V3=0
   Link=2   LinkElem=2   Station=I-End   OutputCase=TH1   CaseType=NonDirHist   StepType=Time   StepNum=0   P=-25   V2=0
   Link=2   LinkElem=2   Station=I-End   OutputCase=TH1   CaseType=NonDirHist   StepType=Time   StepNum=0.01   P=-26 _
        V2=1.5

TABLE:  "JOINT DISPLACEMENTS"
   Joint=7   OutputCase=TH1   CaseType=NonDirHist   StepType=Time   StepNum=0   U1=0
   Joint=7   OutputCase=TH1   CaseType=NonDirHist   StepType=Time   StepNum=0.01   U1=0.002
"""


def read(path, *headers):
    table = open_table(path)
    return [column.tolist() for column in table.columns([table.headers.index(h) for h in headers]).values]


def test_a_recorder_without_names_has_numbered_columns(tmp_path):
    (tmp_path / "slip.out").write_text("0 0 1e-3\n 0.01 -0.5 2e-3 \n")
    assert open_table(tmp_path / "slip.out").headers == ("column 1", "column 2", "column 3")
    assert read(tmp_path / "slip.out", "column 1", "column 3") == [[0.0, 0.01], [1e-3, 2e-3]]


def test_a_recorder_that_stopped_in_a_row_is_told_with_its_line(tmp_path):
    (tmp_path / "slip.out").write_text("0 0 1e-3\n0.01 -0.5\n")
    with pytest.raises(InputError, match="line 2 has 2 columns, the first one 3"):
        open_table(tmp_path / "slip.out")


def test_every_link_and_joint_of_sap2000_has_columns_of_its_own(tmp_path):
    (tmp_path / "run.txt").write_text(SAP2000)
    time, force, other, slip = read(tmp_path / "run.txt", "StepNum", "Link 1 V2", "Link 2 P", "Joint 7 U1")
    assert (time, force, other, slip) == ([0.0, 0.01], [0.0, 1.3], [-25.0, -26.0], [0.0, 0.002])


def test_an_object_with_fewer_steps_is_told(tmp_path):
    (tmp_path / "run.txt").write_text(SAP2000.replace("StepNum=0.01   U1=0.002", "StepNum=0   U1=0.002"))
    with pytest.raises(InputError, match="Joint 7 U1 has 1 steps of 2"):
        open_table(tmp_path / "run.txt")


def test_columns_under_names_with_blanks_between_them_are_read_as_3d_basis_writes_them(tmp_path):
    (tmp_path / "run.out").write_text("  TIME   DISPL X   FORCE X\n   0.000   0.1000E-02   0.2450E+01\n" * 1)
    table = open_table(tmp_path / "run.out")
    assert table.headers == ("TIME", "DISPL X", "FORCE X")


def test_the_files_of_one_run_stand_beside_each_other(tmp_path):
    run = tmp_path / "quake"
    run.mkdir()
    (run / "slip.out").write_text("0 0.1\n0.01 0.2\n")
    (run / "pads.out").write_text("0 24 25\n0.01 26 27\n")
    assert read(run, "slip: column 2", "pads: column 3") == [[0.1, 0.2], [25.0, 27.0]]
    (run / "slip.out").write_text("0 0.1\n")
    table = open_table(run)
    with pytest.raises(InputError, match="must have the same steps"):
        table.columns([table.headers.index("slip: column 2"), table.headers.index("pads: column 3")])


def test_a_folder_without_data_is_no_run(tmp_path):
    with pytest.raises(InputError, match="no data file is in this folder"):
        open_table(tmp_path)


def test_what_is_read_is_numbers(tmp_path):
    (tmp_path / "slip.out").write_text("0 0\n0.01 nan\n")
    assert np.isnan(read(tmp_path / "slip.out", "column 2")[0][1])
