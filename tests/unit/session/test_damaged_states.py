"""Whatever has become of a session's files, opening it says so in a sentence, and what was there is still there."""

import json
import os
import re
import socket
from pathlib import Path

import pytest

from session_campaign import MISSING
from slipwise.errors import SlipwiseError, SlipwiseWarning
from slipwise.session.session import Session


@pytest.fixture(scope="module")
def whole(written):
    """The snapshot of a session of three steps."""
    session = Session(written)
    session.toggle(MISSING)
    session.set(f"{MISSING}.rise", 0.33)
    session.close()
    yield (written / ".slipwise" / "session.json").read_bytes()
    (written / ".slipwise" / "session.json").unlink()


@pytest.fixture
def kept(folder, whole):
    """The session's folder, with that snapshot."""
    made = folder / ".slipwise"
    made.mkdir(mode=0o700)
    (made / "session.json").write_bytes(whole)
    return made


def changed(way: str, value: object):
    """Put a value at a place of the snapshot, "history/states/0/words"; `...` takes what is there away."""

    def damage(data: bytes) -> bytes:
        content = json.loads(data)
        *parents, last = [int(part) if part.isdigit() else part for part in way.split("/")]
        inside = content
        for part in parents:
            inside = inside[part]
        if value is ...:
            del inside[last]
        else:
            inside[last] = value
        return json.dumps(content).encode()

    return damage


def text(old: bytes, new: bytes):
    return lambda data: data.replace(old, new, 1)


