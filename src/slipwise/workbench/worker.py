"""The process that does heavy work: MuJoCo's callbacks belong to a process, and a fit must not make the page wait."""

import multiprocessing
import os
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

from slipwise.effects import Trust
from slipwise.errors import SlipwiseError
from slipwise.jobs.interruption import unheard_by_children
from slipwise.jobs.parallel import begin_worker
from slipwise.view.figures.matplotlib_folder import pass_over_a_matplotlibrc_here

#: A piece of work that goes on so long after it was called off is ended with its process, where somebody waits for that
#: and where nobody does [s].
_PATIENCE, _LONG_PATIENCE = 0.6, 10.0
#: Work that nobody has asked for has this much less of the cores, as `nice` counts.
_COURTESY = 5


class _CalledOff(Exception):
    """Raised inside a piece of work that nobody wants any more."""


@dataclass(frozen=True)
class Report:
    """What the worker says of a piece of work.

    Attributes:
        number: of the work.
        kind: "progress", "done", "failed" or "called off".
        content: (words, share), the answer, or why it failed.
    """

    number: int
    kind: str
    content: Any


class Worker:
    """A process for heavy work; it is started with the first piece, and anew when it had to be ended."""

    def __init__(self, campaign: Path, trust: Trust, listen: Callable[[Report], None], *, aside: bool = False) -> None:
        """Make ready.

        Args:
            campaign: folder of the campaign.
            trust: as for `Session`.
            listen: called with every report, from a thread of the worker's own.
            aside: with what others leave of the cores.
        """
        self._campaign, self._trust, self._listen, self._aside = campaign, trust, listen, aside
        self._process: BaseProcess | None = None
        self._pipe: Connection | None = None
        self._context = multiprocessing.get_context("spawn")
        self._called_off = self._context.RawValue("q", 0)  # one writer: no lock
        self._number = 0
        self._busy = threading.Event()

    @property
    def busy(self) -> bool:
        """Whether a piece of work is being done."""
        return self._busy.is_set()

    def start(self, job: str, run: str, state: Mapping[str, Any]) -> int:
        """Begin a piece of work; gives its number.

        Args:
            job: of `JOBS`.
            run: that it is to look at, for work on one run.
            state: as `state.as_json` gives it.
        """
        self.begin()
        assert self._pipe is not None
        self._number += 1
        self._busy.set()
        self._pipe.send((self._number, job, run, dict(state)))
        return self._number

    def call_off(self, *, patiently: bool = False) -> None:
        """Call the work that is being done off: it stops at its next step, or with its process."""
        if self.busy:
            number = self._called_off.value = self._number
            timer = threading.Timer(_LONG_PATIENCE if patiently else _PATIENCE, self._end_if_still_at, (number,))
            timer.daemon = True
            timer.start()

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._process = None

    def begin(self) -> None:
        """Start the process, where there is none; it opens the campaign while it waits."""
        if self._process is not None and self._process.is_alive():
            return
        self._pipe, far = self._context.Pipe()
        arguments = (far, self._called_off, str(self._campaign), self._trust, self._aside)
        self._process = self._context.Process(target=_work, args=arguments, name="slipwise worker")
        with unheard_by_children():
            self._process.start()
        far.close()
        threading.Thread(target=self._hear, args=(self._pipe, self._process), daemon=True).start()

    def _hear(self, pipe: Connection, process: BaseProcess) -> None:
        try:
            while True:
                self._report(pipe.recv())
        except (EOFError, OSError):
            if self.busy and process is self._process:
                called_off = self._called_off.value >= self._number
                words = "the process that did this work has ended; the session is as before"
                self._process = None
                self._report(Report(self._number, "called off" if called_off else "failed", words))

    def _report(self, report: Report) -> None:
        if report.kind != "progress":
            self._busy.clear()
        self._listen(report)

    def _end_if_still_at(self, number: int) -> None:
        if self.busy and self._number == number and self._process is not None:
            self._process.kill()


def _work(pipe: Connection, called_off: Any, campaign: str, trust: Trust, aside: bool) -> None:
    """Do one piece of work after another, in a process of its own that has the cores for itself."""
    if aside and hasattr(os, "nice"):
        os.nice(_COURTESY)
    begin_worker(own_cores=True)
    pass_over_a_matplotlibrc_here()
    from slipwise.session.session import Session
    from slipwise.workbench.jobs import JOBS, Task

    session: Session | None = None
    with suppress(SlipwiseError):  # who asks for work is told
        session = Session(campaign, trust=trust, resume=False, keep=False)
    while True:
        number, job, run, content = pipe.recv()

        def tell(words: str, share: float, number: int = number) -> None:
            if called_off.value >= number:
                raise _CalledOff
            pipe.send(Report(number, "progress", (words, share)))

        try:
            tell("getting ready", 0.0)
            session = session or Session(campaign, trust=trust, resume=False, keep=False)
            state = session.read_state(content, trust=[one["effect"] for one in content["terms"]])
            pipe.send(Report(number, "done", JOBS[job](Task(session, state, run), tell)))
        except _CalledOff:
            pipe.send(Report(number, "called off", ""))
        except SlipwiseError as error:
            pipe.send(Report(number, "failed", str(error)))
        except Exception as error:
            pipe.send(Report(number, "failed", f"{type(error).__name__}: {error}"))
