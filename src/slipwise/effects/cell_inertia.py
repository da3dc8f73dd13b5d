"""A plate between pad and load cell, whose own inertia the cell reads.

    N_read = N + m_c a_z,table,        F_read = F - h m_c a_table

What stands on the cell moves with the table and needs force of its own. The weight m_c g is in the cell's zero. With
these channels' signs (F is the force of the girder on the pad) the cell reads m_c a less than F in the horizontal: the
plate takes that part from the pad's force. h = 1 for a plate that is free on its cell, less where it is guided,
negative where the cell hangs on the girder's side of its reading.

Valid: m_c 20 to 50 kg; cells on the table.
Source: Newton's second law for the plate; sizes assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._gauges import cells
from slipwise.params import Parameter
from slipwise.record import Record


def gauge(record: Record, target: str, mass: float, horizontal: float) -> Record:
    """Add the plate's inertia to the cell's readings."""
    pushes = {"N": ("table_az", mass), "Fx": ("table_ax", -horizontal * mass), "Fy": ("table_ay", -horizontal * mass)}
    names = {f"pad_{pad}_{part}": push for pad in cells(record, target) for part, push in pushes.items()}
    return record.replaced(
        **{name: record[name] + m * record[a] for name, (a, m) in names.items() if record.has_all(name, a)}
    )


def undo(record: Record, target: str, mass: float, horizontal: float) -> Record:
    """Take the plate's inertia away again; exact, for the table's motion is not changed."""
    return gauge(record, target, -mass, horizontal)


EFFECT = Effect(
    port="gauge",
    component="instrument",
    equation="N_read = N + m_c a_z,  F_read = F - h m_c a_x",
    parameters=(
        Parameter("mass", "kg", 30.0, 0.0, 200.0, 0.0, "20 to 50 kg, assumed", "m_c: between pad and cell"),
        Parameter("horizontal", "1", 1.0, -1.5, 1.5, None, "1 by Newton for these signs", "h: horizontal share"),
    ),
    moves=("pad_*_F?", "pad_*_N"),
    signature="even, in step with the table's acceleration, also while the pads stick; the same mass in heave",
    confused_with={
        "table_pitch": "that shows in the pitch of the loads",
        "channel_gain": "a gain of a cell is in step with its own reading",
    },
    target="channel",
)  # fmt: skip
