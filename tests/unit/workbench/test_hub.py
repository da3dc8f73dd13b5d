"""What a page asks for twice is done once."""

from types import SimpleNamespace

import pytest

pytest.importorskip("starlette")
from slipwise.workbench.hub import Room  # noqa: E402  needs the extra


def test_a_law_that_is_asked_for_twice_stays_in_the_model():
    labels = ["breakaway"]
    session = SimpleNamespace(
        findings={"discover": {"files": ["law.py"]}},
        state=SimpleNamespace(labels=labels),
        effect=lambda name: SimpleNamespace(name=name.removesuffix(".py")),
        toggle=lambda name: labels.append(name.removesuffix(".py")),
    )
    room = object.__new__(Room)
    room.session, room._laws = session, {"law.py"}

    async def change(what):
        what(session)

    room.change = change
    for _ in range(2):  # nothing here waits: a loop of its own would clash with one that a browser has left running
        with pytest.raises(StopIteration):
            room.add_law().send(None)
    assert labels == ["breakaway", "law"]
