"""What leaving each effect out changes, as rows of a table: slip, energy, load, and the channel that changes most."""

from slipwise.diagnosis.result import Diagnosis
from slipwise.selection.importance import Change, Importance
from slipwise.view.words.diagnosis_words import percent

_CALLED = {"peak_slip": "peak slip", "energy": "energy", "largest_load": "largest load"}
#: The same in a terminal of eighty letters.
_BRIEF = {"peak_slip": "slip", "energy": "energy", "largest_load": "load"}
#: In the place of a number that an effect cannot have: the fault of a gauge changes a reading and not the rig.
_NOTHING = "-"


def importance_rows(found: Diagnosis, *, brief: bool = False) -> list[dict[str, str]]:
    """Return one row for every effect that was found, most important first.

    Args:
        found: the diagnosis.
        brief: short headings, and no 95 % interval behind a change.
    """
    called = _BRIEF if brief else _CALLED
    shown = found.importance
    asked = [r for r in _CALLED if any(r in i.responses for i in shown.values() if not i.gauge)]
    return [
        {
            "without": name,
            **{called[r]: _response(i, r, intervals=not brief) for r in asked},
            **_largest(i),
            "it is": "material" if name in found.verdict.effects else "minor",
        }
        for name, i in shown.items()
    ]


def replayed_run(found: Diagnosis) -> str:
    """Say in which run slip, energy and load without an effect are told."""
    objective = found.search.base.objective
    if objective.held_out:
        return f"the held-out run {objective.run(objective.held_out[0]).name}"
    return f"the last run, {objective.run(objective.fitted[-1]).name}"


def _response(of: Importance, name: str, *, intervals: bool) -> str:
    change = of.responses.get(name)
    return _NOTHING if change is None or of.gauge else changed(change, intervals=intervals)


def changed(change: Change, *, intervals: bool = True) -> str:
    """Write a relative change in per cent: "+5.0 % (+4.0 to +6.0)"."""
    value, low, high = (f"{round(100.0 * x, 1) or 0.0:+.1f}" for x in (change.value, change.low, change.high))
    return f"{value} % ({low} to {high})" if intervals else f"{value} %"


def _largest(of: Importance) -> dict[str, str]:
    name = max(of.channels, key=lambda c: of.channels[c], default="")
    return {"most in": name, "by": percent(of.channels[name])} if name else {"most in": _NOTHING, "by": _NOTHING}
