"""The page is there before its session, which opens meanwhile or says why it cannot."""

import pytest

from browser_story import fitted, opened, rested
from workbench_server import Server

expect = pytest.importorskip("playwright.sync_api").expect


@pytest.mark.long
def test_the_page_is_there_before_the_session_and_shows_what_it_showed_last(browser, folder, tmp_path):
    first = Server.of(folder)
    page = opened(browser, first)
    fitted(page)
    rested(page)
    shown = page.locator("#errors").inner_text()
    first.end()
    again = Server.early(folder, tmp_path)
    page = opened(browser, again)
    assert page.locator("#errors").inner_text() == shown
    expect(page.locator("#work-words")).to_contain_text("getting the session ready")
    expect(page.locator("#work-words")).not_to_contain_text("getting the session ready", timeout=30_000)
    assert page.locator("#errors").inner_text() == shown and page.broken == []
    again.end()


def test_a_campaign_that_cannot_be_opened_is_told_on_its_page_and_ends_the_command(browser, new_folder, tmp_path):
    (new_folder / "model.toml").write_text("rig = 'bridge9'")
    server = Server.early(new_folder, tmp_path)
    page = browser.new_context().new_page()
    page.goto(server.address)
    expect(page.locator("#problem")).to_contain_text("bridge9", timeout=30_000)
    assert server.process.wait(20) == 2
