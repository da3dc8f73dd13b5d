"""How right verdicts are on campaigns whose answer is known: exact names, and no worse mistakes.

The answer of a campaign is `truth.json` beside its campaign.toml: {"missing": ["run_in"]}; [] where nothing is missing,
["unknown"] where it is nothing that the catalogue has.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.diagnosis.indistinguishable import list_alike_pairs
from slipwise.effects import base_effects, catalogue
from slipwise.errors import InputError
from slipwise.short_repr import short_repr
from slipwise.studies.campaigns.outcome import Outcome

_UNKNOWN = ["unknown"]


@short_repr
@dataclass(frozen=True)
class Scored:
    """One campaign with its answer.

    Attributes:
        outcome: what was said.
        missing: what is missing in truth.
        right: whether the verdict and every name are exactly right.
    """

    outcome: Outcome
    missing: tuple[str, ...]
    right: bool


def read_truth(folder: Path) -> tuple[str, ...]:
    """Read what a campaign's model lacks.

    Raises:
        InputError: no truth.json, or one that does not say it.
    """
    path = folder / "truth.json"
    try:
        missing = json.loads(path.read_text(encoding="utf-8"))["missing"]
        if not isinstance(missing, list):
            raise TypeError
    except (OSError, ValueError, KeyError, TypeError):
        raise InputError(f'{path}: there must be a list of effects in it, {{"missing": ["run_in"]}}') from None
    return tuple(map(str, missing))


def with_truth(folders: Iterable[Path]) -> list[Path]:
    """Return the campaigns in folders: those of their folders, or themselves, that have campaign.toml and truth.json.

    Raises:
        InputError: a folder with none.
    """
    out: list[Path] = []
    for folder in folders:
        found = [p.parent for p in sorted([*folder.glob("truth.json"), *folder.glob("*/truth.json")])]
        found = [campaign for campaign in found if (campaign / "campaign.toml").is_file()]
        if not found:
            raise InputError(f"{folder}: no campaign with a truth.json beside its campaign.toml lies there")
        out += found
    return out


def is_right(missing: Sequence[str], said: Mapping[str, Any]) -> bool:
    """Return whether a verdict and every name are exactly right.

    Two effects that are one thing to some rigs may stand for each other in an ambiguous verdict.
    """
    springs = {effect.name for effect in base_effects("springs")}  # a base parameter, never missing by itself
    kind, names, hidden = said["verdict"], set(said["effects"]) - springs, set(missing)
    if not missing:
        return kind == "complete" and not names
    if list(missing) == _UNKNOWN:
        return kind == "unknown"
    if kind == "ambiguous":
        pairs = list_alike_pairs(catalogue().values())
        return any(pair & names and pair & hidden and names - pair == hidden - pair for pair in pairs)
    if kind == "instrument" and not any(_of_gauge(name) for name in hidden):
        return False
    return kind in ("named", "instrument") and names == hidden


def score_outcomes(outcomes: Sequence[Outcome], truths: Sequence[tuple[str, ...]]) -> list[Scored]:
    """Hold outcomes against their answers; a campaign that failed is wrong."""
    pairs = zip(outcomes, truths, strict=True)
    return [Scored(o, missing, not o.failed and is_right(missing, o.numbers)) for o, missing in pairs]


def rates(scored: Sequence[Scored]) -> dict[str, tuple[int, int]]:
    """Count, what -> how many of how many: what is right, and the mistakes that mislead most."""
    told = [s for s in scored if not s.outcome.failed]
    complete = [s for s in told if not s.missing]
    unknown = [s for s in told if list(s.missing) == _UNKNOWN]
    gauges = [s for s in told if s.missing and all(map(_of_gauge, s.missing))]
    kinds = {id(s): s.outcome.numbers["verdict"] for s in told}
    return {
        "exactly right": (sum(s.right for s in scored), len(scored)),
        "complete models accused": (sum(kinds[id(s)] != "complete" for s in complete), len(complete)),
        "outside the catalogue, called by a name of it": (
            sum(kinds[id(s)] in ("named", "instrument") for s in unknown),
            len(unknown),
        ),
        "faults of gauges taken for physics": (sum(kinds[id(s)] == "named" for s in gauges), len(gauges)),
    }


def _of_gauge(name: str) -> bool:
    effect = catalogue().get(name)
    return effect is not None and effect.component == "instrument"
