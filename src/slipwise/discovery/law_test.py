"""Whether a law that was found in one campaign holds in another: as it stands, with another size, or not at all.

The law is put beside what the second campaign's own diagnosis names, and everything else is fitted again: without it,
with every number of the law as its file has it, with its strength free, and with all of its numbers free. What these
leave is compared by the likelihood, samples counted as few as in the posterior: a model's own small errors are
systematic, and with every sample any two campaigns would be unlike.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.diagnosis.result import Diagnosis
from slipwise.display import Tabular
from slipwise.effects import Effect
from slipwise.errors import SettingError
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import Interval, compute_two_sided_intervals
from slipwise.estimation.least_squares import Solution, get_slopes, solve, with_slopes
from slipwise.estimation.objective import Objective
from slipwise.evidence.prior import Prior
from slipwise.relations.parameters import Free, Term
from slipwise.selection.candidates import at_odds
from slipwise.selection.hypothesis import Hypothesis, prepare_refit
from slipwise.selection.initial_grid import REFERENCES, strengths

#: What a law must be worth to be there, and what a change of its numbers must be worth to be needed [nats].
_THERE, _NEEDED = -float(np.log(Prior().chance)), 2.0
#: A fit ends where a step lowers the squared residual by less than this, and than this share of what is left [1].
_ENOUGH, _ROUGH = 5.0, 1e-4
#: Stands in the file of every law that `discover` writes.
MARK = "It is a law of the data."


@dataclass(frozen=True, repr=False)
class LawTest(Tabular):
    """How a law of one campaign does in another.

    Attributes:
        law: its name.
        campaign: in which it was tested.
        holds: "as it stands", "with another size", "with other constants", "not at all", or "cannot tell".
        size: its strength here over that of its file, the rest of its form as in the file [1]; NaN where it is not
            there.
        low: lower end of the 95 % interval of that.
        high: upper end.
        errors: largest error of a relation in the fitted runs without it, as it stands, with its size free, and with
            all of its numbers free [floors].
        constants: name -> its number where all are free, with the 95 % interval [SI]; NaN where the data leave it open.
        beside: effects that the diagnosis of this campaign names beside it.
    """

    law: str
    campaign: str
    holds: str
    size: float
    low: float
    high: float
    errors: tuple[float, float, float, float]
    constants: dict[str, tuple[float, float, float]]
    beside: tuple[str, ...]

    @property
    def sentence(self) -> str:
        """The answer in words."""
        without, stands, sized, _ = self.errors
        factor = f"{self.size:.3g} ({self.low:.3g} to {self.high:.3g}) times that of its file"
        told = {
            "as it stands": f"holds as it stands: error {without:.2f} floors without it, {stands:.2f} with it; a "
            f"strength of {factor} would fit best",
            "with another size": f"holds with another size, {factor}: error {without:.2f} floors without it, "
            f"{sized:.2f} with it",
            "with other constants": "holds in its form only, with other constants: as it stands the error is "
            f"{stands:.2f} floors, with its own constants here {self.errors[3]:.2f}",
            "not at all": f"does not hold: error {without:.2f} floors without it, {stands:.2f} with it as it stands, "
            f"{sized:.2f} with its strength free",
            "cannot tell": "cannot be judged here: in these motions it changes too little to be seen; the driving "
            "state has to vary as far as its file says it is valid",
        }[self.holds]
        return f'The law "{self.law}" in {self.campaign} {told}.'

    def as_json(self) -> dict[str, Any]:
        """Return the answer for a program to read."""
        known = {"size": self.size, "low": self.low, "high": self.high}
        return {
            "law": self.law,
            "campaign": self.campaign,
            "holds": self.holds,
            **{k: v if v == v else None for k, v in known.items()},
            "errors": dict(zip(("without", "as it stands", "size free", "all free"), self.errors, strict=True)),
            "constants": {name: _known(of) for name, of in self.constants.items()},
            "beside": list(self.beside),
            "words": self.sentence,
        }

    def _headline(self) -> str:
        return self.sentence

    def _rows(self) -> list[dict[str, Any]]:
        return [{"constant": name, **dict(zip(("value", "low", "high"), of, strict=True))}
                for name, of in self.constants.items()]  # fmt: skip


@dataclass(frozen=True, repr=False)
class LawTests(Tabular):
    """How several laws do in one campaign.

    Attributes:
        tests: of each law.
    """

    tests: tuple[LawTest, ...]

    def as_json(self) -> dict[str, Any]:
        """Return the answers for a program to read."""
        return {"schema": 1, "laws": [test.as_json() for test in self.tests]}

    def _headline(self) -> str:
        return " ".join(test.sentence for test in self.tests) or "no law was given"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"law": t.law, "campaign": t.campaign, "holds": t.holds, "size": t.size, "low": t.low, "high": t.high}
            for t in self.tests
        ]


def _known(of: tuple[float, float, float]) -> dict[str, float | None]:
    """Return a number for JSON, which has none that is not known."""
    return {name: x if x == x else None for name, x in zip(("value", "low", "high"), of, strict=True)}


def hold_laws_against(found: Diagnosis, own: Iterable[Effect]) -> LawTests:
    """Say whether laws that `discover` wrote in other campaigns hold in this one; other effects are passed over.

    Args:
        found: the diagnosis of the campaign; the laws may have competed in it.
        own: effects of a user's files.
    """
    return LawTests(tuple(hold_law_against(found, effect) for effect in own if MARK in effect.text))


def hold_law_against(found: Diagnosis, law: Effect) -> LawTest:
    """Say whether a law holds in a campaign.

    Args:
        found: the diagnosis of the campaign; the law may have competed in it.
        law: the effect of the file.

    Raises:
        SettingError: the law has no strength that could be another one here.
    """
    sizes = strengths(law)
    if not sizes:
        raise SettingError(f"{law.name} has no strength: it cannot be said whether it holds with another size")
    base, ended = found.search.base, found.search.final
    term = Term(law)
    rest = [t for t in ended.terms if t.effect.name != law.name and not at_odds(t, term)]
    objective = base.objective.adding(*rest)
    starts = {t.label: ended.values_of(t) for t in rest}
    plain, free = prepare_refit(base, objective, rest, starts)
    without = _solve(objective, plain, free, ended)
    with_law = objective.adding(term)
    values, more = prepare_refit(base, with_law, [*rest, term], {**starts, term.label: law.typical()})
    values |= {k: v for k, v in without.values.items() if k in values}
    values |= {f"{term.label}.{n}": v for n, v in law.typical().items()}
    own = {f"{term.label}.{p.name}" for p in law.parameters}
    size_keys = {f"{term.label}.{p.name}" for p in sizes}
    fixed = [f for f in more if f.key not in own]
    stands = _solve(with_law, values, fixed, without)
    sized = _solve(with_law, stands.values, [f for f in more if f.key not in own - size_keys], stands)
    every = [f for f in more if f.key not in own or f.key.rpartition(".")[2] not in REFERENCES]
    freed = _solve(with_law, sized.values, every, sized) if len(every) > len(fixed) + len(size_keys) else sized
    fits = [(objective, without), (with_law, stands), (with_law, sized), (with_law, freed)]
    nats = [_log_likelihood(o, s) for o, s in fits]
    key = f"{term.label}.{sizes[0].name}"
    factor = 1.0 / law.typical()[sizes[0].name] if law.typical()[sizes[0].name] else float("nan")
    entry = _intervals(base, with_law, sized)[key]
    own_form = _intervals(base, with_law, freed)
    ends = sorted((entry.low * factor, entry.high * factor))
    constants = {p.name: freed.values[f"{term.label}.{p.name}"] for p in law.parameters}
    known = {n: own_form[k] for n in constants if (k := f"{term.label}.{n}") in own_form}
    return LawTest(
        law=law.name,
        campaign=found.campaign,
        holds=judge(nats, (ends[0], ends[1])),
        size=sized.values[key] * factor,
        low=ends[0],
        high=ends[1],
        errors=(_largest(*fits[0]), _largest(*fits[1]), _largest(*fits[2]), _largest(*fits[3])),
        constants={n: (x, known[n].low, known[n].high) if n in known else (x, x, x) for n, x in constants.items()},
        beside=tuple(dict.fromkeys(t.effect.name for t in rest)),
    )


def _intervals(base: BaseFit, objective: Objective, solution: Solution) -> dict[str, Interval]:
    ended = with_slopes(objective, solution)
    fit = BaseFit(base.campaign, base.model, objective, ended.free, ended)
    return {i.key: i for i in compute_two_sided_intervals(fit).entries}


def judge(nats: Sequence[float], size: tuple[float, float]) -> str:
    """Return how a law holds.

    Args:
        nats: likelihoods without it, as it stands, with its size free, and with all of its numbers free.
        size: ends of the 95 % interval of its size, over that of its file [1]; one that holds zero is none.
    """
    without, stands, sized, freed = nats
    other = freed - sized > _THERE
    if freed - without < _THERE or (not other and size[0] <= 0.0 <= size[1]):  # should it be seen here?
        return "not at all" if without - stands > _NEEDED else "cannot tell"
    if other:
        return "with other constants"
    return "with another size" if sized - stands > _NEEDED else "as it stands"


def _solve(
    objective: Objective, values: dict[str, float], free: Sequence[Free], near: Solution | Hypothesis
) -> Solution:
    known = get_slopes(near.solution if isinstance(near, Hypothesis) else near)
    begin = {k: v for k, v in known.items() if k in {f.key for f in free}}
    start = {**values, **{f.key: float(np.clip(values[f.key], f.low, f.high)) for f in free}}
    return solve(objective, start, free, most=8, enough=_ENOUGH, rough=_ROUGH, begin=begin)


def _log_likelihood(objective: Objective, solution: Solution) -> float:
    """Return the logarithm of the likelihood of the fitted runs, a relation counted as few samples [nats]."""
    prior, out = Prior(), 0.0
    for relation in objective.relations:
        count = min(float(solution.residuals.count(relation, objective.fitted)), prior.independent)
        level = max(solution.residuals.mean_square(relation, objective.fitted), prior.floor)
        out -= 0.5 * count * float(np.log(level))
    return out


def _largest(objective: Objective, solution: Solution) -> float:
    return max(solution.residuals.level(r, objective.fitted) for r in objective.relations)
