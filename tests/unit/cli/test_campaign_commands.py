"""`slipwise init`, `audit` and `compare` on one slider, as a first-time user types them, and as a careless one does."""

import json
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser

import numpy as np
import pytest

from slipwise.cli import main

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome") or ""


def write_run(path, frequency, seed, force_header="pad_A_Fx [kN]"):
    """Write a slider with friction 0.1 N that rises by a third after 4 mm of way, on 20 mm strokes."""
    rng = np.random.default_rng(seed)
    time = np.arange(4000) * 0.002
    slip = 0.02 * np.sin(2 * np.pi * frequency * time)
    speed = 0.02 * 2 * np.pi * frequency * np.cos(2 * np.pi * frequency * time)
    load = 10e3 + 1e3 * np.sin(2 * np.pi * 3.1 * time)
    way = 0.02 * (1.0 + np.sign(speed) * np.sin(2 * np.pi * frequency * time))
    force = 0.1 * load * np.sign(speed) * np.where(way < 0.004, 0.75, 1.0) + 5.0 * rng.standard_normal(len(time))
    slip = slip + 1e-5 * rng.standard_normal(len(time))
    table = np.stack([time, slip * 1e3, load / 1e3, force / 1e3], axis=1)
    header = f"time [s],slip_x [mm],pad_A_N [kN],{force_header}"
    np.savetxt(path, table, delimiter=",", header=header, comments="", fmt="%.8g")


def write_campaign(folder, name="one slider"):
    folder.mkdir(exist_ok=True)
    write_run(folder / "slow.csv", 0.5, 1)
    write_run(folder / "fast.csv", 1.0, 2)
    write_run(folder / "held.csv", 0.8, 3)
    runs = "".join(
        f'[[run]]\nfile = "{file}.csv"\nrole = "{role}"\n'
        for file, role in (("slow", "fit"), ("fast", "fit"), ("held", "holdout"))
    )
    (folder / "campaign.toml").write_text(f'name = {json.dumps(name)}\nrig = "pad"\n{runs}', encoding="utf-8")


@pytest.fixture
def campaign(tmp_path):
    folder = tmp_path / "slider"
    write_campaign(folder)
    return folder


def test_compare_says_where_a_slider_differs_and_writes_page_numbers_and_recording(slipwise, campaign, tmp_path):
    out = tmp_path / "out"
    code, words, _ = slipwise("compare", campaign, "--out", out)
    assert code == 0
    assert "after reversals, both directions" in words.replace("\n", " ")
    assert {p.name for p in out.iterdir()} == {"compare.json", "report.html", "compare.rrd"}
    printed = " ".join(words.split())
    assert "Noise of every gauge, one sample" in printed and "differences of neighbours" in printed
    content = json.loads((out / "compare.json").read_text(encoding="utf-8"))
    assert any("no run begins at rest" in note for note in content["noise"]["notes"])
    assert content["schema"] == 1
    place = content["places"][0]
    assert place["kind"] == "since reversal" and "within 4 mm after a reversal" in place["words"]
    assert any("slip of this rig is prescribed" in words for words in content["cannot"])


def test_compare_prints_json_and_nothing_else_when_asked(slipwise, campaign, tmp_path):
    code, words, _ = slipwise("compare", campaign, "--out", tmp_path / "out", "--no-recording", "--json")
    assert code == 0
    assert json.loads(words)["components"]["pads"]["holdout"] > 2.0


def test_audit_of_a_single_slider_says_that_nothing_holds_its_gauges_against_each_other(slipwise, campaign):
    code, words, _ = slipwise("audit", campaign)
    assert code == 0
    assert "no balance" in words


def test_a_correction_that_the_audit_does_not_name_is_refused(slipwise, campaign):
    code, _, error = slipwise("audit", campaign, "--correct", "channel_gain pad_A_N")
    assert code == 2
    assert "nothing to correct" in error


def test_init_drafts_what_loads_and_never_overwrites(slipwise, campaign):
    (campaign / "campaign.toml").unlink()
    code, _, _ = slipwise("init", campaign)
    assert code == 0
    text = (campaign / "campaign.toml").read_text(encoding="utf-8")
    assert 'file = "slow.csv"' in text and "decide" in text
    assert slipwise("audit", campaign)[0] == 0
    code, _, error = slipwise("init", campaign)
    assert code == 2 and "not overwritten" in error
    assert (campaign / "campaign.toml").read_text(encoding="utf-8") == text


