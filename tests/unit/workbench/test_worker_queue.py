"""Work waits once, begins in order, and is not asked for again while it is being done."""

import pytest

pytest.importorskip("starlette")
from slipwise.errors import SettingError
from slipwise.workbench.worker_queue import Lane


@pytest.fixture
def lane(tmp_path, monkeypatch):
    made = Lane(tmp_path, False, lambda lane, report: None, aside=True)
    monkeypatch.setattr(made._worker, "start", lambda job, run, state: 1)
    return made


def test_work_begins_in_order_and_one_piece_at_a_time(lane):
    for job in ("replay", "locate", "replay"):
        lane.ask(job)
    assert lane.waiting == [("replay", ""), ("locate", "")]
    assert lane.next(dict).job == "replay" and lane.next(dict) is None
    with pytest.raises(SettingError, match="replay is still at work"):
        lane.refuse_if_busy()


def test_what_is_needed_is_not_done_twice_but_a_change_may_ask_for_it_anew(lane):
    lane.need("fit")
    lane.next(dict)
    lane.need("fit")  # as a second page does that is opened meanwhile
    assert lane.waiting == []
    lane.ask("fit")  # of the model as it is now
    assert lane.waiting == [("fit", "")]
