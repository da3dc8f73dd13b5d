"""Tables of what was written for another program, in the units in which engineers read them."""

import math
from typing import Any

from slipwise.export.opensees import OpenSeesExport
from slipwise.export.sap2000 import LinkProperties, SliderLink, SpringLink
from slipwise.units import convert
from slipwise.view.words.numbers import usual_unit


def friction_rows(found: OpenSeesExport) -> list[dict[str, Any]]:
    """Return the friction models of the sliders: one row where all pads have the same."""
    same = len(set(found.frictions.values())) == 1
    shown = {"all": next(iter(found.frictions.values()))} if same else found.frictions
    rows = []
    for pad, fit in shown.items():
        row: dict[str, Any] = {"pad": pad, "model": fit.kind}
        if fit.kind != "Coulomb":
            row |= {"slow": _four(fit.slow)}
        row |= {"fast": _four(fit.fast)}
        if fit.rate:
            row |= {"rate [s/m]": _four(fit.rate)}
        if fit.drop:
            row |= {"drop by pressure": _four(fit.drop), "per pressure [1/MPa]": _four(1e6 * fit.per_pressure)}
        rows.append({**row, "error, rms [%]": round(100.0 * fit.error, 3)})
    return rows


def effect_rows(found: OpenSeesExport) -> list[dict[str, Any]]:
    """Return what became of every effect, and what our replay slides without those that are not wholly there."""
    rows = []
    for part in found.parts:
        row: dict[str, Any] = {"effect": part.effect, "in the script": part.state, "how": part.words}
        if part.peak_slip is not None:
            change = 100.0 * (part.peak_slip / found.peak_slip - 1.0)
            row["peak slip x without it [mm]"] = f"{1e3 * part.peak_slip:.4g} ({change:+.1f} %)"
        rows.append(row)
    return rows


def response_rows(found: OpenSeesExport) -> list[dict[str, Any]]:
    """Return the responses of the run in our replay, and in OpenSees where it was run there."""
    rows = []
    for one in found.responses:
        unit = usual_unit(one.unit)
        row: dict[str, Any] = {
            "response": f"{one.name} [{unit}]",
            "our replay": _four(convert(one.ours, one.unit, unit)),
        }
        if math.isfinite(one.theirs):
            theirs = float(convert(one.theirs, one.unit, unit))
            row |= {"OpenSees": _four(theirs), "difference [%]": round(100.0 * one.error, 2) + 0.0}
        rows.append(row)
    if math.isfinite(found.difference):
        rows.append(
            {"response": "slip x over time, rms of the difference", "difference [%]": _two(100 * found.difference)}
        )
    return rows


def link_rows(found: LinkProperties) -> list[dict[str, Any]]:
    """Return the table of links in kN, m, s: one row each, empty where a property is none of its kind."""
    return [*(_slider(link, True) for link in found.sliders), *(_spring(link) for link in found.springs)]


def short_link_rows(found: LinkProperties) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Return the rows of the sliders and those of the buffers, as a terminal has room for them."""
    return [_slider(link, False) for link in found.sliders], [_spring(link) for link in found.springs]


def _slider(link: SliderLink, whole: bool) -> dict[str, Any]:
    row: dict[str, Any] = {"link": f"pad {link.pad}"}
    if whole:
        row |= {"type": "friction isolator", "U1 stiffness [kN/m]": _four(link.vertical_stiffness / 1e3)}
    row |= {
        "U2, U3 stiffness [kN/m]": _four(link.stiffness / 1e3),
        "friction slow": _four(link.slow),
        "friction fast": _four(link.fast),
        "rate [s/m]": _four(link.rate),
        "radius [m]": _four(link.radius),
        "error, rms [%]": _two(100.0 * link.error),
    }
    if whole:
        row |= {"U1 damping [kN s/m]": _four(link.vertical_damping / 1e3), "load at rest [kN]": _four(link.load / 1e3)}
        for name, pressure, mu in zip(("lower", "middle", "upper"), link.pressures, link.fast_at, strict=True):
            row |= {f"{name} pressure [MPa]": _four(pressure / 1e6), f"friction fast at the {name} pressure": _four(mu)}
    return row


def _spring(link: SpringLink) -> dict[str, Any]:
    return {
        "link": f"buffer {link.buffer} along {link.axis}",
        "type": "gap and hook" if link.gap else "linear",
        "stiffness [kN/m]": _four(link.stiffness / 1e3),
        "damping [kN s/m]": _four(link.damping / 1e3),
        **({"gap to both sides [m]": _four(link.gap)} if link.gap else {}),
    }


def _four(value: Any) -> float:
    return float(f"{float(value):.4g}")


def _two(value: float) -> float:
    return float(f"{value:.2g}")
