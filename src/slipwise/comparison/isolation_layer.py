"""The isolation layer where no bearing's force was measured: energy, effective stiffness and damping of each run.

The force of all bearings is that of inertia, see `relations/base_shear.py`. The linear layer nearest to it is

    F = K x + C v,        period 2 pi sqrt(M/K),  fraction of critical C / (2 sqrt(K M)),  M: all that is carried

by least squares over the run, at rest left out. Period, fraction and the shares do not depend on the masses, forces and
energies go with them.

Source: Chopra, Dynamics of Structures, section 3.9, equivalent viscous damping.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.estimation.base_fit import BaseFit
from slipwise.relations.base_shear import compute_base_shear, predict_base_shear


@dataclass(frozen=True)
class IsolationLayer:
    """What all bearings did together in one run.

    Attributes:
        run: name.
        role: "fit", "repeat" or "holdout".
        peak_slip: largest displacement over the bearings [m].
        peak_force: largest force of all bearings over the carried weight [1].
        energy: that they took over the run, less what the nearest linear spring holds at its end [J].
        stiffness: K of the nearest linear layer [N/m].
        period: of all that is carried on that [s].
        damping: its fraction of critical [1].
        linear_left: rms of the force that the nearest linear layer of this very run leaves, over that of the force [1].
        model_left: the same of the fitted model [1].
    """

    run: str
    role: str
    peak_slip: float
    peak_force: float
    energy: float
    stiffness: float
    period: float
    damping: float
    linear_left: float
    model_left: float


def describe_isolation_layer(base: BaseFit) -> tuple[IsolationLayer, ...]:
    """Return the layer in every run; none where the pads' friction was measured, or their inertia was not."""
    objective = base.objective
    if objective.forces_measured or "girder" not in objective.relations:
        return ()
    found = []
    for place, run in enumerate(objective.runs):
        left = base.solution.residuals.block("girder", place)
        force, judged = compute_base_shear(run), left.mask
        if not np.any(run.velocity[judged]):
            continue
        mass = objective.specimen.carried_mass
        columns = np.stack([run.slip, run.velocity], axis=1)[judged]
        stiffness, dashpot = np.linalg.lstsq(columns, force[judged], rcond=None)[0]
        size = float(np.sqrt(np.mean(force[judged] ** 2)))
        off = {"linear": force[judged] - columns @ [stiffness, dashpot]}
        off["model"] = (force - predict_base_shear(run, left))[judged]
        shares = {name: float(np.sqrt(np.mean(of**2))) / size for name, of in off.items()}
        held = 0.5 * float(stiffness) * (run.slip[-1] ** 2 - run.slip[0] ** 2)
        turn = float(np.sqrt(max(stiffness, 0.0) / mass))
        found.append(
            IsolationLayer(
                run.name,
                run.role,
                float(np.abs(run.slip).max()),
                float(np.abs(force).max()) / objective.specimen.weight,
                float(np.trapezoid(force * run.velocity, run.time) - held),
                float(stiffness),
                2.0 * np.pi / turn if turn else float("inf"),
                float(dashpot) / (2.0 * mass * turn) if turn else float("inf"),
                shares["linear"],
                shares["model"],
            )
        )
    return tuple(found)
