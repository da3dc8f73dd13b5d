"""The mission's sentence as a place to be: see where it fails, add what is missing, watch the error fall, go back."""

import re
import time

import pytest

from browser_story import FIT, error, expect_at_floor, fitted, number, opened, rested
from session_campaign import MISSING

expect = pytest.importorskip("playwright.sync_api").expect


def test_the_error_falls_to_the_floor_as_the_missing_effect_is_added_and_fitted(browser, server):
    page = opened(browser, server)
    fitted(page)
    before = error(page)
    assert before > 3.0 and page.locator('tr[data-relation="pads"] + tr i.over').count() == 1
    rested(page)
    page.get_by_role("switch", name=MISSING, exact=True).check()
    slider = page.locator(number("rise"))
    expect(slider).to_be_visible()
    shown = error(page)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.4 * box["width"], middle)
    page.mouse.down()
    for share in (0.5, 0.6, 0.7, 0.8):
        page.mouse.move(box["x"] + share * box["width"], middle)
        page.wait_for_timeout(150)
    expect(page.locator('tr[data-relation="pads"] td.fitted')).not_to_have_text(f"{shown:.2f}")
    page.mouse.up()
    expect(page.locator("#standing")).to_have_text(f"{MISSING}.rise changed, not fitted")
    page.click("#fit")
    fitted(page)
    expect_at_floor(page)
    assert page.locator("i.over").count() == 0
    page.click("#accept")
    expect(page.locator("#standing")).to_have_text("fitted, accepted")
    assert MISSING in (server.folder / "model.toml").read_text()
    page.click("#undo")
    expect(page.locator("#standing")).to_have_text(f"{MISSING}.rise changed, not fitted")
    page.reload()
    expect(page.locator("#standing")).to_have_text(f"{MISSING}.rise changed, not fitted", timeout=30_000)
    page.click("#redo")
    expect(page.locator("#standing")).to_have_text("fitted, accepted")
    assert page.broken == []


@pytest.mark.long
def test_a_fit_is_called_off_within_a_second_and_leaves_the_model_as_it_was(browser, server):
    page = opened(browser, server)
    fitted(page)
    rested(page)
    page.get_by_role("switch", name=MISSING, exact=True).check()
    expect(page.locator(number("rise"))).to_be_visible()
    page.click("#fit")
    expect(page.locator("#work-words")).to_contain_text("fit: fitting", timeout=FIT)
    assert page.locator("#controls").evaluate("e => e.disabled")
    began = time.monotonic()
    page.click("#cancel")
    expect(page.locator("#news")).to_have_text("fit: called off")
    assert time.monotonic() - began < 2.0
    expect(page.locator("#standing")).to_have_text(f"{MISSING} added, not fitted")
    # the worker is as good as new, and a step is asked for once, however often its button is pressed
    assert page.locator("#go-on").evaluate(
        "e => { e.click(); e.click(); return e.disabled && e.dataset.asked === 'yes'; }"
    )
    fitted(page)


@pytest.mark.long
def test_two_tabs_see_the_same_and_a_killed_server_loses_nothing(browser, server):
    one, other = opened(browser, server), opened(browser, server)
    fitted(one)
    fitted(other)
    one.get_by_role("switch", name=MISSING, exact=True).check()
    expect(other.locator(number("rise"))).to_be_visible()
    other.locator(f'{number("rise")[:-2]}-exact"]').fill("0.42")
    other.keyboard.press("Enter")
    expect(one.locator("#standing")).to_have_text(f"{MISSING}.rise changed, not fitted")
    server.kill()
    expect(one.locator("#problem")).to_contain_text("Nothing is lost")
    again = type(server).of(server.folder)
    page = opened(browser, again)
    expect(page.locator("#standing")).to_have_text(f"{MISSING}.rise changed, not fitted")
    expect(page.locator(f'{number("rise")[:-2]}-exact"]')).to_have_value("0.42")
    again.end()


def test_a_lost_socket_comes_back_by_itself(browser, server):
    page = opened(browser, server)
    fitted(page)
    page.context.set_offline(True)
    page.evaluate("performance.mark('offline')")
    page.context.set_offline(False)
    page.get_by_role("switch", name=MISSING, exact=True).check()
    expect(page.locator("#standing")).to_have_text(f"{MISSING} added, not fitted", timeout=30_000)
    page.click("#undo")
    expect(page.locator("#standing")).to_have_text(re.compile("^fitted"))
