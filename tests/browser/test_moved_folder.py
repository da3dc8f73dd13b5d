"""What became of the campaign's folder and of the last session is said on the page."""

import re

import pytest

from browser_story import fitted, opened, rested
from workbench_server import Server

expect = pytest.importorskip("playwright.sync_api").expect


@pytest.mark.long
def test_a_folder_that_is_moved_is_told_until_it_is_back_and_nothing_is_written_meanwhile(browser, server):
    page = opened(browser, server)
    fitted(page)
    rested(page)
    folder, there = server.folder, server.folder.with_name("april")
    folder.rename(there)
    problem = page.locator("#problem")
    expect(problem).to_have_text(re.compile(f"{folder} was moved to {there} while it is open here"))
    before = (there / ".slipwise" / "session.json").read_bytes()
    for button in ("#undo", "#accept", "#report"):
        page.click(button)
        page.wait_for_timeout(300)
        expect(problem).to_contain_text("was moved to")
    other = opened(browser, server)
    expect(other.locator("#problem")).to_contain_text("was moved to")
    assert not folder.exists() and (there / ".slipwise" / "session.json").read_bytes() == before
    there.rename(folder)
    expect(problem).to_be_hidden()
    page.click("#accept")
    expect(page.locator("#standing")).to_contain_text("accepted")
    assert (folder / "model.toml").is_file() and page.broken == other.broken == []


def test_a_session_that_was_moved_aside_is_told_on_the_page(browser, new_folder):
    (new_folder / ".slipwise").mkdir()
    (new_folder / ".slipwise" / "session.json").write_text('{"schema": 3, "hist')
    server = Server.of(new_folder)
    page = opened(browser, server)
    aside = new_folder / ".slipwise" / "session-1.json"
    expect(page.locator("#problem")).to_contain_text(f"is kept as {aside}: session.json is damaged")
    assert aside.read_text() == '{"schema": 3, "hist' and page.broken == []
    server.end()
