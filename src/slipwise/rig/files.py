"""Where the files of rigs lie: those that ship with the package, and a user's own."""

from importlib.resources import files
from pathlib import Path

from slipwise.errors import unknown_name

#: Specimens that ship with the package.
RIGS: tuple[str, ...] = ("bridge1", "bridge2", "block", "pad", "three_pads", "six_pads", "pendulum", "building")
#: What a file of a rig may end in.
SUFFIXES: tuple[str, ...] = (".xml", ".toml")
#: What is looked for in a folder that is given as a rig.
SPECIMEN_FILE = "specimen.toml"


def models_folder() -> Path:
    """Return the folder of the MJCF files: inside the installed package, or beside `src` in a checkout."""
    packed = Path(str(files("slipwise"))) / "models"
    return packed if packed.is_dir() else Path(__file__).parents[3] / "models"


def find_rig(rig: str | Path, beside: Path | None = None) -> Path:
    """Find the file of a rig given by name or by path.

    Args:
        rig: one of `RIGS`, or the path of an MJCF file or of a specimen.toml.
        beside: folder from which a relative path is meant.

    Raises:
        UnknownNameError: neither a name nor a file.
    """
    if str(rig) in RIGS:
        return next(found for suffix in SUFFIXES if (found := models_folder() / f"{rig}{suffix}").is_file())
    path = (beside / str(rig)) if beside is not None else Path(rig)
    if path.is_dir() and (path / SPECIMEN_FILE).is_file():
        return path / SPECIMEN_FILE
    if path.suffix in SUFFIXES and path.is_file():
        return path
    where = "`slipwise rigs` lists them; the path of an MJCF file or of a specimen.toml works too."
    raise unknown_name("rig", str(rig), RIGS, where)
