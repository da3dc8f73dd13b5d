"""Changed rigs that cannot be, or are no rig at all: what is changed, and words of the answer."""

from changed_rigs import GIRDER_X, INERTIA, Cases

#: What is changed -> the changes, and words of the answer.
IMPOSSIBLE: Cases = {
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
    "a girder inside its pads": (
        (('<body name="girder" pos="0 0 0.366"', '<body name="girder" pos="0 0 0.316"'),),
        ("plate_A lies 50 mm inside the pads",),
    ),
    "a girder above its arms": (
        (('<body name="girder" pos="0 0 0.366"', '<body name="girder" pos="0 0 0.466"'), ('-0.356"', '-0.456"')),
        ("the coefficient -0.366 of the joint girder_pitch", "it is -0.466"),
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
            "inertia = 0 kg m^2 cannot be",
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
        (
            "line 23",
            "bending_mass = 20000 kg must be below the mass",
        ),
    ),
    "pads nowhere": ((("custom", '<text name="pads_on" data="moon"/>'),), ("line 23", "'moon'", "girder, table")),
    # what is missing or is no MJCF
    "no pad D": (
        ((('"pad_D" class'), '"mat_D" class'),),
        ("line 41: the geom 'mat_D' would touch others",),
    ),
    "no plate": ((('"plate_D"', '"slab_D"'),), ("it lacks the geom plate_D",)),
    "no names": ((('<body name="girder"', "<body"),), ("lacks the body girder",)),
    "no joint": (((f"{GIRDER_X}/>", ""),), ("joint",)),
    "no tendon": ((('"pad_B_y"', '"pad_b_y"'),), ("line 78: the tendon 'pad_b_y' would not be simulated",)),
    "no actuator": ((('name="table_ay"', 'name="shaker"'),), ("the actuator 'shaker'",)),
    "no number": ((('<numeric name="pad_damping" data="70710.7"/>', ""),), ("lacks the numbers pad_damping",)),
    "an unknown tag": ((("girder", "<girder/>"),), ("unrecognized element", "'girder', line 66")),
    "an unknown attribute": ((('mass="10000"', 'weight="10000"'),), ("unrecognized attribute: 'weight'", "line 53")),
    "a tag that is not closed": ((("</worldbody>", ""),), ("no XML", "mismatched tag: line 97")),
    "a missing include": ((('"common.xml"', '"nowhere.xml"'),), ("line 3: nowhere.xml cannot be read",)),
    "an include twice": ((('<include file="common.xml"/>', '<include file="common.xml"/>' * 2),), ("included twice",)),
    "another root": ((("<mujoco model", "<robot model"), ("</mujoco>", "</robot>")), ("line 1: this is a <robot>",)),
}
