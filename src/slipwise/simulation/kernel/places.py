"""Where the numbers that every law needs stand in the flat array `u`; each place is the one before plus its size.

The compiled callback knows no names: everything that it needs stands in `data.userdata`. First what is said once, then
what depends on the effects that there are, then a block for every pad, then a block for every buffer: see `layout`. So
one compiled law serves any number of them. Places in a block count from its beginning, `z` of a pad and `b` of a
buffer.
"""

#: Degrees of freedom that may move a pad: of the table and the girder, which come first, and its bending mode.
MAX_DOFS = 11
#: Hooks whose effects act one after another in the order of the model.
CHAINS: tuple[str, ...] = (
    "area", "shear", "coefficient", "stick", "pad", "face", "advance", "stretch", "deflection", "spring", "lift",
    "drag",
)  # fmt: skip

#: Step [s].
DT = 0
N_PADS = DT + 1
N_BUFFERS = N_PADS + 1
N_DOFS = N_BUFFERS + 1
#: Of these, the ones that move a pad or a buffer: at most MAX_DOFS.
N_ARMS = N_DOFS + 1
#: Where the first buffer's block begins.
BUFFERS = N_ARMS + 1
#: First place in `sensordata` of what the law writes there.
USER_SENSOR = BUFFERS + 1
#: Degrees of freedom of the girder: x, y, z, roll, pitch, yaw; the first is -1 where the girder is prescribed.
GIRDER_DOF = USER_SENSOR + 1
#: Load over real area of contact, H [Pa].
PLASTIC_PRESSURE = GIRDER_DOF + 6
#: Friction over real area of contact, s [Pa].
SHEAR_STRENGTH = PLASTIC_PRESSURE + 1
#: Above 0: a pad that sticks bears as much as one that slides fast.
FULL_STICK = SHEAR_STRENGTH + 1
#: Time between the pads' rates of the step before and those of the step [s].
RATE_AGE = FULL_STICK + 1
#: The table's degree of freedom along x, -1 where it does not move, and its velocity in the step before [m/s].
TABLE_DOF = RATE_AGE + 1
TABLE_VELOCITY = TABLE_DOF + 1
#: Further force on the girder along x, y, z [N].
GIRDER_FORCE = TABLE_VELOCITY + 1
#: Per hook in the order of `CHAINS`: how many of the model's effects have it.
EFFECT_COUNT = GIRDER_FORCE + 3
N_STICK = EFFECT_COUNT + CHAINS.index("stick")
N_PAD = EFFECT_COUNT + CHAINS.index("pad")
N_ADVANCE = EFFECT_COUNT + CHAINS.index("advance")
#: How many of the loading train's parts stretch at all.
N_TRAIN = EFFECT_COUNT + len(CHAINS)
#: How many of the model's effects of pads, and of buffers, ask for derived states.
N_OBSERVE = N_TRAIN + 1
N_OBSERVE_BUFFER = N_OBSERVE + 1
#: Above 0: a sliding face is curved at all; and where the girder then rises above the pads that stand on the table.
CURVED = N_OBSERVE_BUFFER + 1
RISES_OVER_PADS = CURVED + 1
#: Where the responses of the rig to the pads' friction begin (see `reversals`), 0 where slip is prescribed.
RESPONSES = RISES_OVER_PADS + 1
#: How many readings of acceleration there are, and the first place of them in `sensordata`.
N_ACCELERATIONS = RESPONSES + 1
ACCELERATIONS = N_ACCELERATIONS + 1
#: Armature of the table's joints [kg, kg m^2].
TABLE_ARMATURE = ACCELERATIONS + 1
END = TABLE_ARMATURE + 1

