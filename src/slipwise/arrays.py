"""What arrays hold, in the words that signatures use; shapes stand in the docstrings."""

import numpy as np
from numpy.typing import NDArray

#: Numbers.
Array = NDArray[np.float64]
#: Whether something holds, sample by sample.
Mask = NDArray[np.bool_]
