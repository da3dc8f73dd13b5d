"""How long the workbench takes from a number that is dragged to the new curves, as the page's socket sees it.

    python scripts/time_workbench.py [--quick] [--out out/workbench] [CAMPAIGN]

The campaign is opened by `slipwise workbench`, a program of its own. A number of the rig and then one of an effect are
dragged, each step when the curves of the step before have come. Without a campaign one is made.
"""

import argparse
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from websockets.sync.client import ClientConnection, connect

from slipwise.record import write_json

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from session_campaign import write_session_campaign  # noqa: E402  # pyright: ignore[reportMissingImports]
from workbench_server import Server  # noqa: E402  # pyright: ignore[reportMissingImports]

#: Dragged numbers, the effect that is put in for them, and the ends between which they are dragged [SI].
DRAGGED = (("rig.mass", "", 9.9e3, 10.1e3), ("run_in.rise", "run_in", 0.0, 0.3))
#: So long nothing is said when nothing is at work, on a machine that is busy otherwise too [s].
QUIET = 8.0


def head_of(told: str | bytes) -> dict[str, Any]:
    """Return what a message is: all of a text, the head of a frame."""
    if isinstance(told, str):
        return json.loads(told)
    size = int.from_bytes(told[:4], "little")
    return json.loads(told[4 : 4 + size])


def wait_for(page: ClientConnection, kind: str, answers: int | None = None) -> dict[str, Any]:
    """Read until a message of this kind comes, or what answers a question; one that refuses something ends the run."""
    while True:
        head = head_of(page.recv(timeout=120))
        if head["kind"] == "problem":
            raise SystemExit(head["words"])
        if head["kind"] == kind and answers in (None, head.get("answers")):
            return head


def wait_until_quiet(page: ClientConnection) -> None:
    """Read until nothing comes any more: fits and what is done aside are over."""
    try:
        while True:
            page.recv(timeout=QUIET)
    except TimeoutError:
        return


def drag(page: ClientConnection, key: str, values: np.ndarray) -> list[float]:
    """Drag a number over values; returns the seconds of each step [s]."""
    out = []
    for number, value in enumerate(values, 1):
        began = time.perf_counter()
        page.send(json.dumps({"do": "drag", "key": key, "value": float(value), "n": number}))
        wait_for(page, "curves", number)
        out.append(time.perf_counter() - began)
    page.send('{"do":"settle"}')
    return out


def main() -> None:
    """Open, drag, print, keep."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaign", type=Path, nargs="?", help="folder; its model.toml and session are used")
    parser.add_argument("--out", type=Path, default=Path("out/workbench"))
    parser.add_argument("--quick", action="store_true", help="ten steps")
    chosen = parser.parse_args()
    chosen.out.mkdir(parents=True, exist_ok=True)
    folder = chosen.campaign or write_session_campaign(chosen.out / "campaign")
    steps = 10 if chosen.quick else 60
    server = Server.of(folder)
    table = {}
    try:
        address = server.address.replace("http", "ws") + "socket"
        with connect(address, max_size=None, open_timeout=120) as page:
            run = wait_for(page, "campaign")["runs"][0]["name"]
            wait_until_quiet(page)
            page.send(json.dumps({"do": "look", "run": run, "relation": "pads", "beside": ""}))
            wait_for(page, "curves")
            for key, effect, low, high in DRAGGED:
                if effect:
                    page.send(json.dumps({"do": "toggle", "effect": effect, "target": ""}))
                    wait_until_quiet(page)
                drag(page, key, np.linspace(low, high, 3))  # the first one compiles
                seconds = drag(page, key, np.linspace(low, high, steps))
                half, most = np.quantile(seconds, (0.5, 0.95))
                table[key] = {"steps": steps, "half_within_s": half, "95_percent_within_s": most}
                print(f"{key:16s} {steps} steps: half within {half * 1e3:.0f} ms, 95 % within {most * 1e3:.0f} ms")
    finally:
        server.end()
    write_json(chosen.out / "workbench.json", table)
    print(f"wrote {chosen.out / 'workbench.json'}")


if __name__ == "__main__":
    main()