NUMBER = f'"{MISSING}.rise": 0.33'.encode()
STEP = "history/states/0"
#: What has become of the snapshot's bytes, and what is said of it.
DAMAGED = {
    "empty": (lambda data: b"", "is empty"),
    "zeros": (lambda data: bytes(len(data)), "is empty"),
    "cut in half": (lambda data: data[: len(data) // 2], "damaged"),
    "without its last byte": (lambda data: data[:-1], "damaged"),
    "one byte flipped": (lambda data: data[:40] + b"\xff" + data[41:], "damaged"),
    "followed by nonsense": (lambda data: data + b"}", "damaged"),
    "twice in one file": (lambda data: data + data, "damaged"),
    "no JSON": (lambda data: b"PK\x03\x04", "damaged"),
    "in UTF-16": (lambda data: data.decode().encode("utf-16"), "damaged"),
    "a list": (lambda data: b"[]", "another version"),
    "nothing": (lambda data: b"null", "another version"),
    "NaN": (text(NUMBER, f'"{MISSING}.rise": NaN'.encode()), "damaged"),
    "Infinity": (text(NUMBER, f'"{MISSING}.rise": Infinity'.encode()), "damaged"),
    "400 digits": (text(NUMBER, f'"{MISSING}.rise": {"9" * 400}'.encode()), "damaged"),
    "31 000 brackets": (text(NUMBER, f'"{MISSING}.rise": {"[" * 31_000}'.encode()), "damaged"),
    "of a later version": (changed("schema", 99), "another version"),
    "without a version": (changed("schema", ...), "another version"),
    "without steps": (changed("history/states", []), "damaged"),
    "without a history": (changed("history", ...), "damaged"),
    "at a step that is not there": (changed("history/place", 3), "at step 4 of 3"),
    "at a step before the first": (changed("history/place", -1), "damaged"),
    "at a step in words": (changed("history/place", "2"), "damaged"),
    "numbers as a list": (changed(f"{STEP}/values", [1.0]), "damaged"),
    "a number as a word": (changed(f"{STEP}/values/rig.mass", "heavy"), "damaged"),
    "a number less": (changed(f"{STEP}/values/rig.mass", ...), "lacks rig.mass"),
    "no numbers": (changed("reference/values", {}), "cannot be evaluated"),
    "a mass below zero": (changed("history/states/2/values/rig.mass", -10_000.0), "cannot be; possible are"),
    "an effect beyond reason": (text(NUMBER, f'"{MISSING}.rise": 1e300'.encode()), "out of bounds"),
    "a slip beyond reason": (changed("history/states/2/values/rig.pitch_slip", 1e300), "far beyond its bounds"),
    "an effect that is none": (changed(f"{STEP}/terms/0/effect", "magic"), "no effect is called 'magic'"),
    "an effect on no channel": (changed(f"{STEP}/terms/0/targets", "pads"), "damaged"),
    "a law for a pad that is none": (changed(f"{STEP}/terms/0/own", ["strength[Z]"]), "no parameter of .* is called"),
    "intervals as words": (changed(f"{STEP}/known", {"rig.mass": ["a", "b", "", ""]}), "damaged"),
    "without weights": (changed(f"{STEP}/weights", ...), "damaged"),
    "without a reference": (changed("reference", ...), "damaged"),
    "findings as a list": (changed("findings", []), "damaged"),
    "a diagnosis without words": (changed("findings/explain", {"of": [], "suggestion": []}), "damaged"),
    "a report elsewhere": (changed("findings/report", {"of": [], "file": "https://evil.example"}), "damaged"),
    "of another campaign": (changed("campaign", "another"), "campaign has changed"),
}


@pytest.mark.parametrize("damage", DAMAGED)
def test_a_snapshot_that_cannot_be_taken_up_is_moved_aside_and_told(kept, damage, whole):
    spoil, said = DAMAGED[damage]
    spoilt = spoil(whole)
    assert spoilt != whole
    (kept / "session.json").write_bytes(spoilt)
    with pytest.warns(SlipwiseWarning, match=said) as told:
        session = Session(kept.parent)
    assert session.state.words == "opened" and str(kept / "session-1.json") in session.notes[0]
    assert [str(one.message) for one in told] == list(session.notes)
    session.close()
    assert (kept / "session-1.json").read_bytes() == spoilt


def as_pipe(path: Path) -> None:
    os.mkfifo(path)


def as_folder(path: Path) -> None:
    path.mkdir()
    (path / "notes.txt").write_text("mine")


def as_link(path: Path) -> None:
    outside = path.parents[2] / "outside"
    outside.write_text("mine")
    path.symlink_to(outside)


def as_link_to_nothing(path: Path) -> None:
    path.symlink_to("/nowhere/at/all")


def as_socket(path: Path) -> None:
    here = os.getcwd()
    os.chdir(path.parent)  # names of sockets are short
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(path.name)
    os.chdir(here)


def as_hole(path: Path) -> None:
    with path.open("wb") as stream:
        stream.truncate(1 << 40)


KINDS = {
    "a pipe": as_pipe,
    "a folder": as_folder,
    "a link": as_link,
    "a link to nothing": as_link_to_nothing,
    "a socket": as_socket,
}


@pytest.mark.parametrize("kind", [*KINDS, "a terabyte"])
def test_what_stands_in_a_snapshot_s_place_is_moved_aside_unread(kept, kind):
    path = kept / "session.json"
    path.unlink()
    {**KINDS, "a terabyte": as_hole}[kind](path)
    before = path.lstat()
    with pytest.warns(SlipwiseWarning, match="1099512 MB" if kind == "a terabyte" else "no file of a session"):
        Session(kept.parent).close()
    assert os.path.samestat((kept / "session-1.json").lstat(), before)


@pytest.mark.parametrize("kind", KINDS)
def test_a_lock_that_is_no_file_is_refused_with_its_name_and_left_alone(kept, kind, whole):
    KINDS[kind](kept / "lock")
    before = (kept / "lock").lstat()
    with pytest.raises(SlipwiseError, match=f"{re.escape(str(kept))}/lock is .*move it away"):
        Session(kept.parent)
    assert os.path.samestat((kept / "lock").lstat(), before) and (kept / "session.json").read_bytes() == whole


@pytest.mark.parametrize(
    "words", [b"", b"\0" * 50, b"\xff\xfe", b"process 1", b"process 1 descriptor 1", b"x" * 10_000]
)
def test_whatever_a_lock_says_that_nobody_holds_the_session_is_taken_up(kept, words):
    (kept / "lock").write_bytes(words)
    session = Session(kept.parent)
    assert not session.notes and session.state.values[f"{MISSING}.rise"] == 0.33
    session.close()


@pytest.mark.parametrize("words", [b"", b"\x1b[2Jgone", b"process 999999999 descriptor 7", b"process 1 descriptor 0"])
def test_whatever_a_lock_says_that_another_holds_only_what_can_be_true_is_repeated(kept, words):
    session = Session(kept.parent)
    (kept / "lock").write_bytes(words)
    with pytest.raises(SlipwiseError, match="is open already, in (another program|process [0-9]+); close"):
        Session(kept.parent)
    session.close()


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "a folder"])
def test_what_stands_in_the_folder_s_place_is_refused_with_its_name(folder, kind):
    KINDS[kind](folder / ".slipwise")
    with pytest.raises(SlipwiseError, match=r"\.slipwise is .*, and no folder for a session; move it away"):
        Session(folder)
    assert (folder / ".slipwise").lstat()


