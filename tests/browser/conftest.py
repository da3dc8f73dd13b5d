"""The workbench as its user meets it: the command, its server, a real browser."""

import os
import shutil

import pytest

from session_campaign import write_session_campaign
from workbench_server import Server

pytest.importorskip("starlette")


@pytest.fixture(scope="session")
def written(tmp_path_factory):
    return write_session_campaign(tmp_path_factory.mktemp("browser") / "march")


@pytest.fixture
def folder(written, tmp_path):
    return shutil.copytree(written, tmp_path / "march", ignore=shutil.ignore_patterns(".slipwise", "model.toml"))


@pytest.fixture
def server(folder):
    """A workbench of a campaign that nobody has opened before."""
    running = Server.of(folder)
    yield running
    running.end()


@pytest.fixture(scope="module")
def shared(written, tmp_path_factory):
    """A workbench for tests that look only."""
    folder = shutil.copytree(written, tmp_path_factory.mktemp("shared") / "march")
    running = Server.of(folder)
    yield running
    running.end()


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium."""
    playwright = pytest.importorskip("playwright.sync_api")
    path = os.environ.get("CHROMIUM") or shutil.which("chromium")
    if path is None:
        pytest.skip("no chromium here")
    with playwright.sync_playwright() as running:
        chromium = running.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield chromium
        chromium.close()
