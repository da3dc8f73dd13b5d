"""A specimen.toml for a structure on isolators whose accelerations and displacements alone were measured.

Masses cannot be told from motions: those of all levels are taken to be equal, and stiffnesses stand in their ratio.
"""

import numpy as np

from slipwise.campaign.level_order import LevelOrder
from slipwise.campaign.zero_state import GRAVITY

#: A mass where no load tells one [kg], and the height of a storey where no drawing tells one [m].
_SOME_MASS, _SOME_HEIGHT = 10e3, 3.0
#: Places of four isolators [m]: no motion tells them.
_PLACES = {"A": (1.8, 1.3), "B": (-1.8, 1.3), "C": (1.8, -1.3), "D": (-1.8, -1.3)}
#: Isolators and storeys for which no stiffness was found get that of these frequencies, all above as one mass [Hz].
_SOME_ISOLATOR, _SOME_STOREY = 0.5, 5.0


def structure_draft(levels: LevelOrder) -> str:
    """Write the text of a specimen.toml: stiffnesses as the motions tell them, what only a person knows marked.

    Args:
        levels: as found in the accelerations.
    """
    isolators, *storeys = levels.links
    mass = f'"{_SOME_MASS / 1e3:g} t"'
    stiffness = _stiffness(isolators.stiffness, _SOME_ISOLATOR, isolators.above)
    carried = isolators.above * _SOME_MASS
    period = 1.0 / isolators.frequency if isolators.frequency else 1.0 / _SOME_ISOLATOR
    lines = [
        "# Drafted: a structure on isolators of which no force was measured. Lines with `decide` need your eyes.",
        "# Motions tell no masses: all levels are ASSUMED to be as heavy. Replace that: forces scale with them.",
        'friction = "none"   # decide: no pad shows a force: isolators that do not slide; else leave it out',
        f"mass = {mass}   # decide: assumed: of the base above the isolators",
        'box = ["4 m", "3 m", "0.5 m"]   # decide: the base along x (shaking), y and z: its moments of inertia',
        'centre_height = "0.4 m"   # decide: of its centre of gravity above the isolators',
        f'pad = {{ radius = "100 mm", stiffness = "{_upright(carried):.3g} kN/mm" }}   # decide: upright',
        "[pads]   # decide: places of the isolators from the middle of the table, x along the shaking",
        *(f'{pad} = {{ x = "{x:g} m", y = "{y:g} m" }}' for pad, (x, y) in _PLACES.items()),
        f"[buffers]   # decide: what isolates, each a quarter: {period:.3g} s, {isolators.critical:.0%} of critical",
    ]
    for number, (x, y) in enumerate(_PLACES.values(), 1):
        lines.append(
            f'{number} = {{ x = "{x:g} m", y = "{y:g} m", stiffness = "{stiffness / len(_PLACES) / 1e6:.4g} kN/mm" }}'
        )
    for number, storey in enumerate(storeys, 1):
        found = _stiffness(storey.stiffness, _SOME_STOREY, storey.above)
        damping = storey.damping * _SOME_MASS
        lines += [
            "[[storeys]]",
            f"mass = {mass}   # decide: assumed: as heavy as every other level",
            f'z = "{number * _SOME_HEIGHT:g} m"   # decide: above the isolators',
            f'stiffness = "{found / 1e6:.4g} kN/mm"   # decide: as its drift follows the inertia above',
            f'damping = "{damping / 1e3:.4g} kN*s/m"   # decide: likewise',
        ]
    return "\n".join(lines) + "\n"


def _stiffness(over_mass: float, usual: float, above: float) -> float:
    """Return a stiffness [N/m] of what was found over the mass of a level [1/s^2]."""
    return _SOME_MASS * (over_mass or above * (2.0 * np.pi * usual) ** 2)


def _upright(carried: float) -> float:
    """Return the upright stiffness [kN/mm] of one of four isolators that sag by a millimetre under a weight [kg]."""
    return carried * GRAVITY / len(_PLACES) / 1e-3 / 1e6
