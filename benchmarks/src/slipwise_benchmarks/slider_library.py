"""The force of a single slider by the library's own laws: the other maker of tests with a prescribed slip.

Friction, its hidden effects, a curved face and a wall are effects of the library's catalogue, driven by the slip and
the load of the test, as its replay drives the pads of a rig.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.model import EffectUse, Model, base_model, use
from slipwise.rig import load_specimen
from slipwise.simulation.predict import predictor
from slipwise_benchmarks.bearing import PRESSURE, SATURATION, TURNS, Bearing
from slipwise_benchmarks.settings import GRAVITY
from slipwise_benchmarks.slider_friction import DECAY, Drive, settling_distance

Array = NDArray[np.float64]
#: Shear strength of a face without friction [Pa]: the least that a specimen may have.
_NOTHING = 1.0e-3


def library_force(bearing: Bearing, drive: Drive) -> Array:
    """Give the force along the table (n,) [N] by the library.

    Args:
        bearing: that is tested; a spring through the middle is a curved face that does as much.
        drive: what the machine does.
    """
    model = _model(bearing, drive)
    count = drive.time.size
    slip, velocity = np.zeros((count, 1, 2)), np.zeros((count, 1, 2))
    slip[:, 0, 0], velocity[:, 0, 0] = drive.slip, drive.velocity
    return predictor(model).pads(drive.time, drive.load[:, None], velocity, slip).force[:, 0, 0]


def _model(bearing: Bearing, drive: Drive) -> Model:
    radius = float(np.sqrt(bearing.load / (np.pi * PRESSURE)))
    specimen = load_specimen("pad").changed(pad_radius=radius, mass=bearing.load / GRAVITY)
    if bearing.mu_fast > 0.0:
        strength = (bearing.mu_fast - bearing.mu_slow) * PRESSURE / -np.expm1(-SATURATION * PRESSURE)
        model = base_model(specimen).setting("contact_area", saturation=SATURATION)
        model = model.setting("shear_rate", strength=strength, rate=bearing.rate, slow=bearing.mu_slow)
    else:
        model = Model(specimen.changed(shear_strength=_NOTHING))
    uses = [_use(name, size, drive) for name, size in bearing.hidden]
    curvature = 1.0 / bearing.radius + bearing.stiffness / bearing.load
    if curvature:
        uses.append(use("slide_curvature", curvature=curvature))
    if bearing.wall:
        uses.append(use("restrainer", stiffness=bearing.wall, limit=bearing.gap))
    if bearing.turning > TURNS:
        uses.append(use("presliding", length=bearing.turning * bearing.stroke))
    return model.adding(*uses)


def _use(name: str, size: float, drive: Drive) -> EffectUse:
    if name == "direction_asymmetry":
        return use(name, difference=size)
    if name == "run_in":
        return use(name, rise=size, distance=settling_distance(drive))
    if name == "breakaway":
        return use(name, rise=size, decay=DECAY)
    return use("pressure_law", slope=size, rated=PRESSURE)
