"""Channels are a grammar: what a pad or a buffer of any name measures has its unit, sign and place."""

import numpy as np
import pytest

from slipwise.channels import CHANNELS, channel, channels_like, check_pattern, is_channel, pads_in, part_of
from slipwise.errors import InputError, UnknownNameError
from slipwise.record import Record


def test_a_pad_of_any_name_measures_what_pad_a_does():
    for name in CHANNELS:
        part, of = part_of(name)
        if part:
            other = channel(name.replace(f"_{of}_", "_P12_"))
            assert (other.unit, other.shown_in) == (CHANNELS[name].unit, CHANNELS[name].shown_in)
            assert "P12" in other.place


@pytest.mark.parametrize("name", ["pad_A", "pad__N", "pad_A_B_N", "pad_A_Fz", "buffer_1_N", "pads_A_N", "pad_a b_N"])
def test_other_names_are_no_channels(name):
    assert not is_channel(name)
    with pytest.raises(UnknownNameError):
        channel(name)


def test_a_pattern_means_the_channels_that_are_there():
    names = ("time", "pad_A_N", "pad_P12_N", "pad_P12_Fx", "slip_x")
    assert channels_like("pad_*_N", names) == ("pad_A_N", "pad_P12_N")
    assert channels_like("all", names) == names
    assert pads_in(names) == ("A", "P12")
    check_pattern("pad_P12_N")
    with pytest.raises(UnknownNameError, match="pad_D_N"):
        check_pattern("pad_*_M")


def test_a_record_stacks_the_pads_that_it_has_or_those_that_are_asked_for():
    time = np.arange(5.0)
    record = Record(time, {f"pad_{pad}_N": time + i for i, pad in enumerate(("B", "A", "Q7"))})
    assert record.stacked("pad_{}_N")[0] == pytest.approx([1.0, 0.0, 2.0])
    assert record.stacked("pad_{}_N", ("Q7", "B"))[0] == pytest.approx([2.0, 0.0])
    with pytest.raises(InputError, match="pad_C_N"):
        record.stacked("pad_{}_N", ("A", "C"))
