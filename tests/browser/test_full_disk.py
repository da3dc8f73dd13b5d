"""A disk that is full is told on the page with the file's path, nothing hangs, and nothing that was done is lost."""

import json
import resource

import pytest

from browser_story import FIT, fitted, opened, rested
from session_campaign import MISSING

expect = pytest.importorskip("playwright.sync_api").expect


@pytest.mark.long
@pytest.mark.skipif(not hasattr(resource, "prlimit"), reason="only Linux limits the files of a process that runs")
def test_a_fit_that_ends_on_a_full_disk_is_told_and_kept_when_there_is_room_again(browser, server):
    page = opened(browser, server)
    fitted(page)
    rested(page)
    snapshot = server.folder / ".slipwise" / "session.json"
    before = snapshot.read_bytes()
    limits = resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE)
    resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (100, limits[1]))
    problem = page.locator("#problem")
    page.get_by_role("switch", name=MISSING, exact=True).check()
    expect(problem).to_contain_text(f"cannot write {snapshot}: file too large; free some space there")
    expect(page.locator("#standing")).to_contain_text(f"{MISSING} added")
    page.click("#fit")
    expect(problem).to_be_hidden()
    expect(problem).to_contain_text(f"cannot write {snapshot}", timeout=FIT)
    expect(page.locator("#controls")).to_be_enabled()
    assert snapshot.read_bytes() == before
    resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, limits)
    page.click("#undo")
    expect(problem).to_be_hidden()
    expect(page.locator("#redo")).to_be_enabled()
    steps = json.loads(snapshot.read_text())["history"]["states"]
    assert steps[-1]["words"] == "fitted" and steps[-2]["words"].endswith("added") and page.broken == []
