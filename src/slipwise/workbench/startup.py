"""The session is opened beside the server: the page is there at once, and is told when the session stands."""

import asyncio
import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from slipwise.errors import SlipwiseError
from slipwise.jobs.interruption import call_off_thread
from slipwise.session.campaign_folder import CampaignFolder

if TYPE_CHECKING:  # what it takes to load them is what the page need not wait for
    from slipwise.effects import Trust
    from slipwise.workbench.hub import Room

#: A page that is on its way is waited for so long, to be told why nothing opens [s].
_ON_ITS_WAY = 10.0
#: An opening that goes on though nobody waits for it is called off again after so long [s].
_PATIENCE = 1.0


class Opening:
    """A room that is being opened."""

    def __init__(self, campaign: Path, trust: "Trust", address: str, ended: Callable[[], None]) -> None:
        """Make ready; `begin` opens it.

        Args:
            campaign: folder of the campaign.
            trust: as for `Session`.
            address: of the page, for whoever would open this campaign too.
            ended: called where it cannot be opened.
        """
        self.campaign, self.place = campaign, CampaignFolder(campaign)
        self._trust, self._address, self._ended = trust, address, ended
        self._task: asyncio.Task[Room] | None = None
        self._lost: SlipwiseError | None = None
        self._page_comes = False
        self._thread: int | None = None

    def begin(self) -> None:
        """Open the room beside the running loop."""
        self._task = asyncio.create_task(self._open())

    def expect_page(self) -> None:
        """Let a page hear that the room cannot be opened before the command ends."""
        self._page_comes = True

    def page_was_told(self) -> None:
        """End the command: a page shows why the room cannot be opened."""
        self._ended()

    @property
    def done(self) -> bool:
        """Whether the room is open, or cannot be opened."""
        return self._task is not None and self._task.done()

    async def room(self) -> "Room":
        """Wait for the room.

        Raises:
            SlipwiseError: the campaign cannot be opened.
        """
        assert self._task is not None
        return await asyncio.shield(self._task)

    async def end(self) -> None:
        """Close the room; one that is being opened is given up."""
        if self._task is not None:
            while not self.done:  # to load and to compile what a session needs can take a minute
                if self._thread is not None:
                    call_off_thread(self._thread)
                await asyncio.wait([self._task], timeout=_PATIENCE)
            if self._task.exception() is None:
                try:
                    self._task.result().close()
                except SlipwiseError as error:
                    self._lost = error

    def check(self) -> None:
        """Raise what has kept the room from being opened, or what was done last from being written, where anything did.

        Raises:
            SlipwiseError: says which file.
        """
        if self._task is not None and self.done:
            self._task.result()
        if self._lost is not None:
            raise self._lost

    async def _open(self) -> "Room":
        try:
            room = await asyncio.to_thread(self._opened)
        except BaseException:
            asyncio.get_running_loop().call_later(_ON_ITS_WAY if self._page_comes else 0.0, self._ended)
            raise
        room.begin()
        print(f"{room.session.campaign.name} is open at {self._address}", flush=True)
        print("Ctrl-C ends it; nothing is lost.", flush=True)
        return room

    def _opened(self) -> "Room":
        self._thread = threading.get_ident()
        try:
            from slipwise.workbench.hub import Room

            room = Room(self.campaign, self._trust)
            if room.session.store is not None:
                room.session.store.tell(self._address)
        finally:
            self._thread = None
        return room
