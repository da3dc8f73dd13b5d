"""Where the numbers that every law needs stand in the flat array `u`; each place is the one before plus its size.

The compiled callback knows no names: everything that it needs stands in `data.userdata`. What depends on the effects
that there are (their parameters, their order, their memory) follows behind `END`: see `layout`.
"""

MAX_PADS = 4
MAX_BUFFERS = 2
MAX_DOFS = 11
#: Hooks whose effects act one after another in the order of the model.
CHAINS: tuple[str, ...] = (
    "area", "shear", "coefficient", "stick", "pad", "advance", "stretch", "deflection", "spring", "settle", "lift",
    "drag",
)  # fmt: skip

#: Step [s].
DT = 0
N_PADS = DT + 1
N_BUFFERS = N_PADS + 1
N_DOFS = N_BUFFERS + 1
#: First place in `sensordata` of what the law writes there.
USER_SENSOR = N_DOFS + 1
#: Degrees of freedom of the girder: x, y, z, roll, pitch, yaw; the first is -1 where the girder is prescribed.
GIRDER_DOF = USER_SENSOR + 1
#: Of one pad [m^2].
APPARENT_AREA = GIRDER_DOF + 6
#: Load over real area of contact, H [Pa].
PLASTIC_PRESSURE = APPARENT_AREA + 1
#: Friction over real area of contact, s [Pa].
SHEAR_STRENGTH = PLASTIC_PRESSURE + 1
#: Above 0: a pad that sticks bears as much as one that slides fast.
FULL_STICK = SHEAR_STRENGTH + 1
#: [N/m].
BUFFER_STIFFNESS = FULL_STICK + 1
#: Per pad: on which side of the middle it stands, along x and y (+1 or -1).
SIDE = BUFFER_STIFFNESS + MAX_BUFFERS
PAD_GEOM = SIDE + 2 * MAX_PADS
#: Per pad, then per buffer: the tendons along x and y, whose lengths are slip and deflection.
TENDON = PAD_GEOM + MAX_PADS
#: Per pad: the constraint rows of dry friction along x and y.
FRICTION_ROW = TENDON + 2 * (MAX_PADS + MAX_BUFFERS)
#: Per tendon: its rate over the rate of each degree of freedom.
JACOBIAN = FRICTION_ROW + 2 * MAX_PADS
#: Of each pad's spring and damper [N/m, N s/m].
PAD_STIFFNESS = JACOBIAN + 2 * (MAX_PADS + MAX_BUFFERS) * MAX_DOFS
PAD_DAMPING = PAD_STIFFNESS + 1
#: Per pad: rate at which it was compressed in the step before [m/s].
COMPRESSION_RATE = PAD_DAMPING + 1
#: Time between those rates and the ones of the step [s].
RATE_AGE = COMPRESSION_RATE + MAX_PADS
#: Per pad: compression of its spring, negative where it does not touch [m].
COMPRESSION = RATE_AGE + 1
#: Per pad: normal load of the step [N].
LOAD = COMPRESSION + MAX_PADS
#: Per pad: friction force that it can carry, s A_r [N].
BOUND = LOAD + MAX_PADS
#: Per pad: force of the girder on it that is not dry friction, along x and y [N].
EXPLICIT = BOUND + MAX_PADS
#: Per pad: dry friction of the step before, along x and y [N].
FORCE = EXPLICIT + 2 * MAX_PADS
#: Per buffer: force of the girder on it along x and y [N].
BUFFER_FORCE = FORCE + 2 * MAX_PADS
#: Further force on the girder along x, y, z [N].
GIRDER_FORCE = BUFFER_FORCE + 2 * MAX_BUFFERS
#: Per pad: force of the loading train along x and y [N], and time [s] of the step before; rate of the contact [m/s].
TRAIN_FORCE = GIRDER_FORCE + 3
TRAIN_TIME = TRAIN_FORCE + 2 * MAX_PADS
TRAIN_VELOCITY = TRAIN_TIME + MAX_PADS
#: Per hook in the order of `CHAINS`: how many of the model's effects have it.
EFFECT_COUNT = TRAIN_VELOCITY + 2 * MAX_PADS
N_STICK = EFFECT_COUNT + CHAINS.index("stick")
N_PAD = EFFECT_COUNT + CHAINS.index("pad")
N_ADVANCE = EFFECT_COUNT + CHAINS.index("advance")
#: How many of the loading train's parts stretch at all.
N_TRAIN = EFFECT_COUNT + len(CHAINS)
#: How many of the model's effects of pads, and of buffers, ask for derived states.
N_OBSERVE = N_TRAIN + 1
N_OBSERVE_BUFFER = N_OBSERVE + 1
END = N_OBSERVE_BUFFER + 1
