"""The answer of a dirty campaign: each effect material, minor or absent, what it is worth, and the first things."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from slipwise_benchmarks.answer_key import Entry
from slipwise_benchmarks.dirty_plan import Plan
from slipwise_benchmarks.first_things import First
from slipwise_benchmarks.gauges import Logger
from slipwise_benchmarks.hidden import Hidden
from slipwise_benchmarks.settings import Settings


@dataclass(frozen=True)
class DirtyTruth:
    """The answer of one campaign.

    Attributes:
        name: of the folder.
        seed: that made it.
        plan: what the seed stands for.
        rig, said_rig: what it is and what campaign.toml says.
        said_mass: what campaign.toml says of the girder's mass [kg]; None: nothing.
        base: true base parameters.
        logger: what the chain did.
        roles: (run, role) in order.
        hidden: what the base model lacks, dirt included.
        key: name -> its entry; what is not there is absent.
        first: faults that come before any balance.
    """

    name: str
    seed: int
    plan: Plan
    rig: str
    said_rig: str
    said_mass: float | None
    base: Settings
    logger: Logger
    roles: tuple[tuple[str, str], ...]
    hidden: Hidden
    key: Mapping[str, Entry]
    first: list[First]

    @property
    def missing(self) -> list[str]:
        """Names that a verdict should give: material, and not absorbed by base parameters; the largest first."""
        there = {n: e for n, e in self.key.items() if e.status == "material" and e.visible}
        return sorted(there, key=lambda name: -there[name].importance.of_limit)

    @property
    def hidden_in_base(self) -> list[str]:
        """Names that matter but that base parameters absorb: they need not be given."""
        return [n for n, e in self.key.items() if e.status == "material" and not e.visible]

    def as_dict(self) -> dict[str, Any]:
        """Give the answer as plain data."""
        base = self.base
        settings = {"h": base.height, "Kb": 0.5 * base.buffer_stiffness, "s1": base.s1, "n": base.n, "k": base.k}
        settings |= {"alpha": base.alpha, "mass": base.mass, "pad_stiffness": base.pad_stiffness}
        settings |= {"pad_damping": base.pad_damping, "inertia_pitch": base.inertia_pitch}
        return {
            "missing": self.missing,
            "hidden_in_base": self.hidden_in_base,
            "minor": [name for name, entry in self.key.items() if entry.status == "minor"],
            "first": [one.describe() for one in self.first],
            "effects": {name: _entry(entry) for name, entry in self.key.items()},
            "group": self.plan.group,
            "seed": self.seed,
            "rig": self.rig,
            "said": {"rig": self.said_rig, "mass": self.said_mass},
            "rich": self.plan.rich,
            "runs": [role for _, role in self.roles],
            "short": self.plan.short,
            "uplift": self.plan.uplift,
            "settings": settings,
            "details": self.hidden.details,
            "logger": asdict(self.logger),
        }


def _entry(entry: Entry) -> dict[str, Any]:
    return {
        "status": entry.status,
        "visible": entry.visible,
        "of_limit": entry.importance.of_limit,
        "importance": {
            "peak_slip": entry.importance.peak_slip,
            "energy": entry.importance.energy,
            "largest_load": entry.importance.largest_load,
            "channels": entry.importance.channels,
        },
        "floors": {"raw": entry.raw, "after_fit": entry.after_fit},
    }