def test_a_session_of_another_user_is_left_alone_and_a_new_one_kept_elsewhere(kept, monkeypatch, tmp_path, whole):
    monkeypatch.setattr("slipwise.session.place.sessions_folder", lambda: tmp_path / "cache")
    monkeypatch.setattr(os, "getuid", lambda: kept.stat().st_uid + 1)
    monkeypatch.setattr("slipwise.session.own_files.is_foreign", lambda path: False)  # of what is made here
    monkeypatch.setattr("slipwise.session.own_files._check", lambda path, found: None)
    with pytest.warns(SlipwiseWarning, match="belongs to another user") as told:
        session = Session(kept.parent)
    assert str(session.store.folder) in str(told[0].message) and session.notes == (str(told[0].message),)
    session.close()
    assert (kept / "session.json").read_bytes() == whole and not (kept / "lock").exists()


def test_a_session_where_nothing_may_be_written_any_more_is_left_alone_and_told(kept, monkeypatch, tmp_path, whole):
    monkeypatch.setenv("SLIPWISE_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.warns(SlipwiseWarning, match=r"\.slipwise cannot be written to; this session is kept in .*cache"):
        Session(kept.parent).close()
    assert (kept / "session.json").read_bytes() == whole


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root gives files away")
def test_a_snapshot_or_a_lock_of_another_user_is_not_opened(kept, whole):
    os.chown(kept / "session.json", 12345, -1)
    with pytest.warns(SlipwiseWarning, match="belongs to another user"):
        Session(kept.parent).close()
    assert (kept / "session-1.json").read_bytes() == whole
    os.chown(kept / "lock", 12345, -1)
    with pytest.raises(SlipwiseError, match="lock belongs to another user; move it away"):
        Session(kept.parent)


def test_a_pipe_beside_a_snapshot_keeps_nobody_waiting(kept):
    os.mkfifo(kept / ".session.json.abcdefgh")
    session = Session(kept.parent)
    session.undo()
    session.close()
    assert not session.notes


def test_what_was_moved_aside_is_taken_up_again_under_its_old_name(kept, whole):
    (kept / "session.json").write_bytes(changed("campaign", "another")(whole))
    with pytest.warns(SlipwiseWarning):
        Session(kept.parent).close()
    with pytest.warns(SlipwiseWarning):  # a second one is not lost to the first
        (kept / "session.json").write_bytes(b"")
        Session(kept.parent).close()
    assert (kept / "session-2.json").read_bytes() == b""
    (kept / "session-1.json").write_bytes(whole)
    (kept / "session-1.json").replace(kept / "session.json")
    session = Session(kept.parent)
    assert not session.notes and len(session.history.states) == 3
    session.close()
