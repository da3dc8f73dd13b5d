"""A session that is being opened is given up when the workbench ends: nobody waits for what it takes to open it."""

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor

from slipwise.workbench.startup import Opening


class SlowRoom:
    """A room that opens as slowly as after an installation, and swallows the first wish to end, as a finaliser does."""

    begun, given_up, open_at_last = False, 0, False

    def __init__(self, campaign, trust) -> None:
        until = time.monotonic() + 30.0
        SlowRoom.begun = True
        while time.monotonic() < until:
            try:
                time.sleep(0.01)
            except BaseException:
                SlowRoom.given_up += 1
                if SlowRoom.given_up == 2:
                    raise
        SlowRoom.open_at_last = True


def test_a_workbench_that_ends_does_not_wait_for_its_session_to_open(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr("slipwise.workbench.hub.Room", SlowRoom)

    async def end_early():
        opening = Opening(tmp_path, False, "http://127.0.0.1:1/", lambda: None)
        opening.begin()
        while not SlowRoom.begun:
            await asyncio.sleep(0.01)
        await opening.end()
        assert opening.done

    # in a thread of its own: a browser's test that ran before in this process leaves its event loop running in this one
    with ThreadPoolExecutor(1) as thread:
        thread.submit(lambda: asyncio.run(end_early())).result(timeout=60.0)
    assert SlowRoom.given_up == 2 and not SlowRoom.open_at_last and "is open" not in capsys.readouterr().out
