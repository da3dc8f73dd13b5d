"""A report stands alone: escaped, linked within itself, fetching nothing."""

import re
from html.parser import HTMLParser

import pytest

from slipwise.view.figures.canvas import save_figure
from slipwise.view.figures.loop_pictures import loops_figure
from slipwise.view.pages.html import Section, bullets, callout, details, figure, page, paragraph, table, verdict

HOSTILE = "<script>alert('x')</script> & \"quoted\" <img src=x onerror=alert(1)>"
VOID = {"meta", "img", "br", "path", "use", "rect", "line", "circle", "image"}


class Reader(HTMLParser):
    """Collects tags, attributes and text, and checks that tags nest."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.text = ""
        self.feed(text)
        assert self.open == [], f"left open: {self.open}"

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
            self.open.pop()

    def handle_data(self, data):
        self.text += data


@pytest.fixture(scope="module")
def whole(record, tmp_path_factory) -> str:
    png = save_figure(loops_figure(record), tmp_path_factory.mktemp("p") / "a.png").read_bytes()
    rows = [{"effect": HOSTILE, "probability": 0.97, "held out": None}, {"effect": "`heating`", HOSTILE: True}]
    return page(
        HOSTILE,
        [
            Section("What is missing", [HOSTILE, table(rows, HOSTILE, marked=[0]), callout(HOSTILE, HOSTILE, "warn")]),
            Section("Loops", [figure(loops_figure(record), HOSTILE), figure(png, HOSTILE, HOSTILE)]),
            Section("Loops", [details(HOSTILE, [bullets([HOSTILE]), paragraph(HOSTILE)], HOSTILE)]),
            Section(HOSTILE, []),
            Section("***", ["no letter in the title"]),
        ],
        [verdict(HOSTILE, HOSTILE, "good", {HOSTILE: HOSTILE, "probability": 0.97})],
    )


def test_what_comes_from_files_is_text_and_never_markup(whole):
    read = Reader(whole)
    assert {"script"} & {tag for tag, _ in read.tags} == set()
    assert all(not name.startswith("on") for _, attributes in read.tags for name in attributes)
    assert all(attributes["src"].startswith("data:") for tag, attributes in read.tags if tag == "img")
    assert read.text.count(HOSTILE) >= 10


def test_every_link_resolves_and_equal_titles_have_anchors_of_their_own(whole):
    read = Reader(whole)
    ids = [attributes["id"] for _, attributes in read.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = [attributes["href"] for tag, attributes in read.tags if tag == "a"]
    assert links[:3] == ["#what-is-missing", "#loops", "#loops-2"] and len(links) == 5
    assert {link.removeprefix("#") for link in links} <= set(ids)


def test_a_report_fetches_nothing(whole):
    read = Reader(whole)
    assert not {"link", "script", "iframe", "object", "base"} & {tag for tag, _ in read.tags}
    for _, attributes in read.tags:
        for name in ("src", "href", "xlink:href", "srcset", "poster", "action"):
            assert (attributes.get(name) or "#").startswith(("#", "data:image/png;base64,"))
    style = "".join(re.findall(r"<style.*?</style>", whole, flags=re.DOTALL))
    assert "@import" not in style and not re.findall(r"url\((?!#)", style)


def test_a_report_reads_on_a_phone_and_on_paper(whole):
    assert 'name="viewport" content="width=device-width' in whole
    assert "@media print" in whole and "@media screen and (max-width" in whole
    assert '<html lang="en">' in whole and '<meta charset="utf-8">' in whole
    scrolled = re.findall(r"<div class=\"scroll\"[^>]*><table>", whole)
    assert len(scrolled) == whole.count("<table>")


def test_pictures_have_words_for_those_who_cannot_see_them(whole):
    read = Reader(whole)
    assert all(attributes.get("alt") for tag, attributes in read.tags if tag == "img")
    named = [attributes for tag, attributes in read.tags if attributes.get("role") == "img"]
    assert named and all(attributes.get("aria-label") for attributes in named)


def test_numbers_stand_to_the_right_and_what_is_missing_stays_empty():
    text = table([{"a": 1.23456, "b": "x"}, {"a": None, "b": True}]).text
    assert '<td class="number">1.235</td>' in text and "<td></td>" in text and "<td>yes</td>" in text
    assert '<th scope="col" class="number">a</th>' in text


def test_code_is_set_as_code():
    assert paragraph("add `run_in` & see").text == "<p>add <code>run_in</code> &amp; see</p>"


def test_the_same_pieces_make_the_same_page(record):
    def make() -> str:
        return page("t", [Section("s", [figure(loops_figure(record), "c")])])

    assert make() == make()
