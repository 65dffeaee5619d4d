"""Checks of single values and arrays: each returns its value in one type, or raises by its name."""

from math import degrees, isfinite, pi
from numbers import Real
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from hopper.arrays import Array, Complex, Numbers
from hopper.errors import InvalidParameterError

_Array = TypeVar("_Array", bound=Numbers)


def real_number(name: str, value: Any, remedy: str = "give one") -> float:
    """Return a real number, finite or not, as a float.

    Raises
    ------
    InvalidParameterError
        If it is a string, a truth value, complex, an array or anything else.
    """
    if type(value) is float:
        return value
    if not is_real(value):
        raise InvalidParameterError(f"{name} = {shown(value)} is not a number: {remedy}")
    try:
        return float(value)
    except OverflowError:
        raise InvalidParameterError(
            f"{name} = {shown(value)} is not a number of floating point: {remedy}"
        ) from None


def positive_number(name: str, value: Any) -> float:
    """Return a positive finite real number as a float.

    Raises
    ------
    InvalidParameterError
        If it is anything else.
    """
    if not (is_real(value) and value > 0 and isfinite(number := real_number(name, value))):
        raise InvalidParameterError(f"{name} = {shown(value)} must be a positive number")
    return number


def fraction(name: str, value: Any) -> float:
    """Return a real number between 0 and 1, both excluded, as a float.

    Raises
    ------
    InvalidParameterError
        As :func:`real_number`, and if it is outside.
    """
    number = real_number(name, value)
    if not 0 < number < 1:
        raise InvalidParameterError(f"{name} = {number} is out of range: use 0 < value < 1")
    return number


def real_array(name: str, value: ArrayLike, remedy: str = "real numbers") -> Array:
    """Return finite real numbers as an array of floats.

    Raises
    ------
    InvalidParameterError
        As :func:`number_array`, and if they are complex.
    """
    array = number_array(name, value, remedy)
    if array.dtype.char == "D":
        raise InvalidParameterError(f"{name} is complex: give {remedy}")
    return array


def real_row(name: str, value: ArrayLike, what: str = "numbers") -> Array:
    """Return finite real numbers, one or a row of them, as an array of floats, shape (n,).

    Raises
    ------
    InvalidParameterError
        As :func:`real_array`, and if they are no row.
    """
    return require_row(name, np.atleast_1d(real_array(name, value)), what)


def complex_row(name: str, value: ArrayLike) -> Complex:
    """Return finite numbers, one or a row of them, as an array of complex ones, shape (n,).

    Raises
    ------
    InvalidParameterError
        As :func:`complex_array`, and if they are no row.
    """
    return require_row(name, np.atleast_1d(complex_array(name, value)))


def require_row(name: str, array: _Array, what: str = "values") -> _Array:
    """Return an array of one dimension.

    Raises
    ------
    InvalidParameterError
        If it has another number of them.
    """
    if array.ndim != 1:
        raise InvalidParameterError(f"{name} has shape {array.shape}: give a row of {what}")
    return array


def require_equal_shapes(**arrays: Numbers | float) -> None:
    """Check that arrays have one shape; single numbers go with any.

    Raises
    ------
    InvalidParameterError
        If they have not.
    """
    shapes = {name: np.shape(array) for name, array in arrays.items()}
    if len(set(shapes.values()) - {()}) > 1:
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InvalidParameterError(f"shapes of {listed} differ: give arrays of one shape")


def complex_array(name: str, value: ArrayLike) -> Complex:
    """Return finite numbers as an array of complex numbers.

    Raises
    ------
    InvalidParameterError
        As :func:`number_array`.
    """
    return number_array(name, value).astype(complex, copy=False)


def number_array(name: str, value: ArrayLike, remedy: str = "numbers") -> Numbers:
    """Return finite numbers as an array, of floats or of complex numbers.

    Raises
    ------
    InvalidParameterError
        If they are not a dense array of finite numbers, without mask. Numeric strings and truth
        values are no numbers.
    """
    array = dense_array(name, value, remedy)
    if array.dtype.kind not in "iufc":
        raise InvalidParameterError(
            f"{name} = {shown(value)} is not an array of numbers: give a dense array of {remedy}"
        )
    if array.dtype.char not in "dD":
        with np.errstate(over="ignore"):  # of longer floats
            array = array.astype(complex if array.dtype.kind == "c" else float)
    if not np.isfinite(array).all():
        raise InvalidParameterError(f"{name} must be finite: remove NaN and inf")
    return array


def dense_array(name: str, value: ArrayLike, remedy: str) -> Any:
    """Return a value as an array of whatever it contains.

    Raises
    ------
    InvalidParameterError
        If it is masked, ragged or no array.
    """
    cause = None
    if not isinstance(value, np.ma.MaskedArray):
        try:
            return np.asarray(value)
        except Exception as error:  # ragged lists, and whatever a foreign type raises
            cause = error
    raise InvalidParameterError(
        f"{name} = {shown(value)} is not a dense array: give one of {remedy}"
    ) from cause


def shown(value: object) -> str:
    """Return a value in at most 60 characters of one line; large ones by their type."""
    if isinstance(value, np.ndarray) and value.size > 4:
        return f"array of shape {value.shape}, dtype {value.dtype}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:40]}... ({type(value).__name__})"


def is_real(value: object) -> bool:
    """Whether a value is a real number: not a string, a truth value, complex or an array."""
    return isinstance(value, Real) and not isinstance(value, bool)


def finite_number(name: str, value: Any, remedy: str = "give one") -> float:
    """Return a finite real number as a float.

    Raises
    ------
    InvalidParameterError
        As :func:`real_number`, and if it is not finite.
    """
    number = real_number(name, value, remedy)
    if not isfinite(number):
        raise InvalidParameterError(f"{name} = {number} must be finite")
    return number


def require_angle(name: str, value: float, *, zero_allowed: bool = False) -> None:
    """Check that an angle in radians is finite and inside (0, pi/2), or [0, pi/2).

    Raises
    ------
    InvalidParameterError
        If it is not; the message states the value in degrees.
    """
    angle = real_number(name, value, "give radians")
    inside = 0 <= angle < pi / 2 if zero_allowed else 0 < angle < pi / 2
    if not inside:
        interval = "[0, 90)" if zero_allowed else "(0, 90)"
        raise InvalidParameterError(
            f"{name} = {degrees(angle):.6g} deg is out of range: it must lie in {interval} deg"
        )
