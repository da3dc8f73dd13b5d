"""The local page: listens on this machine alone, answers nobody without the token, and gives no file but its own."""

import asyncio
import contextlib
import json
import logging
import secrets
import socket
import time
import webbrowser
from collections.abc import AsyncIterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from slipwise.errors import InputError, SlipwiseError
from slipwise.session.campaign_folder import CampaignFolder
from slipwise.session.own_files import read_own
from slipwise.session.place import session_folder
from slipwise.view.pages.html_style import DARK, LIGHT
from slipwise.workbench.page_cache import kept_page
from slipwise.workbench.startup import Opening

try:
    import uvicorn
    from starlette.applications import Starlette
    from starlette.requests import Request
    from starlette.responses import FileResponse, HTMLResponse, PlainTextResponse, RedirectResponse, Response
    from starlette.routing import Route, WebSocketRoute
    from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState
except ModuleNotFoundError as missing:
    raise InputError(f'{missing.name} is not installed; it comes with `pip install "slipwise[workbench]"`') from None

if TYPE_CHECKING:
    from slipwise.effects import Trust

#: Colours of the project's pages; what is measured and what is modelled, and what stands on the blue of a button.
_THEME = f""":root {{ {LIGHT} --measured: #8a96a3; --model: var(--blue); --on-blue: #ffffff; color-scheme: light; }}
:root[data-theme=dark] {{ {DARK} --on-blue: #11151a; }}
@media (prefers-color-scheme: dark) {{ :root:not([data-theme=light]) {{ {DARK} --on-blue: #11151a; }} }}
"""
_STATIC = Path(__file__).parent / "static"
_LOOPBACK = "127.0.0.1"
_HOSTS = (_LOOPBACK, "localhost")
#: A page that takes nothing for so long is not waited for [s].
_PATIENCE = 5.0
#: Nothing but what the page brings along; no other page may frame it, or learn its address.
_HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
        "connect-src 'self' ws://127.0.0.1:* ws://localhost:*; frame-ancestors 'none'; base-uri 'none'"
    ),
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-cache",
}
#: Reports bring their own style and pictures, and no script.
_REPORT_HEADERS = _HEADERS | {
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'"
}
#: Told until the session stands; what the page shows meanwhile is what it showed last.
_OPENING = {"kind": "progress", "job": "open", "words": "getting the session ready", "share": 0.0, "seconds": 0.0,
            "aside": False}  # fmt: skip
#: First part of the address that works once, how long it waits for that [s], and what is said afterwards.
_ONCE, _ONCE_LASTS = "once", 60.0
_USED = (
    "This address was opened before, or a minute has gone by; take the one that `slipwise workbench` prints. If you "
    "have not opened it within that minute, another user of this machine may have: end the workbench, start it again.\n"
)
_REPORTS = ("report.html", "diagnosis.html")


