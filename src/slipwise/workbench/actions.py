"""What a page may ask for: a short list, and nothing else."""

from msgspec.structs import asdict

from slipwise.errors import SettingError, SlipwiseError
from slipwise.workbench import messages as said
from slipwise.workbench.hub import Room
from slipwise.workbench.page import Page


async def act(room: Room, page: Page, text: str | bytes) -> None:
    """Do what a page asks for; what cannot be done, or is no request at all, it is told in words.

    Args:
        room: the session.
        page: that asks.
        text: its message, as it came from the socket.
    """
    try:
        message = said.read_message(text)
    except SlipwiseError as error:
        await page.tell_problem(str(error))
        return
    try:
        await _act(room, page, message)
    except SlipwiseError as error:
        await page.tell_problem(str(error))
        await room.show_state(page, answers=message.n if isinstance(message, said.Drag) else 0)


async def _act(room: Room, page: Page, message: said.Message) -> None:
    match message:
        case said.Look():
            await room.look(page, **asdict(message))
        case said.Drag(key, value, number):
            await room.drag(page, key, value, number)
        case said.Settle():
            await room.settle()
        case said.Set(key, value):
            await room.change(lambda session: session.set(key, value))
        case said.Toggle(effect, target):
            _refuse_file(room, effect)
            await room.change(lambda session: session.toggle(effect, target))
        case said.Take():
            await room.change(lambda session: session.take_suggestion())
        case said.Law():
            await room.add_law()
        case said.Undo():
            await room.change(lambda session: session.undo())
        case said.Redo():
            await room.change(lambda session: session.redo())
        case said.Accept():
            await room.change(lambda session: session.accept())
        case said.Cancel():
            room.cancel()
        case said.Fit() | said.Locate() | said.Report() | said.Explain() | said.Discover() | said.Next():
            await room.work(type(message).__name__.lower())


def _refuse_file(room: Room, name: str) -> None:
    """Refuse an effect that is neither of the catalogue nor of the model; a page names no file.

    Raises:
        SettingError: the name is that of a file.
    """
    own = {t.effect.name for t in room.session.state.terms}
    if name.endswith(".py") and name not in own:
        raise SettingError(f"{name}: a page may name effects, but no file; open the workbench with --effect {name}")
