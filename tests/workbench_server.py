"""A workbench that runs as a program of its own."""

import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO

COMMAND = [sys.executable, "-c", "from slipwise.cli import main; main()", "workbench"]


@dataclass
class Server:
    """A workbench that runs; `address` has its token."""

    folder: Path
    process: subprocess.Popen
    address: str

    @classmethod
    def of(cls, folder: Path, stderr: IO | None = None) -> "Server":
        command = [*COMMAND, str(folder), "--no-show"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=stderr, text=True)
        found = re.search(r"http\S+", process.stdout.readline())
        assert found, "the workbench said no address"
        return cls(folder, process, found[0])

    @classmethod
    def early(cls, folder: Path, own: Path) -> "Server":
        """One whose page may be opened before its session stands, as the user's browser opens it.

        Args:
            folder: of the campaign.
            own: a folder for the browser that takes the address down.
        """
        taken, browser = own / "address", own / "browser.sh"
        browser.write_text(f'#!/bin/sh\necho "$1" > {taken}.part && mv {taken}.part {taken}\n')
        browser.chmod(0o755)
        process = subprocess.Popen([*COMMAND, str(folder)], env={**os.environ, "BROWSER": f"{browser} %s"})
        while not taken.is_file():
            assert process.poll() is None, "the workbench has ended"
            time.sleep(0.01)
        return cls(folder, process, taken.read_text().strip())

    def kill(self) -> None:
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def end(self) -> None:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(20)
