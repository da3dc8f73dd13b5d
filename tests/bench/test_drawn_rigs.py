"""Drawn rigs stand on their pads, and the library reads them as they were drawn."""

from pathlib import Path

import numpy as np
import pytest

from bench.drawn_rigs import draw_rig, specimen_toml
from slipwise.rig import load_specimen
from slipwise.rig.statics import at_rest


def test_drawn_rigs_are_of_every_size_and_read_as_drawn(tmp_path: Path) -> None:
    rigs = [draw_rig(np.random.default_rng(seed)) for seed in range(40)]
    assert min(r.mass for r in rigs) < 2e3 and max(r.mass for r in rigs) > 5e4
    slender = [r.height / r.spacing_x for r in rigs]
    assert min(slender) < 0.15 and max(slender) > 0.6
    for rig in rigs:
        path = tmp_path / "specimen.toml"
        path.write_text(specimen_toml(rig))
        read = load_specimen(path)
        assert (read.mass, read.centre_height) == pytest.approx((rig.mass, rig.height), rel=1e-3)
        assert read.half_spacing == pytest.approx((rig.spacing_x / 2, rig.spacing_y / 2), rel=1e-3)
        assert read.rated_pressure == pytest.approx(16.9e6, rel=2e-3)
        assert np.ptp(at_rest(read).load) < 1e-6 * read.weight
