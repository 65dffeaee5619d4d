"""Types of arrays that more than one package speaks of."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]
Numbers = NDArray[Any]  # float64 or complex128
