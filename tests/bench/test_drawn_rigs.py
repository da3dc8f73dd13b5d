"""Drawn rigs stand on their pads, and the library reads them as they were drawn."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.rig import load_specimen
from slipwise.rig.statics import at_rest
from slipwise_benchmarks.campaign import make_campaign
from slipwise_benchmarks.drawn_rigs import DRAWN, draw_rig, possible_on
from slipwise_benchmarks.hidden import hide
from slipwise_benchmarks.specimen_text import specimen_toml

RIGS = [draw_rig(np.random.default_rng(seed)) for seed in range(60)]


def test_drawn_rigs_are_of_every_size_and_kind():
    assert min(r.mass for r in RIGS) < 2e3 and max(r.mass for r in RIGS) > 5e4
    slender = [r.height / r.spacing_x for r in RIGS]
    assert min(slender) < 0.15 and max(slender) > 0.6
    assert {len(r.pads) for r in RIGS} == set(range(3, 9))
    assert {len(r.buffers) for r in RIGS} == set(range(5))
    radii = [1.0 / r.pads[0].curvature for r in RIGS if r.pads[0].curvature]
    assert min(radii) < 1.0 and max(radii) > 2.0 and len(radii) < len(RIGS) / 2


def test_the_library_reads_a_drawn_rig_as_it_was_drawn(tmp_path: Path):
    for rig in RIGS:
        path = tmp_path / "specimen.toml"
        path.write_text(specimen_toml(rig))
        read = load_specimen(path)
        assert (read.mass, read.centre_height) == pytest.approx((rig.mass, rig.height), rel=1e-3)
        for place, pad in zip(read.places, rig.pads, strict=True):
            assert (place.x, place.y) == pytest.approx((pad.x, pad.y), rel=1e-4, abs=1e-6)
            assert place.stiffness == pytest.approx(pad.stiffness, rel=1e-3)
            assert place.curvature == pytest.approx(pad.curvature, rel=1e-5)
        assert len(read.buffers) == len(rig.buffers)
        assert at_rest(read).load.min() > 0.4 * read.weight / len(rig.pads)


def test_what_hides_makes_sense_on_a_rig():
    for rig in RIGS:
        names = possible_on(rig)
        assert rig.buffers or not any(name.startswith(("buffer_", "key_")) for name in names)
        assert ("uneven_seating" in names) == (len(rig.pads) > 3)
        hide(names, "large", rig, np.random.default_rng(1))


@pytest.mark.slow
def test_a_drawn_campaign_has_its_rig_beside_it_and_is_read(tmp_path: Path):
    truth = make_campaign(tmp_path / "r1", 36_400, effects=[], rig=DRAWN)
    campaign = load_campaign(tmp_path / "r1")
    assert truth.missing == () and truth.size_in_floors < 0.05
    assert len(campaign.specimen.pads) == len(truth.base.pads)
