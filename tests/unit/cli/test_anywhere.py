"""Commands work for a user without a home, a name or a folder to write to, whatever the shell's settings."""

import os
import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest

#: Commands that compile, draw, start processes and read a campaign.
COMMANDS = (
    "channels",
    "effects heating --picture {out}/a.png",
    "audit {campaign}",
    "replay sine:2Hz,0.3g,cycles=9 --no-recording --out {out}/replay",
    "ensemble sine:2Hz,0.3g,cycles=9 --vary rig.mass=9..11t --members 2 --workers 2 --out {out}/ensemble",
)
#: A home that is not there, one that cannot be written to, none at all.
HOMES = ({"HOME": "/nonexistent"}, {"HOME": "/proc"}, {"HOME": ""}, {})
#: Where what was compiled is kept, for tests of something else.
COMPILED = {name: value for name, value in os.environ.items() if name == "SLIPWISE_CACHE"}


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Lend a campaign that cannot be written to."""
    folder = tmp_path_factory.mktemp("share") / "campaign"
    with resources.as_file(resources.files("slipwise") / "demo_data") as data:
        shutil.copytree(data, folder)
    for path in (*folder.iterdir(), folder):
        path.chmod(0o555 if path.is_dir() else 0o444)
    return folder


def run(words: str, campaign: Path, out: Path, home: dict[str, str]) -> subprocess.CompletedProcess[str]:
    """Run a command with hardly any surroundings; temporary files are in a folder of the test."""
    (out / "temporary").mkdir(exist_ok=True)
    kept = {name: value for name, value in os.environ.items() if name in ("PATH", "PYTHONPATH")}
    surroundings = {**kept, "LANG": "C", "TMPDIR": str(out / "temporary"), **home}
    command = [sys.executable, "-m", "slipwise", *words.format(campaign=campaign, out=out).split()]
    return subprocess.run(command, env=surroundings, cwd=out, capture_output=True, text=True, umask=0o077)


@pytest.mark.parametrize(
    "home", [pytest.param(home, marks=[pytest.mark.long] * (home in HOMES[1:3]), id=str(home)) for home in HOMES]
)
def test_a_command_without_a_home_works_and_writes_nothing_where_it_is_run(
    home: dict[str, str], campaign: Path, tmp_path: Path
) -> None:
    done = run("effects heating --picture {out}/a.png", campaign, tmp_path, home)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("\n") <= 1 and "Traceback" not in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "temporary"}


@pytest.mark.long
def test_all_that_compiles_works_without_a_home_and_says_at_most_one_line_of_the_cache(
    campaign: Path, tmp_path: Path
) -> None:
    for words in COMMANDS:
        done = run(words, campaign, tmp_path, HOMES[0])
        assert done.returncode == 0, done.stderr
        assert done.stderr.count("compiled code") <= 1 and "Traceback" not in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "replay", "ensemble", "temporary"}


@pytest.fixture(scope="module")
def plain_picture(campaign: Path, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Lend the picture of an effect as it is where nothing lies in the current folder."""
    folder = tmp_path_factory.mktemp("plain")
    assert run("effects heating --picture {out}/a.png", campaign, folder, COMPILED).returncode == 0
    return (folder / "a.png").read_bytes()


@pytest.mark.parametrize("settings", [b"figure.dpi: 20\ntext.usetex: True\n", b"figure.dpi: 20 # \xe9\xff\n"])
def test_a_matplotlibrc_of_the_current_folder_is_not_read(
    settings: bytes, plain_picture: bytes, campaign: Path, tmp_path: Path
) -> None:
    (tmp_path / "matplotlibrc").write_bytes(settings)
    done = run("effects heating --picture {out}/a.png", campaign, tmp_path, COMPILED)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.png").read_bytes() == plain_picture and "matplotlibrc" not in done.stderr


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root mounts a disk of its own")
def test_a_picture_without_any_folder_for_temporary_files_is_refused_with_what_to_do(tmp_path: Path) -> None:
    if sys.executable.startswith(("/tmp/", "/var/tmp/", "/dev/shm/")):
        pytest.skip(f"{sys.executable} stands in a folder that this test hides")
    mounts = "for place in /tmp /var/tmp /dev/shm; do mount -t tmpfs -o ro tmpfs $place || exit 99; done; cd /proc; "
    program = f"{mounts} exec {sys.executable} -P -m slipwise effects heating --picture /proc/a.png"
    bare = {"PATH": os.environ["PATH"], "HOME": "/proc", "LANG": "C"}
    done = subprocess.run(["unshare", "-m", "sh", "-c", program], env=bare, capture_output=True, text=True)
    if done.returncode == 99 or "unshare" in done.stderr:
        pytest.skip(f"a namespace cannot be made here: {done.stderr.strip()[-200:]}")
    assert done.returncode == 2 and "TMPDIR=FOLDER names one" in done.stderr and "Traceback" not in done.stderr
