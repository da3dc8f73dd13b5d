"""A plate between pad and load cell, whose own inertia the cell reads.

    N_read = N + m_c (a_z + w g),        F_read = F - h m_c a,        a: acceleration of the table

What stands on the cell moves with the table and needs force of its own. With these channels' signs (F is the force of
the girder on the pad) the cell reads m_c a less than F: the plate takes that part from the pad's force. h = 1 for a
plate that is free on its cell, less where it is guided, negative where the cell hangs on the other side of its mass.
The plate's weight is in the cell's zero (w = 0) unless the zero was taken without it (w = 1).

Valid: m_c 20 to 50 kg; cells on the table.
Source: Newton's second law for the plate; sizes assumed.
"""

from slipwise.effects._effect import Effect
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import ForDiagnosis, Gauges, Rare
from slipwise.effects._gauges import aimed
from slipwise.params import Parameter
from slipwise.record import Record

GRAVITY = 9.80665


def gauge(record: Record, target: str, mass: float, horizontal: float, weighed: float) -> Record:
    """Add the plate's inertia to the cell's readings."""
    out = {}
    for pad in {name[:5] for name in aimed(record, "pad_*_[NF]*" if target == "all" else target)}:
        for part, axis in (("N", "z"), ("Fx", "x"), ("Fy", "y")):
            name, table = f"{pad}_{part}", f"table_a{axis}"
            if part == "N" and name in record:
                up = record[table] if table in record else 0.0
                out[name] = record[name] + mass * (up + weighed * GRAVITY)
            elif record.has_all(name, table):
                out[name] = record[name] - horizontal * mass * record[table]
    return record.replaced(**out)


def undo(record: Record, target: str, mass: float, horizontal: float, weighed: float) -> Record:
    """Take the plate's inertia away again; exact, for the table's motion is not changed."""
    return gauge(record, target, -mass, horizontal, weighed)


EFFECT = Effect(
    contract=1,
    port="gauge",
    parameters=(
        Parameter("mass", "kg", 30.0, 0.0, 200.0, 0.0, "20 to 50 kg, assumed", "m_c: between pad and cell"),
        Parameter("horizontal", "1", 1.0, -1.5, 1.5, None, "1 by Newton for these signs", "h: horizontal share"),
        Parameter("weighed", "1", 0.0, 0.0, 1.0, None, "assumed: in the zero", "w: share of its weight that is read"),
    ),
    diagnosis=ForDiagnosis(
        component="instrument",
        equation="N_read = N + m_c a_z,  F_read = F - h m_c a",
        moves=("pad_*_F?", "pad_*_N"),
        signature="even, in step with the table's acceleration, also while the pads stick; the same mass in heave",
        confused_with={
            "table_pitch": "that shows in the pitch of the loads",
            "channel_gain": "a gain of a cell is in step with its own reading",
        },
    ),
    gauges=Gauges(
        target="channel",
        fault=GaugeFault(
            says="read the inertia of {size} between pad and cell",
            settled_by="a sine below slip (0.03 g): what the cells read there in step with the table is inertia",
            unit="kg",
            least={"*": 6.0},
            step=10.0,
            forms={
                "all cells": {"horizontal": 1.0, "weighed": 0.0},
                "all cells, added": {"horizontal": -1.0, "weighed": 0.0},
            },
        ),
        sits="pads",
    ),
    rare=Rare(exact=True),
)  # fmt: skip
