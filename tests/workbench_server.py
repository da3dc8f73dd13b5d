"""A workbench that runs as a program of its own."""

import re
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

COMMAND = [sys.executable, "-c", "from slipwise.cli import main; main()", "workbench"]


@dataclass
class Server:
    """A workbench that runs; `address` has its token."""

    folder: Path
    process: subprocess.Popen
    address: str

    @classmethod
    def of(cls, folder: Path) -> "Server":
        process = subprocess.Popen([*COMMAND, str(folder), "--no-show"], stdout=subprocess.PIPE, text=True)
        found = re.search(r"http\S+", process.stdout.readline())
        assert found, "the workbench said no address"
        return cls(folder, process, found[0])

    def kill(self) -> None:
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def end(self) -> None:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(20)
