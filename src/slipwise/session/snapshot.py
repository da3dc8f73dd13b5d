"""Where a session lies on disk: one folder, one file that is always whole, one program at a time."""

import json
import os
from collections.abc import Mapping
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign
from slipwise.errors import InputError
from slipwise.record import write_text
from slipwise.session.place import session_folder, snapshot_file

try:
    import fcntl
except ModuleNotFoundError:  # Windows
    fcntl = None

_SCHEMA = 2
_LOCK = "lock"


def fingerprint(campaign: Campaign) -> str:
    """Give what changes when the measurement, or what is said of it, does."""
    told = [(r.file, r.sha256, r.role, r.window, r.rest_before) for r in campaign.runs]
    return sha256(repr((told, campaign.rig, campaign.logger, dict(campaign.known))).encode()).hexdigest()


class Store:
    """The folder of a session, held by one program as long as it is open."""

    def __init__(self, campaign: Path) -> None:
        """Take the folder of the session.

        Args:
            campaign: folder of the campaign.

        Raises:
            InputError: another program works there; the message says which, and where.
        """
        folder = self.folder = session_folder(campaign)
        self._file = snapshot_file(campaign)
        folder.mkdir(parents=True, exist_ok=True)
        self._lock = open(folder / _LOCK, "a+", encoding="utf-8")  # noqa: SIM115  held until `close`
        if fcntl is not None:
            try:
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                self._lock.seek(0)
                holder = self._lock.read().strip() or "another program"
                self._lock.close()
                raise InputError(
                    f"{folder.parent}: a session of this campaign is open already, in {holder}; close that one first, "
                    "or go on there"
                ) from None
        self.tell("")

    def tell(self, address: str) -> None:
        """Leave word where this session is to be found, for whoever comes second."""
        self._lock.seek(0)
        self._lock.truncate()
        self._lock.write(f"process {os.getpid()}" + (f" at {address}" if address else ""))
        self._lock.flush()

    def read(self) -> Mapping[str, Any] | None:
        """Give what was written last; None where nothing was, or by another version."""
        try:
            content = json.loads(self._file.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        return content if isinstance(content, dict) and content.get("schema") == _SCHEMA else None

    def write(self, content: Mapping[str, Any]) -> None:
        """Write a snapshot; a program that is killed leaves the one before."""
        write_text(self._file, json.dumps({"schema": _SCHEMA, **content}, allow_nan=False))

    def close(self) -> None:
        """Let others take the folder."""
        with suppress(OSError, ValueError):
            self._lock.truncate(0)
        self._lock.close()
