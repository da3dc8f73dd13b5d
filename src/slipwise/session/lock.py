"""One program at a time works at a session: a locked file says which process, and whoever comes second is told where.

The address of a page holds its token, and no disk holds that: it is in a file in memory, which the same user's programs
read through the process that has it open (Linux; elsewhere a second program is told the process alone).
"""

import errno
import os
import re
from contextlib import suppress
from pathlib import Path
from typing import IO

from slipwise.errors import InputError, cannot_write
from slipwise.session.own_files import open_own

try:
    import fcntl
except ModuleNotFoundError:  # Windows
    fcntl = None

_MEMORY = "slipwise-address"
_HOLDER = re.compile(r"process (\d{1,10})(?: descriptor (\d{1,6}))?")
_ADDRESS = re.compile(r"http://[!-~]{1,200}")
#: What is said where a disk knows no locks, as some network shares.
_NO_LOCKS = frozenset({errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL})


class Lock:
    """A lock file that is held.

    Attributes:
        sure: False where the disk knows no locks, so that nobody can be kept out.
    """

    def __init__(self, path: Path, campaign: Path) -> None:
        """Take a lock; the file stays when it is given back.

        Args:
            path: of the file.
            campaign: whose session it guards, as messages name it.

        Raises:
            InputError: another program has it, and which; or what has its name is no plain file of this user.
            OutputError: the file cannot be made.
        """
        self._path, self._campaign = path, campaign
        self._memory: IO[bytes] | None = None
        self.sure = fcntl is not None
        try:
            self._file = open(open_own(path, os.O_RDWR | os.O_CREAT), "r+b", buffering=0)  # noqa: SIM115  until `close`
        except InputError as error:
            raise InputError(f"{error}; move it away, then open again") from None
        except OSError as error:
            raise cannot_write(path, error) from error
        try:
            self._take()
            self.tell("")
        except BaseException:
            self._file.close()
            raise

    def _take(self) -> None:
        if fcntl is None:
            return
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno in _NO_LOCKS:
                self.sure = False
                return
            holder = _holder(self._file.read(100).decode("ascii", "replace"))
            raise InputError(
                f"{self._campaign}: a session of this campaign is open already, in {holder}; close that one "
                "first, or go on there"
            ) from None

    def tell(self, address: str) -> None:
        """Leave word where this session is to be found, for whoever comes second.

        Raises:
            OutputError: the disk is full.
        """
        words = f"process {os.getpid()}"
        if address and hasattr(os, "memfd_create"):
            self._forget()
            self._memory = open(os.memfd_create(_MEMORY), "r+b", buffering=0)  # noqa: SIM115  held until `close`
            os.fchmod(self._memory.fileno(), 0o600)
            self._memory.write(address.encode())
            words += f" descriptor {self._memory.fileno()}"
        try:
            self._file.seek(0)
            self._file.truncate()
            self._file.write(words.encode())
        except OSError as error:
            raise cannot_write(self._path, error) from error

    def holds(self) -> bool:
        """Return whether the file is still at its place: who finds none there, or another, takes the session too."""
        try:
            return os.path.samestat(os.lstat(self._path), os.fstat(self._file.fileno()))
        except (OSError, ValueError):
            return False

    def close(self) -> None:
        """Return the lock back."""
        self._forget()
        with suppress(OSError, ValueError):  # closed already
            self._file.truncate(0)
        self._file.close()

    def _forget(self) -> None:
        if self._memory is not None:
            self._memory.close()


def _holder(words: str) -> str:
    """Say who holds a lock, as far as its file can be believed."""
    found = _HOLDER.fullmatch(words.strip())
    if found is None:
        return "another program"
    process, descriptor = found.groups()
    address = _address(process, descriptor) if descriptor else ""
    return f"process {process}" + (f" at {address}" if address else "")


def _address(process: str, descriptor: str) -> str:
    """Read the address that a process of this user holds in memory; "" where it holds none."""
    path = f"/proc/{process}/fd/{descriptor}"
    try:
        if os.readlink(path) != f"/memfd:{_MEMORY} (deleted)":  # the process of this number is another by now
            return ""
        with open(path, "rb") as stream:
            address = stream.read(300).decode("ascii", "replace")
    except OSError:
        return ""
    return address if _ADDRESS.fullmatch(address) else ""
