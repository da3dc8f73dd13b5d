"""The page that was kept is shown only where nothing has changed since, and is what the session would show."""

import os

import pytest

pytest.importorskip("starlette")
from slipwise.workbench.page_cache import keep_page, kept_page

TOLD = [{"kind": "state", "words": "Größe"}, b"\x01\x00\xff", {"kind": "campaign"}, b""]


@pytest.fixture
def campaign(tmp_path):
    (tmp_path / "campaign.toml").write_text("name = 'march'")
    (tmp_path / ".slipwise").mkdir()
    (tmp_path / ".slipwise" / "session.json").write_text("{}")
    keep_page(tmp_path, TOLD)
    return tmp_path


def test_what_was_kept_comes_back(campaign):
    assert kept_page(campaign) == TOLD


@pytest.mark.parametrize("name", ["campaign.toml", ".slipwise/session.json", "model.toml"])
def test_a_page_of_another_campaign_or_session_is_not_shown(campaign, name):
    (campaign / name).write_text("another")
    assert kept_page(campaign) == []


@pytest.mark.parametrize("spoil", [
    lambda p: p[:-1], lambda p: b"nonsense", lambda p: b"[]\n", lambda p: b"", lambda p: b"[" * 31_000,
    lambda p: b"\xff\n", lambda p: p.replace(b"false", b"0", 1), lambda p: p.replace(b"[[", b"[[true, -1], [", 1),
    lambda p: p.replace(b'"kind"', b'["kind', 1), lambda p: p.replace(b'{"kind": "state"', b'["kind", "state", "', 1),
])  # fmt: skip
def test_a_broken_page_is_not_shown(campaign, spoil):
    path = campaign / ".slipwise" / "page.bin"
    path.write_bytes(spoil(path.read_bytes()))
    assert kept_page(campaign) == []


@pytest.mark.parametrize("put", [os.mkfifo, os.mkdir, lambda path: path.symlink_to("/etc/passwd")])
@pytest.mark.parametrize("name", ["page.bin", "session.json"])
def test_what_is_no_file_is_neither_shown_nor_waited_for(campaign, name, put):
    path = campaign / ".slipwise" / name
    path.unlink()
    put(path)
    assert kept_page(campaign) == []
    keep_page(campaign, TOLD)
    assert kept_page(campaign) == (TOLD if name == "page.bin" and put is not os.mkdir else [])


def test_where_nothing_can_be_kept_nothing_is_shown(campaign):
    (campaign / ".slipwise" / "page.bin").unlink()
    (campaign / ".slipwise" / "session.json").unlink()
    keep_page(campaign, TOLD)
    assert kept_page(campaign) == [] and os.listdir(campaign / ".slipwise") == []
