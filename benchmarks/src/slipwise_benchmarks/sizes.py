"""Sizes that were planted, in the catalogue's own numbers, where both simulators write the law in the same form.

A hyperbolic run-in has no "rise" of an exponential one; such cases are left out.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from slipwise_benchmarks.score import right
from slipwise_benchmarks.settings import PAD_SIGN_X, PAD_SIGN_Y

Details = Mapping[str, Any]
#: Excursion at which the catalogue states the gain of a hardening buffer, over that of the bench [1].
_HARDENING = 1.5
#: Stiffness of a pad with which the catalogue turns a height into a load [N/m].
_RATED_PAD = 2.0e8


def _spread(d: Details) -> dict[str, float]:
    if len(d["pad_factor"]) != 4:  # each over the first
        first, *others = d["pad_factor"]
        return {f"level[{pad}]": factor / first - 1.0 for pad, factor in zip("BCDEFGH", others, strict=False)}
    factor, x, y = (np.asarray(v, dtype=float) for v in (d["pad_factor"], PAD_SIGN_X, PAD_SIGN_Y))
    modes = {"along": x, "across": y, "diagonal": x * y}
    return {name: float(np.mean(factor * mode)) for name, mode in modes.items()}


def _patch(d: Details) -> dict[str, float]:
    four = len(d["patch"]) == 4
    return {f"pad_{p.lower()}" if four else f"rise[{p}]": v for p, v in zip("ABCDEFGH", d["patch"], strict=False)}


def _filter(d: Details) -> dict[str, float]:
    first = d["form"] == "first order"
    return {"lag": (1.0 if first else np.sqrt(2.0)) / (2.0 * np.pi * d["size"])}


#: effect -> (forms that the catalogue writes in the same way, () for all; planted details -> its strengths).
_SAME_FORM: dict[str, tuple[tuple[str, ...], Callable[[Details], dict[str, float]]]] = {
    "anisotropy": ((), lambda d: {"ratio": 1.0 + d["anisotropy"]}),
    "breakaway": (("Gaussian in speed", "exponential in speed"), lambda d: {"rise": d["breakaway"]}),
    "buffer_damping": (("linear",), lambda d: {"damping": 0.5 * d["buffer_damping"]}),
    "buffer_hardening": ((), lambda d: {"gain": d["hardening"] * _HARDENING ** d["hardening_power"]}),
    "buffer_height": ((), lambda d: {"height": d["buffer_height"]}),
    "buffer_hysteresis": (("Bouc-Wen, exponent 1",), lambda d: {"strength": 0.5 * d["hysteresis_force"]}),
    "buffer_mismatch": ((), lambda d: {"difference": d["mismatch"]}),
    "buffer_softening": (("exponential in the largest excursion",), lambda d: {"rise": d["softening"]}),
    "cell_inertia": ((), lambda d: {"mass": d["size"]}),
    "channel_delay": ((), lambda d: {"delay": d["size"]}),
    "channel_filter": ((), _filter),
    "channel_gain": ((), lambda d: {"gain": d["size"]}),
    "clock_skew": ((), lambda d: {"skew": d["size"]}),
    "direction_asymmetry": ((), lambda d: {"difference": d["asymmetry"]}),
    "girder_bending": (("gauge at the supports",), lambda d: {"frequency": d["bending_frequency"]}),
    "guide_drag": (("linear",), lambda d: {"damping": d["drag"]}),
    "heating": (("half-space kernel, Kumar's factor",), lambda d: {"share": d["heat"]}),
    "key_clearance": ((), lambda d: {"clearance": d["clearance"]}),
    "key_friction": (("smooth in speed",), lambda d: {"friction": d["key_friction"]}),
    "load_crosstalk": ((), lambda d: {"share": d["size"]}),
    "mass_eccentricity": ((), lambda d: {"along": d["centre_x"], "across": d["centre_y"]}),
    "pad_spread": ((), _spread),
    "position_patch": (("Gaussian",), _patch),
    "presliding": (("Dahl",), lambda d: {"length": d["presliding_length"]}),
    "pressure_law": (("power",), lambda d: {"slope": d["pressure_size"]}),
    "rate_and_state": (("ageing law",), lambda d: {"direct": d["rate_direct"], "state": d["rate_evolution"]}),
    "run_in": (("exponential in distance",), lambda d: {"rise": d["wear"]}),
    "slide_curvature": ((), lambda d: {"curvature": d["curvature"]}),
    "slide_tilt": ((), lambda d: {"tilt": d["tilt"]}),
    "table_pitch": (("follows the table's acceleration",), lambda d: {"compliance": d["pitch_per_acceleration"]}),
}
#: Those whose numbers stand for the pads and two buffers of the girder in the middle of its pads.
_OF_GIRDER = {"uneven_seating", "mass_eccentricity", "buffer_damping", "buffer_hysteresis"}
#: Those whose numbers are of four pads at the corners of a rectangle, or of each pad where there are not four.
_OF_CORNERS = {"pad_spread", "position_patch"}


def planted(truth: Mapping[str, Any]) -> dict[str, float]:
    """Give "effect.strength" -> planted value of a campaign's answer, where the laws are the same."""
    out: dict[str, float] = {}
    other = set[str]()
    if "pads" in truth["settings"]:
        other = _OF_GIRDER | (_OF_CORNERS if len(truth["settings"]["pads"]) == 4 else set())
    for effect, details in truth["details"].items():
        if effect in other:
            continue
        if effect == "uneven_seating":
            stiffness = truth["settings"]["pad_stiffness"]
            out["uneven_seating.warp"] = details["seating"][0] * stiffness / _RATED_PAD
        elif effect in _SAME_FORM:
            forms, values = _SAME_FORM[effect]
            if not forms or details["form"] in forms:
                out |= {f"{effect}.{name}": float(value) for name, value in values(details).items() if value != 0.0}
    return out


def sizes(results: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Hold every planted size of rightly named campaigns against the interval that was given.

    Returns:
        one row per size: campaign, size, planted, found, low, high, inside.
    """
    rows: list[dict[str, Any]] = []
    for result in results:
        truth, said = result["truth"], result["said"]
        if said["verdict"] not in ("named", "instrument") or not right(truth, said):
            continue
        given = said["candidates"][0]["parameters"] if said["candidates"] else {}  # a wrong sign has no size
        found = {_plain(key): i for key, i in given.items()}
        for name, value in planted(truth).items():
            i = found.get(name)
            if i is not None and not (i["low"] is None and i["value"] == 0.0):  # such a one no channel shows
                inside = i["low"] is not None and bool(i["low"] <= value <= i["high"])
                row = {"campaign": result["name"], "size": name, "planted": value, "found": i["value"]}
                rows.append({**row, "low": i["low"], "high": i["high"], "inside": inside})
    return rows


def _plain(key: str) -> str:
    """Take the channel out of "channel_gain[pad_A_N].gain"."""
    effect, _, name = key.rpartition(".")
    return f"{effect.split('[')[0]}.{name}"
