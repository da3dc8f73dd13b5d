"""Property modification factors and coefficients as the standards name them, as far as a test has measured them.

    ASCE/SEI 7, 17.2.8.4:   lambda_max = [1 + 0.75 (lambda_ae,max - 1)] lambda_test,max lambda_spec,max
                            lambda_min = [1 - 0.75 (1 - lambda_ae,min)] lambda_test,min lambda_spec,min

Nominal is the mean of the first three cycles of the reference motion: the series of cycles that slides furthest, of
those with three cycles where there is one. lambda_test is the largest and the smallest cycle of that motion over
nominal; for the coefficient of friction, of all cyclic motions too, which differ in speed, load and stroke. lambda_spec
is the largest and the smallest pad over the mean of the pads. lambda_ae, of ageing and environment, no such test
measures: it is taken as 1 in the product, which is said beside it.

EN 15129 names the upper and lower bound design properties (UBDP, LBDP), EN 1337-2 the static and the dynamic
coefficient.

Source: ASCE/SEI 7-16, sections 17.2.8.2 to 17.2.8.5; McVitty and Constantinou, MCEER-15-0005 (2015); EN 15129:2009;
EN 1998-2:2005, Annex J; EN 1337-2:2004, Annex D.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

#: Measured quantities of the closed cycles of one series of one stroke, in order.
CycleValues = Sequence[Mapping[str, float]]
ASCE, EN_ISOLATORS, EN_SLIDERS = "ASCE/SEI 7", "EN 15129", "EN 1337-2"
#: Cycles of the reference motion that are nominal.
NOMINAL_CYCLES = 3
#: A second slope adds less than this share of the strength over the stroke: its ratios say nothing [1].
_NO_SLOPE = 0.1
_WORDS = {
    "friction_mean": "coefficient of friction",
    "characteristic_strength": "characteristic strength Q_d",
    "second_slope_stiffness": "post-sliding stiffness K_d",
    "energy": "energy per cycle",
}


@dataclass(frozen=True)
class StandardValue:
    """A factor, a bound or a coefficient.

    Attributes:
        standard: that names it.
        name: as it is named there.
        quantity: of which.
        value: measured [1].
        basis: what it was measured on.
    """

    standard: str
    name: str
    quantity: str
    value: float
    basis: str


def choose_reference(cyclic: Mapping[str, CycleValues]) -> str:
    """Return the series of cycles that is nominal.

    Args:
        cyclic: name of a series -> its cycles, of the sum of the pads; at least one.
    """

    def rank(name: str) -> tuple[bool, float]:
        cycles = cyclic[name]
        return len(cycles) >= NOMINAL_CYCLES, float(
            np.mean([c["displacement_max"] - c["displacement_min"] for c in cycles])
        )

    return max(cyclic, key=rank)


def list_factors(
    cyclic: Mapping[str, CycleValues], pads: Mapping[str, CycleValues], first: Mapping[str, float]
) -> list[StandardValue]:
    """Return what standards ask of a bearing and the test has measured.

    Args:
        cyclic: name of a series -> its cycles, of the sum of the pads or of the only pad.
        pads: pad -> its cycles of the reference motion; of several pads.
        first: run -> coefficient of the first movement of the sum, for runs that begin at rest.
    """
    out: list[StandardValue] = []
    if cyclic:
        reference = choose_reference(cyclic)
        out += _asce(reference, cyclic, pads) + _en_isolators(reference, cyclic)
    return out + _en_sliders(cyclic, first)


def _asce(reference: str, cyclic: Mapping[str, CycleValues], pads: Mapping[str, CycleValues]) -> list[StandardValue]:
    out, product = [], {"max": float("nan"), "min": float("nan")}
    for key, words in _WORDS.items():
        if (found := _test_factors(cyclic[reference], key)) is None:
            continue
        basis = f"cycles of {reference} over their nominal"
        out += [StandardValue(ASCE, f"lambda_test,{end}", words, value, basis) for end, value in found.items()]
        if key == "characteristic_strength":
            product = found
    if len(cyclic) > 1:
        nominal = _nominal(cyclic[reference], "friction_mean")
        all_cycles = [c["friction_mean"] / nominal for cycles in cyclic.values() for c in cycles]
        basis = f"all cycles of {len(cyclic)} motions of other speeds, loads or strokes, over nominal of {reference}"
        ends = {"max": max(all_cycles), "min": min(all_cycles)}
        out += [StandardValue(ASCE, f"lambda_test,{e}", _WORDS["friction_mean"], v, basis) for e, v in ends.items()]
    spec = {"max": 1.0, "min": 1.0}
    if len(pads) > 1:
        means = [_nominal(cycles, "friction_mean") for cycles in pads.values()]
        spec = {"max": max(means) / float(np.mean(means)), "min": min(means) / float(np.mean(means))}
        basis = f"{len(pads)} pads of this specimen in {reference}, each over their mean"
        out += [StandardValue(ASCE, f"lambda_spec,{e}", _WORDS["friction_mean"], v, basis) for e, v in spec.items()]
    parts = "lambda_test of Q_d" + (" times lambda_spec" if len(pads) > 1 else "")
    for end in ("max", "min"):
        value = product[end] * spec[end]
        basis = f"{parts}; lambda_ae was not measured and is taken as 1"
        out.append(StandardValue(ASCE, f"lambda_{end}", _WORDS["characteristic_strength"], value, basis))
    return [one for one in out if np.isfinite(one.value)]


def _en_isolators(reference: str, cyclic: Mapping[str, CycleValues]) -> list[StandardValue]:
    nominal = _nominal(cyclic[reference], "friction_mean")
    every = [c["friction_mean"] for cycles in cyclic.values() for c in cycles]
    words, basis = _WORDS["friction_mean"], f"all cycles of {', '.join(cyclic)}"
    found = {"upper bound (UBDP)": max(every), "lower bound (LBDP)": min(every)}
    out = [StandardValue(EN_ISOLATORS, "nominal", words, nominal, f"first cycles of {reference}")]
    out += [StandardValue(EN_ISOLATORS, name, words, value, basis) for name, value in found.items()]
    out += [
        StandardValue(EN_ISOLATORS, f"{name} over nominal", words, value / nominal, basis)
        for name, value in found.items()
    ]
    return [one for one in out if np.isfinite(one.value)]


def _en_sliders(cyclic: Mapping[str, CycleValues], first: Mapping[str, float]) -> list[StandardValue]:
    out = []
    if first:
        run = max(first, key=lambda name: first[name])
        out.append(StandardValue(EN_SLIDERS, "static coefficient, largest", "first movement", first[run], f"{run}"))
    every = {run: [c["friction_mean"] for c in cycles] for run, cycles in cyclic.items()}
    if every:
        run = max(every, key=lambda name: max(every[name]))
        basis = f"cycle {int(np.argmax(every[run])) + 1} of {run}"
        out.append(StandardValue(EN_SLIDERS, "dynamic coefficient, largest", "a whole cycle", max(every[run]), basis))
    return [one for one in out if np.isfinite(one.value)]


def _test_factors(cycles: CycleValues, key: str) -> dict[str, float] | None:
    """Return the largest and the smallest cycle over nominal; None of a single cycle, or a slope that is none."""
    nominal = _nominal(cycles, key)
    if len(cycles) < 2 or not np.isfinite(nominal):
        return None
    if key == "second_slope_stiffness":
        half = 0.5 * np.mean([c["displacement_max"] - c["displacement_min"] for c in cycles])
        if abs(nominal) * half < _NO_SLOPE * abs(_nominal(cycles, "characteristic_strength")):
            return None
    over = [c[key] / nominal for c in cycles if np.isfinite(c[key])]
    if min(over) <= 0.0:  # a slope that is there has one sign
        return None
    return {"max": max(over), "min": min(over)}


def _nominal(cycles: CycleValues, key: str) -> float:
    known = [c[key] for c in cycles[:NOMINAL_CYCLES] if np.isfinite(c[key])]
    return float(np.mean(known)) if known else float("nan")
