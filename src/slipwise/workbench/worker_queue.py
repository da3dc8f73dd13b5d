"""Where work is done, and in which order: what a user asks for at once, what nobody asked for beside it."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.effects import Trust
from slipwise.errors import SettingError
from slipwise.workbench.worker import Report, Worker


@dataclass
class Piece:
    """A piece of work that is being done.

    Attributes:
        job: name.
        run: that it looks at, for work on one run.
        number: that the worker has given it.
        began: when [s].
    """

    job: str
    run: str
    number: int
    began: float

    @property
    def seconds(self) -> float:
        """How long it has been at work."""
        return time.monotonic() - self.began


class Lane:
    """A process for one piece of work after another."""

    def __init__(self, campaign: Path, trust: Trust, hear: Callable[["Lane", Report], None], *, aside: bool) -> None:
        """Make ready.

        Args:
            campaign: folder of the campaign.
            trust: as for `Session`.
            hear: called with every report, from a thread.
            aside: with what the other leaves of the cores.
        """
        self.aside = aside
        self.now: Piece | None = None
        self.waiting: list[tuple[str, str]] = []
        self._worker = Worker(campaign, trust, lambda report: hear(self, report), aside=aside)

    def warm(self) -> None:
        """Get the process ready before there is anything to do."""
        self._worker.begin()

    def ask(self, job: str, run: str = "") -> None:
        """Let a piece of work wait; once is enough."""
        if (job, run) not in self.waiting:
            self.waiting.append((job, run))

    def need(self, job: str) -> None:
        """Let a piece of work wait, where it is neither waiting nor being done."""
        if self.now is None or self.now.job != job:
            self.ask(job)

    def refuse_if_busy(self) -> None:
        """Say that something is being done, if so.

        Raises:
            SettingError: names it.
        """
        if self.now is not None:
            raise SettingError(f"{self.now.job} is still at work; wait for it, or cancel it")

    def next(self, state: Callable[[], Mapping[str, Any]]) -> Piece | None:
        """Begin what waits, if nothing is being done; gives what was begun."""
        if self.now is not None or not self.waiting:
            return None
        job, run = self.waiting.pop(0)
        self.now = Piece(job, run, self._worker.start(job, run, state()), time.monotonic())
        return self.now

    def call_off(self) -> None:
        """Call off what is being done."""
        self._worker.call_off()

    def drop(self, job: str) -> None:
        """Let a piece of work be that is worth nothing any more; its process stays."""
        if self.now is not None and self.now.job == job:
            self._worker.call_off(patiently=True)

    def close(self) -> None:
        """End the process."""
        self._worker.close()
