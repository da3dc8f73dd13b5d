"""Audit of a structure with accelerometers and displacements alone: its levels contradict or confirm each other."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from four_pads import describe_four_pads
from slipwise.campaign import Campaign, load_campaign
from slipwise.campaign.draft import init_campaign
from slipwise.instruments.checks import Checks, check_instruments
from slipwise.record import Record
from slipwise.signals.shift import shift
from unit.campaign.shear_building import MASSES, SHARES, STIFFNESSES, channels

SHARED = Path(__file__).parents[4] / "shared" / "building"
SPECIMEN = f"""{describe_four_pads(centre_height="0.1 m")}
[buffers]
1 = {{ x = "0 m", y = "0 m", stiffness = "0.4 kN/mm" }}
"""


@pytest.fixture(scope="module")
def building(tmp_path_factory) -> Campaign:
    folder = tmp_path_factory.mktemp("building")
    storeys = "".join(
        f'[[storeys]]\nmass = "{mass} kg"\nz = "{3 * i} m"\nstiffness = "{stiffness} N/m"\n'
        for i, (mass, stiffness) in enumerate(zip(MASSES[1:], STIFFNESSES[1:], strict=True), 1)
    )
    (folder / "specimen.toml").write_text(SPECIMEN + storeys, encoding="utf-8")
    runs = ""
    for seed, role in ((0, "fit"), (1, "holdout")):
        run = channels(seed)
        units = {name: "s" if name == "time" else "m/s^2" if "_a" in name else "m" for name in run}
        header = ",".join(f"{name} [{units[name]}]" for name in run)
        np.savetxt(
            folder / f"{role}.csv", np.stack(list(run.values()), axis=1), "%.9g", ",", header=header, comments=""
        )
        runs += f'[[run]]\nfile = "{role}.csv"\nrole = "{role}"\n'
    (folder / "campaign.toml").write_text(f'rig = "specimen.toml"\n{runs}', encoding="utf-8")
    return load_campaign(folder)


def with_runs(campaign: Campaign, change, only: str = "") -> Campaign:
    runs = (replace(r, record=change(r.record)) if only in ("", r.name) else r for r in campaign.runs)
    return replace(campaign, runs=tuple(runs))


def test_a_structure_that_is_mapped_right_is_confirmed_and_its_storeys_are_known(building):
    found = check_instruments(building)
    assert found.words.startswith("Yes: ") and not found.accused
    answers = {(a.level, a.run): a for a in found.report.levels}
    isolated, roof = answers["girder_ax", "fit"], answers["storey_3_ax", "fit"]
    assert isolated.frequency == pytest.approx(np.sqrt(STIFFNESSES[0] / MASSES.sum()) / (2 * np.pi), rel=0.03)
    assert roof.frequency == pytest.approx(np.sqrt(STIFFNESSES[3] / MASSES[3]) / (2 * np.pi), rel=0.03)
    critical = 0.5 * SHARES[0] * np.sqrt(STIFFNESSES[0] / MASSES.sum())
    assert isolated.damping == pytest.approx(critical, rel=0.1)
    assert max(a.left for a in answers.values()) < 0.05
    assert not any("no independent measurement" in note for note in found.notes)
    assert any("no load and no friction of a pad was measured" in words for words in found.cannot)


def turned(name: str):
    return lambda record: record.replaced(**{name: -record[name]})


def late(name: str, delay: float):
    return lambda record: record.replaced(**{name: shift(record[name], record.dt, delay)})


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (turned("storey_2_ax"), "storey_2_ax has the wrong sign"),
        (turned("storey_1_dx"), "storey_1_dx has the wrong sign"),
        (late("storey_2_ax", 0.03), "storey_2_ax comes "),
        (late("storey_1_ax", 1.2), "storey_1_ax comes 1.2e+03 ms late"),
        (late("storey_3_dx", 0.01), "storey_3_dx comes "),
        (lambda r: r.replaced(storey_2_dx=1.05 * r["storey_2_dx"]), "storey_2_dx reads "),
        (lambda r: r.replaced(storey_2_ax=0.01 * r["storey_2_ax"]), "storey_2_ax is dead in fit, holdout"),
    ],
    ids=["turned floor", "turned displacement", "late", "very late", "late displacement", "gain", "dead"],
)
def test_a_faulty_gauge_of_a_floor_is_the_only_one_accused(building, change, words):
    found = check_instruments(with_runs(building, change))
    assert [f.words for f in found.report.findings if words in f.words] == [f.words for f in found.report.findings]
    assert len(found.report.findings) == 1 and not found.report.contradictions


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda r: r.replaced(slip_x=r["slip_x"] + r["table_dx"]), 'write slip_x = "slip_x_raw - table_dx"'),
        (
            lambda r: r.replaced(storey_3_dx=r["storey_3_dx"] - r["slip_x"]),
            'write storey_3_dx = "storey_3_dx_raw + slip_x"',
        ),
        (lambda r: r.replaced(storey_3_dx=r["slip_x"]), "by the accelerations it is that of girder minus table"),
        (
            lambda r: r.replaced(table_dx=r["slip_x"] + r["table_dx"]),
            "by the accelerations it is",
        ),
    ],
    ids=["in space", "from another level", "of another level", "base for the table"],
)
def test_a_displacement_from_elsewhere_is_named_and_no_gauge_is_accused_for_it(building, change, words):
    found = check_instruments(with_runs(building, change))
    assert [f.words for f in found.report.findings] == []
    (said,) = found.report.contradictions
    assert words in said and said in found.words


def swapped(one: str, other: str):
    return lambda record: record.replaced(**{one: record[other], other: record[one]})


def test_levels_in_another_order_are_named_in_the_run_that_has_them(building):
    found = check_instruments(with_runs(building, swapped("storey_1_ax", "storey_3_ax"), only="holdout"))
    (said,) = found.report.contradictions
    assert said.startswith("in holdout the levels stand in another order than in the other runs")
    assert "storey_3_ax in what is mapped to storey_1_ax" in said and "[run.columns]" in said
    assert not found.report.findings and {a.run for a in found.report.levels} == {"fit"}


def test_levels_in_another_order_in_all_runs_are_an_error_of_the_columns(building):
    found = check_instruments(with_runs(building, swapped("girder_ax", "storey_2_ax")))
    (said,) = found.report.contradictions
    assert said.startswith("the levels stand in another order than [columns] says") and not found.report.findings


def test_a_floor_turned_in_one_run_alone_is_no_sign_of_its_gauge(building):
    found = check_instruments(with_runs(building, turned("storey_2_ax"), only="fit"))
    assert found.report.contradictions == (
        "storey_2_ax stands turned round in fit and not in other runs; give that run sign = -1 for it in [run.columns]",
    )


def test_accelerations_of_no_one_structure_are_not_judged(building):
    def noise(record: Record) -> Record:
        rng = np.random.default_rng(3)
        return record.replaced(**{n: rng.permutation(record[n]) for n in record.channels if n.startswith("storey_")})

    found = check_instruments(with_runs(building, noise))
    assert not found.report.levels
    assert any("does not answer" in words for words in found.cannot)


def test_a_table_that_does_not_shake_across_is_not_dead_there(building):
    def across(record: Record) -> Record:
        levels = [n for n in record.channels if n.endswith("_ax")]
        return record.replaced(**{f"{n[:-1]}y": (0.0 if n == "table_ax" else 0.02) * record[n] for n in levels})

    found = check_instruments(with_runs(building, across))
    assert not found.accused and not any("_ay does not answer" in words for words in found.cannot)


def test_a_displacement_made_of_accelerations_is_no_independent_gauge(building):
    def computed(record: Record) -> Record:
        drift = record["storey_1_ax"] - record["table_ax"]
        twice = np.append(0.0, np.cumsum(np.cumsum(drift - drift.mean()))[:-1]) * record.dt**2
        return record.replaced(storey_1_dx=twice - np.polyval(np.polyfit(record.time, twice, 3), record.time))

    (note,) = [n for n in check_instruments(with_runs(building, computed)).notes if "independent" in n]
    assert note.startswith("storey_1_dx is the double integral of accelerations, too well for a gauge")


@pytest.mark.skipif(not SHARED.is_dir(), reason="the records of a real building are not here")
def test_a_real_building_as_drafted_is_confirmed_and_its_displacements_are_no_gauges(tmp_path):
    for path in SHARED.glob("CNP100.csv"):
        (tmp_path / path.name).symlink_to(path)
    init_campaign(tmp_path)
    specimen = tmp_path / "specimen.toml"
    lines = specimen.read_text(encoding="utf-8").splitlines()
    specimen.write_text("\n".join(line for line in lines if not line.startswith("friction")), encoding="utf-8")
    found: Checks = check_instruments(tmp_path)
    assert not found.accused and len(found.report.levels) == 6
    isolated = found.report.levels[0]
    assert 1.0 / isolated.frequency == pytest.approx(2.3, abs=0.15)
    (note,) = [n for n in found.notes if "independent" in n]
    assert all(name in note for name in ("table_dx", "slip_x", *(f"storey_{i}_dx" for i in range(1, 6))))
