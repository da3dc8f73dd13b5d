"""Campaigns that lack gauges, or the beginning of every record: what is left is named, what it cannot show is said."""

from dataclasses import replace

import pytest

from measured import fit_base
from slipwise.campaign import Campaign, Logger
from slipwise.diagnosis.diagnose import diagnose
from slipwise.errors import InputError
from slipwise.record import Record
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

pytestmark = pytest.mark.long


def _without(campaign: Campaign, *gauges: str) -> Campaign:
    def left(record: Record) -> Record:
        return Record(record.time, {name: values for name, values in record.channels.items() if name not in gauges})

    return replace(campaign, runs=tuple(replace(run, record=left(run.record)) for run in campaign.runs))


@pytest.fixture(scope="module")
def play() -> Campaign:
    """Play in the shear key."""
    return as_campaign(build_campaign(7011, effects=("key_clearance",), size="medium"))


def test_a_buffer_shows_in_the_girders_pitch_where_nobody_measured_its_acceleration(play: Campaign) -> None:
    found = diagnose(_without(play, "girder_ax", "girder_az"))
    assert found.verdict.effects == ("key_clearance",), found.sentence
    assert "girder" not in found.relations


@pytest.mark.parametrize("known", [True, False])
def test_pads_alone_accuse_nobody_of_what_only_balances_see(play: Campaign, known: bool) -> None:
    """Reversals look right only through the logger's filter, of which two pads tell as well as four."""
    few = _without(play, "pad_B_Fx", "pad_D_Fx")
    found = diagnose(few if known else replace(few, logger=Logger()))
    assert found.verdict.kind == "complete", found.sentence
    assert found.final_error < 1.15
    assert any(reason.startswith("key_clearance:") for reason in found.cannot_tell)


def test_friction_without_any_load_is_refused_in_words(play: Campaign) -> None:
    with pytest.raises(InputError, match=r"pad_\*_N"):
        fit_base(_without(play, *(f"pad_{p}_N" for p in "ABCD")))


def test_a_pad_without_a_load_is_left_out(play: Campaign) -> None:
    assert fit_base(_without(play, "pad_B_N")).objective.runs[0].pads == ("A", "C", "D")


def test_records_that_begin_in_motion_name_what_whole_ones_do(play: Campaign) -> None:
    """Beyond the cut nobody knows how the slip bends, and its accelerometers seem to disagree."""

    def cut(record: Record) -> Record:
        kept = record.time >= 2.6
        return Record(record.time[kept], {name: values[kept] for name, values in record.channels.items()})

    late = replace(play, runs=tuple(replace(run, record=cut(run.record)) for run in play.runs))
    found = diagnose(late)
    assert not any(run.states.at_rest[0] for run in found.final.objective.runs)
    assert found.verdict.effects == ("key_clearance",), found.sentence
    assert found.final_error < 1.15
