"""Cells of the pads on a logger that was started late are brought forward; others stay where they are."""

from dataclasses import replace

import numpy as np
import pytest

from measured import mended_for_fits
from slipwise.campaign import Campaign
from slipwise.preparation.data_corrections import describe_corrections
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.preparation.synchronisation import find_late_cells, find_late_motion, synchronise, without_partner
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

CELLS = tuple(f"pad_{pad}_{kind}" for pad in "ABCD" for kind in ("N", "Fx"))


@pytest.fixture(scope="module")
def sound() -> Campaign:
    return as_campaign(build_campaign(61, effects=(), rig="bridge1"))


def late_by(sound: Campaign, delay: float, channels: tuple[str, ...] = CELLS) -> Campaign:
    runs = (replace(run, record=synchronise(run.record, channels, -delay)) for run in sound.runs)
    return replace(sound, runs=tuple(runs))


def test_cells_that_are_in_step_are_not_late(sound: Campaign) -> None:
    assert find_late_cells(sound) is None and find_late_motion(sound) is None
    assert "late" not in {fault.kind for fault in find_sample_faults(sound)}


@pytest.mark.parametrize("delay", [0.1, 0.5, -0.3])
def test_how_late_cells_are_is_found_within_two_milliseconds(sound: Campaign, delay: float) -> None:
    found = find_late_cells(late_by(sound, delay))
    assert found is not None
    assert set(found.channels) == set(CELLS)
    assert found.delay == pytest.approx(delay, abs=2e-3)


@pytest.mark.parametrize("delay", [0.0, 0.087, 1.145, -0.3])
def test_load_cells_alone_show_by_inertia_how_late_they_are(sound: Campaign, delay: float) -> None:
    loads = tuple(name for name in CELLS if name.endswith("_N"))
    late = late_by(sound, delay, loads)
    kept = {r.name: {n: x for n, x in r.record.channels.items() if not n.endswith("_Fx")} for r in late.runs}
    runs = (replace(run, record=replace(run.record, channels=kept[run.name])) for run in late.runs)
    found = find_late_cells(replace(late, runs=tuple(runs)))
    assert (found is None) == (delay == 0.0)
    assert found is None or (set(found.channels) == set(loads) and found.delay == pytest.approx(delay, abs=2e-3))


@pytest.mark.parametrize("delay", [0.18, -0.3])
def test_a_cell_on_a_late_module_is_found_by_the_others_and_is_not_taken_for_turned(
    sound: Campaign, delay: float
) -> None:
    campaign = late_by(sound, delay, ("pad_A_Fx",))
    assert find_late_cells(campaign) is None
    found = {fault.channels: (fault.kind, fault.size) for fault in find_sample_faults(campaign)}
    assert found == {("pad_A_Fx",): ("late", pytest.approx(delay, abs=2e-3))}


def test_of_two_cells_that_contradict_each_other_none_is_called_late(sound: Campaign) -> None:
    both = late_by(late_by(sound, 0.2, ("pad_A_Fx",)), -0.2, ("pad_B_Fx",))
    assert "late" not in {fault.kind for fault in find_sample_faults(both)}


def test_late_cells_are_brought_forward_and_their_end_is_not_judged(sound: Campaign) -> None:
    campaign = late_by(sound, 0.25)
    faults = find_sample_faults(campaign)
    (told,) = (thing for thing in describe_corrections(faults) if thing.kind == "late")
    assert set(told.channels) == set(CELLS) and "s behind the other channels" in told.words
    whole, invalid = mended_for_fits(campaign, faults)
    run, true = whole.runs[0], sound.runs[0].record
    judged = ~invalid[run.name]["pad_A_N"]
    assert np.flatnonzero(~judged)[0] >= len(true) - round(0.27 / true.dt)
    middle = slice(200, -400)
    assert np.std((run.record["pad_A_N"] - true["pad_A_N"])[middle]) < 0.2 * np.std(true["pad_A_N"])


def test_the_samples_without_partners_lie_at_the_end_that_is_missing() -> None:
    assert list(np.flatnonzero(without_partner(100, 0.01, 0.05))) == [94, 95, 96, 97, 98, 99]
    assert list(np.flatnonzero(without_partner(100, 0.01, -0.05))) == [0, 1, 2, 3, 4, 5]


GIRDER, TABLE = ("girder_ax", "girder_ay", "girder_az"), ("table_ax", "table_ay", "table_az")


@pytest.mark.parametrize(
    ("channels", "delay"),
    [(GIRDER, 0.3), (GIRDER, -1.2), (TABLE, 0.2), (TABLE, 2.0), ((*GIRDER, *TABLE), 0.4), (("slip_x", "slip_y"), 0.25)],
)
def test_gauges_of_the_motion_on_a_late_logger_are_found(
    sound: Campaign, channels: tuple[str, ...], delay: float
) -> None:
    there = tuple(name for name in channels if name in sound.runs[0].record)
    found = find_late_motion(late_by(sound, delay, there))
    assert found is not None
    assert set(there) <= set(found.channels)
    assert {name.split("_")[0] for name in found.channels} - {"yaw"} == {name.split("_")[0] for name in there}
    assert found.delay == pytest.approx(delay, abs=2e-3)


def test_a_late_table_and_late_cells_are_told_apart(sound: Campaign) -> None:
    both = late_by(late_by(sound, 0.2, TABLE), 0.5)
    late = [(set(f.channels), f.size) for f in find_sample_faults(both) if f.kind == "late"]
    assert [channels & {"table_ax", "pad_A_N"} for channels, _ in late] == [{"table_ax"}, {"pad_A_N"}]
    assert [size for _, size in late] == pytest.approx([0.2, 0.5], abs=3e-3)
