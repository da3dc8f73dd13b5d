"""Follow the workbench's own guidance on campaigns with hidden effects, and count the clicks to an accepted model.

    python scripts/make_bench.py --out out/bench --count 15 --seed 38000
    python scripts/follow_guidance.py out/bench --out out/workbench.json

Every campaign is opened in Chromium as a user has it. The button under "Next step" is clicked, and nothing else, until
a model is accepted or no button is left; then the effects of model.toml are held against the campaign's answer. Effects
that the diagnosis calls minor may be in the model or not. Needs the extra `dev` and Chromium.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

import slipwise as sw

#: Most clicks on a campaign, and the time that one may take [ms].
MOST, PATIENCE = 12, 1_800_000


@dataclass(frozen=True)
class Followed:
    """What following the page has led to.

    Attributes:
        campaign: name.
        missing: what is hidden in it.
        added: effects of the accepted model that the base model lacks.
        minor: those that the diagnosis calls minor.
        accepted: whether a model was accepted.
        right: whether all that is hidden, and nothing else that matters, was named and is in it.
        clicks: on what, in order.
        worst: error of the worst balance at the end [floors].
        seconds: it took.
    """

    campaign: str
    missing: list[str]
    added: list[str]
    minor: list[str]
    accepted: bool
    right: bool
    clicks: list[str]
    worst: float
    seconds: float


def follow(browser: Browser, folder: Path, missing: list[str]) -> Followed:
    """Open a campaign and follow the page."""
    began = time.monotonic()
    command = [sys.executable, "-m", "slipwise", "workbench", str(folder), "--no-show"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert server.stdout is not None
    address = server.stdout.readline().split()[-1]
    page = browser.new_context(viewport={"width": 1500, "height": 1000}).new_page()
    clicks: list[str] = []
    try:
        page.goto(address)
        page.wait_for_selector("#errors table", timeout=PATIENCE)
        while len(clicks) < MOST and (not clicks or clicks[-1] != "Accept"):
            _rest(page)
            button = page.locator("#go-on")
            if not button.count():
                break
            clicks.append(button.inner_text())
            button.click()
        _rest(page)
        worst = max(float(words) for words in page.locator("#errors td.now").all_inner_texts())
    finally:
        page.context.close()
        server.terminate()
        server.wait()
    return _judged(folder, missing, clicks, worst, time.monotonic() - began)


def _rest(page: Page) -> None:
    """Wait until nothing is being done, and the model is fitted or a fit is the next step."""
    for _ in range(3):
        page.wait_for_selector("#go-on[data-asked]", state="detached", timeout=PATIENCE)
        page.wait_for_selector("#work", state="hidden", timeout=PATIENCE)
        page.wait_for_timeout(700)


def _judged(folder: Path, missing: list[str], clicks: list[str], worst: float, seconds: float) -> Followed:
    said: dict[str, Any] = json.loads((folder / ".slipwise" / "session.json").read_text())["findings"]
    minor = list(said.get("explain", {}).get("minor", []))
    path = folder / "model.toml"
    model = sw.load_model(path, trust=True) if path.is_file() else None
    uses = [] if model is None else [use.effect for use in model.uses if not use.effect.base]
    added = ["unknown" if effect.name not in sw.effects.catalogue() else effect.name for effect in uses]
    # a fault of samples that was named is mended before any fit: no model holds it
    matters, named = set(added) - set(minor), set(said.get("explain", {}).get("effects", []))
    right = matters <= set(missing) <= set(added) | named and model is not None
    return Followed(folder.name, missing, added, minor, model is not None, right, clicks, worst, seconds)


def main(arguments: list[str] | None = None) -> int:
    """Read the command line, follow the page on every campaign, and print the rate."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench", type=Path, help="folder with campaigns and truth/, of make_bench.py")
    parser.add_argument("--out", type=Path, default=Path("out/workbench.json"), help="takes what was found")
    parser.add_argument("--only", nargs="*", default=None, help="names of campaigns; all that hide something otherwise")
    chosen = parser.parse_args(arguments)
    told = {path.stem: json.loads(path.read_text())["missing"] for path in sorted(chosen.bench.glob("truth/*.json"))}
    names = [name for name in told if (name in chosen.only if chosen.only else told[name])]
    found: list[Followed] = []
    with sync_playwright() as running:
        executable = os.environ.get("CHROMIUM") or shutil.which("chromium")
        browser = running.chromium.launch(executable_path=executable, args=["--no-sandbox"])
        for name in names:
            found.append(follow(browser, chosen.bench / name, told[name]))
            print(json.dumps(asdict(found[-1])), flush=True)
    chosen.out.parent.mkdir(parents=True, exist_ok=True)
    chosen.out.write_text(json.dumps([asdict(one) for one in found], indent=1))
    right = sum(one.right for one in found)
    most = max((len(one.clicks) for one in found), default=0)
    print(f"{right} of {len(found)} right, at most {most} clicks")
    return 0


if __name__ == "__main__":
    sys.exit(main())
