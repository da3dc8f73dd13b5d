"""Send damaged messages to a workbench: each is done, or refused in words; a traceback or a silence is a failure.

A campaign of the second simulator is written to a temporary folder and opened by `slipwise workbench`, a program of its
own. After every hundred messages it must still answer; at its end nothing but sentences may stand in its terminal.

python tests/fuzz_messages.py --count 20000 --seed 1
"""

import argparse
import logging
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from mutated_messages import Talker, mutated
from session_campaign import write_session_campaign
from workbench_server import Server

#: Messages between two questions that must be answered.
_BATCH = 100


def fuzz(server: Server, seed: int, count: int) -> tuple[int, int, list[str]]:
    """Send messages; gives how many were sent, how often the server hung up, and what failed."""
    rng = np.random.default_rng(seed)
    page = Talker(server.address)
    sent = 0
    failures: list[str] = []
    while sent < count and not failures:
        batch = [mutated(rng) for _ in range(min(_BATCH, count - sent))]
        for data, as_text in batch:
            page.say(data, as_text=as_text)
        page.say(b'{"do":"cancel"}')
        sent += len(batch)
        if not page.answered():
            failures.append(f"no answer after {sent} messages; the last: {[data[:80] for data, _ in batch]}")
        elif server.process.poll() is not None:
            failures.append(f"the server has ended with {server.process.returncode}")
        if sent % 2000 == 0:
            print(f"{sent} messages", flush=True)
    page.close()
    return sent, page.hung_up, failures


def main() -> int:
    """Send as many messages as are asked for; 1 if anything but a refusal in words was met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    logging.disable()  # the client's library complains of servers that hang up
    with tempfile.TemporaryDirectory() as name:
        folder, said = write_session_campaign(Path(name) / "march"), Path(name) / "terminal"
        began = time.perf_counter()
        with said.open("wb") as stream:
            server = Server.of(folder, stderr=stream)
            try:
                sent, hung_up, failures = fuzz(server, given.seed, given.count)
            finally:
                server.end()
        words = said.read_text(encoding="utf-8", errors="replace")
        if "Traceback" in words:
            failures.append(words[-4000:])
        if server.process.returncode not in (0, -15, 143):
            failures.append(f"it ended with {server.process.returncode}: {words[-400:]}")
    print(f"{sent} damaged messages, hung up {hung_up} times, {time.perf_counter() - began:.0f} s")
    for failure in failures:
        print(f"FAILED {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
