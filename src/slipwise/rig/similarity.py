"""The similarity law of the tests: acceleration, pressure and h/b scale by 1.

Source: paper, Similarity law and Table 1; the scale factors are of length. What follows from them:
time and velocity sqrt(length), mass and force length^2, stiffness length, energy length^3.
The physics does not follow it everywhere: n (s/m), heating and the pre-sliding length do not scale.
"""

from dataclasses import dataclass

#: Prototype length over model length. Source: paper, Superstructure model.
LENGTH_SCALE: dict[str, float] = {"bridge1": 10.69, "bridge2": 12.17}


@dataclass(frozen=True)
class Similarity:
    """Prototype over model, for each quantity [1]."""

    length: float
    time: float
    velocity: float
    frequency: float
    acceleration: float
    mass: float
    force: float
    stiffness: float
    pressure: float
    energy: float


def similarity(length: float) -> Similarity:
    """Return all scales that follow from the scale of length.

    Args:
        length: prototype length over model length [1], e.g. LENGTH_SCALE["bridge1"].
    """
    root = length**0.5
    return Similarity(
        length=length,
        time=root,
        velocity=root,
        frequency=1.0 / root,
        acceleration=1.0,
        mass=length**2,
        force=length**2,
        stiffness=length,
        pressure=1.0,
        energy=length**3,
    )
