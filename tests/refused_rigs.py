"""Changed rigs with parts or attributes that a replay would leave out: what is changed, and words of the answer."""

from changed_rigs import GIRDER_X, INERTIA, Cases

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
BALLAST = '<inertial pos="0 0 0" mass="5000" diaginertia="9 9 9"/>'

#: What is changed -> the changes, and words of the answer; the element is among them.
LEFT_OUT: Cases = {
    # parts that are not simulated
    "a fifth pad without its arms": (
        A_PAD,
        ("line 90", "'pad_E_x' has the coefficient 0 of the joint girder_pitch", "it is -0.366"),
    ),
    "a third buffer without its arms": (
        A_BUFFER,
        ("'buffer_3_y' has the coefficient 0 of the joint girder_yaw", "it is 1"),
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
    "a buffer's damping": (
        ((BUFFER_1_Y, BUFFER_1_Y.replace(" stiff", ' damping="2e4" stiff')),),
        ("line 85", "'buffer_1_y' has damping = 20000", "buffer_damping"),
    ),
    "a buffer's play along y alone": (
        ((BUFFER_1_Y, BUFFER_1_Y.replace(" stiff", ' springlength="-0.01 0.01" stiff')),),
        ("line 85", "buffer 1 has a play of 0.01 m along y, 0 m along x"),
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
    "an actuator with feedback": (
        (('biasprm="98076.3 0 0"', 'biasprm="98076.3 -5 0"'),),
        ("line 94", "'table_az' has biasprm = 98076.3 -5", "no gain on position"),
    ),
    "a plate beside its pad": (
        (('conaffinity="2" pos="-1.5', 'conaffinity="2" pos="11'),),
        ("line 58", "plate_B lies 12.5, 0 m off pad_B"),
    ),
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
}
