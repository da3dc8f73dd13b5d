"""Which rig the files of a folder were measured on: one of the package, or one that is drafted to be filled in."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from slipwise.campaign.draft.roles import rig_of
from slipwise.campaign.draft.structure import structure_draft
from slipwise.campaign.level_order import LevelOrder
from slipwise.campaign.zero_state import GRAVITY
from slipwise.record import Record
from slipwise.rig import RIGS, load_specimen
from slipwise.rig.files import SPECIMEN_FILE

#: What the pads carry differs from a rig's weight by less than this where it is that rig [1].
_SAME_WEIGHT = 0.05
#: Pads that a draft has a rig for.
MOST_DRAFTED = 12
#: A mass where no load tells one [kg].
_SOME_MASS = 10e3


def rig_for(
    records: Sequence[Record], pads: tuple[str, ...], folder: Path, levels: LevelOrder | None
) -> tuple[str, str, str]:
    """Return the rig of a campaign, why, and the text of a specimen.toml that must be written for it, or "".

    Args:
        records: of its files, as far as their channels are known.
        pads: that the files have channels of.
        folder: of the files; a specimen.toml in it is their rig.
        levels: of a structure without force gauges; None where the files show none.
    """
    if (folder / SPECIMEN_FILE).is_file():
        return SPECIMEN_FILE, "it lies in this folder", ""
    if levels is not None:
        why = "a structure whose accelerations alone were measured: it was drafted beside this file, fill it in"
        return SPECIMEN_FILE, why, structure_draft(levels)
    if len(pads) < 3:
        return "pad", "not enough pads for a girder", ""
    weights = {name: rig.weight for name in RIGS if (rig := load_specimen(name)).free and rig.pads == pads}
    if len(weights) > 1:
        return *rig_of(records, list(weights)), ""
    loads = loads_at_rest(records, pads)
    if loads is not None:
        name = min(weights, key=lambda n: abs(weights[n] - sum(loads)), default="")
        if name and abs(sum(loads) / weights[name] - 1.0) < _SAME_WEIGHT:
            return name, f"its pads {', '.join(pads)} carry {sum(loads) / 1e3:.3g} kN here", ""
    if len(pads) > MOST_DRAFTED:
        return SPECIMEN_FILE, f"{len(pads)} pads: `slipwise rigs --new NAME` writes a file to begin with", ""
    why = f"no rig of the package has {len(pads)} pads so loaded: it was drafted beside this file, fill it in"
    return SPECIMEN_FILE, why, specimen_draft(pads, loads)


def loads_at_rest(records: Sequence[Record], pads: Sequence[str]) -> tuple[float, ...] | None:
    """Return what each pad usually carries [N]; None where no file has the loads of all."""
    weighing = [record for record in records if record.has_all(*(f"pad_{pad}_N" for pad in pads))]
    if not weighing:
        return None
    medians = [[float(np.median(record[f"pad_{pad}_N"])) for pad in pads] for record in weighing]
    return tuple(map(float, np.median(medians, axis=0)))


def specimen_draft(pads: Sequence[str], loads: Sequence[float] | None) -> str:
    """Write the text of a specimen.toml: what the loads tell, and what only a person knows marked.

    Args:
        pads: their names.
        loads: of each at rest [N]; None where they are not known.
    """
    mass = _SOME_MASS if loads is None else sum(loads) / GRAVITY
    told = "no load tells it" if loads is None else f"the pads carry {sum(loads) / 1e3:.4g} kN together"
    lines = [
        "# Drafted: a rig that no file describes. Lines with `decide` are placeholders that need your eyes.",
        f'mass = "{mass / 1e3:.4g} t"   # decide: {told}',
        'box = ["4 m", "3 m", "0.5 m"]   # decide: the girder along x (shaking), y and z: its moments of inertia',
        'centre_height = "0.4 m"   # decide: of its centre of gravity above the sliding plane',
        'pad = { radius = "25 mm", stiffness = "200 kN/mm" }   # decide: of every pad; what a pad says itself counts',
        "[pads]   # decide: places from the middle of the table, x along the shaking",
    ]
    for i, pad in enumerate(pads):
        angle = 2.0 * np.pi * (i + 0.5) / len(pads)
        x, y = 1.8 * np.cos(angle), 1.3 * np.sin(angle)
        carries = "" if loads is None else f" it carries {loads[i] / 1e3:.4g} kN"
        lines.append(f'{pad} = {{ x = "{x:.2f} m", y = "{y:.2f} m" }}   # decide:{carries or " measure it"}')
    lines += [
        "# [buffers]   # decide: none, or springs between table and girder",
        '# 1 = { x = "0 m", y = "0 m", stiffness = "2.4 kN/mm" }',
    ]
    return "\n".join(lines) + "\n"
