"""What an ambiguous verdict leaves open: the explanations, and what would tell each two of them apart."""

from collections.abc import Mapping, Sequence
from itertools import combinations, product

from slipwise.diagnosis.candidates import ONE_THING
from slipwise.diagnosis.search_state import Search
from slipwise.diagnosis.verdict import Verdict
from slipwise.effects import Effect, catalogue

Explanation = tuple[str, ...]


def explanations(found: Verdict, best: Sequence[str]) -> tuple[Explanation, ...]:
    """Give what may be missing, each as the names of all its effects: one explanation unless the verdict is ambiguous.

    Args:
        found: the verdict.
        best: names of the hypothesis at which the search ended.
    """
    if found.kind != "ambiguous":
        return (found.effects,) if found.effects else ()
    told: list[Explanation] = []
    if found.rivals:
        for names in (tuple(best), *(h.names for h in found.rivals)):
            if set(names) not in map(set, told):  # the same effects in another order are no other explanation
                told.append(names)
    else:
        pair = next((p for p in ONE_THING if p & set(best)), frozenset(found.effects))
        told = [(name,) for name in found.effects if name in pair]
    rivals = {name for names in told for name in names}
    sure = tuple(name for name in found.effects if name not in rivals)
    return tuple((*names, *sure) for names in told)


def partings(found: Verdict, state: Search) -> tuple[str, ...]:
    """Say for each two explanations of an ambiguous verdict what would tell them apart; nothing for another verdict."""
    known = known_effects(state)
    out = []
    for one, other in combinations(explanations(found, state.best.names), 2):
        ours, theirs = (tuple(n for n in a if n not in b) for a, b in ((one, other), (other, one)))
        told = [words for pair in product(ours, theirs) if (words := _told_apart(*pair, known))]
        swap = f"{' + '.join(theirs) or 'nothing'} instead of {' + '.join(ours) or 'nothing'}"
        out.append("; ".join(told) or f"{swap}: no effect's file names a test; `slipwise next` ranks table motions")
    return tuple(out)


def known_effects(state: Search) -> dict[str, Effect]:
    """Give the catalogue and a user's own effects that were looked at, by name."""
    return {**catalogue(), **{t.effect.name: t.effect for t in state.terms}}


def _told_apart(one: str, other: str, known: Mapping[str, Effect]) -> str:
    """Give the test of two effects from the file of either, in which "that" is the other one; "" if neither has it."""
    for effect, rival in ((one, other), (other, one)):
        test = known[effect].confused_with.get(rival) if effect in known else None
        if test:
            return f"{rival} instead of {effect}: {test}"
    return ""
