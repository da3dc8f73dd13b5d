"""The command line, run inside the test."""

import sys

import pytest

from slipwise.cli import main


@pytest.fixture
def slipwise(monkeypatch, capsys):
    """Run the command line; gives exit code, output and errors."""

    def run(*words):
        monkeypatch.setattr(sys, "argv", ["slipwise", *map(str, words)])
        with pytest.raises(SystemExit) as ended:
            main()
        caught = capsys.readouterr()
        return ended.value.code, caught.out, caught.err

    return run
