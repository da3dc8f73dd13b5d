"""The snapshot of a session on disk: one private folder, one file that is always whole, one program at a time."""

import json
import os
import warnings
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign
from slipwise.errors import OutputError, SlipwiseWarning
from slipwise.jobs.atomic_write import atomic
from slipwise.session.campaign_folder import CampaignFolder
from slipwise.session.lock import Lock
from slipwise.session.own_files import move_aside, read_own
from slipwise.session.place import BESIDE, is_foreign, snapshot_file
from slipwise.session.schema import SCHEMA, checked

_LOCK = "lock"


def fingerprint(campaign: Campaign) -> str:
    """Return what changes when the measurement, or what is said of it, does."""
    told = [(r.file, r.sha256, r.role, r.window, r.rest_before) for r in campaign.runs]
    return sha256(repr((told, campaign.rig, campaign.logger, dict(campaign.known))).encode()).hexdigest()


class Store:
    """The folder of a session, held by one program as long as it is open.

    Attributes:
        folder: where it is.
        notes: what a user should know of it.
    """

    def __init__(self, campaign: CampaignFolder) -> None:
        """Take the folder of the session.

        Args:
            campaign: its folder.

        Raises:
            InputError: another program works there, and where; or what has the folder's name is not this user's.
            OutputError: nothing can be written there.
        """
        self._campaign = campaign
        self.folder = campaign.session_folder()
        self._file = snapshot_file(campaign.path)
        self._lock = Lock(self.folder / _LOCK, campaign.path)
        self._written = ""
        notes: list[str] = []
        beside = campaign.path / BESIDE
        if self.folder != beside and os.path.lexists(beside):
            why = "belongs to another user" if is_foreign(beside) else "cannot be written to"
            notes.append(f"{beside} {why}; this session is kept in {self.folder}")
        if not self._lock.sure:
            notes.append("this disk knows no locks; see to it that no other program works at this campaign")
        self.notes = tuple(notes)
        for words in notes:
            warnings.warn(words, SlipwiseWarning, stacklevel=3)

    def tell(self, address: str) -> None:
        """Leave word where this session is to be found, for whoever comes second."""
        self._lock.tell(address)

    def read(self) -> Mapping[str, Any] | None:
        """Return what was written last; None where nothing was.

        Raises:
            InputError: it cannot be read, or is damaged.
        """
        data = read_own(self._file)
        return None if data is None else checked(data, self._file.name)

    def move_aside(self) -> Path:
        """Return the snapshot another name, so that the next one does not take its place; gives the path."""
        return move_aside(self._file)

    def write(self, content: Mapping[str, Any]) -> None:
        """Write a snapshot, if it is another than the last; a program that is killed leaves the one before.

        Raises:
            OutputError: the disk is full, or the folder is no longer where it was.
        """
        text = json.dumps({"schema": SCHEMA, **content}, allow_nan=False)
        if text == self._written:
            return
        self._campaign.check()
        if not self._lock.holds():
            raise OutputError(
                f"{self.folder} was removed or replaced while its session is open, so nothing more is written; put it "
                "back, or close this session and open the campaign again"
            )
        with atomic(self._file, "w", private=True) as stream:
            stream.write(text)
        self._written = text

    def close(self) -> None:
        """Let others take the folder."""
        self._lock.close()
