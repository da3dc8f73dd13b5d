"""The friction surface mu(P, V) that a fit means, with its band: parameters trade off, the surface does not.

Source: docs/theory.md, section 2.3; band by first-order propagation.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import Intervals
from slipwise.estimation.least_squares import STEP
from slipwise.short_repr import short_repr
from slipwise.simulation.predict import predictor

#: Points of the surface along either axis.
_PRESSURES, _SPEEDS = 9, 12


@short_repr
@dataclass(frozen=True)
class FrictionSurface:
    """Coefficient of friction of the fitted model where the campaign has been.

    Attributes:
        pressure: (p,) [Pa].
        speed: (v,) [m/s].
        friction: (p, v) F/N in steady sliding, from rest [1].
        deviation: (p, v) standard deviation that comes from the fitted numbers [1].
    """

    pressure: Array
    speed: Array
    friction: Array
    deviation: Array


def compute_friction_surface(base: BaseFit, found: Intervals) -> FrictionSurface | None:
    """Return the surface over the pressures and speeds that the campaign has seen.

    None where no load is known, or nothing slides.
    """
    runs = base.objective.runs
    area = base.objective.specimen.pad_area
    loads = np.concatenate([r.load[r.sliding].ravel() for r in runs])
    speeds = np.concatenate([np.abs(r.velocity[r.sliding]) for r in runs])
    if not base.objective.specimen.slides or len(loads) == 0 or not np.isfinite(loads).all():
        return None
    low, high = np.quantile(loads, [0.005, 0.995])
    pressure = np.linspace(max(low, 1e-3 * high), high, _PRESSURES) / area
    fastest = float(np.quantile(speeds, 0.995))
    speed = fastest * np.linspace(0.02, 1.0, _SPEEDS) ** 1.5
    values = base.solution.values
    here = _friction(base, values, pressure, speed)
    keys = [k for k in found.keys if not k.startswith("rig.") or k == "rig.shear_strength"]
    scales = {f.key: f.scale for f in base.free}
    slopes = []
    for key in keys:
        step = STEP * scales[key]
        high_f = next(f.high for f in base.free if f.key == key)
        step = -step if values[key] + step > high_f else step
        moved = _friction(base, {**values, key: values[key] + step}, pressure, speed)
        slopes.append((moved - here) / step)
    places = [found.keys.index(k) for k in keys]
    own = found.covariance[np.ix_(places, places)]
    slope = np.stack(slopes) if slopes else np.zeros((0, *here.shape))
    variance = np.einsum("ipv,ij,jpv->pv", slope, own, slope)
    return FrictionSurface(pressure, speed, here, np.sqrt(np.maximum(variance, 0.0)))


def _friction(base: BaseFit, values: Mapping[str, float], pressure: Array, speed: Array) -> Array:
    model = base.objective.model(values)
    law = predictor(model)
    pads = len(model.specimen.pads)
    out = np.empty((len(pressure), len(speed)))
    for i, p in enumerate(pressure):
        for j, v in enumerate(speed):
            law.reset()
            load = p * np.array([model.specimen.pad_areas])
            velocity = np.zeros((1, pads, 2))
            velocity[:, :, 0] = v
            # what the pad could carry: a law with a memory of slip has not built up its force yet
            out[i, j] = float(law.pads(np.zeros(1), load, velocity, np.zeros((1, pads, 2))).bound[0, 0] / load[0, 0])
    return out
