"""MJCF files of rigs, made by changing a shipped one: each change is a text and what stands in its place."""

import shutil
from pathlib import Path

from slipwise.rig import RIGS
from slipwise.rig.files import find_rig

#: Stands for the end of a part of the file: what is added goes before it.
END = {
    "girder": '        <site name="girder_centre"',
    "table": '      <body name="girder"',
    "world": "  </worldbody>",
    "tendon": "  </tendon>",
    "actuator": "  </actuator>",
    "custom": "  </custom>",
    "file": "</mujoco>",
}
#: What is changed -> the changes, and words of the answer.
Cases = dict[str, tuple[tuple[tuple[str, str], ...], tuple[str, ...]]]
GIRDER_X = '<joint name="girder_x" type="slide" axis="1 0 0"'
INERTIA = '<inertial pos="0 0 0" mass="10000" diaginertia="21041.6667 7708.3333 28333.3333"/>'


def changed(folder: Path, *changes: tuple[str, str], rig: str = "bridge1", included: bool = False) -> Path:
    """Write a shipped rig with changes into a folder and give the path of its file.

    Args:
        folder: where to write.
        changes: text and what takes its place wherever it stands; a key of `END` adds before the end of that part.
        rig: what to change.
        included: change common.xml instead.
    """
    for name in (*RIGS, "common"):
        shutil.copy(find_rig("bridge1").with_name(f"{name}.xml"), folder / f"{name}.xml")
    path = folder / ("common.xml" if included else f"{rig}.xml")
    text = path.read_text()
    for old, new in changes:
        at = END.get(old, old)
        assert at in text, f"{at!r} is not in {path.name}"
        text = text.replace(at, f"{new}\n{at}" if old in END else new)
    (folder / "mine.xml").write_text((folder / f"{rig}.xml").read_text() if included else text)
    if included:
        path.write_text(text)
    return folder / "mine.xml"
