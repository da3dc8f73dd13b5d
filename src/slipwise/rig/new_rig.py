"""A rig of one's own: a specimen.toml to begin with, and the MJCF that is written from it."""

import re
from pathlib import Path

from slipwise.errors import InputError, SettingError
from slipwise.record import write_text
from slipwise.rig.files import SPECIMEN_FILE
from slipwise.rig.mjcf.writer import mjcf_text
from slipwise.rig.specimen import Specimen
from slipwise.rig.specimen_file import read_specimen

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
#: Ten lines that are a rig; what else may stand in the file is told in docs/specimens.md.
TEMPLATE = """\
mass = "12 t"
box = ["4 m", "3 m", "0.5 m"]   # the girder along x (shaking), y and z: its moments of inertia
centre_height = "0.4 m"         # of its centre of gravity above the sliding plane
pad = { radius = "25 mm", stiffness = "200 kN/mm" }   # of every pad
pads.A = { x = "1.8 m", y = "1.3 m" }
pads.B = { x = "-1.8 m", y = "1.3 m" }
pads.C = { x = "1.8 m", y = "-1.3 m" }
pads.D = { x = "-1.8 m", y = "-1.3 m" }
buffers.1 = { x = "0 m", y = "0 m", stiffness = "2.4 kN/mm" }
sources.mass = "weighed on ..."
"""


def new_rig(name: str, beside: Path) -> tuple[Path, Path]:
    """Write a folder with a specimen.toml to be edited, and its MJCF.

    Args:
        name: of the rig and of its folder.
        beside: folder in which it is made.

    Returns:
        specimen.toml and the MJCF file.

    Raises:
        SettingError: the name is no word.
        InputError: there is something of this name already.
    """
    if not _NAME.fullmatch(name):
        raise SettingError(f"{name!r} cannot name a rig; give a word of letters, digits, - and _, as my_rig")
    folder = beside / name
    if folder.exists():
        raise InputError(f"{folder} is there already; give another name, or edit {folder / SPECIMEN_FILE}")
    path = folder / SPECIMEN_FILE
    write_text(path, TEMPLATE)
    return path, write_mjcf(read_specimen(path))


def write_mjcf(specimen: Specimen) -> Path:
    """Write a specimen's MJCF beside its file, as NAME.xml; gives its path.

    Raises:
        InputError: the specimen was read from an MJCF already.
    """
    path = specimen.path.with_name(f"{specimen.name}.xml")
    if specimen.path.suffix == ".xml":
        raise InputError(f"{specimen.path.name} is an MJCF already; give a {SPECIMEN_FILE}")
    write_text(path, mjcf_text(specimen))
    return path
