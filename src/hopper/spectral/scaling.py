"""Powers of two, by which every matrix is brought to entries of about 1 and its results back.

They change exponents only: for c a power of two, results for c M at c z are c times those for M at
z, bit for bit.
"""

import numpy as np
from numpy.typing import ArrayLike

from hopper.arguments import checked
from hopper.arrays import Array, Numbers
from hopper.errors import InvalidParameterError


@checked
def exponent_of(values: ArrayLike) -> int:
    """Return e for which the largest real or imaginary part lies in [2^(e - 1), 2^e); 0 for 0."""
    return int(np.frexp(np.abs(_parts(np.asarray(values))).max(initial=0.0))[1])


@checked
def times_power(values: ArrayLike, exponent: int) -> Numbers:
    """Return 2^exponent times values; what is too small becomes 0, what is too large inf."""
    return _times_power(np.asarray(values), exponent)


@checked
def represented(name: str, values: ArrayLike, exponent: int) -> Numbers:
    """Return 2^exponent times values, exactly.

    Raises
    ------
    InvalidParameterError
        If that is outside the range of numbers, or loses digits below it; named ``name``.
    """
    given = np.asarray(values)
    result = _times_power(given, exponent)
    if not (_times_power(result, -exponent) == given).all():
        raise InvalidParameterError(
            f"{name} is outside the range of floating-point numbers, about 1e-308 to 1e308: "
            "scale the matrix, and what it is compared with, by a power of 10"
        )
    return result


def _times_power(values: Numbers, exponent: int) -> Numbers:
    with np.errstate(over="ignore", under="ignore"):
        scaled = np.asarray(np.ldexp(_parts(values), exponent))
    return scaled.view(complex).reshape(values.shape) if np.iscomplexobj(values) else scaled


def _parts(values: Numbers) -> Array:
    """Return real and imaginary parts beside each other."""
    return np.ascontiguousarray(values).view(float) if np.iscomplexobj(values) else values
