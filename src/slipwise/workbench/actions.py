"""What a page may ask for: a short list, and nothing else."""

from collections.abc import Mapping
from typing import Any

from slipwise.errors import SettingError, SlipwiseError
from slipwise.workbench.room import Page, Room

#: Work of `jobs.JOBS` that a page may ask for; a replay follows by itself.
_WORK = ("fit", "locate", "report", "explain", "discover", "next")


async def act(room: Room, page: Page, message: Mapping[str, Any]) -> None:
    """Do what a page asks for; what cannot be done it is told in words."""
    try:
        await _act(room, page, message)
    except SlipwiseError as error:
        await page.send({"kind": "problem", "job": "", "words": str(error)})
        await room.show_state(page, answers=_whole(message.get("n", 0)))
    except (KeyError, TypeError, ValueError, AttributeError):
        await page.send({"kind": "problem", "job": "", "words": "the workbench did not understand this request"})


async def _act(room: Room, page: Page, message: Mapping[str, Any]) -> None:
    match message["do"]:
        case "look":
            seen = [str(message[key]) for key in ("run", "relation", "beside")]
            await room.look(page, seen[0], seen[1], seen[2], watches=bool(message.get("watches")))
        case "drag":
            await room.drag(page, str(message["key"]), float(message["value"]), _whole(message["n"]))
        case "settle":
            await room.settle()
        case "set":
            given = message["value"]
            value = given if isinstance(given, str) else float(given)
            await room.change(lambda session: session.set(str(message["key"]), value))
        case "toggle":
            effect, target = _listed(room, str(message["effect"])), str(message.get("target", ""))
            await room.change(lambda session: session.toggle(effect, target))
        case "take":
            await room.change(lambda session: session.take_suggestion())
        case "law":
            await room.add_law()
        case "undo":
            await room.change(lambda session: session.undo())
        case "redo":
            await room.change(lambda session: session.redo())
        case "accept":
            await room.change(lambda session: session.accept())
        case "cancel":
            room.cancel()
        case job if job in _WORK:
            await room.work(job)
        case other:
            raise SettingError(f"the workbench knows no {other!r}")


def _listed(room: Room, name: str) -> str:
    """Give the name of an effect of the catalogue or of the model; a page names no file."""
    own = {t.effect.name: t.effect for t in room.session.state.terms}
    if name in own or not name.endswith(".py"):
        return name
    raise SettingError(f"{name}: a page may name effects, but no file; open the workbench with --effect {name}")


def _whole(value: Any) -> int:
    return int(value)
