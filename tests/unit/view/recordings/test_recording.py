"""A recording holds the rig, its forces, its loops and every channel, on one timeline."""

import numpy as np
import pytest
from rerun.chunk import RrdReader

from slipwise.errors import InputError, SettingError
from slipwise.record import Record
from slipwise.rig.storeys import Storey
from slipwise.view.figures.style import UPLIFT, packed
from slipwise.view.geometry import RigGeometry
from slipwise.view.recordings.recording import write_recording
from slipwise.view.recordings.scene import nice_zoom


class Content:
    """Columns of a recording by entity path and the end of their name."""

    def __init__(self, path, kind: str = "recordings") -> None:
        reader = RrdReader(path)
        (self.store,) = getattr(reader, kind)()
        self.chunks = [chunk for chunk in reader.stream(store=self.store)]
        self.entities = {chunk.entity_path for chunk in self.chunks}

    def column(self, entity: str, ending: str) -> list:
        for chunk in self.chunks:
            batch = chunk.to_record_batch()
            for name in batch.schema.names:
                if chunk.entity_path == entity and name.endswith(ending):
                    return batch.column(name).to_pylist()
        raise AssertionError(f"no {ending} at {entity}; entities: {sorted(self.entities)}")

    def times(self, entity: str) -> np.ndarray:
        for chunk in self.chunks:
            if chunk.entity_path == entity and "time" in chunk.timeline_names:
                return chunk.to_record_batch().column("time").to_numpy(zero_copy_only=False).astype(np.int64) * 1e-9
        raise AssertionError(f"nothing happens at {entity}")


@pytest.fixture(scope="module")
def content(record, geometry, tmp_path_factory) -> Content:
    return Content(write_recording(record, geometry, tmp_path_factory.mktemp("r") / "run.rrd", "a title"))


def test_every_channel_is_there_in_the_units_that_people_read(content, record):
    assert {f"/channels/{name}" for name in record.channels} <= content.entities
    slip = [row[0] for row in content.column("/channels/slip_x", "Scalars:scalars")]
    assert max(slip) == pytest.approx(1e3 * record["slip_x"].max())
    assert min(content.column("/channels/pad_B_N", "Scalars:scalars"))[0] == pytest.approx(0.0)


def test_the_rig_stands_in_the_laboratory_and_on_the_table(content):
    for root in ("/laboratory", "/on_the_table"):
        for part in ("table/top", "table/rubber", "table/pads", "table/girder/deck", "table/load", "table/friction"):
            assert f"{root}/{part}" in content.entities


def test_the_table_moves_in_the_laboratory_and_stands_still_in_its_own_frame(content, record):
    zoom = nice_zoom(np.abs(record["table_dx"]).max(), 0.75)
    moved = np.array(content.column("/laboratory/table", "Transform3D:translation"))[:, 0]
    shown = np.interp(content.times("/laboratory/table"), record.time, zoom * record["table_dx"])
    np.testing.assert_allclose(moved[:, 0], shown, atol=1e-4)
    still = np.array(content.column("/on_the_table/table", "Transform3D:translation"))
    assert np.all(still == 0.0)
    slip = np.array(content.column("/on_the_table/table/girder", "Transform3D:translation"))[:, 0, 0]
    assert slip.max() / record["slip_x"].max() == pytest.approx(
        nice_zoom(np.abs(record["slip_x"]).max(), 0.5), rel=1e-2
    )


def test_arrows_are_as_long_as_the_forces(content, record, geometry):
    loads = np.array(content.column("/laboratory/table/load", "Arrows3D:vectors"))
    times = content.times("/laboratory/table/load")
    assert loads.shape == (len(times), 4, 3) and np.all(loads[:, :, :2] == 0.0)
    unit = loads[0, 0, 2] / record["pad_A_N"][0]
    np.testing.assert_allclose(loads[:, 1, 2], unit * np.interp(times, record.time, record["pad_B_N"]), atol=1e-4)
    friction = np.array(content.column("/laboratory/table/friction", "Arrows3D:vectors"))
    expected = 10 * unit * np.interp(times, record.time, record["pad_C_Fx"])
    np.testing.assert_allclose(friction[:, 2, 0], expected, atol=1e-3)