#: In a pad's block. Apparent area [m^2].
APPARENT_AREA = 0
#: Of the spring and the damper [N/m, N s/m].
PAD_STIFFNESS = APPARENT_AREA + 1
PAD_DAMPING = PAD_STIFFNESS + 1
#: Where the pad stands along x and y, over the farthest pad's distance from their middle (-1 to 1).
SIDE = PAD_DAMPING + 1
#: Of its sliding face as rated, 1/R [1/m].
CURVATURE = SIDE + 2
PAD_GEOM = CURVATURE + 1
#: The tendons along x and y, whose lengths are its slip.
PAD_TENDON = PAD_GEOM + 1
#: The constraint rows of dry friction along x and y.
FRICTION_ROW = PAD_TENDON + 2
#: Rates of the two tendons over the rate of each degree of freedom.
PAD_JACOBIAN = FRICTION_ROW + 2
#: Rate at which it was compressed in the step before [m/s].
COMPRESSION_RATE = PAD_JACOBIAN + 2 * MAX_DOFS
#: Compression of its spring, negative where it does not touch [m].
COMPRESSION = COMPRESSION_RATE + 1
#: Normal load of the step [N].
LOAD = COMPRESSION + 1
#: Friction force that it can carry, s A_r [N].
BOUND = LOAD + 1
#: Force normal to its sliding face [N]: the load where that is flat.
NORMAL = BOUND + 1
#: Height of the face at the slip over that at the middle [m], its rate [m/s], its slope along x and y [1].
RISE = NORMAL + 1
RISE_RATE = RISE + 1
SLOPE = RISE_RATE + 1
#: Load times slope along x and y [N], and the horizontal part of a friction that is an explicit force [N].
RESTORING = SLOPE + 2
ALONG = RESTORING + 2
#: Force of the girder on it that is not dry friction, along x and y [N].
EXPLICIT = ALONG + 2
#: Dry friction of the step before, along x and y [N].
FORCE = EXPLICIT + 2
#: Force of the loading train along x and y [N], and time [s] of the step before; rate of the contact [m/s].
TRAIN_FORCE = FORCE + 2
TRAIN_TIME = TRAIN_FORCE + 2
TRAIN_VELOCITY = TRAIN_TIME + 1
#: What the effects on pads may know of the rig: rocking rate [rad/s], velocity [m/s] and acceleration [m/s^2] of the
#: table.
RIG_MOTION = TRAIN_VELOCITY + 2
#: Slip rate of the step before, along x and y [m/s].
LAST_VELOCITY = RIG_MOTION + 3
#: What each of its two rows of dry friction may carry in the step [N].
ROW_BOUND = LAST_VELOCITY + 2
#: Sense (-1 or 1) in which each row slides at the end of the step before; 0 where it sticks or does not touch.
SENSE = ROW_BOUND + 2
#: Acceleration of each row's slip [m/s^2] under all the friction that it may carry, in the step before; nan where it
#: is not known.
EXCESS = SENSE + 2
#: Of a step in which friction turns round or gives way, per row: change of its mean force [N], a force on trial [N],
#: slip rate at the step's end [m/s], when after the step's middle it happens [s], and change of the force at that
#: instant times half the square of that time [N s^2].
CHANGE = EXCESS + 2
TRIAL = CHANGE + 2
END_RATE = TRIAL + 2
LATE = END_RATE + 2
BEND = LATE + 2
#: Slip rate along x and y [m/s] at the step's instant, for which the law was asked; of the step before that rate, what
#: the pad could carry [N], and the force normal to its face [N].
RATE = BEND + 2
LAST_RATE = RATE + 2
LAST_BOUND = LAST_RATE + 2
LAST_NORMAL = LAST_BOUND + 1
#: Share by which a metre per second changes what the pad may carry at rest [s/m], and what it may carry at the step's
#: rate over that [1].
RATE_SHARE = LAST_NORMAL + 1
OVER_REST = RATE_SHARE + 1
#: Where the memory of the effects on pads begins; their parameters follow.
PAD_MEMORY = OVER_REST + 1

#: In a buffer's block. Stiffness along x and y [N/m].
BUFFER_STIFFNESS = 0
#: Way to either side before it is touched [m].
BUFFER_GAP = BUFFER_STIFFNESS + 2
#: On which side of the middle it stands (-1 to 1).
BUFFER_SIDE = BUFFER_GAP + 1
#: The tendons along x and y, whose lengths are its deflection, and their rates over those of the degrees of freedom.
BUFFER_TENDON = BUFFER_SIDE + 1
BUFFER_JACOBIAN = BUFFER_TENDON + 2
#: Force of the girder on it along x and y [N].
BUFFER_FORCE = BUFFER_JACOBIAN + 2 * MAX_DOFS
#: Where the memory of the effects on buffers begins: along x, then along y.
BUFFER_MEMORY = BUFFER_FORCE + 2
