"""What an audit judges, and where: records, balances and their noise; constants of the rig and faults taken out."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from slipwise.arrays import Array
from slipwise.effects import Effect
from slipwise.instruments.suspects import Suspect
from slipwise.relations.balance_rows import PreparedRun, list_constants, with_records
from slipwise.relations.rigid_balances import Relation
from slipwise.rig import Specimen

#: A rated mass is taken to be right within this, a mass that the campaign gives within that [1].
RATED_MASS, KNOWN_MASS = 0.01, 0.003
#: A fault, and its size [SI].
Size = tuple[Suspect, float]


@dataclass(frozen=True)
class Case:
    """All that an audit is made from.

    Attributes:
        runs: as recorded, smoothed.
        relations: that the channels allow.
        specimen: rated.
        noise: a sample of the noise of each run's channels.
        mass_error: how far the mass may be from the specimen's [1].
        passed: highest frequency that reached the records [Hz].
        effects: that may be suspects or physical explanations.
    """

    runs: list[PreparedRun]
    relations: list[Relation]
    specimen: Specimen
    noise: Sequence[Mapping[str, Array]]
    mass_error: float
    passed: float
    effects: tuple[Effect, ...]


@dataclass(frozen=True)
class Point:
    """Where balances are evaluated.

    Attributes:
        constants: of the rig.
        sizes: faults that are taken out of the records, and how large.
    """

    constants: dict[str, float]
    sizes: tuple[Size, ...] = ()


def start(case: Case) -> Point:
    """Return the rated mass, and no other constant."""
    constants = dict.fromkeys(list_constants(case.relations), 0.0)
    if "mass" in constants:
        constants["mass"] = case.specimen.mass
    return Point(constants)


def mended(runs: Sequence[PreparedRun], sizes: Iterable[Size]) -> list[PreparedRun]:
    """Return the runs without faults."""
    out = list(runs)
    for suspect, size in reversed(list(sizes)):
        out = with_records(out, lambda r, s=suspect, z=size: s.correct(r, z))
    return out
