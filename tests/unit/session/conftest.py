"""One campaign for all tests of sessions, and a session of it in which the base model was fitted."""

import shutil

import pytest

from session_campaign import write_session_campaign
from slipwise.session.session import Session


@pytest.fixture(scope="session")
def written(tmp_path_factory):
    return write_session_campaign(tmp_path_factory.mktemp("sessions") / "march")


@pytest.fixture(scope="session")
def fitted(written):
    """The base model, fitted; leaves nothing on disk, and tests leave it as it was."""
    session = Session(written, keep=False)
    session.fit()
    return session


@pytest.fixture
def folder(written, tmp_path):
    """A copy that a test may change."""
    return shutil.copytree(written, tmp_path / "march", ignore=shutil.ignore_patterns(".slipwise"))
