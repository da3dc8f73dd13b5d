"""`slipwise init` for any number of pads: the rig is named where it is known, else drafted for its user to fill in."""

import tomllib

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.campaign.draft import init_campaign
from slipwise.rig import load_specimen


def folder_of(folder, pads: str, loads, header: str = "pad_{}_N [kN],pad_{}_Fx [kN]", order: str = "") -> dict:
    """Write a run of so many pads, draft from it, and give the draft."""
    time = np.arange(400) * 0.01
    slip = 10.0 * np.sin(2 * np.pi * time) * np.minimum(time, 1.0)
    rate = np.sign(np.gradient(slip))
    columns, names = [time, slip], ["time [s]", "slip_x [mm]"]
    for pad, load in zip(pads, loads, strict=True):
        number = str(pads.index(pad) + 1)
        names += [h.replace("{}", number if "LC" in header else pad) for h in header.split(",")]
        columns += [load + 0.1 * np.cos(time), 0.1 * load * rate]
    np.savetxt(folder / "a.csv", np.stack(columns, axis=1), "%.6g", ",", header=",".join(names), comments="")
    return tomllib.loads(init_campaign(folder).read_text(encoding="utf-8"))


@pytest.mark.parametrize("rig", ["three_pads", "six_pads"])
def test_a_rig_of_the_package_is_known_by_its_pads_and_its_weight(tmp_path, rig):
    specimen = load_specimen(rig)
    load = specimen.weight / len(specimen.pads) / 1e3
    draft = folder_of(tmp_path, "".join(specimen.pads), [load] * len(specimen.pads))
    assert draft["rig"] == rig and not (tmp_path / "specimen.toml").exists()
    assert load_campaign(tmp_path).specimen.pads == specimen.pads


@pytest.mark.parametrize("pads", ["ABC", "ABCDE", "ABCDEF", "ABCDEFGHIJKL"])
def test_another_rig_is_drafted_with_what_its_loads_tell_and_the_rest_is_marked(tmp_path, pads):
    loads = [30.0 + 2.0 * i for i in range(len(pads))]
    draft = folder_of(tmp_path, pads, loads)
    assert draft["rig"] == "specimen.toml"
    text = (tmp_path / "specimen.toml").read_text(encoding="utf-8")
    assert all("decide" in line for line in text.splitlines() if "=" in line and not line.startswith("#"))
    specimen = load_campaign(tmp_path).specimen
    assert specimen.pads == tuple(pads) and specimen.weight == pytest.approx(1e3 * sum(loads), rel=0.01)
    assert "it carries 31.9" in text or "it carries 32" in text


def test_cells_that_are_only_counted_are_named_by_their_numbers(tmp_path):
    draft = folder_of(tmp_path, "ABCDE", [20.0] * 5, "LC{} vertical [kN],LC{} horizontal [kN]")
    assert draft["columns"]["LC4 vertical [kN]"]["channel"] == "pad_D_N"
    assert draft["columns"]["LC5 horizontal [kN]"]["channel"] == "pad_E_Fx"
    assert load_campaign(tmp_path).specimen.pads == tuple("ABCDE")


def test_a_specimen_that_lies_there_already_is_the_rig_and_stays_as_it_is(tmp_path):
    (tmp_path / "specimen.toml").write_text(
        'mass = "10 t"\nbox = ["4 m", "3 m", "0.5 m"]\ncentre_height = "0.4 m"\n'
        'pad = { radius = "25 mm", stiffness = "200 kN/mm" }\n[pads]\nwest = { x = "-1 m", y = "0 m" }\n'
        'north = { x = "1 m", y = "1 m" }\nsouth = { x = "1 m", y = "-1 m" }\n'
    )
    before = (tmp_path / "specimen.toml").read_text()
    time = np.arange(50) * 0.01
    names = "time [s],slip_x [mm],pad_west_N [kN],pad_north_N [kN],pad_south_N [kN]"
    rows = np.stack([time, time, *[30.0 + 0 * time] * 3], axis=1)
    np.savetxt(tmp_path / "a.csv", rows, "%.6g", ",", header=names, comments="")
    draft = tomllib.loads(init_campaign(tmp_path).read_text(encoding="utf-8"))
    assert draft["rig"] == "specimen.toml" and (tmp_path / "specimen.toml").read_text() == before
    assert "columns" not in draft and load_campaign(tmp_path).specimen.pads == ("west", "north", "south")
