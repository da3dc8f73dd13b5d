"""What the page showed last, kept so that it is there at once while the session is still being opened.

It is shown only where neither the campaign nor the session has changed since, and is replaced by what the session says.
"""

import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

import slipwise
from slipwise.errors import OutputError
from slipwise.session.place import session_folder, snapshot_file
from slipwise.whole_file import atomic

#: What a page is told: text (as JSON), or bytes.
Message = Mapping[str, Any] | bytes
_NAME = "page.bin"


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
        with atomic(session_folder(campaign) / _NAME) as stream:
            stream.write(json.dumps(head).encode() + b"\n" + b"".join(parts))
    except (OSError, OutputError):
        return


def kept_page(campaign: Path) -> list[Message]:
    """Give what was kept; nothing where the campaign, its session or the program is another by now."""
    try:
        first, _, body = (session_folder(campaign) / _NAME).read_bytes().partition(b"\n")
        head = json.loads(first)
        if head["of"] != _fingerprint(campaign) or sum(size for _, size in head["parts"]) != len(body):
            return []
        out: list[Message] = []
        for packed, size in head["parts"]:
            out.append(body[:size] if packed else json.loads(body[:size]))
            body = body[size:]
        return out
    except (OSError, ValueError, KeyError, TypeError):
        return []


def _fingerprint(campaign: Path) -> str:
    """Give what changes when the page may: files by size and date, which takes no time, as `make` does."""
    files = sorted(p for p in campaign.resolve().iterdir() if p.is_file())
    told = [(p.name, p.stat().st_size, p.stat().st_mtime_ns) for p in files]
    session = sha256(snapshot_file(campaign).read_bytes()).hexdigest()
    return sha256(repr((slipwise.__version__, told, session)).encode()).hexdigest()
