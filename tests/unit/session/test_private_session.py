"""A session is its user's alone, its address is on no disk; where nothing can be kept, that is told with the path."""

import os
import resource
import stat
import subprocess
import sys

import pytest

from slipwise.errors import OutputError
from slipwise.session.session import Session

ADDRESS = "http://127.0.0.1:8000/a-token-that-nobody-may-read/"


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


@pytest.mark.parametrize("umask", [0o000, 0o022, 0o077])
def test_its_folder_and_files_are_closed_to_others_whatever_the_umask(folder, umask):
    before = os.umask(umask)
    try:
        session = Session(folder)
        session.store.tell(ADDRESS)
        session.close()
    finally:
        os.umask(before)
    made = folder / ".slipwise"
    assert mode(made) == 0o700 and {p.name: mode(p) for p in made.iterdir()} == {"lock": 0o600, "session.json": 0o600}


def test_a_folder_and_files_that_stood_open_are_closed(folder):
    Session(folder).close()
    made = folder / ".slipwise"
    for path in (*made.iterdir(), made):
        path.chmod(0o777)
    session = Session(folder)
    session.undo() if session.history.before else session.redo() if session.history.after else session.keep()
    session.close()
    assert mode(made) == 0o700 and mode(made / "lock") == 0o600 and mode(made / "session.json") == 0o600


def test_the_address_is_in_no_file_of_the_session_and_still_told_to_the_second_program_of_the_user(folder):
    session = Session(folder)
    session.store.tell(ADDRESS)
    assert all(b"token" not in path.read_bytes() for path in (folder / ".slipwise").iterdir())
    code = f"from slipwise.session.session import Session; Session({str(folder)!r})"
    second = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert f"in process {os.getpid()} at {ADDRESS};" in second.stderr
    session.close()
    assert (folder / ".slipwise" / "lock").read_bytes() == b""


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root becomes another user")
def test_another_user_learns_neither_the_address_nor_the_session(folder):
    session = Session(folder)
    session.store.tell(ADDRESS)
    words = (folder / ".slipwise" / "lock").read_text().split()
    for path in (*folder.parents, folder):
        path.chmod(path.stat().st_mode | 0o055) if path != path.parent else None
    code = """
import os, sys
os.setgroups([]); os.setgid(65534); os.setuid(65534)
for path in sys.argv[1:]:
    try:
        print(open(path, "rb").read())
    except PermissionError:
        print("refused")
"""
    wanted = [folder / ".slipwise" / "lock", folder / ".slipwise" / "session.json", f"/proc/{words[1]}/fd/{words[3]}"]
    done = subprocess.run([sys.executable, "-c", code, *map(str, wanted)], capture_output=True, text=True)
    assert done.stdout.split() == ["refused"] * 3, done.stderr
    session.close()


def test_a_disk_that_is_full_at_the_start_is_told_with_the_path(folder):
    code = f"from slipwise.session.session import Session; Session({str(folder)!r})"

    def full():
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, preexec_fn=full)
    assert f"OutputError: cannot write {folder}/.slipwise/lock: file too large; free some space there" in done.stderr


def test_a_step_that_finds_the_disk_full_stays_in_memory_and_is_kept_with_the_next_one(folder):
    session = Session(folder)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
    try:
        with pytest.raises(OutputError, match=r"\.slipwise/session\.json: file too large"):
            session.set("rig.mass", "10.1 t")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert session.state.values["rig.mass"] == pytest.approx(10_100)
    session.keep()
    session.close()
    again = Session(folder)
    assert again.state.values["rig.mass"] == pytest.approx(10_100) and not again.notes
    again.close()
