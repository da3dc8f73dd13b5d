"""How right discovered laws are: state, port, parity, form, constants, what they explain, and what is claimed too much.

A result holds name, truth (truth.json of a campaign) and said (what `slipwise discover --json` prints). Only the first
law of an answer is held against the truth; any other is one too many.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

from slipwise_benchmarks.score_constants import constant_rows

Truth = dict[str, Any]
Said = dict[str, Any]
Result = dict[str, Any]
#: Share of the held-out excess that a law should explain [1], and error that it should leave [floors].
EXPLAINED, DOWN = 0.95, 1.25
#: Most forms that may be listed, the first one included.
MOST_FORMS = 3
#: Forms that the library calls by other names than the bench.
FORMS: dict[str, str] = {"saturation": "tanh", "decay": "exp", "logarithm": "log", "linear x linear": "product"}
#: Forms that read alike over a part of their range: a mistake among them is a small one, and a mistake all the same.
NEAR: tuple[frozenset[str], ...] = (
    frozenset({"bump", "lorentz"}),
    frozenset({"tanh", "step", "hinge", "linear", "power"}),
    frozenset({"linear", "square", "power"}),
    frozenset({"exp", "lorentz", "tanh", "bump"}),
)


def first_law(said: Said) -> dict[str, Any]:
    """Give the first law of an answer, an empty one where there is none."""
    laws = said.get("laws") or []
    return laws[0] if laws else {}


def claims_law(said: Said) -> bool:
    """Tell whether an answer says that a law was found."""
    return said.get("evidence") == "law"


def in_library(truth: Truth) -> bool:
    """Tell whether there is a law that the states of the library drive."""
    return truth["law"] is not None and truth["law"]["driver"] == "in library"


def state_right(truth: Truth, said: Said) -> bool:
    """Tell whether exactly the driving states are given, in any order."""
    return sorted(first_law(said).get("states") or []) == sorted(truth["law"]["state"])


def port_right(truth: Truth, said: Said) -> bool:
    """Tell whether port and parity are right; a law that differs by direction is neither odd nor even."""
    law, given = truth["law"], first_law(said)
    return given.get("port") == law["port"] and (law["by direction"] or given.get("parity") == law["parity"])


def where_right(truth: Truth, said: Said) -> bool:
    """Tell whether the pads are right on which a law acts."""
    return first_law(said).get("where") == truth["law"]["where"]


def forms(said: Said) -> list[str | None]:
    """Give the forms of the first law in the order in which they are listed, by the names of the bench."""
    law = first_law(said)
    given = [law["form"], *(form for form in law.get("tied") or [] if form != law["form"])] if law else []
    return [FORMS.get(form, form) for form in given]


def form_first(truth: Truth, said: Said) -> bool:
    """Tell whether the true form leads."""
    return forms(said)[:1] == [truth["law"]["form"]]


def form_listed(truth: Truth, said: Said) -> bool:
    """Tell whether the true form is listed, among at most three."""
    return truth["law"]["form"] in forms(said) and len(forms(said)) <= MOST_FORMS


def form_near(truth: Truth, said: Said) -> bool:
    """Tell whether the first form is another one that reads like the true one."""
    first, true = forms(said)[:1], truth["law"]["form"]
    return bool(first) and first[0] != true and any({first[0], true} <= alike for alike in NEAR)


def explained(said: Said) -> float | None:
    """Give the share of the held-out run's excess over noise that the laws explain [1]; None: nothing is told."""
    errors = said.get("held_out")
    if not errors or errors["before"] <= 1.0:
        return None
    return 1.0 - max(errors["after"] ** 2 - 1.0, 0.0) / (errors["before"] ** 2 - 1.0)


def law_right(truth: Truth, said: Said) -> bool:
    """Tell whether a claimed law is the one that is there: state, port, parity, and the form among those listed."""
    return in_library(truth) and all(check(truth, said) for check in (state_right, port_right, form_listed))


