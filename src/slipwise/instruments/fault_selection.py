"""Which suspects stand: forward choice among suspects and physics, then what speaks for each suspect."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.instruments.acceptance import Evidence, possible, weigh
from slipwise.instruments.candidate_gain import supports
from slipwise.instruments.delay_or_filter import is_delay
from slipwise.instruments.disturbances import Alternative, alternatives
from slipwise.instruments.joint_fit import Case, JointFit, fit, noise_with_itself, signature, start
from slipwise.instruments.suspects import Suspect, suspects
from slipwise.relations.balance_rows import Block

#: Explanations that are tried at most, refused ones included.
_MOST = 10
#: Candidates that are fitted in each step, and how near to the best they must be for that [1].
_TRIED, _NEAR = 4, 0.4
#: Least gain of the score for an explanation to be taken up.
_WORTH = 12.0
#: A filter must explain more than a delay by this, in units of the score: of 36 plantings true delays lay at most 22
#: behind a filter, true filters at least 93 ahead of a delay.
_ALIKE = 45.0


@dataclass(frozen=True)
class FaultSelection:
    """The faults that were selected.

    Attributes:
        fit: the last joint fit.
        accepted: suspects that stand, with reasons in numbers.
        small: suspects that are there, but too small to matter.
        refused: suspects that explained something but not as a fault would.
        physics: names of physical alternatives that were taken up.
    """

    fit: JointFit
    accepted: tuple[Evidence, ...]
    small: tuple[Evidence, ...]
    refused: tuple[Evidence, ...]
    physics: tuple[str, ...]


def select_faults(case: Case, begun: JointFit | None = None) -> FaultSelection:
    """Choose explanations one by one until nothing is worth another.

    Args:
        case: what is judged.
        begun: its fit of constants alone, if there is one.
    """
    first = here = begun or start(case)
    # before physics is named, what a fault that stands has left is what the next one has to explain
    plain = first
    candidates: list[Suspect | Alternative] = [*suspects(case.runs[0].record, case.specimen, case.effects)]
    blocks: list[Block] = []
    itself: list[Mapping[str, float]] = []
    one_sided: list[bool] = []
    for who in candidates:
        assert isinstance(who, Suspect)
        blocks.append(signature(case, who, first.corrected, first.stack, first.constants))
        itself.append(noise_with_itself(case, who, first.corrected, first.stack, first.constants))
        one_sided.append(who.one_sided)
    for alternative in alternatives(case.runs, case.relations, case.effects, case.specimen):
        candidates.append(alternative)
        blocks.append(alternative.columns)
        itself.append({})
        one_sided.append(False)
    accepted: list[Evidence] = []
    refused: list[Evidence] = []
    small: list[Evidence] = []
    for _ in range(_MOST):
        found = supports(here, case, blocks, itself, one_sided)
        fits = {i: _with(case, here, candidates[i]) for i in _to_try(found)}
        for i, tried in fits.items():
            # signatures are taken at small sizes: a large delay explains more than its signature does
            found[i] = tried.score - here.score
        best = max(fits, key=lambda i: float(found[i]), default=-1)
        if best < 0:
            break
        best, fuller = _plainer(case, here, candidates, found, fits, best), best
        chosen, worth = candidates[best], float(found[best])
        others = [(c, worth - float(g)) for c, g in zip(candidates, found, strict=True)]
        # a fuller form that gave way is no rival
        against = [(_called(c), loss) for c, loss in others if fuller == best or not _is_fuller(c, chosen)]
        rivals = sorted(against, key=_loss)
        for pile in (candidates, blocks, itself, one_sided):
            del pile[best]
        if worth < _WORTH:
            continue
        if isinstance(chosen, Alternative):
            here = fits[best]
            continue
        tried = fits[best]
        evidence = weigh(case, plain, here, tried, len(tried.model.sizes) - 1)
        if evidence.why_not and not evidence.small:
            best, disturbed = _disturbed(case, tried, candidates, blocks, itself, one_sided)
            if disturbed is not None:
                again = weigh(case, plain, here, disturbed, len(tried.model.sizes) - 1)
                other = weigh(case, plain, tried, disturbed, len(tried.model.sizes))
                if not again.why_not and other.small and possible(other):
                    for pile in (candidates, blocks, itself, one_sided):
                        del pile[best]
                    evidence, tried = again, disturbed
                    small.append(other)
        if evidence.small and possible(evidence):
            # too small to matter, but true: it stays, lest its traces be given to others
            small.append(evidence)
            here = tried
        elif evidence.why_not:
            refused.append(evidence)
        else:
            accepted.append(replace(evidence, rivals=tuple(r for r in rivals if r[0] != _called(chosen))[:6]))
            here = tried
            plain = plain if here.model.physics else here
    physics = tuple(a.name for a in here.model.physics)
    return FaultSelection(here, _as_fitted_last(accepted, here), _as_fitted_last(small, here), tuple(refused), physics)


def _disturbed(
    case: Case,
    tried: JointFit,
    candidates: Sequence[Suspect | Alternative],
    blocks: Sequence[Block],
    itself: Sequence[Mapping[str, float]],
    one_sided: Sequence[bool],
) -> tuple[int, JointFit | None]:
    """Return the suspect that explains most of what a fit leaves, and the fit with it; none where none is worth it.

    Cards that are a tenth of a millisecond apart matter to nobody, but may bend what a balance says of another gauge.
    """
    found = supports(tried, case, blocks, itself, one_sided)
    number = int(np.argmax(found)) if len(found) else -1
    if number < 0 or found[number] < _WORTH or not isinstance(candidates[number], Suspect):
        return -1, None
    return number, _with(case, tried, candidates[number])


def _as_fitted_last(evidence: Sequence[Evidence], last: JointFit) -> tuple[Evidence, ...]:
    """Return evidence with the sizes of the last joint fit: what was named later had disturbed the earlier ones."""
    sizes = {who.key: (size, error) for (who, size), error in zip(last.model.sizes, last.errors, strict=True)}
    return tuple(replace(e, size=sizes[e.suspect.key][0], error=sizes[e.suspect.key][1]) for e in evidence)


def _plainer(
    case: Case,
    here: JointFit,
    candidates: Sequence[Suspect | Alternative],
    found: Array,
    fits: dict[int, JointFit],
    best: int,
) -> int:
    """Take the plainer form where the best explains hardly more, or is no other thing; fit it where it was not.

    Below the band's edge filter and delay are nearly one.
    """
    who = candidates[best]
    for i, other in enumerate(candidates):
        if isinstance(who, Suspect) and _is_fuller(who, other):
            if i not in fits:
                fits[i] = _with(case, here, other)
                found[i] = fits[i].score - here.score
            same = is_delay(who.effect, who.values(fits[best].model.sizes[-1][1]), case.passed)
            if found[i] > _WORTH and (same or found[i] > found[best] - _ALIKE):
                return i
    return best


def _is_fuller(who: Suspect | Alternative, other: Suspect | Alternative) -> bool:
    """Return whether a suspect is the fuller form of another on the same gauges: a filter of a delay."""
    if not isinstance(who, Suspect) or not isinstance(other, Suspect):
        return False
    return (who.effect.plainer, who.target) == (other.effect.name, other.target)


def _loss(rival: tuple[str, float]) -> float:
    return rival[1]


def _to_try(found: Array) -> list[int]:
    """Return the numbers of the candidates that are worth a fit of their own: the best few that are near the best."""
    if len(found) == 0:
        return []
    best = np.argsort(-found)[:_TRIED]
    return [int(i) for i in best if found[i] > max(_WORTH, _NEAR * found[best[0]])]


def _with(case: Case, here: JointFit, who: Suspect | Alternative) -> JointFit:
    if isinstance(who, Alternative):
        model = replace(here.model, physics=(*here.model.physics, who))
    else:
        model = replace(here.model, sizes=(*here.model.sizes, (who, 0.0)))
    return fit(case, model, here.constants)


def _called(who: Suspect | Alternative) -> str:
    return who.name if isinstance(who, Alternative) else f"{who.effect.name} {who.label}"
