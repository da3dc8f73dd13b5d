"""What a verdict leaves open: explanations and what would tell each two of them apart, and what comes nearest."""

from collections.abc import Mapping
from itertools import combinations, product

from slipwise.diagnosis.findings import compute_excess_over_noise
from slipwise.diagnosis.indistinguishable import list_alike_pairs, list_known_effects
from slipwise.diagnosis.verdict import Verdict
from slipwise.effects import Effect
from slipwise.selection.search_state import Search

Explanation = tuple[str, ...]
#: A law that explains less is not near [1].
_LEAST_SHARE = 0.05


def find_nearest_family(state: Search) -> tuple[str, float] | None:
    """Return the law of the catalogue that alone explains most, and its share of what stands above the noise [1].

    None where no law explains as much as `_LEAST_SHARE`. What is not straight in a law's size is left out.
    """
    summary = state.path[0].summary
    over = max(compute_excess_over_noise(summary, summary), 1e-12)
    laws = [a for a in state.alone if a.term.effect.component != "instrument"]
    best = max(laws, key=lambda a: a.gain, default=None)
    share = min(best.gain / over, 1.0) if best is not None else 0.0
    return (best.term.effect.name, share) if best is not None and share >= _LEAST_SHARE else None


def list_explanations(found: Verdict, state: Search) -> tuple[Explanation, ...]:
    """Return what may be missing, each as the names of all its effects: one unless the verdict is ambiguous.

    Args:
        found: the verdict.
        state: of the search.
    """
    if found.kind != "ambiguous":
        return (found.effects,) if found.effects else ()
    unlike: list[Explanation] = []
    best = state.best.names
    if found.rivals:
        for names in (best, *(h.names for h in found.rivals)):
            if set(names) not in map(set, unlike):  # the same effects in another order are no other explanation
                unlike.append(names)
    else:
        pair = next(
            (p for p in list_alike_pairs(list_known_effects(state).values()) if p & set(best)), frozenset(found.effects)
        )
        unlike = [(name,) for name in found.effects if name in pair]
    rivals = {name for names in unlike for name in names}
    sure = tuple(name for name in found.effects if name not in rivals)
    return tuple((*names, *sure) for names in unlike)


def list_discriminating_tests(found: Verdict, state: Search) -> tuple[str, ...]:
    """Say for each two explanations of an ambiguous verdict what would tell them apart; nothing for another verdict."""
    known = list_known_effects(state)
    out = []
    for one, other in combinations(list_explanations(found, state), 2):
        ours, theirs = (tuple(n for n in a if n not in b) for a, b in ((one, other), (other, one)))
        sentences = [words for pair in product(ours, theirs) if (words := _discriminating_test(*pair, known))]
        swap = f"{' + '.join(theirs) or 'nothing'} instead of {' + '.join(ours) or 'nothing'}"
        out.append(
            "; ".join(sentences) or f"{swap}: no effect's file names a test; `slipwise next` ranks table motions"
        )
    return tuple(out)


def _discriminating_test(one: str, other: str, known: Mapping[str, Effect]) -> str:
    """Return test of two effects from the file of either, in which "that" is the other one; "" if neither has it."""
    for effect, rival in ((one, other), (other, one)):
        test = known[effect].confused_with.get(rival) if effect in known else None
        if test:
            return f"{rival} instead of {effect}: {test}"
    return ""