def wrongly_claimed(truth: Truth, said: Said) -> bool:
    """Tell whether a law is claimed that is not there."""
    return claims_law(said) and not law_right(truth, said)


_OF_LAWS: dict[str, Callable[[Truth, Said], bool]] = {
    "driving state right": state_right,
    "port and parity right": port_right,
    "pads right": where_right,
    "true form first": form_first,
    f"true form among at most {MOST_FORMS} listed": form_listed,
    "first form another that reads alike": form_near,
    f"held-out excess explained at least {EXPLAINED}": lambda _, said: (explained(said) or 0.0) >= EXPLAINED,
    f"held-out error at most {DOWN} floors": lambda _, said: (
        bool(said.get("held_out")) and said["held_out"]["after"] <= DOWN
    ),
    "law claimed": lambda _, said: claims_law(said),
    "law claimed and right": lambda truth, said: claims_law(said) and law_right(truth, said),
}
_OF_ALL: dict[str, Callable[[Truth, Said], bool]] = {
    "wrong law claimed": wrongly_claimed,
    "further law that is not there": lambda _, said: len(said.get("laws") or []) > 1,
}
#: Campaigns without a law, by what is in them instead.
_WITHOUT: dict[str, Callable[[Truth], bool]] = {
    "law claimed on a complete campaign": lambda truth: truth["law"] is None and not truth["beside"],
    "law claimed where only a known effect is": lambda truth: truth["law"] is None and bool(truth["beside"]),
    "law claimed though no state drives it": lambda truth: truth["law"] is not None and not in_library(truth),
}


def rates(results: Sequence[Result]) -> dict[str, list[int]]:
    """Give the counts that the targets speak of, each [how many, of how many]."""
    flags: dict[str, list[bool]] = defaultdict(list)
    for result in results:
        truth, said = result["truth"], result["said"]
        if in_library(truth):
            for name, check in _OF_LAWS.items():
                flags[name].append(bool(check(truth, said)))  # numpy's own truth adds up to what JSON has not
        for name, check in _OF_ALL.items():
            flags[name].append(bool(check(truth, said)))
        for name, belongs in _WITHOUT.items():
            if belongs(truth):
                flags[name].append(claims_law(said))
    held = constant_rows([r for r in results if in_library(r["truth"]) and form_first(r["truth"], r["said"])])
    flags["constants within 10 %"] = [row["within"] for row in held]
    flags["constants inside their 95 % interval"] = [row["inside"] for row in held]
    return {name: [sum(values), len(values)] for name, values in flags.items()}


def split(results: Sequence[Result]) -> dict[str, list[int]]:
    """Give how often the driving state was right, by kind of campaign, by port and by state."""
    flags: dict[str, list[bool]] = defaultdict(list)
    for result in results:
        truth = result["truth"]
        if not in_library(truth):
            continue
        good = state_right(truth, result["said"])
        beside = "beside a known effect" if truth["beside"] else "alone"
        law = truth["law"]
        kinds = ("dirty" if truth["dirty"] else "clean", beside, law["port"], " x ".join(law["state"]))
        for kind in kinds:
            flags[kind].append(good)
    return {name: [sum(values), len(values)] for name, values in flags.items()}


def wrong(results: Sequence[Result]) -> list[dict[str, Any]]:
    """Give every campaign whose answer is not right, what is there and what was said."""
    rows = []
    for result in results:
        truth, said = result["truth"], result["said"]
        quiet = not in_library(truth) and not claims_law(said)
        if not quiet and not law_right(truth, said):
            words = {"evidence": said.get("evidence"), "said": _words(first_law(said), "states")}
            rows.append({"campaign": result["name"], "there": _words(truth["law"] or {}, "state"), **words})
    return rows


def _words(law: dict[str, Any], states: str) -> str:
    if not law:
        return "nothing"
    return f"{law['form']} over {' x '.join(law[states])}, {law['port']}, {law['where']}, {law['parity']}"
