"""One session, the pages that look at it, and the work that is done for them; every change goes through here."""

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign
from slipwise.effects import Trust
from slipwise.errors import OutputError, SettingError, SlipwiseError
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.session.responses import replayed_run
from slipwise.session.series import list_balances
from slipwise.session.session import Session
from slipwise.session.state import as_json, from_json, named
from slipwise.workbench.curves import View, curves_frame, measured_frame, shown_answer
from slipwise.workbench.folder_watch import watch_folder
from slipwise.workbench.jobs import SHOWN
from slipwise.workbench.page import Page, Send
from slipwise.workbench.page_cache import keep_page
from slipwise.workbench.replies import campaign_told, progress_told, state_told
from slipwise.workbench.worker import Report
from slipwise.workbench.worker_queue import Lane, Piece

#: While one of these is done the model stands still: its answer is a step of the history.
_CHANGING = ("fit",)


class Room:
    """A session with its pages, and two processes that work for it.

    Work that nobody has asked for (a replay after a change, where the model fails) is done aside, so that what a user
    asks for begins at once.
    """

    def __init__(self, campaign: Campaign | Path | str, trust: Trust) -> None:
        """Open the session; see `Session` for what it raises."""
        self.session = Session(campaign, trust=trust)
        self.pages: list[Page] = []
        self._thread = ThreadPoolExecutor(1)
        self._shown: dict[str, Mapping[str, Any] | bytes] = {}
        self._laws, self._moved = set[str](), ""
        self._loop: asyncio.AbstractEventLoop | None = None
        self._watch: asyncio.Task[None] | None = None
        folder = self.session.campaign.folder
        self._asked = Lane(folder, trust, self._listen, aside=False)
        self._aside = Lane(folder, trust, self._listen, aside=True)

    def begin(self) -> None:
        """Take the running loop, for the reports of the work, and watch over the campaign's folder."""
        self._loop = asyncio.get_running_loop()
        self._watch = self._loop.create_task(watch_folder(self.session.place, self._tell_moved))

    def _listen(self, lane: Lane, report: Report) -> None:
        if self._loop is not None and not self._loop.is_closed():
            asyncio.run_coroutine_threadsafe(self._hear(lane, report), self._loop)

    def close(self) -> None:
        """End the worker and the session; an OutputError says why what was done last is not on disk."""
        if self._watch is not None:
            self._watch.cancel()
        for lane in (self._asked, self._aside):
            lane.close()
        self._thread.shutdown(cancel_futures=True)
        try:
            self.session.keep()
            self._keep_page()
        finally:
            self.session.close()

    async def enter(self, send: Send) -> Page:
        """Let a page in: it is told everything, and shown the run that fails worst."""
        page = Page(send, await self._do(self._first_view), set())
        self.pages.append(page)
        await send(await self._do(lambda: campaign_told(self.session)))
        await send(await self._do(lambda: state_told(self.session)))
        await self.show(page)
        for message in self._shown.values():
            await send(message)
        for lane in (self._asked, self._aside):  # which says nothing by itself before its next step
            if lane.now is not None:
                await send(progress_told(lane.now.job, "at work", 0.0, lane.now.seconds, aside=lane.aside))
        if self._moved:
            await send({"kind": "moved", "words": self._moved})
        elif self.session.notes:
            await page.tell_problem(" ".join(self.session.notes))
        await self._ask_for_what_is_missing()
        return page

    async def _tell_moved(self, words: str) -> None:
        """Tell every page what became of the campaign's folder; "" where it is back, and work goes on."""
        self._moved = words
        await self._send_all({"kind": "moved", "words": words})
        await self._next()

    def _first_view(self) -> View:
        """Return what a new page looks at: the run in which a balance fails worst."""
        worst = max(self.session.errors(), key=lambda e: max(e.runs.values(), default=-1.0))
        return View(max(worst.runs, key=lambda run: worst.runs[run]))

    def _keep_page(self) -> None:
        """Keep what a new page is told, for the next time that the campaign is opened."""
        if self.session.place.moved():
            return
        view = self._first_view()
        told = [campaign_told(self.session), state_told(self.session)]
        curves = [measured_frame(self.session, view.run), curves_frame(self.session, view)]
        keep_page(self.session.campaign.folder, [*told, *curves, *self._shown.values()])

    def leave(self, page: Page) -> None:
        """Let a page go; nothing else changes."""
        if page in self.pages:
            self.pages.remove(page)

    async def look(self, page: Page, run: str, relation: str, beside: str, *, watches: bool = False) -> None:
        """Let a page look at something else."""
        names = [r.name for r in self.session.ready.runs]
        balances = await self._do(lambda: list_balances(self.session.ready.objective(self.session.state)))
        if run in names and relation in balances:
            page.view = View(run, relation, beside, watches)
            await self.show(page)
            await self._ask_for_watched()

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
        self._refuse_change()
        await self._do(lambda: self.session.set(key, value, keep=False))
        await self.show(page, answers, dragged=True)

    async def change(self, what: Callable[[Session], Any]) -> None:
        """Change the session, and show it to everybody.

        Raises:
            SlipwiseError: it cannot be changed so.
        """
        self._refuse_change()
        await self._step(lambda: what(self.session))

    async def _step(self, what: Callable[[], Any], *, replay: bool = True) -> None:
        """Do what changes the session and show it to everybody: also a step that is in memory and not on the disk."""
        try:
            await self._do(what)
        except OutputError:
            await self._tell_all(replay=replay)
            raise
        await self._tell_all(replay=replay)

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

        def put_in(session: Session) -> None:
            if session.effect(files[0]).name not in session.state.labels:  # asked for twice, it would go out again
                session.toggle(files[0])

        await self.change(put_in)

    async def settle(self) -> None:
        """Keep a number that was let go, and show everybody what it has changed."""
        await self._do(self.session.keep)
        await self._tell_all()

    async def work(self, job: str) -> None:
        """Begin a piece of work that a user asks for.

        Raises:
            SettingError: another one is still at work.
            OutputError: the campaign is no longer at its place.
        """
        self._asked.refuse_if_busy()
        self.session.place.check()
        self._asked.ask(job)
        await self._next()

    def cancel(self) -> None:
        """Call off the work that a user has asked for, or what is done aside."""
        (self._aside if self._asked.now is None else self._asked).call_off()

    def _refuse_change(self) -> None:
        """Refuse a step that could not be kept, or that a fit would overtake."""
        self.session.place.check()
        if self._asked.now is not None and self._asked.now.job in _CHANGING:
            raise SettingError("a fit is at work on this model; wait for it, or cancel it")

    async def _ask_for_what_is_missing(self) -> None:
        """Ask for the base fit, the replay and the places where the model fails, where nobody has yet."""
        if not self.session.reference.fitted and not self.session.state.fitted:
            self._asked.need("fit")  # until it is done there is little else that a user could want
        if "replay" not in self._shown:
            self._aside.need("replay")
            self._aside.need("system")
        if "locate" not in self.session.findings:
            self._aside.need("locate")
        await self._next()

    async def _ask_for_watched(self) -> None:
        """Ask for the replays of runs whose channels somebody looks at."""
        usual = replayed_run(self.session.ready)
        for run in {page.view.run for page in self.pages if page.view.watches} - {usual}:
            if f"watch {run}" not in self._shown:
                self._aside.ask("watch", run)
        await self._next()

    async def _next(self) -> None:
        """Begin what waits, where the folder from which workers take the campaign is still at its place."""
        if self.session.place.moved():
            return
        for lane in (self._asked, self._aside):
            begun = lane.next(lambda: as_json(self.session.state))
            if begun is not None:  # told at once: a process that has to be started first says nothing for a while
                await self._send_all(progress_told(begun.job, "getting ready", 0.0, 0.0, aside=lane.aside))

    async def _hear(self, lane: Lane, report: Report) -> None:
        piece = lane.now
        if piece is None or report.number != piece.number:
            return
        if report.kind == "progress":
            words, share = report.content
            await self._send_all(progress_told(piece.job, words, share, piece.seconds, aside=lane.aside))
            return
        lane.now = None
        how, problem = report.kind, report.content if report.kind == "failed" else ""
        if how == "done":
            try:
                await (self._show_answer if piece.job in SHOWN else self._take)(piece, report.content)
            except SlipwiseError as error:  # what was found is there, and could not be written
                how, problem = "failed", str(error)
        if problem:
            await self._send_all({"kind": "problem", "job": piece.job, "words": problem})
        ended = {"kind": "ended", "job": piece.job, "how": how, "aside": lane.aside, "seconds": piece.seconds}
        await self._send_all(ended)
        await self._next()
        if self._asked.now is None and self._aside.now is None and not self._moved:
            self._asked.warm()
            await self._do(self._keep_page)

    async def _show_answer(self, piece: Piece, answer: Any) -> None:
        """Show what was replayed; pages that come later are shown it too."""
        message = shown_answer(piece.job, answer)
        if message is not None:
            self._shown[f"{piece.job} {piece.run}".rstrip()] = message
            await self._send_all(message)

    async def _take(self, piece: Piece, answer: Any) -> None:
        """Take an answer into the session, and show it."""
        if piece.job == "fit":
            known = {named(t.effect): t.effect for t in self.session.state.terms}
            state = from_json(answer, lambda name: known[name])
            await self._step(lambda: self.session.fitted(state))
        else:
            self._laws |= set(answer.get("files", ()))
            await self._step(lambda: self.session.remember(piece.job, answer), replay=False)

    async def _tell_all(self, *, replay: bool = True) -> None:
        told = await self._do(lambda: state_told(self.session))
        for page in list(self.pages):
            await page.send(told)
            await self.show(page)
        if replay:
            self._shown = {}  # of the model as it was
            self._aside.drop("system")
            await self._send_all({"kind": "system", "errors": None})
            self._aside.ask("replay")
            await self._ask_for_watched()
            self._aside.ask("system")
            await self._next()

    async def _send_all(self, message: Mapping[str, Any] | bytes) -> None:
        for page in list(self.pages):
            await page.send(message)

    async def _do(self, what: Callable[[], Any]) -> Any:
        """Do something with the session: one thing at a time, beside the loop."""
        return await asyncio.get_running_loop().run_in_executor(self._thread, _alone, what)


def _alone(what: Callable[[], Any]) -> Any:
    with one_thread_algebra():
        return what()
