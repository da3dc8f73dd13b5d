"""A table's displacement as its command: what becomes of it is an acceleration, and it is said."""

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError
from slipwise.motion.source_file import SourceFile

Array = NDArray[np.float64]


def acceleration_of(displacement: Array, dt: float, source: SourceFile, name: str) -> tuple[Array, str]:
    """Differentiate a displacement twice.

    Args:
        displacement: (n,) [m].
        dt: step [s].
        source: the file, for messages.
        name: of the column.

    Returns:
        The acceleration (n,) [m/s^2] and what was done, in words.

    Raises:
        InputError: too few samples.
    """
    from slipwise.signals.second_derivative import second_derivative  # here, for it takes long to load

    if len(displacement) < 9:
        raise InputError(f"{source.name}: {len(displacement)} samples of a displacement are too few to differentiate")
    values, frequency = second_derivative(displacement, dt)
    return values, f"{name} is a displacement: differentiated twice, below {frequency:.3g} Hz"
