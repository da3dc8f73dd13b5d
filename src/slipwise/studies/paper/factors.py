"""Figs. 7 and 8: the load of pad A, its Factor A (inertia) and Factor B (rocking), and pad B against it."""

from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import PADS
from slipwise.model import Model
from slipwise.record import Record
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import LoadFactors, load_factors
from slipwise.studies.paper.finding import FAILS, HOLDS, Finding, Study
from slipwise.studies.paper.settings import PaperSettings, paper_model


def rocking_per_g(record: Record, model: Model) -> tuple[float, float]:
    """Regress Factor B of pad A on girder acceleration and slip.

    Returns:
        Swing of load per g of girder acceleration over the load at rest [1], for which statics says 2 h/b; and the load
        per slip [N/m], for which P-delta says m g/(2 b) with pads on the table.
    """
    specimen = model.built_specimen()
    rocking = _without_inertia(load_factors(record, specimen.mass, specimen.gravity, basis_of(specimen)))[:, 0]
    columns = np.stack([-record["girder_ax"] / specimen.gravity, record["slip_x"]], axis=1)
    slopes, *_ = np.linalg.lstsq(columns, rocking - rocking.mean(), rcond=None)
    return float(slopes[0]) / (specimen.weight / len(specimen.pads)), float(slopes[1])


def _without_inertia(split: LoadFactors) -> Array:
    """Return Factor B as the paper makes it, load minus Factor A (n, 4) [N]: nothing is forced to be opposite."""
    return split.rocking + split.rest


def study(settings: PaperSettings, records: dict[str, Record]) -> Study:
    """Split the loads of both bridges.

    Args:
        settings: the assumptions.
        records: bridge -> record of its pier-top motion.
    """
    rows: list[dict[str, Any]] = []
    curves: dict[str, Any] = {}
    for bridge, record in records.items():
        model = paper_model(bridge, settings)
        specimen = model.built_specimen()
        split = load_factors(record, specimen.mass, specimen.gravity, basis_of(specimen))
        slope, by_slip = rocking_per_g(record, model)
        rocking = _without_inertia(split)
        rows.append(
            {
                "bridge": bridge,
                "girder_rms_g": float(record["girder_ax"].std() / specimen.gravity),
                "inertia_swing": float(split.inertia_swing[0]),
                "rocking_swing": float(np.ptp(rocking[:, 0]) / 2.0 * len(PADS) / specimen.weight),
                "rocking_rms": float(rocking[:, 0].std() * len(PADS) / specimen.weight),
                "per_g": slope,
                "per_g_expected": 2.0 * specimen.slenderness,
                "per_slip": by_slip,
                "correlation_A_B": float(np.corrcoef(rocking[:, 0], rocking[:, 1])[0, 1]),
                "sum_A_B": float(np.abs(rocking[:, 0] + rocking[:, 1]).max() / np.abs(rocking[:, 0]).max()),
            }
        )
        curves[bridge] = {
            "time": record.time,
            "load": record["pad_A_N"],
            "inertia": split.inertia[:, 0],
            "rocking": rocking[:, 0],
            "rocking_B": rocking[:, 1],
        }
    one, two = rows
    ratio = two["per_g"] / one["per_g"]
    raw = two["rocking_swing"] / one["rocking_swing"]
    expected = two["per_g_expected"] / one["per_g_expected"]
    findings = (
        Finding(
            "Fig. 7",
            "Load minus mass times vertical acceleration leaves the part of rocking, larger in Bridge 2.",
            f"{ratio:.2f} times per g (h/b: 2.00)",
            f"Factor B swings by ±{one['rocking_swing']:.0%} (Bridge 1) and ±{two['rocking_swing']:.0%} (Bridge 2) "
            "of the "
            f"load at rest: {raw:.2f} times. Per g of girder acceleration {ratio:.2f} times, {one['per_g']:.3f} and "
            f"{two['per_g']:.3f}, for which 2 h/b says {one['per_g_expected']:.3f} and {two['per_g_expected']:.3f}.",
            HOLDS if abs(ratio / expected - 1.0) < 0.05 else FAILS,
            "The ratio of h/b is 2.00 per g; the swings themselves also carry each bridge's own motion and the "
            "weight that "
            "moves over pads on the table.",
            ("buffer_height", "pads_on", "b_means", "ground"),
            {"bridges": rows, "ratio_per_g": ratio, "ratio_of_swings": raw},
        ),
        Finding(
            "Fig. 8",
            "Pads A and B, on opposite sides, swing against each other.",
            f"correlation {one['correlation_A_B']:.3f}",
            f"Correlation {one['correlation_A_B']:.3f} and {two['correlation_A_B']:.3f}; the sum of their Factors B "
            "stays "
            f"below {max(one['sum_A_B'], two['sum_A_B'], 1e-3):.1%} of one.",
            HOLDS if max(r["correlation_A_B"] for r in rows) < -0.99 else FAILS,
            "A and B on opposite sides in the shaking direction.",
            ("A and B lie across from each other",),
            {},
        ),
    )
    table = [
        {
            "bridge": r["bridge"],
            "Factor A swing": f"±{r['inertia_swing']:.0%}",
            "Factor B swing": f"±{r['rocking_swing']:.0%}",
            "B per g": f"{r['per_g']:.4f}",
            "2 h/b": f"{r['per_g_expected']:.4f}",
            "B per slip [kN/mm]": f"{r['per_slip'] / 1e6:.4f}",
            "corr. A, B": f"{r['correlation_A_B']:.4f}",
        }
        for r in rows
    ]
    return Study("loads", "Load on the pads (Figs. 7, 8)", findings, {"Both factors": table}, curves)
