"""The noise floor of every channel as people read it: in the channel's usual unit, with its basis or the reason."""

from slipwise.channels import channel
from slipwise.evidence.floor import STATES, Floor
from slipwise.units import parse_unit


def floor_rows(floor: Floor) -> list[dict[str, str]]:
    """Return one row a channel: its unit, the floor in each state of motion, and what it rests on."""
    rows = []
    for name, own in floor.channels.items():
        known = channel(name)
        factor = parse_unit(known.shown_in, known.unit, name)
        row = {"channel": name, "unit": known.shown_in}
        if own.known:
            row |= {state: f"{own.by_state[state] / factor:.3g}" for state in STATES}
            row["from"] = "; ".join(dict.fromkeys(own.basis[state] for state in STATES))
        else:
            row |= dict.fromkeys(STATES, "unknown")
            row["from"] = f"floor unknown: {own.basis[STATES[0]]}"
        rows.append(row)
    return rows
