"""What a page may say: the one schema that every message of the socket is held against before anything is done."""

from typing import Annotated

from msgspec import Meta, MsgspecError, Struct
from msgspec.json import Decoder

from slipwise.errors import SettingError

#: Names of runs, numbers, effects and channels, values with their units; none of them is longer.
_Name = Annotated[str, Meta(max_length=500)]
_Value = Annotated[str, Meta(max_length=60)]
#: Questions that a page numbers, so that it knows the answer: as far as JavaScript counts whole numbers.
_Number = Annotated[int, Meta(ge=0, lt=2**53)]


class _Message(Struct, tag_field="do", forbid_unknown_fields=True, frozen=True):
    pass


class Look(_Message, tag="look", frozen=True):
    """Look at a run and a balance, at another model beside, or at a recorded channel."""

    run: _Name
    relation: _Name
    beside: _Name
    watches: bool = False


class Drag(_Message, tag="drag", frozen=True):
    """Change a number that is still being dragged; `n` comes back with the curves."""

    key: _Name
    value: float
    n: _Number


class Settle(_Message, tag="settle", frozen=True):
    """Keep the number that was let go."""


class Set(_Message, tag="set", frozen=True):
    """Change a number: SI, or a text with its unit."""

    key: _Name
    value: float | _Value


class Toggle(_Message, tag="toggle", frozen=True):
    """Put an effect in or take it out; `target` is the channel or card, for effects that need one."""

    effect: _Name
    target: _Name = ""


class Take(_Message, tag="take", frozen=True):
    """Put in what the diagnosis has named."""


class Law(_Message, tag="law", frozen=True):
    """Put in the law that was found."""


class Undo(_Message, tag="undo", frozen=True):
    """Go one step back."""


class Redo(_Message, tag="redo", frozen=True):
    """Go one step forward."""


class Accept(_Message, tag="accept", frozen=True):
    """Write the model beside the campaign."""


class Cancel(_Message, tag="cancel", frozen=True):
    """Call off the work that is being done."""


class Fit(_Message, tag="fit", frozen=True):
    """Fit all numbers."""


class Locate(_Message, tag="locate", frozen=True):
    """Say where the model fails."""


class Report(_Message, tag="report", frozen=True):
    """Write the report of the comparison."""


class Explain(_Message, tag="explain", frozen=True):
    """Say what is missing."""


class Discover(_Message, tag="discover", frozen=True):
    """Find the law of what is missing."""


class Next(_Message, tag="next", frozen=True):
    """Say which motion would tell most."""


#: Work that takes long and that a page may ask for; a replay follows by itself.
Work = Fit | Locate | Report | Explain | Discover | Next
Message = Look | Drag | Settle | Set | Toggle | Take | Law | Undo | Redo | Accept | Cancel | Work

_DECODER = Decoder(Message)


def read_message(said: str | bytes) -> Message:
    """Read what a page has said.

    Raises:
        SettingError: it is no JSON, or no message of this schema; the message says where it does not fit.
    """
    try:
        return _DECODER.decode(said)
    except (MsgspecError, UnicodeError, RecursionError) as error:
        raise SettingError(f"the workbench did not understand this request: {error}") from None
