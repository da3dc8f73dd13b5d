"""What the page showed last, kept so that it is there at once while the session is still being opened.

It is shown only where neither the campaign nor the session has changed since, and is replaced by what the session says.
"""

import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, MsgspecError, Struct
from msgspec.json import decode

import slipwise
from slipwise.errors import SlipwiseError
from slipwise.jobs.atomic_write import atomic
from slipwise.session.own_files import read_own
from slipwise.session.place import session_folder, snapshot_file

#: What a page is told: text (as JSON), or bytes.
Message = Mapping[str, Any] | bytes
_NAME = "page.bin"


class _Head(Struct, forbid_unknown_fields=True):
    """What stands before the messages: of which campaign they are; whether each is packed, and its size [bytes]."""

    of: str
    parts: list[tuple[bool, Annotated[int, Meta(ge=0)]]]


def keep_page(campaign: Path, messages: Sequence[Message]) -> None:
    """Keep what a new page is told; where that cannot be, the next page waits for its session.

    Args:
        campaign: folder of the campaign; its session is on disk.
        messages: in order.
    """
    parts = [m if isinstance(m, bytes) else json.dumps(m, allow_nan=False).encode() for m in messages]
    sizes = [[isinstance(m, bytes), len(p)] for m, p in zip(messages, parts, strict=True)]
    try:
        head = {"of": _fingerprint(campaign), "parts": sizes}
        with atomic(session_folder(campaign) / _NAME, private=True) as stream:
            stream.write(json.dumps(head).encode() + b"\n" + b"".join(parts))
    except (OSError, SlipwiseError):
        return


def kept_page(campaign: Path) -> list[Message]:
    """Return what was kept; nothing where the campaign, its session or the program is another by now."""
    try:
        first, _, body = (read_own(session_folder(campaign) / _NAME) or b"").partition(b"\n")
        head = decode(first, type=_Head)
        if head.of != _fingerprint(campaign) or sum(size for _, size in head.parts) != len(body):
            return []
        out: list[Message] = []
        for packed, size in head.parts:
            out.append(body[:size] if packed else decode(body[:size], type=dict[str, Any]))
            body = body[size:]
        return out
    except (OSError, MsgspecError, RecursionError, UnicodeError, SlipwiseError):
        return []


def _fingerprint(campaign: Path) -> str:
    """Return what changes when the page may: files by size and date, which takes no time, as `make` does.

    Raises:
        OSError: there is no session.
        InputError: its file is none of this user's.
    """
    files = [(p.name, p.stat()) for p in sorted(campaign.resolve().iterdir()) if p.is_file()]
    told = [(name, found.st_size, found.st_mtime_ns) for name, found in files]
    session = read_own(snapshot_file(campaign))
    if session is None:
        raise FileNotFoundError(snapshot_file(campaign))
    return sha256(repr((slipwise.__version__, told, sha256(session).hexdigest())).encode()).hexdigest()