def test_uplift_is_marked_by_colour_for_as_long_as_it_lasts(content, record):
    colours = np.array(content.column("/laboratory/table/pads", "Cylinders3D:colors"))
    times = content.times("/laboratory/table/pads")
    lifted = np.any(colours == packed(UPLIFT), axis=1)
    assert lifted.any() and not lifted.all() and not lifted[0]
    assert np.all(record["pad_A_N"][np.searchsorted(record.time, times[colours[:, 0] == packed(UPLIFT)] - 1e-6)] <= 0.0)
    words = {row[0] for row in content.column("/pads/pad_A", "StateChange:state")}
    assert words == {"slides", "sticks", "lifted off"}


def test_loops_grow_to_the_whole_loop(content, record):
    for panel in ("A", "B", "C", "D", "sum"):
        pieces = content.column(f"/loops/0/{panel}/past", "LineStrips2D:strips")
        assert len(pieces) == pytest.approx(25 * record.time[-1], rel=0.05)
        ends = [piece[0][-1] for piece in pieces]
        assert all(piece[0][0] == end for piece, end in zip(pieces[1:], ends[:-1], strict=True)), "no gap"
        dot = content.column(f"/loops/0/{panel}/now", "Points2D:positions")[-1][0]
        np.testing.assert_allclose(ends[-1], dot, atol=2.0)


def test_the_layout_opens_with_the_rig_the_loops_the_series_and_an_explanation(record, geometry, tmp_path):
    path = write_recording(record, geometry, tmp_path / "run.rrd", "a title")
    layout = Content(path, "blueprints")
    text = "\n".join(str(chunk) for chunk in layout.chunks)
    for view in ("3D", "2D", "TimeSeries", "TextDocument", "StateTimeline"):
        assert view in text
    words = Content(path).column("/about", "TextDocument:text")[0][0]
    assert words.startswith("# a title") and "magenta" in words and "bridge1" in words


def test_the_same_record_gives_the_same_content_and_another_record_another_id(record, geometry, tmp_path):
    first = Content(write_recording(record, geometry, tmp_path / "1.rrd", "t"))
    second = Content(write_recording(record, geometry, tmp_path / "2.rrd", "t"))
    assert first.store.recording_id == second.store.recording_id
    assert first.entities == second.entities
    for entity, ending in (
        ("/laboratory/table", "translation"),
        ("/channels/yaw", "scalars"),
        ("/loops/board", "blob"),
    ):
        assert first.column(entity, ending) == second.column(entity, ending)
    other = write_recording(record.replaced(slip_x=0.9 * record["slip_x"]), geometry, tmp_path / "3.rrd", "t")
    assert Content(other).store.recording_id != first.store.recording_id
    assert sorted(path.name for path in tmp_path.iterdir()) == ["1.rrd", "2.rrd", "3.rrd"]


def test_a_sparse_record_shows_what_it_has_and_names_what_it_lacks(record, geometry, tmp_path):
    sparse = Record(record.time, {name: record[name] for name in ("slip_x", "pad_A_N", "pad_A_Fx")})
    content = Content(write_recording(sparse, geometry, tmp_path / "s.rrd", "sparse"))
    words = content.column("/about", "TextDocument:text")[0][0]
    assert "Not recorded" in words and "table_dx" in words and "pad_B_N" in words and "pad_A_N" not in words
    assert "/loops/0/A/past" in content.entities and "/loops/0/sum/past" not in content.entities
    assert "/laboratory/table/buffer_force" not in content.entities


def test_a_record_in_which_nothing_can_move_is_refused(record, geometry, tmp_path):
    for poor in (Record(record.time, {"pad_A_N": record["pad_A_N"]}), record.between(0.0, 0.0)):
        with pytest.raises(InputError, match="slip_x over at least two samples"):
            write_recording(poor, geometry, tmp_path / "x.rrd", "t")
    assert list(tmp_path.iterdir()) == []


