"""specimen.npz: what one campaign says of its specimen, in a file, so that campaigns of other days can be joined."""

from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile

import msgspec
import numpy as np

from slipwise.errors import InputError
from slipwise.jobs.atomic_write import atomic
from slipwise.specimens.specimen import SpecimenColumn, SpecimenNumber, SpecimenStatistics

#: Number of the format.
SCHEMA = 1
_ARRAYS = ("whole", "ridge", "pull", "trifle")


@dataclass(frozen=True)
class _About:
    """All but the arrays."""

    schema: int
    name: str
    rig: str
    columns: tuple[SpecimenColumn, ...]
    numbers: tuple[SpecimenNumber, ...]
    chance: dict[str, float]
    named: tuple[str, ...]
    apart: tuple[tuple[str, str], ...]


def write_specimen(of: SpecimenStatistics, path: Path) -> Path:
    """Write a specimen.

    Args:
        of: the specimen.
        path: of the file; its folder is made.

    Raises:
        OutputError: the disk or its owner does not allow it.
    """
    about = _About(SCHEMA, of.name, of.rig, of.columns, of.numbers, dict(of.chance), of.named, of.apart)
    text = np.frombuffer(msgspec.json.encode(about), np.uint8)
    with atomic(path) as stream:
        np.savez_compressed(stream, about=text, **{name: getattr(of, name) for name in _ARRAYS})
    return path


def read_specimen(path: Path) -> SpecimenStatistics:
    """Read a specimen.

    Raises:
        InputError: there is none, or it is of another version.
    """
    try:
        with np.load(path, allow_pickle=False) as content:
            arrays = [np.asarray(content[name], float) for name in _ARRAYS]
            about = msgspec.json.decode(content["about"].tobytes(), type=_About)
    except (OSError, ValueError, KeyError, BadZipFile, msgspec.MsgspecError) as error:
        raise InputError(
            f"{path} does not hold what a law over several specimens needs ({error}); diagnose its campaign again"
        ) from None
    if about.schema != SCHEMA:
        raise InputError(f"{path} is of another version of slipwise; diagnose its campaign again")
    whole, ridge, pull, trifle = arrays
    return SpecimenStatistics(
        about.name, about.rig, about.columns, about.numbers, whole, ridge, pull, trifle, about.chance, about.named,
        about.apart,
    )  # fmt: skip
