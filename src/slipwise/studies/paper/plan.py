"""Which replays the studies need: one list, so that one progress bar and one kill-proof file serve them all."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from slipwise.short_repr import short_repr
from slipwise.studies.paper.member import Member
from slipwise.studies.paper.settings import PaperSettings

#: Energies of Fig. 10 with and without vertical motion [J]. Source: paper, Influence of vertical ground motion.
ENERGY_WITH, ENERGY_WITHOUT = 5320.0, 5310.0
#: Vertical motion of the extreme analysis over that of the tests. Source: paper, Fig. 15.
EXTREME = 5.0
#: Times the tests' vertical motion, and h/b, of the map.
MAP_SCALES = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0)
MAP_SLENDERNESS = (0.061, 0.122, 0.244, 0.366, 0.488)
#: What the authors added later, and both together. Source: JSCE Proc. Earthquake Eng. 28 (2005) paper 123, abstract.
LATER: Mapping[str, tuple[str, ...]] = {
    "paper": (),
    "run_in": ("run_in",),
    "heating": ("heating",),
    "both": ("run_in", "heating"),
}


@short_repr
@dataclass(frozen=True)
class Plan:
    """Groups of replays by name, all in one list."""

    groups: Mapping[str, tuple[Member, ...]]

    @property
    def members(self) -> list[Member]:
        """Return all in order."""
        return [member for group in self.groups.values() for member in group]

    def sorted(self, numbers: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
        """Return the numbers of all members back by group."""
        out, first = {}, 0
        for name, group in self.groups.items():
            out[name] = numbers[first : first + len(group)]
            first += len(group)
        return out


def drawn(settings: PaperSettings, seed: int) -> Member:
    """Draw one earthquake of Bridge 1 within the assumed ranges, with its vertical part; the same for the same seed."""
    rng = np.random.default_rng([settings.seed, seed])
    peak = rng.uniform(settings.peak_low, settings.peak_high)
    frequency = rng.uniform(settings.frequency_low, settings.frequency_high)
    strong = rng.uniform(settings.strong_low, settings.strong_high)
    # Rounded, because the motion is described in text and its key must be that of the text.
    peak, frequency, strong = (round(float(v), 4) for v in (peak, frequency, strong))
    return Member("bridge1", seed, peak, frequency, strong, round(peak * settings.vertical_share, 4), settings)


def middle(settings: PaperSettings) -> Member:
    """Return the earthquake of the pictures: the middle of the assumed ranges."""
    peak, frequency, strong = (
        round(0.5 * (getattr(settings, f"{name}_low") + getattr(settings, f"{name}_high")), 4)
        for name in ("peak", "frequency", "strong")
    )
    vertical = round(peak * settings.vertical_share, 4)
    return Member("bridge1", settings.seed, peak, frequency, strong, vertical, settings)


def plan(settings: PaperSettings, *, quick: bool = False) -> Plan:
    """Choose the replays.

    Args:
        settings: the assumptions; `members` sets the size of the big ensemble, the others follow from it.
        quick: a coarse map.
    """
    count = settings.members
    some, few = max(count // 8, 2), 1 if quick else 3
    motions = [drawn(settings, seed) for seed in range(1, count + 1)]
    scales, slenderness = (MAP_SCALES[::5], MAP_SLENDERNESS[1:4:2]) if quick else (MAP_SCALES, MAP_SLENDERNESS)
    groups: dict[str, tuple[Member, ...]] = {
        "with": tuple(motions),
        "without": tuple(replace(m, vertical=0.0) for m in motions),
        "figure": (replace(middle(settings), target=ENERGY_WITH),),
        "reach": tuple(replace(m, target=ENERGY_WITH) for m in motions[:some]),
        "extreme": tuple(replace(m, vertical=m.vertical * EXTREME) for m in motions[: 2 * some]),
        "map": tuple(
            replace(m, vertical=m.vertical * scale, slenderness=h)
            for scale in scales
            for h in slenderness
            for m in motions[:few]
        ),
    }
    for name, effects in LATER.items():
        if effects:
            later = [replace(m, effects=effects) for m in motions[:some]]
            groups[f"{name} with"] = tuple(later)
            groups[f"{name} without"] = tuple(replace(m, vertical=0.0) for m in later)
            groups[f"{name} extreme"] = tuple(replace(m, vertical=m.vertical * EXTREME) for m in later)
    return Plan(groups)