def test_init_maps_foreign_headers_by_word_and_unit_and_marks_them(slipwise, tmp_path):
    (tmp_path / "a.csv").write_text("t (s),disp (in),force (kip),note (-)\n0,0,1,2\n0.1,0.1,1,2\n", encoding="utf-8")
    assert slipwise("init", tmp_path)[0] == 0
    text = (tmp_path / "campaign.toml").read_text(encoding="utf-8")
    assert re.search(r'"disp \(in\)" = \{ channel = "slip_x", unit = "in" \} +# decide', text)
    assert re.search(r'^# "note \(-\)"', text, re.MULTILINE)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('rig = "pad"', 'rgi = "pad"', "'rig'|did you mean rig"),
        ('role = "holdout"', 'role = "houldout"', "did you mean holdout"),
        ('file = "held.csv"', 'file = "hold.csv"', "no such file"),
    ],
)
def test_a_typo_in_campaign_toml_is_one_clear_message(slipwise, campaign, before, after, message):
    path = campaign / "campaign.toml"
    path.write_text(path.read_text(encoding="utf-8").replace(before, after), encoding="utf-8")
    code, _, error = slipwise("compare", campaign, "--out", campaign / "out")
    assert code == 2
    assert re.search(message, error)
    assert "Traceback" not in error and len(error.strip().splitlines()) == 1


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ("pad_A_Fx [mm]", r"slow\.csv.*pad_A_Fx.*N"),
        ("pad_A_Fx", r"slow\.csv.*no unit.*kN"),
        ("force [kN]", r"slow\.csv: no pad_\*_Fx was measured"),
    ],
)
def test_a_wrong_unit_or_a_missing_channel_names_file_and_cure(slipwise, campaign, header, message):
    for seed, name in enumerate(("slow", "fast", "held")):
        write_run(campaign / f"{name}.csv", 0.7, seed, header)
    code, _, error = slipwise("compare", campaign, "--out", campaign / "out")
    assert code == 2
    assert "Traceback" not in error and len(error.strip().splitlines()) == 1
    assert re.search(message, error)
    assert not (campaign / "out" / "report.html").exists()


class Page(HTMLParser):
    """What a page refers to."""

    def __init__(self):
        super().__init__()
        self.anchors, self.links, self.outside, self.scripts = set(), set(), [], 0

    def handle_starttag(self, tag, attrs):
        self.scripts += tag == "script"
        for key, value in attrs:
            if key == "id":
                self.anchors.add(value)
            elif key in ("href", "xlink:href") and (value or "").startswith("#"):
                self.links.add(value[1:])
            elif key in ("src", "href", "xlink:href") and not (value or "").startswith("data:"):
                self.outside.append(value)


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """Compare a campaign with a name that a page must escape; gives the page."""
    home = tmp_path_factory.mktemp("report")
    write_campaign(home / "evil", name='<script>alert(1)</script> & "two"')
    words = ["slipwise", "compare", str(home / "evil"), "--out", str(home / "out"), "--no-recording"]
    with pytest.MonkeyPatch.context() as patch, pytest.raises(SystemExit) as ended:
        patch.setattr(sys, "argv", words)
        main()
    assert ended.value.code == 0
    return home / "out" / "report.html"


def test_the_report_needs_nothing_from_outside_and_its_anchors_lead_somewhere(report):
    page = Page()
    page.feed(report.read_text(encoding="utf-8"))
    assert page.outside == []
    assert page.links <= page.anchors and len(page.links) > 6


def test_names_from_files_are_escaped(report):
    text = report.read_text(encoding="utf-8")
    page = Page()
    page.feed(text)
    assert page.scripts == 0
    assert "&lt;script&gt;alert(1)&lt;/script&gt; &amp;" in text


@pytest.mark.skipif(not CHROMIUM, reason="no chromium on this machine: the page is not opened in a browser")
@pytest.mark.parametrize("width", [1280, 390])
def test_a_browser_opens_the_report_without_errors_requests_or_sideways_scrolling(report, tmp_path, width):
    probe = """<script>addEventListener("load", () => {
      const every = [...document.querySelectorAll("figure svg, figure img")];
      const drawn = every.filter(d => d.getClientRects().length);  // not what is for a screen of another size
      const empty = drawn.filter(d => d.getBoundingClientRect().height < 40).length;
      const asked = performance.getEntriesByType("resource").length;
      const wide = document.documentElement.scrollWidth - innerWidth;
      document.title = `drawn=${drawn.length} empty=${empty} asked=${asked} wide=${wide}`; });
      addEventListener("error", e => { document.body.dataset.failed = e.message; });</script>"""
    page = tmp_path / "probed.html"
    page.write_text(report.read_text(encoding="utf-8").replace("</head>", probe + "</head>"), encoding="utf-8")
    quiet = "--no-first-run --disable-background-networking --disable-component-update --disable-sync".split()
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", *quiet, f"--user-data-dir={tmp_path / 'own'}",
               f"--window-size={width},2000", "--virtual-time-budget=4000", "--dump-dom", page.as_uri()]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=90, check=True)
    found = re.search(r"drawn=(\d+) empty=(\d+) asked=(\d+) wide=(-?\d+)", done.stdout)
    assert found, "the page did not finish loading"
    drawn, empty, asked, wide = map(int, found.groups())
    assert drawn >= 6 and empty == 0 and asked == 0
    assert wide <= 0
    assert "data-failed" not in done.stdout
