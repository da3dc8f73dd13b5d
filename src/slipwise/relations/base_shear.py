"""What all bearings give together, from the inertia of the girder and its storeys.

    force of the girder on its bearings = -(m a + sum m_i a_i)

Friction of the pads and buffers together: no gauge of force is needed, only the accelerations of all that is carried.
It is known as well as the masses are: a mass that is wrong by a factor makes it wrong by that factor.

Source: d'Alembert; docs/theory.md, section 1.6.
"""

import numpy as np

from slipwise.arrays import Array
from slipwise.relations.run_data import FitRun
from slipwise.relations.table import Block, Residuals
from slipwise.rig.frame import frame_push


def compute_base_shear(run: FitRun) -> Array:
    """Return the force of the girder on all its bearings along x (n,) [N].

    Args:
        run: with the accelerations of the girder and of all its storeys.
    """
    specimen = run.states.specimen
    return frame_push(run.record, specimen) - specimen.mass * run.record["girder_ax"]


def predict_base_shear(run: FitRun, left: Block) -> Array:
    """Return the same as a fit predicts it, (n,) [N]; NaN where the girder's balance is not judged.

    Args:
        run: as measured.
        left: what the fit leaves of the girder's balance in this run.
    """
    predicted = compute_base_shear(run) + run.states.specimen.mass * left.value * left.noise
    return np.where(left.mask, predicted, np.nan)


def pair_forces(run: FitRun, residuals: Residuals, place: int) -> tuple[Array, Array]:
    """Return measured and predicted force of every pad along x (n, p) [N]; of all bearings (n, 1) where none was.

    Args:
        run: as measured.
        residuals: of a fit.
        place: of the run.
    """
    if run.forces_measured:
        return run.force, residuals.pad_forces[place]
    return compute_base_shear(run)[:, None], predict_base_shear(run, residuals.block("girder", place))[:, None]
