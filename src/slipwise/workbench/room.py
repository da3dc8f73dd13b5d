"""One session, the pages that look at it, and the work that is done for them; every change goes through here."""

import asyncio
import time
from collections.abc import Awaitable, Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign
from slipwise.effects import Trust
from slipwise.errors import SettingError
from slipwise.parallel import one_thread_algebra
from slipwise.session.session import Session
from slipwise.session.state import as_json, from_json, named
from slipwise.workbench.curves import View, curves_frame, measured_frame, replay_frame
from slipwise.workbench.kept_page import keep_page
from slipwise.workbench.told import campaign_told, progress_told, state_told
from slipwise.workbench.worker import Report, Worker

#: Gives text (as JSON) or bytes to one page.
Send = Callable[[Mapping[str, Any] | bytes], Awaitable[None]]
#: While one of these is done the model stands still: its answer is a step of the history.
_CHANGING = ("fit",)


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


@dataclass
class _Piece:
    job: str
    asked: bool
    number: int = 0
    began: float = 0.0


class Room:
    """A session with its pages and its worker.

    Work that nobody has asked for (a replay after a change, where the model fails) makes way for what a user wants.
    """

    def __init__(self, campaign: Campaign | Path | str, trust: Trust) -> None:
        """Open the session; see `Session` for what it raises."""
        self.session = Session(campaign, trust=trust)
        self.pages: list[Page] = []
        self._thread = ThreadPoolExecutor(1)
        self._trust = trust
        self._waiting: list[_Piece] = []
        self._now: _Piece | None = None
        self._replay: bytes | None = None
        self._laws: set[str] = set()
        self._worker: Worker | None = None

    def begin(self) -> None:
        """Take the running loop, for the worker's reports."""
        loop = asyncio.get_running_loop()

        def listen(report: Report) -> None:
            if not loop.is_closed():
                asyncio.run_coroutine_threadsafe(self._hear(report), loop)

        self._worker = Worker(self.session.campaign.folder, self._trust, listen)

    def close(self) -> None:
        """End the worker and the session; all that was done is on disk."""
        if self._worker is not None:
            self._worker.close()
        self._thread.shutdown(cancel_futures=True)
        self._keep_page()
        self.session.close()

    async def enter(self, send: Send) -> Page:
        """Let a page in: it is told everything, and shown the run that fails worst."""
        page = Page(send, await self._do(self._first_view), set())
        self.pages.append(page)
        await send(await self._do(lambda: campaign_told(self.session)))
        await send(await self._do(lambda: state_told(self.session)))
        await self.show(page)
        if self._replay is not None:
            await send(self._replay)
        self._ask_for_what_is_missing()
        return page

    def _first_view(self) -> View:
        """Give what a new page looks at: the run in which a balance fails worst."""
        worst = max(self.session.errors(), key=lambda e: max(e.runs.values()))
        return View(max(worst.runs, key=lambda run: worst.runs[run]))

    def _keep_page(self) -> None:
        """Keep what a new page is told, for the next time that the campaign is opened."""
        view = self._first_view()
        told = [campaign_told(self.session), state_told(self.session)]
        curves = [measured_frame(self.session, view.run), curves_frame(self.session, view)]
        keep_page(self.session.campaign.folder, [*told, *curves, *([self._replay] if self._replay else [])])

    def leave(self, page: Page) -> None:
        """Let a page go; nothing else changes."""
        if page in self.pages:
            self.pages.remove(page)

    async def look(self, page: Page, run: str, relation: str, beside: str) -> None:
        """Let a page look at something else."""
        names = [r.name for r in self.session.ready.runs]
        relations = await self._do(lambda: self.session.ready.problem(self.session.state).relations)
        if run in names and relation in relations:
            page.view = View(run, relation, beside)
            await self.show(page)

    async def show(self, page: Page, answers: int = 0, *, dragged: bool = False) -> None:
        """Give a page the curves that it looks at; in a hurry while a number is dragged."""
        view = page.view
        if view.run not in page.measured:
            page.measured.add(view.run)
            await page.send(await self._do(lambda: measured_frame(self.session, view.run)))
        await page.send(await self._do(lambda: curves_frame(self.session, view, answers, dragged=dragged)))

    async def show_state(self, page: Page, answers: int = 0) -> None:
        """Give a page the state anew: what it has asked for was refused, and its switches stand as it has asked."""
        await page.send({**await self._do(lambda: state_told(self.session)), "answers": answers})

    async def drag(self, page: Page, key: str, value: float, answers: int) -> None:
        """Change a number while it is dragged: only the page that does so is shown, as fast as can be."""
        self._refuse_while_fitting()
        await self._do(lambda: self.session.set(key, value, keep=False))
        await self.show(page, answers, dragged=True)

    async def change(self, what: Callable[[Session], Any]) -> None:
        """Change the session, and show it to everybody.

        Raises:
            SlipwiseError: it cannot be changed so.
        """
        self._refuse_while_fitting()
        await self._do(lambda: what(self.session))
        await self._tell_all()

    async def add_law(self) -> None:
        """Put the law in that was found here; one that another session has found is a file like any other.

        Raises:
            SettingError: no law was found here.
        """
        files = [name for name in self.session.findings.get("discover", {}).get("files", ()) if name in self._laws]
        if not files:
            raise SettingError(
                "no law was found since the workbench was opened; find it, or look at the file of an earlier one and "
                "allow it by --effect when you open the workbench"
            )
        await self.change(lambda session: session.toggle(files[0]))

    async def settle(self) -> None:
        """Keep a number that was let go, and show everybody what it has changed."""
        await self._do(self.session.keep)
        await self._tell_all()

    async def work(self, job: str) -> None:
        """Begin a piece of work that a user asks for; what nobody asked for makes way."""
        assert self._worker is not None
        if self._now is not None and self._now.asked:
            raise SettingError(f"{self._now.job} is still at work; wait for it, or cancel it")
        self._waiting.insert(0, _Piece(job, asked=True))
        if self._now is not None:
            self._waiting.append(_Piece(self._now.job, asked=False))
            self._worker.call_off()
        self._next()

    def cancel(self) -> None:
        """Call off the work that is being done."""
        if self._worker is not None:
            self._worker.call_off()

    def _refuse_while_fitting(self) -> None:
        if self._now is not None and self._now.job in _CHANGING:
            raise SettingError("a fit is at work on this model; wait for it, or cancel it")

    def _ask_for_what_is_missing(self) -> None:
        """Ask for the base fit, the replay and the places where the model fails, where nobody has yet."""
        if not self.session.reference.fitted and not self.session.state.fitted:
            self._background("fit")
        if self._replay is None:
            self._background("replay")
        if "locate" not in self.session.findings:
            self._background("locate")
        self._next()

    def _background(self, job: str) -> None:
        if all(piece.job != job for piece in self._waiting):
            self._waiting.append(_Piece(job, asked=False))

    def _next(self) -> None:
        """Begin what waits, if nothing is being done."""
        if self._now is not None or not self._waiting or self._worker is None:
            return
        piece = self._now = self._waiting.pop(0)
        piece.began = time.monotonic()
        piece.number = self._worker.start(piece.job, as_json(self.session.state))

    async def _hear(self, report: Report) -> None:
        piece = self._now
        if piece is None or report.number != piece.number:
            return
        seconds = time.monotonic() - piece.began
        if report.kind == "progress":
            words, share = report.content
            await self._send_all(progress_told(piece.job, words, share, seconds))
            return
        self._now = None
        if report.kind == "done":
            await self._take(piece.job, report.content)
        elif report.kind == "failed":
            await self._send_all({"kind": "problem", "job": piece.job, "words": report.content})
        ended = {"kind": "ended", "job": piece.job, "how": report.kind, "seconds": seconds}
        await self._send_all(ended)
        self._next()
        if self._now is None:
            await self._do(self._keep_page)

    async def _take(self, job: str, answer: Any) -> None:
        """Take an answer of the worker into the session, and show it."""
        if job == "replay":
            if isinstance(answer, str):
                await self._send_all({"kind": "no replay", "words": answer})
            else:
                self._replay = replay_frame(*answer)
                await self._send_all(self._replay)
            return
        if job == "fit":
            known = {named(t.effect): t.effect for t in self.session.state.terms}
            state = from_json(answer, lambda name: known[name])
            await self._do(lambda: self.session.fitted(state))
        else:
            self._laws |= set(answer.get("files", ()))
            await self._do(lambda: self.session.remember(job, answer))
        await self._tell_all(replay=job == "fit")

    async def _tell_all(self, *, replay: bool = True) -> None:
        told = await self._do(lambda: state_told(self.session))
        for page in list(self.pages):
            await page.send(told)
            await self.show(page)
        if replay:
            self._background("replay")
            self._next()

    async def _send_all(self, message: Mapping[str, Any] | bytes) -> None:
        for page in list(self.pages):
            await page.send(message)

    async def _do(self, what: Callable[[], Any]) -> Any:
        """Do something with the session: one thing at a time, beside the loop."""
        return await asyncio.get_running_loop().run_in_executor(self._thread, _alone, what)


def _alone(what: Callable[[], Any]) -> Any:
    with one_thread_algebra():
        return what()
