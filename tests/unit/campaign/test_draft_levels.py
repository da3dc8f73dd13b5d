"""`slipwise init` where no force was measured: levels of a structure are told by what drives and by what answers."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, load_campaign
from slipwise.campaign.draft import init_campaign
from unit.campaign.shear_building import MASSES, STIFFNESSES, channels

SHARED = Path(__file__).parents[4] / "shared" / "building"
#: Header -> channel, in an order and under letters that say nothing.
LETTERS = {
    "time [s]": "time", "p [m/s^2]": "storey_2_ax", "q [m/s^2]": "table_ax", "r [m/s^2]": "girder_ax",
    "w [m/s^2]": "storey_3_ax", "k [m/s^2]": "storey_1_ax", "m [mm]": "slip_x", "o [mm]": "storey_2_dx",
    "b [mm]": "table_dx", "e [mm]": "storey_3_dx", "g [mm]": "storey_1_dx",
}  # fmt: skip


def write(folder: Path, name: str, seed: int, headers: dict[str, str], **changed: np.ndarray) -> None:
    """Write a run under some headers, with some channels changed."""
    run = {**channels(seed), **changed}
    columns = [run[channel] * (1e3 if "[mm]" in header else 1.0) for header, channel in headers.items()]
    np.savetxt(folder / name, np.stack(columns, axis=1), "%.8g", ",", header=",".join(headers), comments="")


def drafted(folder: Path) -> dict:
    return tomllib.loads(init_campaign(folder).read_text(encoding="utf-8"))


def mapped(columns: dict) -> dict[str, tuple[str, int]]:
    return {header: (entry["channel"], entry.get("sign", 1)) for header, entry in columns.items()}


def loaded(folder: Path) -> Campaign:
    """Load a drafted campaign as one whose pads may slide, which every reader knows."""
    specimen = folder / "specimen.toml"
    lines = specimen.read_text(encoding="utf-8").splitlines()
    specimen.write_text("\n".join(line for line in lines if not line.startswith("friction")), encoding="utf-8")
    return load_campaign(folder)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("letters")
    write(folder, "one.csv", 0, LETTERS)
    init_campaign(folder)
    return folder


def test_letters_are_mapped_by_what_their_columns_do(folder):
    draft = tomllib.loads((folder / "campaign.toml").read_text(encoding="utf-8"))
    assert mapped(draft["columns"]) == {h: (c, 1) for h, c in LETTERS.items() if c != "time"}
    assert "derived" not in draft and draft["rig"] == "specimen.toml"


def test_the_drafted_structure_has_the_period_of_the_isolators_and_masses_that_are_marked_as_assumed(folder):
    text = (folder / "specimen.toml").read_text(encoding="utf-8")
    specimen = tomllib.loads(text)
    assert specimen["friction"] == "none"
    stiffness = sum(float(b["stiffness"].split()[0]) * 1e6 for b in specimen["buffers"].values())
    carried = 1e3 * sum(float(m["mass"].split()[0]) for m in (specimen, *specimen["storeys"]))
    assert np.sqrt(stiffness / carried) == pytest.approx(np.sqrt(STIFFNESSES[0] / MASSES.sum()), rel=0.05)
    assert len(specimen["storeys"]) == 3 and text.count("assumed") == 4 and "ASSUMED" in text


def test_what_is_drafted_of_a_structure_can_be_read(folder):
    campaign = loaded(folder)
    assert len(campaign.specimen.storeys) == 3
    np.testing.assert_allclose(campaign.runs[0].record["slip_x"], channels(0)["slip_x"], atol=1e-7)


def test_numbers_in_names_that_count_from_the_roof_do_not_decide(tmp_path):
    names = {"time": "time [s]", "table_ax": "a0 [g]", "girder_ax": "a4 [g]", "storey_1_ax": "a3 [g]"}
    names |= {"storey_2_ax": "a2 [g]", "storey_3_ax": "a1 [g]"}
    write(tmp_path, "run.csv", 1, {header: channel for channel, header in names.items()})
    assert mapped(drafted(tmp_path)["columns"]) == {h: (c, 1) for c, h in names.items() if c != "time"}


def test_a_file_whose_levels_stand_upside_down_gets_columns_of_its_own(tmp_path):
    upside = dict(zip(LETTERS, LETTERS.values(), strict=True))
    for one, other in (("girder_ax", "storey_3_ax"), ("storey_1_ax", "storey_2_ax"), ("slip_x", "storey_3_dx"),
                       ("storey_1_dx", "storey_2_dx")):  # fmt: skip
        first, second = (next(h for h, c in LETTERS.items() if c == name) for name in (one, other))
        upside[first], upside[second] = other, one
    write(tmp_path, "a.csv", 0, LETTERS)
    write(tmp_path, "b.csv", 1, upside)
    write(tmp_path, "c.csv", 2, LETTERS)
    draft = drafted(tmp_path)
    assert [("columns" in run) for run in draft["run"]] == [False, True, False]
    assert mapped(draft["run"][1]["columns"]) == {h: (c, 1) for h, c in upside.items() if c != "time"}
    assert "# note: b.csv has its levels in another order" in (tmp_path / "campaign.toml").read_text(encoding="utf-8")
    second = loaded(tmp_path).runs[1].record
    np.testing.assert_allclose(second["storey_3_dx"], channels(1)["storey_3_dx"], atol=1e-7)
    np.testing.assert_allclose(second["girder_ax"], channels(1)["girder_ax"], atol=1e-6)


def test_a_dead_accelerometer_is_left_out_and_the_other_levels_are_mapped(tmp_path):
    dead = 1e-3 * np.random.default_rng(0).standard_normal(len(channels(0)["time"]))
    write(tmp_path, "run.csv", 0, LETTERS, storey_3_ax=dead)
    said = mapped(drafted(tmp_path)["columns"])
    lost = ("storey_3_ax", "storey_3_dx", "time")
    assert said == {h: (c, 1) for h, c in LETTERS.items() if c not in lost}
    text = (tmp_path / "campaign.toml").read_text(encoding="utf-8")
    assert "it hardly moves beside the others: is it dead?" in text
    assert "it follows that of storey_2_dx, which is taken from" in text


def test_displacements_from_elsewhere_are_computed_back_and_a_turned_floor_gets_its_sign(tmp_path):
    run = channels(0)
    changed = {
        "slip_x": run["slip_x"] + run["table_dx"],
        "storey_2_dx": run["storey_2_dx"] - run["storey_1_dx"],
        "storey_1_ax": -run["storey_1_ax"],
    }
    write(tmp_path, "run.csv", 0, LETTERS, **changed)
    draft = drafted(tmp_path)
    said = mapped(draft["columns"])
    assert said["m [mm]"] == ("slip_x_raw", 1) and said["o [mm]"] == ("storey_2_dx_raw", 1)
    assert said["k [m/s^2]"] == ("storey_1_ax", -1)
    assert draft["derived"] == {
        "slip_x": "slip_x_raw - table_dx",
        "storey_2_dx": "storey_1_dx + storey_2_dx_raw",
    }
    record = loaded(tmp_path).runs[0].record
    for name in ("slip_x", "storey_1_ax", "storey_2_dx"):
        np.testing.assert_allclose(record[name], run[name], atol=1e-4 * np.abs(run[name]).max())


def test_a_displacement_without_a_unit_gets_that_of_its_size(tmp_path):
    headers = {h.replace("m [mm]", "Hub_1"): c for h, c in LETTERS.items()}
    write(tmp_path, "run.csv", 0, headers, slip_x=1e3 * channels(0)["slip_x"])
    assert drafted(tmp_path)["columns"]["Hub_1"] == {"channel": "slip_x", "unit": "mm"}


def test_a_displacement_that_was_computed_from_accelerations_is_said_to_be_no_gauge(tmp_path):
    run = channels(0)
    drift = run["girder_ax"] - run["table_ax"]
    twice = np.cumsum(np.cumsum(drift - drift.mean())) * (run["time"][1] - run["time"][0]) ** 2
    twice = np.append(0.0, twice[:-1])
    twice -= np.polyval(np.polyfit(run["time"], twice, 3), run["time"])
    write(tmp_path, "run.csv", 0, LETTERS, slip_x=twice)
    init_campaign(tmp_path)
    lines = (tmp_path / "campaign.toml").read_text(encoding="utf-8").splitlines()
    computed = [line.split(" = ")[0] for line in lines if "too well for a gauge" in line]
    assert computed == ['"m [mm]"']


@pytest.mark.skipif(not SHARED.is_dir(), reason="the records of a real building are not here")
def test_a_real_building_is_mapped_and_the_record_in_another_order_is_named(tmp_path):
    for path in SHARED.glob("*.csv"):
        (tmp_path / path.name).symlink_to(path)
    draft = drafted(tmp_path)

    def expected(levels: range) -> dict[str, tuple[str, int]]:
        names = ["girder", *(f"storey_{i}" for i in range(1, 6))]
        out = {"u [m/s^2]": ("table_ax", 1), "du [m]": ("table_dx", 1)}
        for number, name in zip(levels, names, strict=True):
            out[f"a{number} [m/s^2]"] = (f"{name}_ax", 1)
            out[f"d{number} [m]"] = (f"{name}_dx" if name != "girder" else "slip_x", 1)
        return out

    assert mapped(draft["columns"]) == expected(range(1, 7))
    own = {run["file"]: mapped(run["columns"]) for run in draft["run"] if "columns" in run}
    assert own == {"ICA50.csv": expected(range(6, 0, -1))}
