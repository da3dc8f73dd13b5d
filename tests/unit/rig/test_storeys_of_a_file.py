"""Storeys in an MJCF file: read as they are, or refused with the element named."""

import re
from pathlib import Path

import pytest

from slipwise.errors import InputError
from slipwise.rig import load_specimen
from slipwise.rig.files import models_folder

BUILDING = (models_folder() / "building.xml").read_text(encoding="utf-8")


def changed(tmp_path: Path, old: str, new: str) -> Path:
    text = re.sub(old, new, BUILDING, count=1)
    assert text != BUILDING
    path = tmp_path / "mine.xml"
    path.write_text(text)
    return path


def test_values_of_a_storey_are_read(tmp_path: Path) -> None:
    path = changed(tmp_path, 'storey_2_x" type="slide" axis="1 0 0" stiffness="[^"]*" damping="[^"]*"',
                   'storey_2_x" type="slide" axis="1 0 0" stiffness="3e6" damping="500"')  # fmt: skip
    storeys = load_specimen(path).storeys
    assert storeys[1].stiffness_x == 3e6 and storeys[1].damping_x == 500.0
    assert storeys[1].z == pytest.approx(2.7) and storeys[0] == load_specimen("building").storeys[0]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('<joint name="storey_1_x"', '<joint name="storey_1_x" frictionloss="5"', "storey_1_x.*frictionloss"),
        ('storey_1_x" type="slide" axis="1 0 0"', 'storey_1_x" type="slide" axis="0 0 1"', "slide along x and y"),
        ('<joint name="storey_2_y"', '<joint name="storey_2_y" springref="0.1"', "storey_2_y.*springref"),
        ('<body name="storey_1" pos="0 0', '<body name="storey_1" pos="0.2 0', "beside the girder's centre"),
        ('<body name="storey_2"', '<body name="storey_3"', "numbered from 1"),
        ('<body name="storey_2"', '<body name="attic"', "the body 'attic' has a mass of 3000 kg"),
        ('(name="storey_1" pos="0 0 1.2">.*?diaginertia=")[^"]*"', r'\1 900 900 900"', "inertia of 900 kg m"),
        ('<joint name="storey_1_y"[^>]*>', "", "a storey has storey_1_x and storey_1_y"),
    ],
)  # fmt: skip
def test_what_would_not_be_simulated_is_refused_with_the_element(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    old = f"(?s){old}" if ".*?" in old else old
    with pytest.raises(InputError, match=f"(?s)mine.xml.*{words}"):
        load_specimen(changed(tmp_path, old, new))
