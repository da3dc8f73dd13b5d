"""What a rig's file holds and a replay would leave out is refused: element, file and what is possible are named."""

import pytest

from changed_rigs import END, INERTIA, changed
from slipwise.errors import InputError
from slipwise.rig import load_specimen

A_PAD = (
    ("table", '<geom name="pad_E" class="pad" contype="16" pos="0 2.5 -0.0215"/>'),
    ("girder", '<geom name="plate_E" class="plate" conaffinity="16" pos="0 2.5 -0.356"/>'),
    ("tendon", '<fixed name="pad_E_x" class="friction"><joint joint="girder_x" coef="1"/></fixed>'),
    ("tendon", '<fixed name="pad_E_y" class="friction"><joint joint="girder_y" coef="1"/></fixed>'),
)
A_BUFFER = (
    ("table", '<geom name="buffer_3" type="cylinder" size="0.12 0.06" pos="1 0 -0.095" class="visual"/>'),
    ("tendon", '<fixed name="buffer_3_x" stiffness="2e6"><joint joint="girder_x" coef="1"/></fixed>'),
    ("tendon", '<fixed name="buffer_3_y" stiffness="2e6"><joint joint="girder_y" coef="1"/></fixed>'),
)
BUFFER_1_Y = '<fixed name="buffer_1_y" stiffness="1730589.336">'
PAD_B = '<geom name="pad_B" class="pad" contype="2" pos="-1.5 2.5 -0.0215"'
TABLE_AX = '<general name="table_ax" joint="table_x" gainprm="1e10"'
GIRDER_X = '<joint name="girder_x" type="slide" axis="1 0 0"'
BALLAST = '<inertial pos="0 0 0" mass="5000" diaginertia="9 9 9"/>'

