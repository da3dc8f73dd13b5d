"""What the workbench says where it cannot be opened."""

import socket
import subprocess
import sys

import pytest

from session_campaign import write_session_campaign

COMMAND = "import sys; from slipwise.cli import main; sys.argv = ['slipwise', 'workbench', '{}']; main()"


def run(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)


def test_without_its_extra_it_says_how_to_install_it():
    ended = run(f"import sys; sys.modules['uvicorn'] = None; {COMMAND.format('.')}")
    assert ended.returncode == 2
    assert 'uvicorn is not installed; it comes with `pip install "slipwise[workbench]"`' in ended.stderr


def test_a_folder_without_a_campaign_and_a_port_that_is_taken_are_told_in_one_line(tmp_path):
    pytest.importorskip("starlette")
    ended = run(COMMAND.format(tmp_path))
    assert ended.returncode == 2 and "campaign.toml" in ended.stderr and "Traceback" not in ended.stderr
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        ended = run(f"from slipwise.workbench.server import _listen; _listen({port})")
    assert f"port {port} is taken" in ended.stderr


def test_a_disk_that_is_full_at_the_start_is_told_with_the_path(tmp_path):
    pytest.importorskip("starlette")
    folder = write_session_campaign(tmp_path / "march")
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))"
    ended = run(f"{limit}; {COMMAND.format(folder)[:-8]}; sys.argv += ['--no-show']; main()")
    assert ended.returncode == 2 and "Traceback" not in ended.stderr
    assert f"error: cannot write {folder}/.slipwise/lock: file too large; free some space there" in ended.stderr


def test_the_door_opens_without_the_extra_being_loaded():
    ended = run("import sys, slipwise as sw; sw.workbench.serve; print('starlette' in sys.modules)")
    assert ended.stdout.strip() == "False"
