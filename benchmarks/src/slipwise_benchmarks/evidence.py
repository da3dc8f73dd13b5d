"""What a diagnosis decided by, in numbers: what `scripts/calibrate.py` fits the probabilities to."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.unknown_surface import leftover, structured
from slipwise.diagnosis.verdict import evidence_of, evidence_of_rest
from slipwise.evidence.calibration import Calibration, Logistic
from slipwise.evidence.decision import Decision, decide

#: A verdict's chance where that is the product of those of its parts.
PRODUCT = Logistic(0.0, {"product": 1.0})


def decide_by_product(row: Mapping[str, Any], parts: Calibration) -> Decision:
    """Decide by the parts of a calibration; the probability is the product of their chances.

    Args:
        row: of `scripts/17_verdicts.py`: "evidence", "rest", and "at_limit" with names that are not believed.
        parts: the calibration.
    """
    of = {name: one for name, one in row["evidence"].items() if name not in row["at_limit"]}
    return decide(of, row["rest"], Materiality().channel, replace(parts, all_right=PRODUCT))


def evidence_in(found: Diagnosis) -> dict[str, Any]:
    """Give the evidence for every effect of the final model, and on what is left.

    Returns:
        "effects": name -> the numbers of `evidence_of`, and "instead": names that the nearest rival has in its place;
        "rest": the numbers of `evidence_of_rest`; "path": labels of the effects at each step of the search.
    """
    state, verdict = found.search, found.verdict
    effects: dict[str, Any] = {}
    for finding in verdict.findings:
        rival = finding.rival.hypothesis.names if finding.rival else ()
        instead = [name for name in rival if name not in state.best.names]
        effects[finding.name] = {**evidence_of(finding), "instead": instead}
    surface = leftover(state.final)
    surface = surface if structured(surface) else None
    rest = evidence_of_rest(state.path[0], state.final, surface)
    return {"effects": effects, "rest": rest, "path": [[t.label for t in h.terms] for h in state.path]}
