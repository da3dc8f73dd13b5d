"""A hash of everything that decides what is said of a campaign: its files, the model to start from, and the code."""

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from importlib.metadata import version
from pathlib import Path

from slipwise.campaign.settings import read_settings
from slipwise.errors import SlipwiseError
from slipwise.jobs.code_hash import hash_of_files
from slipwise.rig.files import find_rig

#: The page is made by the code too, and probabilities come from a table.
_DECIDING = ("**/*.py", "**/*.json")


def campaign_key(folder: Path, model: Path | None, effects: Iterable[Path], settings: Sequence[object]) -> str:
    """Return the hash.

    Args:
        folder: with campaign.toml; notes and answers that lie beside the data decide nothing.
        model: the model.toml to start from; the one beside campaign.toml if there is one when not given.
        effects: a user's own effect files.
        settings: what else decides the results, as JSON can hold it.
    """
    model = model or folder / "model.toml"
    code = (version("slipwise"), version("mujoco"), hash_of_files(*_DECIDING))
    beside = sorted(model.parent.glob("*.py")) if model.is_file() else []
    contents = [_digest(path) for path in (*_files(folder), model, *beside, *effects)]
    text = json.dumps([str(folder.resolve()), contents, code, list(settings)])
    return hashlib.sha256(text.encode()).hexdigest()[:20]


def _files(folder: Path) -> Iterator[Path]:
    """Yield campaign.toml and the files that it names; alone where it cannot be read."""
    yield folder / "campaign.toml"
    try:
        stated = read_settings(folder / "campaign.toml")
        rig = find_rig(stated.rig, folder)
    except SlipwiseError:
        return
    yield rig
    for run in stated.runs:
        whole, part = folder / run.file, folder / run.file.rpartition("#")[0]
        yield part if "#" in run.file and not whole.is_file() else whole


def _digest(path: Path) -> str:
    if not path.is_file():
        return ""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
