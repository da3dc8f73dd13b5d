"""What tests do on the page of the workbench: open it, wait for a fit, read an error."""

import re

import pytest

from session_campaign import MISSING

expect = pytest.importorskip("playwright.sync_api").expect
#: Time for a fit beside other tests [ms].
FIT = 90_000


def opened(browser, server, **settings):
    page = browser.new_context(viewport={"width": 1500, "height": 1000}, **settings).new_page()
    page.broken = []
    page.on("pageerror", lambda error: page.broken.append(str(error)))
    page.goto(server.address)
    expect(page.locator("#errors table")).to_be_visible(timeout=30_000)
    return page


def fitted(page):
    expect(page.locator("#standing")).to_have_text(re.compile("^fitted"), timeout=FIT)


def rested(page):
    """Wait until no work is left to be done."""
    for _ in range(3):
        expect(page.locator("#work")).to_be_hidden(timeout=FIT)
        page.wait_for_timeout(400)


def error(page, of="fitted"):
    return float(page.locator(f'tr[data-relation="pads"] td.{of}').inner_text())


def expect_at_floor(page):
    """Wait until both errors of the pads are at the floor: they may come after the words that a fit is over."""
    for of in ("fitted", "now"):
        for _ in range(50):
            if error(page, of) < 1.15:
                break
            page.wait_for_timeout(200)
        assert error(page, of) < 1.15


def number(name):
    return f'[id="number-{MISSING}.{name}"]'
