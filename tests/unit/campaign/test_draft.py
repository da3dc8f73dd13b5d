"""`slipwise init` drafts what the headers say, marks what only a person knows, and what it drafts can be read."""

import re
import tomllib

import pytest
from scipy.io import savemat

from slipwise.campaign import load_campaign
from slipwise.campaign.draft import draft_campaign
from slipwise.errors import InputError
from unit.campaign.slider import HEADER, slider, text


def drafted(folder, **files: str) -> str:
    for name, content in files.items():
        (folder / f"{name}.csv").write_text(content, encoding="utf-8")
    draft, _ = draft_campaign(folder)
    (folder / "campaign.toml").write_text(draft, encoding="utf-8")
    return draft


def test_our_own_headers_are_read_as_drafted(tmp_path):
    draft = drafted(tmp_path, a=text(slider(1)), b=text(slider(2)))
    assert "[columns]" not in draft and draft.count("decide") >= 3
    assert [run.role for run in load_campaign(tmp_path).runs] == ["fit", "holdout"]


@pytest.mark.parametrize(
    ("header", "unit", "channel"),
    [
        ("Zeit [ms]", "ms", "time"),
        ("disp (in)", "in", "slip_x"),
        ("velocity (in/s)", "in/s", "slip_vx"),
        ("normal load [kN]", "kN", "pad_A_N"),
        ("friction force (kip)", "kip", "pad_A_Fx"),
        ("pressure [bar]", "bar", "pad_A_P"),
        ("girder acc [g]", "g", "girder_ax"),
    ],
)
def test_a_foreign_header_is_mapped_where_word_and_unit_agree_and_marked_for_the_eye(tmp_path, header, unit, channel):
    draft = drafted(tmp_path, a=f"{header},other (-)\n0,1\n1,2\n")
    (line,) = [line for line in draft.splitlines() if line.startswith(f'"{header}"')]
    assert "# decide" in line
    assert tomllib.loads(line)[header] == {"channel": channel, "unit": unit}


def test_a_word_whose_unit_does_not_fit_is_left_to_the_user(tmp_path):
    draft = drafted(tmp_path, a="time [s],force [mm]\n0,1\n1,2\n")
    assert re.search(r'^# "force \[mm\]".*decide', draft, re.MULTILINE)


@pytest.mark.parametrize("load", [150.0, -150.0])
def test_a_load_that_the_machine_keeps_is_a_load_with_its_sign(tmp_path, load):
    table = slider(1)
    table[:, 2] = load
    draft = drafted(tmp_path, a=text(table, "Time [s],Position [mm],Axial Force [kN],Lateral Force [kN]"))
    entry = {"channel": "pad_A_N", "unit": "kN"} | ({"sign": -1} if load < 0 else {})
    assert tomllib.loads(draft)["columns"]["Axial Force [kN]"] == entry
    assert load_campaign(tmp_path).runs[0].record["pad_A_N"][0] == pytest.approx(150e3)


def test_a_pad_without_a_load_is_asked_for_one(tmp_path):
    draft = drafted(tmp_path, a="time [s],slip_x [mm],pad_A_Fx [kN]\n0,1,2\n1,2,3\n")
    assert '# pad_A_N = "10 kN"' in draft


def test_four_pads_make_a_girder_and_one_pad_a_slider(tmp_path):
    four = ",".join(f"pad_{pad}_Fx [kN]" for pad in "ABCD")
    assert 'rig  = "bridge1"' in drafted(tmp_path, a=f"time [s],{four}\n0,1,2,3,4\n1,2,3,4,5\n")
    assert 'rig  = "pad"' in drafted(tmp_path, a=text(slider(1), HEADER))


def test_matlab_files_are_drafted_by_the_names_of_their_variables(tmp_path):
    savemat(tmp_path / "run.mat", {"t": slider(1)[:, 0], "x": slider(1)[:, 1:]})
    draft, _ = draft_campaign(tmp_path)
    assert 'file = "run.mat"' in draft and '# "x(:,1)"' in draft


def test_a_name_with_quotes_and_brackets_stays_inside_its_string(tmp_path):
    folder = tmp_path / 'a "b" [c]'
    folder.mkdir()
    assert tomllib.loads(drafted(folder, a=text(slider(1))))["name"] == 'a "b" [c]'


def test_a_folder_without_data_says_which_files_are_data(tmp_path):
    with pytest.raises(InputError, match=r"no data file in it; possible: \.csv"):
        draft_campaign(tmp_path)
    with pytest.raises(InputError, match="no such folder"):
        draft_campaign(tmp_path / "nowhere")


def test_a_file_with_other_columns_than_the_rest_is_told(tmp_path):
    draft = drafted(
        tmp_path, a=text(slider(1), "t [s],x [mm],N [kN],F [kN]"), b=text(slider(2), "t [s],u [mm],N [kN],F [kN]")
    )
    assert "# note: b.csv has no column 'x [mm]': name its columns as in the other files" in draft


def test_a_folder_whose_files_cannot_be_read_says_why(tmp_path):
    (tmp_path / "run.mat").write_bytes(b"MATLAB 5.0 MAT-file")
    with pytest.raises(InputError, match=r"no data file in it can be read: run\.mat \(not a readable MATLAB file"):
        draft_campaign(tmp_path)


def test_a_table_with_a_broken_row_is_not_drafted_as_one_without_numbers(tmp_path):
    rows = "".join(f"{0.1 * k:.1f},{k % 7},{k % 5}\n" for k in range(50))
    (tmp_path / "run.csv").write_text("Time [s],Slip [mm],Friction [N]\n" + rows.replace("2.0,6,0", "2.0,60"))
    with pytest.raises(InputError, match=r"run\.csv \(line 22: a row with 2 columns where the header has 3"):
        draft_campaign(tmp_path)
