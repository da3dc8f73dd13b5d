"""The folder of an open campaign, known by what it is and not by its name: whoever moves it meanwhile is told."""

import os
import weakref
from contextlib import suppress
from pathlib import Path

from slipwise.errors import OutputError
from slipwise.session.own_files import make_private
from slipwise.session.place import session_folder


class CampaignFolder:
    """A folder as it was when it was opened.

    Attributes:
        path: where it was then.
    """

    def __init__(self, path: Path) -> None:
        """Take note of a folder; it stays open, so that no other one can be given its number on the disk."""
        self.path = path.resolve()
        self._handle: int | None = None
        self._found: os.stat_result | None = None
        with suppress(OSError):  # a campaign that was made in memory has none
            if hasattr(os, "O_DIRECTORY"):  # Windows opens no folders
                self._handle = os.open(self.path, os.O_RDONLY | os.O_DIRECTORY)
                weakref.finalize(self, os.close, self._handle)
            self._found = os.stat(self.path)

    def moved(self) -> str:
        """Say what became of the folder; "" where it is still at its place."""
        if self._found is None:
            return ""
        with suppress(OSError):
            if os.path.samestat(os.stat(self.path), self._found):
                return ""
        return (
            f"the folder {self.path} was {self._whereto()} while it is open here, so nothing more is written; move it "
            "back, or close this session and open the campaign where it is now"
        )

    def check(self) -> None:
        """Refuse to go on where the folder is no longer at its place.

        Raises:
            OutputError: says what became of it.
        """
        if words := self.moved():
            raise OutputError(words)

    def session_folder(self) -> Path:
        """Return the folder of its session, made and private, to write into.

        Raises:
            OutputError: the campaign is no longer at its place, or the folder cannot be made.
            InputError: what has the folder's name is no folder of this user.
        """
        self.check()
        return make_private(session_folder(self.path))

    def _whereto(self) -> str:
        try:
            now = os.readlink(f"/proc/self/fd/{self._handle}")
        except OSError:  # another system than Linux
            return "moved away or removed"
        return "removed" if now.endswith(" (deleted)") else f"moved to {now}"
