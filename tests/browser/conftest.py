"""The workbench as its user meets it: the command, its server, a real browser."""

import os
import shutil

import pytest

from session_campaign import write_session_campaign
from workbench_server import Server

pytest.importorskip("starlette")
fcntl = pytest.importorskip("fcntl")


@pytest.fixture(scope="session")
def written(tmp_path_factory):
    """A campaign that nobody has opened before."""
    return write_session_campaign(tmp_path_factory.mktemp("browser") / "march")


@pytest.fixture(scope="session")
def settled(browser, tmp_path_factory):
    """A campaign whose workbench has done all that it does by itself: made once, and every worker takes the same."""
    from browser_story import fitted, opened, rested  # which skips where there is no browser

    root = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        root = root.parent
    folder = root / "settled" / "march"
    with (root / "settled.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.is_dir():
            running = Server.of(write_session_campaign(root / "settling" / "march"))
            page = opened(browser, running)
            fitted(page)
            rested(page)
            page.context.close()
            running.end()
            (root / "settling").rename(root / "settled")
    return folder


@pytest.fixture
def folder(settled, tmp_path):
    """A campaign that a workbench has had open, with the session that it has left."""
    return shutil.copytree(settled, tmp_path / "march")


@pytest.fixture
def new_folder(written, tmp_path):
    """A campaign that nobody has opened before."""
    return shutil.copytree(written, tmp_path / "march")


@pytest.fixture
def server(folder):
    running = Server.of(folder)
    yield running
    running.end()


@pytest.fixture(scope="module")
def looked_at(written):
    """The campaign of `shared`."""
    return written


@pytest.fixture(scope="module")
def shared(looked_at, tmp_path_factory):
    """A workbench for tests that look only."""
    running = Server.of(shutil.copytree(looked_at, tmp_path_factory.mktemp("shared") / "march"))
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
