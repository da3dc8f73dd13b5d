"""Component level: every law and balance fed with measured load, slip and speed, in multiples of its noise floor."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.estimation.base_fit import BaseFit
from slipwise.relations.base_shear import compute_base_shear
from slipwise.relations.motions import is_same_motion
from slipwise.relations.run_data import FitRun
from slipwise.rig.frame import frame_push
from slipwise.rig.load_basis import WARPS, basis_of

#: Relation -> what it is called, unit of its residual.
NAMES: Mapping[str, tuple[str, str]] = {
    "pads": ("pad friction", "N"),
    "girder": ("girder balance", "m/s^2"),
    "heave": ("heave of the loads", "N"),
    "pitch": ("pitch of the loads", "N"),
    "roll": ("roll of the loads", "N"),
    **{name: (f"{name.replace('_', ' ')} of the loads", "N") for name in WARPS},
    "storeys": ("push of the storeys", "N"),
    "motion": ("slip against accelerometers", "1"),
    "across": ("pad friction across", "N"),
    "girder_y": ("girder balance across", "m/s^2"),
}


@dataclass(frozen=True)
class ComponentError:
    """Error of one relation in one run.

    Attributes:
        relation: "pads", "girder", "heave" ...
        run: name.
        role: "fit", "repeat" or "holdout".
        error: rms of the residual over its floor [1].
        rms: of the residual, in the relation's unit.
        floor: noise that divides the residual, see `compute_dividing_noise`, in the relation's unit: rms over error.
        share: rms of the residual over the rms of what was measured; NaN for relations that are zero by nature [1].
        samples: that were judged.
    """

    relation: str
    run: str
    role: str
    error: float
    rms: float
    floor: float
    share: float
    samples: int


def compute_component_errors(base: BaseFit) -> tuple[ComponentError, ...]:
    """Return the error of every relation in every run."""
    out = []
    for relation in base.objective.relations:
        for of in base.solution.residuals.blocks(relation):
            run, part = base.objective.run(of.run), of.value
            judged = of.mask  # rounded records leave a residual of exactly zero where it is judged
            if not np.any(part[judged]):
                continue
            left = part[judged] * of.noise[judged]
            measured = run.force[judged] if relation == "pads" else _measured(relation, run, judged)
            size = float(np.sqrt(np.mean(measured**2))) if measured is not None else float("nan")
            rms, error = float(np.sqrt(np.mean(left**2))), float(np.sqrt(of.squares / of.count))
            out.append(
                ComponentError(
                    relation,
                    run.name,
                    run.role,
                    error,
                    rms,
                    compute_dividing_noise(left, part[judged]),
                    rms / size if size > 0.0 else float("nan"),
                    of.count,
                )
            )
    return tuple(out)


def compute_dividing_noise(residual: Array, in_floors: Array) -> float:
    """Return the one noise that divides a residual to the same error as its own noise does sample by sample.

    sqrt(sum r^2 / sum (r / sigma)^2): the noise itself where it is the same in all samples. It times an error is the
    rms of the residual.

    Args:
        residual: r, (n,) in the relation's unit, not all of it zero.
        in_floors: r / sigma, (n,).
    """
    return float(np.sqrt(np.sum(residual**2) / np.sum(in_floors**2)))


def _measured(relation: str, run: FitRun, judged: NDArray[np.bool_]) -> Array | None:
    if relation == "across":
        return run.across[judged]
    if relation == "girder" and not run.forces_measured:
        return compute_base_shear(run)[judged] / run.states.specimen.mass
    if relation == "girder":
        return run.channel("girder_ax")[judged]
    if relation == "heave":
        return run.load.sum(axis=1)[judged]
    if relation == "storeys":
        return frame_push(run.record, run.states.specimen)[judged]
    if relation == "pitch":
        return (run.load @ basis_of(run.states.specimen).rigid[1])[judged]
    return None


def pool_errors(errors: Sequence[ComponentError], relation: str, *, held_out: bool) -> float | None:
    """Return the error of a relation over all fitted, or all held-out, runs; None where there is none."""
    chosen = [e for e in errors if e.relation == relation and (e.role == "holdout") == held_out]
    count = sum(e.samples for e in chosen)
    if count == 0:
        return None
    return float(np.sqrt(sum(e.samples * e.error**2 for e in chosen) / count))


def compute_repeat_errors(base: BaseFit) -> dict[str, float]:
    """Hold a repeated run against its first: rms of the difference of both residuals over sqrt(2), in floors.

    Whatever is the same in both runs drops out, the model's errors included: what stays is noise, and 1 says that the
    floor is right. Empty without a repeated run of the same length and motion.
    """
    runs, residuals = base.objective.runs, base.solution.residuals
    pairs = [
        (i, j)
        for j, later in enumerate(runs)
        if later.role == "repeat"
        for i, first in enumerate(runs[:j])
        if is_same_motion(first, later)
    ]
    out = {}
    for relation in base.objective.relations:
        for i, j in pairs[-1:]:
            first, again = residuals.block(relation, i), residuals.block(relation, j)
            both = first.mask & again.mask
            if both.any():
                out[relation] = float(np.sqrt(np.mean((first.value - again.value)[both] ** 2) / 2.0))
    return out
