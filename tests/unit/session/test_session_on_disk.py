"""Nothing is lost when a session ends, and nothing is run or overwritten that the user has not allowed."""

import json
import os
import signal
import stat
import subprocess
import sys

import pytest

from session_campaign import MISSING
from slipwise.errors import InputError, OutputError, SlipwiseWarning
from slipwise.session.session import Session


def test_a_killed_session_is_taken_up_where_it_was(folder):
    code = f"""
import os, signal
from slipwise.session.session import Session
session = Session({str(folder)!r})
session.toggle({MISSING!r})
session.set("{MISSING}.rise", 0.33)
session.undo()
os.kill(os.getpid(), signal.SIGKILL)
"""
    ended = subprocess.run([sys.executable, "-c", code])
    assert ended.returncode == -signal.SIGKILL
    session = Session(folder)
    assert session.state.labels[-1] == MISSING and session.state.words == f"{MISSING} added"
    session.redo()
    assert session.state.values[f"{MISSING}.rise"] == 0.33
    session.close()


def test_errors_are_the_same_after_a_session_is_taken_up_again(folder):
    first = Session(folder)
    first.fit()
    before = [e.fitted for e in first.errors()]
    first.close()
    again = Session(folder)
    assert again.state == first.state
    assert [e.fitted for e in again.errors()] == pytest.approx(before, rel=1e-6)
    again.close()


def test_a_second_program_is_told_where_the_first_is(folder):
    session = Session(folder)
    session.store.tell("http://127.0.0.1:8000/")
    code = f"from slipwise.session.session import Session; Session({str(folder)!r})"
    second = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert f"is open already, in process {os.getpid()} at http://127.0.0.1:8000/" in second.stderr
    session.close()
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == 0


def test_accept_writes_the_model_and_the_next_session_goes_on_from_it(folder):
    session = Session(folder)
    session.toggle(MISSING)
    session.accept()
    session.close()
    assert MISSING in (folder / "model.toml").read_text()
    again = Session(folder)
    assert not again.notes and again.state.labels == session.state.labels and again.reference == again.state
    again.close()


def test_a_model_that_was_edited_by_hand_is_read_anew_and_undo_leads_back(folder):
    session = Session(folder)
    session.toggle(MISSING)
    session.accept()
    session.close()
    path = folder / "model.toml"
    path.write_text(path.read_text().replace("rise = 0.3", "rise = 0.5"))
    again = Session(folder)
    assert again.state.values[f"{MISSING}.rise"] == 0.5 and "read anew" in again.notes[0]
    again.undo()
    assert again.state.values[f"{MISSING}.rise"] == 0.3
    again.close()


def test_a_campaign_that_has_changed_begins_a_new_session(folder):
    session = Session(folder)
    session.toggle(MISSING)
    session.close()
    text = (folder / "campaign.toml").read_text()
    (folder / "campaign.toml").write_text(text.replace('rest_before = "30 min"', 'rest_before = "20 min"', 1))
    with pytest.warns(SlipwiseWarning, match="has changed"):
        again = Session(folder)
    assert MISSING not in again.state.labels and "has changed" in again.notes[0]
    again.close()


def test_an_effect_file_that_a_snapshot_names_is_not_run_unasked(folder):
    session = Session(folder)
    session.close()
    trap = folder / "trap.py"
    trap.write_text(f"open({str(folder / 'ran')!r}, 'w')")
    snapshot = folder / ".slipwise" / "session.json"
    content = json.loads(snapshot.read_text())
    content["history"]["states"][0]["terms"].append({"effect": str(trap), "targets": [""], "group": ""})
    snapshot.write_text(json.dumps(content))
    with pytest.warns(SlipwiseWarning, match="--effect"):
        again = Session(folder)
    assert not (folder / "ran").exists() and "not run unasked" in again.notes[0]
    again.close()


def test_a_campaign_that_cannot_be_opened_leaves_no_lock(folder):
    (folder / "model.toml").write_text("rig = 'bridge9'")
    with pytest.raises(Exception, match="bridge9"):
        Session(folder)
    (folder / "model.toml").unlink()
    Session(folder).close()


def test_a_folder_that_may_not_be_written_has_its_session_in_the_cache(folder, monkeypatch, tmp_path):
    monkeypatch.setenv("SLIPWISE_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    session = Session(folder)
    assert session.store.folder.is_relative_to(tmp_path / "cache") and not (folder / ".slipwise").exists()
    session.close()
    assert {stat.S_IMODE(p.stat().st_mode) for p in (session.store.folder, session.store.folder.parent)} == {0o700}


def test_sessions_that_stood_open_in_the_cache_are_closed_to_others_and_kept(folder, monkeypatch, tmp_path):
    monkeypatch.setenv("SLIPWISE_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    (tmp_path / "cache" / "sessions").mkdir(parents=True)
    (tmp_path / "cache" / "sessions" / "kept").write_text("of another campaign")
    (tmp_path / "cache" / "sessions").chmod(0o755)
    Session(folder).close()
    assert stat.S_IMODE((tmp_path / "cache" / "sessions").stat().st_mode) == 0o700
    assert (tmp_path / "cache" / "sessions" / "kept").exists()


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root gives files away")
def test_a_cache_of_another_user_holds_no_session(folder, monkeypatch, tmp_path):
    monkeypatch.setenv("SLIPWISE_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    (tmp_path / "cache").mkdir(mode=0o700)
    os.chown(tmp_path / "cache", 12345, -1)
    session = Session(folder)
    assert session.store.folder.is_relative_to(tmp_path / f"slipwise-{os.getuid()}")
    session.close()
    os.chown(tmp_path / f"slipwise-{os.getuid()}" / "sessions", 12345, -1)
    with pytest.raises(OutputError, match="no session is kept there, for .*cache is somebody else's; SLIPWISE_CACHE="):
        Session(folder)


def test_a_folder_that_is_not_there_is_no_campaign_and_is_not_made(folder):
    with pytest.raises(InputError, match="no such"):
        Session(folder / "nowhere")
    assert not (folder / "nowhere").exists()