#: What is changed -> the changes, and words of the answer; the element is among them.
CASES: dict[str, tuple[tuple[tuple[str, str], ...], tuple[str, ...]]] = {
    # parts that are not simulated
    "a fifth pad": (A_PAD, ("line 46", "pads E, which would not be simulated")),
    "a third buffer": (A_BUFFER, ("line 46", "buffers 3, which would not be simulated")),
    "a child body": (
        (("girder", f'<body name="ballast">{BALLAST}</body>'),),
        ("line 66", "the body 'ballast' has a mass of 5000 kg, which would not be counted"),
    ),
    "a swinging child body": (
        (("girder", f'<body name="crane"><joint name="swing"/>{BALLAST}</body>'),),
        ("the body 'crane' has a mass of 5000 kg",),
    ),
    "a body beside the table": (
        (("world", f'<body name="tower"><freejoint name="loose"/>{BALLAST}</body>'),),
        ("the body 'tower' has a mass of 5000 kg",),
    ),
    "a geom with mass": (
        (("girder", '<geom name="parapet" type="box" size="1 0.1 0.5" class="visual" mass="800"/>'),),
        ("line 66", "the geom 'parapet'", "mass of 800 kg, which would not be counted"),
    ),
    "a geom with density": (
        (("girder", '<geom type="box" size="1 1 1" contype="0" conaffinity="0" density="7850"/>'),),
        ("line 66", "density of 7850 kg/m^3, which would not be counted"),
    ),
    "a stopper": (
        (("table", '<geom name="stopper" type="box" size="0.1 0.1 0.1" pos="2 0 0.3"/>'),),
        ("line 46", "the geom 'stopper' would touch others"),
    ),
    "a floor": (
        (("world", '<geom name="floor" type="plane" size="9 9 1"/>'),),
        ("the geom 'floor' would touch others",),
    ),
    "a second hinge": (
        ((f"{GIRDER_X}/>", f'{GIRDER_X}/><joint name="warp" axis="1 0 0"/>'),),
        ("more than 6 dofs in body 'girder'", "line 46"),
    ),
    "a table that rolls": (
        (('<joint name="table_pitch"', '<joint name="table_roll" axis="1 0 0"/><joint name="table_pitch"'),),
        ("line 30", "the joint 'table_roll' of the table would not be simulated"),
    ),
    "a weld": (
        (("file", '<equality><weld name="glue" body1="table" body2="girder"/></equality>'),),
        (
            "line 97",
            "the equality constraint 'glue' would not be simulated",
        ),
    ),
    "an excluded contact": (
        (("file", '<contact><exclude name="no" body1="table" body2="girder"/></contact>'),),
        (
            "line 97",
            "the contact exclusion 'no'",
        ),
    ),
    "a contact pair": (
        (("file", '<contact><pair name="both" geom1="deck" geom2="table"/></contact>'),),
        (
            "line 97",
            "the contact pair 'both'",
        ),
    ),
    "an actuator on the girder": (
        (("actuator", '<motor name="damper" joint="girder_x" gear="5"/>'),),
        ("line 96", "the actuator 'damper' would not be simulated"),
    ),
    "another tendon": (
        (("tendon", '<fixed name="brace" stiffness="1e6"><joint joint="girder_x" coef="1"/></fixed>'),),
        ("line 88", "the tendon 'brace' would not be simulated"),
    ),
    "a number that nobody reads": (
        (("custom", '<numeric name="friction" data="0.1"/>'),),
        ("line 23", "the numeric 'friction' is not understood"),
    ),
    "two numbers for one": (
        (('name="pad_stiffness" data="200e6"', 'name="pad_stiffness" data="200e6 100e6"'),),
        ("line 19", "the numeric 'pad_stiffness' is not understood", "one number each"),
    ),
    "a text that nobody reads": (
        (("custom", '<text name="pads_at" data="girder"/>'),),
        ("line 23", "the text 'pads_at' is not understood", "pads_on"),
    ),
    "copies made by a macro": (
        (("girder", '<replicate count="1000000000"><geom size="1" class="visual"/></replicate>'),),
        ("line 66", "<replicate> is not read"),
    ),
    # attributes that are not simulated
    "one pad's radius": (((PAD_B, f'{PAD_B} size="0.03"'),), ("line 35", "pad_B has a radius of 0.03 m")),
    "one pad's friction": (
        ((PAD_B, f'{PAD_B} friction="0.2 0.005 0.0001"'),),
        ("line 35", "'pad_B' has friction = 0.2"),
    ),
    "one pad's solref": (((PAD_B, f'{PAD_B} solref="-9e4 -5e2"'),), ("line 35", "'pad_B' has solref", "pad_stiffness")),
    "one pad's margin": (((PAD_B, f'{PAD_B} margin="0.01"'),), ("line 35", "the geom 'pad_B' has margin = 0.01")),
    "one pad's neighbour": (
        ((PAD_B, PAD_B.replace('"2"', '"3"')),),
        (
            "line 35",
            "the geom 'pad_B' has contype = 3",
        ),
    ),
    "a short plate": (
        (('name="plate_C" class="plate"', 'name="plate_C" class="plate" size="0.05 0.05 0.01"'),),
        ("line 60", "the geom 'plate_C' has size = 0.05 0.05 0.01"),
    ),
    "a buffer's y stiffness": (
        ((BUFFER_1_Y, BUFFER_1_Y.replace("1730589", "1000000")),),
        ("line 85", "buffer 1 has a stiffness of 1e+06 N/m along y"),
    ),
    "a buffer's damping": (
        ((BUFFER_1_Y, BUFFER_1_Y.replace(" stiff", ' damping="2e4" stiff')),),
        ("line 85", "'buffer_1_y' has damping = 20000", "buffer_damping"),
    ),
    "a buffer's play": (
        ((BUFFER_1_Y, BUFFER_1_Y.replace(" stiff", ' springlength="-0.01 0.01" stiff')),),
        ("line 85", "'buffer_1_y' has springlength = -0.01 0.01"),
    ),
    "a friction in the tendon": (
        (('name="pad_C_x" class="friction"', 'name="pad_C_x" class="friction" frictionloss="2000"'),),
        ("the tendon 'pad_C_x' has frictionloss = 2000", "shear_strength"),
    ),
    "another arm": (
        (
            (
                'coef="-0.366"/><joint joint="girder_yaw" coef="-1.5"',
                'coef="-0.366"/><joint joint="girder_yaw" coef="-1"',
            ),
        ),
        ("'buffer_1_x' has the coefficient -1 of the joint girder_yaw", "it is -1.5"),
    ),
    "a brake on the girder": (
        ((GIRDER_X, f'{GIRDER_X} damping="5e3"'),),
        ("line 47", "'girder_x' has damping = 5000", "guide_drag"),
    ),
    "a spring on the girder": (
        ((GIRDER_X, f'{GIRDER_X} stiffness="1e6"'),),
        ("line 47", "'girder_x' has stiffness = 1e+06"),
    ),
    "a friction of the guide": (
        ((GIRDER_X, f'{GIRDER_X} frictionloss="9"'),),
        ("'girder_x' has frictionloss = 9", "guide_drag"),
    ),
    "a stop of the girder": (((GIRDER_X, f'{GIRDER_X} range="-0.1 0.1"'),), ("line 47", "'girder_x' has limited = 1")),
    "a joint's start": (((GIRDER_X, f'{GIRDER_X} ref="0.1"'),), ("line 47", "'girder_x' has ref = 0.1")),
    "a joint's axis": (
        ((GIRDER_X, GIRDER_X.replace('"1 0 0"', '"1 1 0"')),),
        ("line 47", "'girder_x' has axis = 0.70"),
    ),
    "a turned girder": (
        (('<body name="girder" pos', '<body name="girder" euler="0 0 0.1" pos'),),
        ("line 46", "the body 'girder' has quat"),
    ),
    "a girder without weight": (
        (('<body name="girder" pos', '<body name="girder" gravcomp="1" pos'),),
        ("line 46", "the body 'girder' has gravcomp = 1"),
    ),
    "a raised table": (
        (('<body name="table">', '<body name="table" pos="0 0 1">'),),
        ("line 26", "'table' has pos = 0 0 1"),
    ),
    "products of inertia": (
        ((INERTIA, INERTIA.replace("diag", "full").replace('28333.3333"', '28333.3333 500 0 0"')),),
        ("line 53", "products of inertia 500, 0, 0 kg m^2"),
    ),
    "a weak actuator": (((TABLE_AX, TABLE_AX.replace("1e10", "1e9")),), ("line 92", "'table_ax' has gainprm = 1e+09")),
    "a limited actuator": (
        ((TABLE_AX, f'{TABLE_AX} ctrlrange="-1 1"'),),
        ("line 92", "'table_ax' has ctrllimited = 1"),
    ),
    "an actuator on another joint": (
        ((TABLE_AX, TABLE_AX.replace("table_x", "table_y")),),
        ("line 92", "table_ax must drive the joint table_x"),
    ),
    "a site off the centre": (
        (('name="girder_centre" pos="0 0 0"', 'name="girder_centre" pos="0 0 0.1"'),),
        ("line 66", "girder_centre stands off the centre of gravity by 0, 0, 0.1 m"),
    ),
    "gauges at one edge": (
        (('name="girder_edge_2" pos="-1.5', 'name="girder_edge_2" pos="1.2'),),
        ("line 67", "girder_edge_1 and _2 stand at 1.5, 0 and 1.2, 0 m"),
    ),
    # options
    "gravity aslant": (
        (("custom", '</custom><option gravity="1 0 -9.8"/><custom>'),),
        ("the option gravity = 1 0 -9.8",),
    ),
    "no gravity": ((("custom", '</custom><option gravity="0 0 0"/><custom>'),), ("the option gravity = 0 0 0",)),
    "wind": ((("custom", '</custom><option wind="9 0 0"/><custom>'),), ("the option wind = 9 0 0",)),
    "dense air": ((("custom", '</custom><option density="1.2"/><custom>'),), ("the option density = 1.2",)),
    "an integrator": (
        (("custom", '</custom><option integrator="RK4"/><custom>'),),
        ("the option integrator = RK4", "EULER"),
    ),
    "a time step": ((("custom", '</custom><option timestep="0.01"/><custom>'),), ("timestep = 0.01", "--step")),
    "no contacts": (
        (("custom", '</custom><option><flag contact="disable"/></option><custom>'),),
        ('the flag contact="disable"',),
    ),
    # pads that cannot carry
    "pads all on one side": (
        (('pos="-1.5 2.5 -0.0215"', 'pos="0.5 2.5 -0.0215"'), ('pos="-1.5 -2.5 -0.0215"', 'pos="0.5 -2.5 -0.0215"')),
        ("line 32", "the pads cannot carry: all stand on one side"),
    ),
    "a girder beyond its pads": (
        (('<body name="girder" pos="0 0', '<body name="girder" pos="0 3'),),
        ("the pads cannot carry: all stand on one side of the girder's centre of gravity (y = 3 m)",),
    ),
    "a pad out of line": (
        (('pos="-1.5 2.5 -0.0215"', 'pos="-1.2 2.5 -0.0215"'),),
        ("line 35", "pad_B stands at -1.2, 2.5 m", "corners of a rectangle"),
    ),
    "pads with each other's names": (
        (
            ('"pad_A" class', '"pad_X" class'),
            ('"pad_B" class', '"pad_A" class'),
            ('"pad_X" class', '"pad_B" class'),
            ('contype="1"', 'contype="16"'),
            ('contype="2"', 'contype="1"'),
            ('contype="16"', 'contype="2"'),
        ),
        ("pad_A stands at -1.5, 2.5 m",),
    ),
    "a girder inside its pads": (
        (('<body name="girder" pos="0 0 0.366"', '<body name="girder" pos="0 0 0.316"'),),
        ("the coefficient -0.366 of the joint girder_pitch", "it is -0.316"),
    ),
    "a girder whose plates are inside its pads": (
        (('2.5 -0.356"', '2.5 -0.406"'),),
        ("plate_A lies 50 mm inside the pads", "pos z = -0.356"),
    ),
    "pads inside the girder": ((("-0.0215", "-0.0115"),), ("line 32", "the girder begins inside its pads, by 10 mm")),
    "a pad far too high": (
        (('pos="-1.5 2.5 -0.0215"', 'pos="-1.5 2.5 -0.0015"'),),
        ("line 46", "the pads cannot carry the girder", "at least three pads"),
    ),
    "pads far too soft": ((('data="200e6"', 'data="200e3"'),), ("would sink 122.583 mm into its pads",)),
    # numbers that cannot be
    "zero mass": (
        (('mass="10000"', 'mass="0"'),),
        ("line 53", "mass = 0 kg cannot be; possible are 0.001 to 1e+08 kg"),
    ),
    "negative mass": (
        (('mass="10000"', 'mass="-1"'),),
        (
            "line 53",
            "mass = -1 kg cannot be",
        ),
    ),
    "infinite mass": ((('mass="10000"', 'mass="inf"'),), ("line 53", "mass='inf' of the inertial", "finite")),
    "no number as mass": ((('mass="10000"', 'mass="nan"'),), ("line 53", "mass='nan' of the inertial", "finite")),
    "a huge mass": ((('mass="10000"', 'mass="1e300"'),), ("line 53", "mass = 1e+300 kg cannot be")),
    "a mass in words": ((('mass="10000"', 'mass="10 t"'),), ("bad format in attribute 'mass'", "line 53")),
    "zero inertia": (
        ((INERTIA, INERTIA.replace("7708.3333", "0")),),
        (
            "line 53",
            "diaginertia",
        ),
    ),
    "an impossible inertia": (
        ((INERTIA, INERTIA.replace("7708.3333", "1")),),
        ("inertia must satisfy A + B >= C", "line 46"),
    ),
    "a negative stiffness": (
        (('stiffness="1730589.336"', 'stiffness="-2e6"'),),
        ("line 84", "buffer_stiffness = -2e+06 N/m cannot be; possible are 0 to"),
    ),
    "a negative pad stiffness": (
        (('data="200e6"', 'data="-200e6"'),),
        ("line 19", "pad_stiffness = -2e+08 N/m cannot be; possible are"),
    ),
    "no number as friction": (
        (('data="1.108676e6"', 'data="NaN"'),),
        ("line 22", "the numeric 'shear_strength'", "finite"),
    ),
    "a bending mass above the mass": (
        (("custom", '<numeric name="bending_mass" data="2e4"/>'),),
        ("bending_mass = 20000 kg must be below the mass",),
    ),
    "pads nowhere": ((("custom", '<text name="pads_on" data="moon"/>'),), ("line 23", "'moon'", "girder, table")),
    # what is missing or is no MJCF
    "no pad D": (
        ((('"pad_D" class'), '"mat_D" class'),),
        ("the pads A, B, C; a girder that is free has the pads A, B, C, D",),
    ),
    "no plate": ((('"plate_D"', '"slab_D"'),), ("it lacks the geom plate_D",)),
    "no names": ((('<body name="girder"', "<body"),), ("lacks the body girder",)),
    "no joint": (((f"{GIRDER_X}/>", ""),), ("joint",)),
    "no tendon": ((('"pad_B_y"', '"pad_b_y"'),), ("pads b, which would not be simulated",)),
    "no actuator": ((('name="table_ay"', 'name="shaker"'),), ("the actuator 'shaker'",)),
    "no number": ((('<numeric name="pad_damping" data="70710.7"/>', ""),), ("lacks the numbers pad_damping",)),
    "an unknown tag": ((("girder", "<girder/>"),), ("unrecognized element", "'girder', line 66")),
    "an unknown attribute": ((('mass="10000"', 'weight="10000"'),), ("unrecognized attribute: 'weight'", "line 53")),
    "a tag that is not closed": ((("</worldbody>", ""),), ("no XML", "mismatched tag: line 97")),
    "a missing include": ((('"common.xml"', '"nowhere.xml"'),), ("line 3: nowhere.xml cannot be read",)),
    "an include twice": ((('<include file="common.xml"/>', '<include file="common.xml"/>' * 2),), ("included twice",)),
    "another root": ((("<mujoco model", "<robot model"), ("</mujoco>", "</robot>")), ("line 1: this is a <robot>",)),
}


def test_the_cases_name_parts_of_the_file():
    assert set(END) >= {"girder", "table"} and len(CASES) >= 35


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