def test_pads_that_hang_on_the_girder_travel_with_it(record, geometry, tmp_path):
    hanging = RigGeometry(**{**vars(geometry), "pads_on": "girder"})
    content = Content(write_recording(record, hanging, tmp_path / "g.rrd", "t"))
    assert "/laboratory/table/girder/pads" in content.entities and "/laboratory/table/pads" not in content.entities


def test_a_rig_of_one_pad_is_drawn(record, geometry, tmp_path):
    one = RigGeometry(**{**vars(geometry), "pad_places": ((0.0, 0.0),), "buffer_places": ()})
    content = Content(write_recording(record, one, tmp_path / "p.rrd", "t"))
    assert np.array(content.column("/laboratory/table/load", "Arrows3D:vectors")).shape[1] == 1


def test_floors_sway_as_far_as_their_columns_give_way_and_stand_still_where_nothing_was_measured(
    record, geometry, tmp_path
):
    storeys = (Storey(3e3, 1.5, 2e6, 1e6, 0.0, 0.0), Storey(2e3, 2.7, 1e6, 1e6, 0.0, 0.0))
    framed = RigGeometry(**{**vars(geometry), "storeys": storeys})
    still = Content(write_recording(record, framed, tmp_path / "still.rrd", "t"))
    place = np.array(still.column("/on_the_table/table/girder/storeys/floors", "Boxes3D:centers"))
    assert np.ptp(place, axis=0).max() == 0.0 and place[0, :, 2].tolist() == pytest.approx([1.5, 2.7])
    moved = record.replaced(storey_1_ax=record["girder_ax"], storey_2_ax=2.0 * record["girder_ax"])
    content = Content(write_recording(moved, framed, tmp_path / "moved.rrd", "t"))
    zoom = nice_zoom(np.abs(record["slip_x"]).max(), 0.5)
    top = np.array(content.column("/on_the_table/table/girder/storeys/floors", "Boxes3D:centers"))[:, 1, 0]
    sway = -((3e3 + 4e3) / 2e6 + 4e3 / 1e6) * record["girder_ax"]
    shown = np.interp(content.times("/on_the_table/table/girder/storeys/floors"), record.time, zoom * sway)
    assert top == pytest.approx(shown, abs=1e-5)
    columns = np.array(content.column("/on_the_table/table/girder/storeys/columns", "LineStrips3D:strips"))
    assert columns.shape[1:] == (8, 2, 3)


@pytest.mark.parametrize("pads_on", ["table", "girder"])
def test_a_slider_stays_on_its_curved_plate_as_drawn(record, geometry, tmp_path, pads_on):
    curved = RigGeometry(**{**vars(geometry), "pads_on": pads_on, "pad_curvatures": (0.0, 0.5, 0.5, 0.5)})
    content = Content(write_recording(record, curved, tmp_path / "c.rrd", "t"))
    zoom = nice_zoom(np.abs(record["slip_x"]).max(), 0.5)
    path = "/on_the_table/table/girder/plates" if pads_on == "table" else "/on_the_table/table/plates"
    points = np.array(content.column(path, "Mesh3D:vertex_positions")[0])
    assert len(points) % 3 == 0
    from_b = points[: len(points) // 3] - [*geometry.pad_places[1], 0.0]
    away = np.hypot(from_b[:, 0], from_b[:, 1])
    rise = zoom * 0.5 * 0.5 * (away / zoom) ** 2
    assert from_b[:, 2] == pytest.approx(-rise if pads_on == "table" else rise, abs=1e-6)
    assert away.max() > zoom * np.abs(record["slip_x"]).max()


def test_a_shape_that_cannot_be_drawn_is_refused(geometry):
    with pytest.raises(SettingError, match="one pad or more"):
        RigGeometry(**{**vars(geometry), "pad_places": ()})
    with pytest.raises(SettingError, match="above zero"):
        RigGeometry(**{**vars(geometry), "mass": 0.0})


@pytest.mark.parametrize(("largest", "zoom"), [(0.025, 20.0), (0.1, 5.0), (0.4, 1.0), (3.0, 1.0), (0.0, 1.0)])
def test_motion_is_enlarged_by_round_factors_and_never_shrunk(largest, zoom):
    assert nice_zoom(largest, 0.5) == zoom
