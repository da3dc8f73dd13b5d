"""Laws that explain a campaign alike, to be told apart: each is the effect that its user would add, fitted like any."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from slipwise.diagnosis.result import Diagnosis
from slipwise.discovery.discover import discover
from slipwise.discovery.effect_file import can_be_written, write_law
from slipwise.discovery.law import Law
from slipwise.discovery.result import Discovery
from slipwise.effects import find_effect
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis, polish, refit

#: What may be said of a discovery whose laws are worth an experiment.
_CLAIMED = ("law", "state", "organised")


@dataclass(frozen=True)
class Contest:
    """Hypotheses to be told apart.

    Attributes:
        hypotheses: the best first.
        chances: probability of each today [1].
        words: what they are, where their names do not say it.
    """

    hypotheses: tuple[Hypothesis, ...]
    chances: tuple[float, ...]
    words: str = ""


def law_contest(found: Diagnosis, folder: Path, most: int) -> Contest | None:
    """Return the laws that explain as much where the catalogue ends; None where no two of them do.

    Args:
        found: a diagnosis whose verdict is unknown.
        folder: where the effects of the laws are written; they are compiled from there.
        most: laws at most.
    """
    told = discover(found.final.campaign, diagnosis=found)
    if told.evidence not in _CLAIMED:
        return None
    laws = [law for law in (told.laws[0], *told.laws[0].alternatives) if can_be_written(law)][:most]
    if len(laws) < 2:
        return None
    named = dict(zip(_names(laws), laws, strict=True))
    hypotheses = tuple(_fitted(found, told, law, name, folder) for name, law in named.items())
    words = " ".join(f"{name}: {law.equation}." for name, law in named.items())
    return Contest(hypotheses, (1.0 / len(laws),) * len(laws), words)


def _names(laws: Sequence[Law]) -> list[str]:
    """Name laws by form and state, with a number where two are alike in both."""
    names: list[str] = []
    for law in laws:
        name = re.sub(r"\W+", "_", f"{law.form}_of_{'_and_'.join(law.states)}").lower()
        names.append(f"{name}_{len(names) + 1}" if name in names else name)
    return names


def _fitted(found: Diagnosis, told: Discovery, law: Law, name: str, folder: Path) -> Hypothesis:
    """Fit a law as an effect beside those that the search for it began with."""
    term = Term(find_effect(str(write_law(law, told.origin, folder, name, ""))))
    base, known = found.search.base, told.base.solution.values
    beside = [t for t in told.base.objective.terms if t not in base.objective.terms]
    starts = {t.label: {n: known[f"{t.label}.{n}"] for n in t.effect.parameter_names} for t in beside}
    return polish(refit(base, [*beside, term], {**starts, term.label: term.effect.typical()}))