def application(opening: Opening, token: str, key: str) -> Starlette:
    """Make the application.

    Args:
        opening: the session with its pages, which is opened when the application begins.
        token: first part of every address.
        key: leads to the page once: what a browser is started with can be read by every user of the machine.
    """
    unused, until = {key}, time.monotonic() + _ONCE_LASTS

    def allowed(part: str, host: str | None, origin: str | None) -> bool:
        """Return whether a request comes from the page: by its token, on this machine, and from no other site."""
        names = [host] if origin is None else [host, origin.partition("://")[2]]
        local = all((name or "").rpartition(":")[0] in _HOSTS for name in names)
        return local and secrets.compare_digest(part.encode(), token.encode())

    async def enter(request: Request) -> Response:
        given = request.path_params["key"]
        fresh = given in unused and time.monotonic() < until
        if not fresh or not allowed(token, request.headers.get("host"), request.headers.get("origin")):
            return PlainTextResponse(_USED, 404)
        unused.clear()
        return RedirectResponse(f"/{token}/", 303, headers=_HEADERS)

    async def get(request: Request) -> Response:
        part, name = request.path_params["token"], request.path_params.get("name", "index.html")
        if not allowed(part, request.headers.get("host"), request.headers.get("origin")):
            return PlainTextResponse("This address has no page; take the one that `slipwise workbench` prints.\n", 404)
        opening.expect_page()
        if name in _REPORTS:
            return await asyncio.to_thread(_report, opening.place, name)
        if name == "theme.css":
            return Response(_THEME, media_type="text/css", headers=_HEADERS)
        known = {path.name: path for path in _STATIC.iterdir() if path.is_file()}
        if name not in known:
            return PlainTextResponse(f"no {name} here\n", 404)
        return FileResponse(known[name], headers=_HEADERS)

    async def talk(channel: WebSocket) -> None:
        headers = channel.headers
        if not allowed(channel.path_params["token"], headers.get("host"), headers.get("origin")):
            await channel.close(4403)
            return
        await channel.accept()

        async def send(message: Mapping[str, Any] | bytes) -> None:
            packed = isinstance(message, bytes)
            sent = channel.send_bytes(message) if packed else channel.send_text(json.dumps(message, allow_nan=False))
            # a page that has gone comes back by itself, and is told everything; one that sleeps keeps nobody waiting
            with contextlib.suppress(RuntimeError, WebSocketDisconnect, TimeoutError):
                await asyncio.wait_for(sent, _PATIENCE)

        if not opening.done:
            for message in [*kept_page(opening.campaign), _OPENING]:
                await send(message)
        try:
            room = await opening.room()
        except SlipwiseError as error:
            await send({"kind": "over", "words": str(error)})
            opening.page_was_told()
            return
        from slipwise.workbench.actions import act  # loaded with the room by now

        await send({"kind": "ended", "job": "open", "how": "done", "aside": False})
        page = await room.enter(send)
        try:
            while channel.application_state is WebSocketState.CONNECTED:  # a page that has gone hears no more
                await act(room, page, await _heard(channel))
        except WebSocketDisconnect:
            pass
        finally:
            room.leave(page)

    @contextlib.asynccontextmanager
    async def life(app: Starlette) -> AsyncIterator[None]:
        opening.begin()
        yield
        await opening.end()

    routes = [
        Route(f"/{_ONCE}/{{key}}", enter),
        WebSocketRoute("/{token}/socket", talk),
        Route("/{token}/", get),
        Route("/{token}/{name}", get),
    ]
    return Starlette(routes=routes, lifespan=life)


def _report(place: CampaignFolder, name: str) -> Response:
    """Return a report of the session's folder, where it is a plain file of this user."""
    try:
        place.check()
        page = read_own(session_folder(place.path) / name)
    except SlipwiseError as error:
        return PlainTextResponse(f"{error}\n", 404)
    if page is None:
        return PlainTextResponse(f"no {name} here\n", 404)
    return HTMLResponse(page, headers=_REPORT_HEADERS)


async def _heard(channel: WebSocket) -> str | bytes:
    """Wait for what a page says.

    Raises:
        WebSocketDisconnect: it has gone.
    """
    message = await channel.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message["code"])
    return message.get("text") or message.get("bytes") or b""


def run(campaign: Path | str, *, trust: "Trust", port: int, show: bool) -> None:
    """Serve one campaign until Ctrl-C; see `slipwise.workbench.serve`."""
    folder = Path(campaign)
    if not (folder / "campaign.toml").is_file():
        from slipwise.campaign import load_campaign

        load_campaign(folder)  # says what is wrong with it, before any page is opened
    listening = _listen(port)
    token, key = secrets.token_urlsafe(16), secrets.token_urlsafe(16)
    root = f"http://{_LOOPBACK}:{listening.getsockname()[1]}"

    def end() -> None:
        server.should_exit = True

    opening = Opening(folder, trust, f"{root}/{token}/", end)
    config = uvicorn.Config(
        application(opening, token, key), log_level="warning", access_log=False, ws_max_size=2**16, server_header=False
    )
    logging.getLogger("uvicorn.error").addFilter(_without_traceback)  # after the configuration of its own logging
    server = uvicorn.Server(config)
    # a browser takes as long to come as the session to open
    if show and webbrowser.open(f"{root}/{_ONCE}/{key}"):
        opening.expect_page()
    asyncio.run(server.serve(sockets=[listening]))
    opening.check()


def _without_traceback(record: logging.LogRecord) -> bool:
    """Leave the line of what a page has sent that is no text, and take the traceback of it away."""
    if record.exc_info and isinstance(record.exc_info[1], UnicodeError):
        record.exc_info = None
    return True


def _listen(port: int) -> socket.socket:
    """Take a port of the loopback address.

    Raises:
        InputError: another program has it.
    """
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        listening.bind((_LOOPBACK, port))
        listening.listen()
    except OSError:
        listening.close()
        raise InputError(f"port {port} is taken by another program; without --port, a free one is found") from None
    return listening
