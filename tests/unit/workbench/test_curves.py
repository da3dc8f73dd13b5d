"""What the page draws of a run: friction of every pad, or what all bearings carry where none was measured."""

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("starlette")
from session_campaign import write_session_campaign  # noqa: E402
from slipwise.session.session import Session  # noqa: E402
from slipwise.workbench.curves import View, curves_frame, measured_frame  # noqa: E402  needs the extra
from slipwise.workbench.replies import campaign_told  # noqa: E402
from slipwise_benchmarks.without_gauges import write_without  # noqa: E402
from unpacked_frame import unpacked  # noqa: E402

RUN = "quake2_hv"


@pytest.fixture(scope="module")
def gauged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_session_campaign(tmp_path_factory.mktemp("gauged") / "march")


def test_friction_of_every_pad_is_shown_where_it_was_measured(gauged: Path) -> None:
    session = Session(gauged, keep=False)
    head, arrays = unpacked(measured_frame(session, RUN))
    assert head["panels"] == ["Pad A", "Pad B", "Pad C", "Pad D"] and campaign_told(session)["pads"] == list("ABCD")
    _, curves = unpacked(curves_frame(session, View(RUN)))
    assert curves["pads"].shape == arrays["force"].shape == (len(arrays["time"]), 4)


@pytest.mark.parametrize("gone", ["forces", "pads"])
def test_force_of_all_bearings_is_shown_where_no_pads_was_measured(gone: str, gauged: Path, tmp_path: Path) -> None:
    write_without(gauged, tmp_path / "bare", gone)
    whole, bare = Session(gauged, keep=False), Session(tmp_path / "bare", keep=False)
    head, arrays = unpacked(measured_frame(bare, RUN))
    assert head["panels"] == ["All bearings"] and campaign_told(bare)["pads"] == []
    _, known = unpacked(measured_frame(whole, RUN))
    specimen = bare.campaign.specimen
    given = known["force"].sum(axis=1) + sum(specimen.buffer_stiffness) * known["slip"]
    assert arrays["force"].shape == (len(given), 1)
    assert np.std(arrays["force"][:, 0] - given) < 0.1 * np.std(given)
    head, curves = unpacked(curves_frame(bare, View(RUN)))
    assert head["unit"] == "N" and head["labels"] == ["all bearings"]
    left = curves["pads"][:, 0] - arrays["force"][:, 0]
    assert 0.0 < np.nanstd(left) < 0.5 * np.std(given)
    _, dragged = unpacked(curves_frame(bare, View(RUN), dragged=True))
    assert dragged["pads"].shape[1] == 1
    girder, _ = unpacked(curves_frame(bare, View(RUN, "girder")))
    assert girder["relation"] == "girder"
