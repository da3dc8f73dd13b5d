"""A folder is known by what it is: one that is moved, removed or replaced while it is open gets nothing by mistake."""

import shutil

import pytest

from session_campaign import MISSING
from slipwise.errors import InputError, OutputError
from slipwise.session.campaign_folder import CampaignFolder
from slipwise.session.session import Session


def test_a_campaign_that_was_moved_is_told_with_its_new_place_and_nothing_appears_at_the_old_one(folder):
    session = Session(folder)
    there = folder.rename(folder.with_name("april"))
    for act in (lambda: session.toggle(MISSING), session.accept, lambda: session.place.session_folder()):
        with pytest.raises(OutputError, match=f"{folder} was moved to {there} while it is open"):
            act()
    assert not folder.exists()
    there.rename(folder)
    session.keep()
    session.close()
    again = Session(folder)
    assert MISSING in again.state.labels  # what was done meanwhile was kept in memory
    again.close()


def test_another_campaign_in_its_place_is_left_alone(folder):
    session = Session(folder)
    there = folder.rename(folder.with_name("april"))
    shutil.copytree(there, folder, ignore=shutil.ignore_patterns(".slipwise"))
    other = Session(folder)  # which no lock of the first keeps out
    other.set("rig.mass", "10.1 t")
    with pytest.raises(OutputError, match="was moved"):
        session.toggle(MISSING)
    session.close()
    other.close()
    again = Session(folder)
    assert again.state.values["rig.mass"] == pytest.approx(10_100) and MISSING not in again.state.labels
    again.close()


def test_a_folder_that_was_removed_and_made_anew_is_another_one(tmp_path):
    made = tmp_path / "march"
    made.mkdir()
    place = CampaignFolder(made)
    assert place.moved() == ""
    for _ in range(20):  # a disk gives the number of a folder that nobody holds to the next one
        made.rmdir()
        assert "removed" in place.moved()
        made.mkdir()
        assert "removed" in place.moved()


def test_a_session_whose_folder_was_replaced_writes_nothing_into_the_other(folder):
    session = Session(folder)
    shutil.rmtree(folder / ".slipwise")
    other = Session(folder)
    before = (folder / ".slipwise" / "session.json").read_bytes()
    with pytest.raises(OutputError, match=r"\.slipwise was removed or replaced while its session is open"):
        session.toggle(MISSING)
    assert (folder / ".slipwise" / "session.json").read_bytes() == before
    with pytest.raises(InputError, match="is open already"):
        Session(folder)
    session.close()
    other.close()
