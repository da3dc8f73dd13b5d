"""Measured and simulated rigs stand side by side on one timeline."""

import numpy as np
import pytest
from rerun.chunk import RrdReader

from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.view.recordings.comparison import write_comparison


def columns(path, entity: str, ending: str) -> list:
    for chunk in RrdReader(path).stream():
        batch = chunk.to_record_batch()
        for name in batch.schema.names:
            if chunk.entity_path == entity and name.endswith(ending):
                return batch.column(name).to_pylist()
    raise AssertionError(f"no {ending} at {entity}")


@pytest.fixture(scope="module")
def simulated(record) -> Record:
    """Pad A is off by a constant; the sampling is another one and the run ends earlier."""
    time = np.arange(0.0, 6.0, 0.0025)
    channels = {name: np.interp(time, record.time, values) for name, values in record.channels.items()}
    channels["pad_A_Fx"] = channels["pad_A_Fx"] + 3000.0
    return Record(time, channels)


@pytest.fixture(scope="module")
def path(record, simulated, geometry, tmp_path_factory):
    return write_comparison(
        record,
        [("base model", simulated), ("+ heating", record)],
        geometry,
        tmp_path_factory.mktemp("c") / "c.rrd",
        "t",
    )


def test_rigs_stand_beside_each_other_and_share_the_time_they_have_in_common(path, record):
    places = [columns(path, f"/rigs/{i}/table", "Transform3D:translation")[0][0] for i in range(3)]
    assert places[0][0] < places[1][0] < places[2][0]
    times = columns(path, "/rigs/1/table", "time")
    assert times == columns(path, "/rigs/0/table", "time")
    assert times[-1].total_seconds() == pytest.approx(5.99, abs=0.02)


def test_a_pad_is_coloured_by_its_residual_and_only_that_pad(path):
    off = np.array(columns(path, "/rigs/1/table/pads", "Cylinders3D:colors"))
    agrees, differs = 0x5F6B7AFF, 0xFF3D8BFF
    assert np.all(off[:, 1:] == agrees)
    assert np.mean(off[:, 0] == differs) > 0.5
    perfect = np.array(columns(path, "/rigs/2/table/pads", "Cylinders3D:colors"))
    assert np.all(perfect == agrees)


def test_series_and_loops_lie_over_one_another_and_residuals_are_simulated_minus_measured(path):
    for entity in ("/channels/slip_x/0", "/channels/slip_x/2", "/loops/0/A/past", "/loops/2/sum/past"):
        assert columns(path, entity, "time")
    residual = [row[0] for row in columns(path, "/residuals/pad_A_Fx/1", "Scalars:scalars")]
    assert np.median(residual) == pytest.approx(3.0, abs=0.05)


def test_labels_must_tell_the_simulations_apart(record, simulated, geometry, tmp_path):
    for wrong in ([], [("a", simulated), ("a", simulated)], [("measured", simulated)]):
        with pytest.raises(InputError, match="labels of their own"):
            write_comparison(record, wrong, geometry, tmp_path / "x.rrd", "t")


def test_records_that_share_no_time_are_refused(record, simulated, geometry, tmp_path):
    later = Record(simulated.time + 100.0, simulated.channels)
    with pytest.raises(InputError, match="share no time"):
        write_comparison(record, [("a", later)], geometry, tmp_path / "x.rrd", "t")
    assert list(tmp_path.iterdir()) == []
