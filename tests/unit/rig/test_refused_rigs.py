"""What a rig's file holds and a replay would leave out is refused: element, file and what is possible are named."""

import re

import mujoco
import pytest

from changed_rigs import changed
from impossible_rigs import IMPOSSIBLE
from refused_rigs import LEFT_OUT
from slipwise.errors import InputError
from slipwise.rig import load_specimen
from slipwise.rig.files import find_rig
from slipwise.rig.mjcf.comparison import NOT_FELT, fields_of

CASES = LEFT_OUT | IMPOSSIBLE


@pytest.mark.parametrize("case", CASES)
def test_a_changed_rig_is_refused_in_a_sentence_that_names_the_element_and_the_file(case, tmp_path):
    changes, words = CASES[case]
    with pytest.raises(InputError) as told:
        load_specimen(changed(tmp_path, *changes))
    said = str(told.value)
    assert said.startswith("mine.xml") and "\n" not in said
    assert [word for word in words if word not in said] == [], said


@pytest.mark.parametrize(
    ("before", "added", "words"),
    [
        ('<default class="driven">', '<joint damping="9"/>', "mine.xml, line 27: the joint 'table_x' has damping = 9"),
        ('condim="1" contype="1"', 'friction="0.2" ', "mine.xml, line 32: the geom 'pad_A' has friction = 0.2"),
        ('gravity="0 0', 'wind="9 0 0" ', "common.xml, line 9: the option wind = 9 0 0"),
    ],
    ids=["of all joints", "of all pads", "an option"],
)
def test_defaults_and_options_of_an_included_file_count_as_if_they_were_written_there(before, added, words, tmp_path):
    with pytest.raises(InputError) as told:
        load_specimen(changed(tmp_path, (before, added + before), included=True))
    assert words in str(told.value)


#: Kinds of fields of a compiled model: compared field by field; parts that are read or counted; what only shows or
#: measures; and what MuJoCo computes from the others.
COMPARED = "jnt dof body geom tendon actuator qpos qpos0 opt"
COUNTED = "site wrap text tuple eq pair exclude plugin flex flexedge"
SHOWN = "cam light mat mesh tex hfield skin sensor key vis stat oct bvh paths"
COMPUTED = "B D M efm0 efmC flg mapD2M mapM2D mapM2M nefm0L nefm0dof signature ten tree"
VIEWS = "bind camera equality from joint keyframe material texture"


def test_every_kind_of_field_of_a_compiled_model_has_its_place():
    """A MuJoCo with a new kind of element fails here, before a rig can hold one that nobody looks at."""
    model = mujoco.MjModel.from_xml_path(str(find_rig("bridge1")))
    fields = {name for name in dir(model) if not re.match(r"_|n[A-Za-z]+(_|$)", name)}
    kinds = {re.split("[_]", name)[0] for name in fields}
    assert kinds - set(" ".join((COMPARED, COUNTED, SHOWN, COMPUTED, VIEWS)).split()) == set()


@pytest.mark.parametrize("prefix", NOT_FELT)
def test_what_is_not_compared_is_a_field_that_there_is(prefix):
    model = mujoco.MjModel.from_xml_path(str(find_rig("bridge1")))
    assert NOT_FELT[prefix] <= set(fields_of(model, prefix))
