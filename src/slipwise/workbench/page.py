"""One open page, as the server knows it."""

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import Any

from slipwise.workbench.curves import View

#: Gives text (as JSON) or bytes to one page.
Send = Callable[[Mapping[str, Any] | bytes], Awaitable[None]]


@dataclass
class Page:
    """One open page.

    Attributes:
        send: gives it a message.
        view: what it looks at.
        measured: runs whose measurement it has.
    """

    send: Send
    view: View
    measured: set[str]

    async def tell_problem(self, words: str) -> None:
        """Say what could not be done, in words."""
        await self.send({"kind": "problem", "job": "", "words": words})
