"""`slipwise init` on a laboratory's own headers: columns by what their numbers do, roles by motion, the rig by both."""

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

import slipwise
from slipwise.campaign import load_campaign
from slipwise.campaign.draft import init_campaign

DEMO = load_campaign(Path(slipwise.__file__).parent / "demo_data")
LABORATORY = {
    "time": "Time [s]", "table_ax": "ACC_Table_X [g]", "table_az": "ACC_Table_Z [g]", "girder_ax": "AccDeckX (m/s2)",
    "girder_az": "AccDeckZ (m/s2)", "slip_x": "LVDT_X [mm]",
    **{f"pad_{pad}_N": f"LC{k}_Vert [kN]" for k, pad in enumerate("ABCD", 1)},
    **{f"pad_{pad}_Fx": f"LC{k}_Horz [N]" for k, pad in enumerate("ABCD", 1)},
}  # fmt: skip
FACTOR = {"g": 9.80665, "m/s2": 1.0, "mm": 1e-3, "kN": 1e3, "N": 1.0, "s": 1.0}


def written(folder: Path, names: dict[str, str], turned: tuple[str, ...] = ()) -> dict:
    """Write the demo's runs under other headers, draft from them, and give the draft."""
    for run in DEMO.runs:
        columns = {"time": run.record.time, **run.record.channels}
        chosen = [n for n in columns if n in names]
        units = [re.split(r"[\[(]", names[n])[-1].rstrip("])") for n in chosen]
        signs = [-1.0 if n in turned else 1.0 for n in chosen]
        table = np.stack([s * columns[n] / FACTOR[u] for s, n, u in zip(signs, chosen, units, strict=True)], axis=1)
        head = ",".join(names[n] for n in chosen)
        np.savetxt(folder / f"{run.name}.csv", table, "%.7g", ",", header=head, comments="")
    (folder / "notes.txt").write_text("Pads were cleaned before run 3.\nRoom 21 degrees.\n", encoding="utf-8")
    (folder / "rig.png").write_bytes(b"\x89PNG")
    return tomllib.loads(init_campaign(folder).read_text(encoding="utf-8"))


def channels(draft: dict) -> dict[str, tuple[str, int]]:
    return {header: (entry["channel"], entry.get("sign", 1)) for header, entry in draft["columns"].items()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("laboratory")


@pytest.fixture(scope="module")
def draft(folder):
    return written(folder, LABORATORY)


def test_every_column_of_a_laboratory_is_mapped_with_its_reason(draft, folder):
    assert channels(draft) == {header: (channel, 1) for channel, header in LABORATORY.items()}
    lines = [
        line for line in (folder / "campaign.toml").read_text(encoding="utf-8").splitlines() if "{ channel" in line
    ]
    assert all("# decide: sure: " in line or "# decide: likely: " in line for line in lines)
    assert any("unloads while the girder is pushed to +x" in line for line in lines)


def test_roles_follow_from_the_motions_and_the_draft_can_be_read(draft, folder):
    assert {Path(run["file"]).stem: run["role"] for run in draft["run"]} == {run.name: run.role for run in DEMO.runs}
    assert draft["rig"] == DEMO.rig
    read = load_campaign(folder)
    np.testing.assert_allclose(
        read.run("sine_hv").record["pad_B_Fx"], DEMO.run("sine_hv").record["pad_B_Fx"], atol=0.01
    )


def test_notes_and_pictures_are_passed_over_and_listed(draft, folder):
    text = (folder / "campaign.toml").read_text(encoding="utf-8")
    assert "# not read: notes.txt (no line of column names" in text
    assert "# not read: rig.png (no data file)" in text


def test_headers_that_say_nothing_are_mapped_by_what_the_numbers_do_and_turned_ones_by_their_sign(tmp_path):
    names = {name: f"CH{k} [{header.split('[')[-1].split('(')[-1].rstrip('])')}]"
             for k, (name, header) in enumerate(LABORATORY.items())}  # fmt: skip
    turned = ("slip_x", "pad_A_N", "pad_B_N", "pad_C_N", "pad_D_N")
    found = channels(written(tmp_path, names, turned))
    right = {names[name]: (name, -1 if name in turned else 1) for name in names}
    wrong = {header: given for header, given in found.items() if given != right[header]}
    assert not wrong and len(found) >= 12


def test_a_person_is_asked_for_the_rig_and_the_loggers_filter(tmp_path):
    (tmp_path / "a.csv").write_text("time [s],slip_x [mm],pad_A_Fx [kN],pad_A_N [kN]\n0,1,2,3\n1,2,3,3\n2,3,3,3\n")
    asked = []

    def ask(question: str, default: str) -> str:
        asked.append((question.split()[0], default))
        return {"Which": "block", "Low-pass": "80 Hz"}[question.split()[0]]

    draft = tomllib.loads(init_campaign(tmp_path, ask=ask).read_text(encoding="utf-8"))
    assert draft["rig"] == "block" and draft["logger"] == {"lowpass": "80 Hz"}
    assert asked == [("Which", "pad"), ("Low-pass", "")]
