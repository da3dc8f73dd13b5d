"""Whether a verdict on a family's campaign is right, by its answer key.

Right: every planted effect of one limit of materiality and one floor or more is named or listed among the minor ones,
and nothing is named that is below 0.7 limits.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Any

from slipwise_benchmarks.score import BASE, SAME
from slipwise_benchmarks.score_dirty import ALSO

#: An effect may be named from so many limits of materiality on [1].
MAY_BE_NAMED = 0.7
#: Faults that samples show by themselves, however little they change: who names one that was planted accuses nobody.
SHOWN_BY_SAMPLES = frozenset({"channel_clipping", "dropped_samples"})
Answer = Mapping[str, Any]
Said = Mapping[str, Any]


def named(said: Said) -> set[str]:
    """Give what a verdict names; "unknown" where it says so, alone or beside names."""
    names = set(said.get("effects") or []) - BASE
    unknown = said.get("verdict") == "unknown" or said.get("leftover") == "unknown"
    return names | {"unknown"} if unknown else names


def listed(said: Said) -> set[str]:
    """Give what a verdict names or lists among what is there and hardly matters."""
    return named(said) | (set(said.get("minor") or []) - BASE)


def may_be_named(answer: Answer) -> set[str]:
    """Give every name that is no accusation: near what is material, what stands for it, what tells a first thing."""
    near = {name for name, entry in answer["effects"].items() if entry["of_limit"] >= MAY_BE_NAMED}
    near |= SHOWN_BY_SAMPLES & answer.get("details", {}).keys()
    near |= {other for name in near for other in answer["alternatives"].get(name, ())}
    near |= {other for name in near for pair in SAME if name in pair for other in pair}
    return near.union(*(ALSO.get(one["kind"], set()) for one in answer["first"]))


def missed(answer: Answer, said: Said) -> set[str]:
    """Give needed names that are neither named nor listed, nor what counts for them."""
    given = listed(said)
    return {name for name in answer["missing"] if not given & _counting_for(answer, name)}


def accused(answer: Answer, said: Said) -> set[str]:
    """Give names that are below what may be named."""
    return named(said) - may_be_named(answer)


def right(answer: Answer, said: Said) -> bool:
    """Tell whether nothing is missed and nothing is accused; a diagnosis that failed is wrong."""
    if str(said.get("verdict", "failed")).startswith("failed"):
        return False
    return not missed(answer, said) and not accused(answer, said)


def rates(results: Iterable[tuple[Answer, Said]]) -> dict[str, tuple[int, int]]:
    """Give how many are right, of how many: in all trained families, by maker, by family, and held-out ones apart."""
    flags: dict[str, list[bool]] = defaultdict(list)
    for answer, said in results:
        good = right(answer, said)
        flags["held-out families" if answer["held_out_family"] else "families of training"].append(good)
        flags[f"maker {answer['maker']}"].append(good)
        flags[f"family {answer['family']}"].append(good)
    return {name: (sum(values), len(values)) for name, values in flags.items()}


def _counting_for(answer: Answer, name: str) -> set[str]:
    pairs = [pair for pair in SAME if name in pair]
    return {name, *answer["alternatives"].get(name, ())}.union(*pairs)
