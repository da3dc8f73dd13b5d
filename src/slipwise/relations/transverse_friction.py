"""Friction across the girder, where pads have gauges for it and the girder moves that way too.

    F_y = F_b v_y / |v| + what effects add

Where a pad is slow the direction of its velocity is noise, so only fast samples are held against the law.
"""

from slipwise.arrays import Array
from slipwise.relations.pad_law import log_force
from slipwise.relations.run_data import FitRun
from slipwise.signals.filters import LowPass
from slipwise.simulation.predict import PadForces


def predict_logged_across(run: FitRun, law_forces: PadForces, by: LowPass | None) -> Array:
    """Return the pads' forces along y as the logger would have written them, (n, p) [N].

    Args:
        run: whose samples and filter.
        law_forces: of the law at the instants, (f, p, 2) [N].
        by: the filter where the campaign does not know it.
    """
    return log_force(law_forces.force[:, :, 1], run, by, averaged=False)
