"""Watches whether a campaign's folder is still where it was opened: a page that lies still is told too."""

import asyncio
from collections.abc import Awaitable, Callable

from slipwise.session.campaign_folder import CampaignFolder

#: How long a folder may have been moved before somebody is told [s].
_EVERY = 1.0


async def watch_folder(place: CampaignFolder, tell: Callable[[str], Awaitable[None]]) -> None:
    """Tell what became of a folder, whenever that changes, until the task is cancelled.

    Args:
        place: the folder.
        tell: called with words, or with "" where the folder is back at its place.
    """
    told = ""
    while True:
        words = await asyncio.to_thread(place.moved)  # a share that has gone lets its reader wait
        if words != told:
            told = words
            await tell(words)
        await asyncio.sleep(_EVERY)
