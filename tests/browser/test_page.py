"""The page for everybody: by keyboard, by screen reader, on a phone, dark and light, and without any network."""

import re

import pytest

from browser_story import fitted, opened, rested
from session_campaign import MISSING

expect = pytest.importorskip("playwright.sync_api").expect
MOST_BYTES = 1_000_000


@pytest.fixture(scope="module")
def looked_at(settled):
    return settled


@pytest.fixture
def page(browser, shared):
    page = opened(browser, shared)
    fitted(page)
    rested(page)
    return page


def violations(page):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    found = axe.run(page).response["violations"]
    return [(v["id"], [n["html"][:120] for n in v["nodes"][:3]]) for v in found]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1500, 1000), (390, 844)], ids=["desktop", "phone"])
def test_a_screen_reader_finds_nothing_to_object_to(browser, shared, scheme, size):
    page = opened(browser, shared, color_scheme=scheme)
    fitted(page)
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.wait_for_timeout(300)
    assert violations(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "nothing stands out to the side"


def test_everything_works_by_keyboard(page):
    switch = page.get_by_role("switch", name=MISSING, exact=True)
    switch.focus()
    page.keyboard.press("Space")
    slider = page.get_by_role("slider", name=re.compile("new pad over a settled one"))
    expect(slider).to_be_visible()
    before = slider.get_attribute("aria-valuetext")
    slider.focus()
    page.keyboard.press("ArrowRight")
    expect(slider).not_to_have_attribute("aria-valuetext", before)
    expect(page.locator("#standing")).to_have_text(f"{MISSING}.rise changed, not fitted")
    expect(slider).to_be_focused()
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    expect(page.locator("#standing")).to_have_text(re.compile("^fitted"))


def test_a_phone_shows_the_session_and_does_not_change_it(page):
    page.set_viewport_size({"width": 390, "height": 844})
    expect(page.locator("#errors table")).to_be_visible()
    expect(page.locator("#fit")).to_be_hidden()
    assert page.locator("#effects").evaluate("e => e.inert")


def test_the_page_is_light_and_asks_nobody_else(browser, shared):
    page = browser.new_context().new_page()
    asked, sizes = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("response", lambda response: sizes.append(len(response.body())))
    page.goto(shared.address)
    expect(page.locator("#errors table")).to_be_visible(timeout=30_000)
    host = shared.address.split("/")[2]
    assert all(url.split("/")[2] == host for url in asked if not url.startswith("data:"))
    assert sum(sizes) < MOST_BYTES


def test_units_change_by_a_switch(page):
    loads = page.locator("#readings tr", has_text="largest load").locator("td").first
    expect(loads).to_contain_text("kN")
    page.select_option("#units", "si")
    expect(loads).to_have_text(re.compile(r"\d N$"))
    page.select_option("#units", "usual")


def test_any_channel_and_any_shape_can_be_looked_at(page):
    broken = page.broken
    for name in page.locator("#history option").evaluate_all("all => all.map((o) => o.value)"):
        page.select_option("#history", name)
    for shape in ("speed", "pressure", "loop"):
        page.select_option("#shape", shape)
    page.select_option("#beside", "paper")
    expect(page.locator("#errors thead")).to_contain_text("beside")
    page.select_option("#run", "quake2_hv")
    page.select_option("#history", "channel:slip_x")
    expect(page.locator("#histories .u-legend").first).to_contain_text("model")
    assert broken == []


def test_histories_and_loops_zoom_together(page):
    page.fill("#from", "2")
    page.fill("#to", "3")
    page.keyboard.press("Enter")
    page.locator("#to").blur()
    expect(page.locator("#from")).to_have_value("2.00")
    whole = page.locator("#loops figcaption span").first.inner_text()
    page.click("#whole")
    expect(page.locator("#loops figcaption span").first).not_to_have_text(whole)
