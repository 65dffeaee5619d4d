"""Arguments held to their annotations, so that a public function refuses what it cannot mean.

:func:`checked` reads the annotations of a function once. At each call it turns the arguments into
what they say, or raises an error that names the argument. Ranges and shapes are left to the
function itself. An annotation may carry a check of its own, ``Annotated[ArrayLike, real_array]``.
"""

from collections.abc import Callable, Sequence
from functools import partial, wraps
from inspect import isclass, signature
from operator import index
from types import UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, cast, get_args, get_origin

import numpy as np
from numpy.typing import ArrayLike

from hopper.arrays import Array, Complex, Mask, Numbers
from hopper.errors import InvalidParameterError
from hopper.values import (
    complex_array,
    complex_row,
    dense_array,
    finite_number,
    fraction,
    number_array,
    positive_number,
    real_array,
    real_number,
    real_row,
    shown,
)

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Check = Callable[..., Any]  # of name and value

# What makes the results that other functions take.
_MAKERS = {
    "Hopper": "Hopper(geometry, delta, half_angle)",
    "YieldCondition": "yield_condition(name)",
    "RadialSolution": "solve_radial(hopper, friction_angle)",
    "SchurForm": "schur_form(matrix)",
    "Pseudospectrum": "pseudospectrum(form, real, imag)",
    "ModalBasis": "modal_basis(solution, ...)",
    "Base": "base_of(solution)",
    "Top": "scaled(factor)",
}
_LARGEST_COUNT = 2**31


def checked(function: _Function) -> _Function:
    """Hold the arguments of a function to their annotations."""
    hints = {
        name: function.__annotations__.get(name, Any) for name in signature(function).parameters
    }
    checks = {name: _check_of(hint) for name, hint in hints.items()}
    # Values of the very class asked for need no more than that: it is most of them.
    in_order = tuple((name, _class_of(hints[name]), check) for name, check in checks.items())
    most = len(in_order)

    @wraps(function)
    def call(*values: Any, **named: Any) -> Any:
        given = [
            value if type(value) is kind else check(name, value)
            for (name, kind, check), value in zip(in_order, values, strict=False)
        ]
        # Too many arguments, or unknown ones, are left to the function's own complaint.
        if len(values) > most:
            given += values[most:]
        if named:
            for name in named.keys() & checks.keys():
                named[name] = checks[name](name, named[name])
        return function(*given, **named)

    return cast(_Function, call)


def _class_of(hint: Any) -> type | None:
    """Return the class whose objects an annotation takes as they are, None if there is none."""
    plain = hint in (str, bool) or hint not in _PLAIN
    return hint if plain and isclass(hint) and get_origin(hint) is None else None


def _check_of(hint: Any) -> _Check:
    """Return the function of (name, value) that an annotation stands for."""
    if hint in _PLAIN:
        return _PLAIN[hint]
    arguments, origin = get_args(hint), get_origin(hint)
    if origin is Annotated:
        return arguments[1]
    if origin is Literal:
        return partial(_one_of, arguments)
    if origin in (Union, UnionType):
        check = _check_of(arguments[0])  # what is first is the widest
        if type(None) not in arguments:
            return check
        return lambda name, value: None if value is None else check(name, value)
    if origin is Callable:
        return _function
    if origin is tuple:
        return partial(_tuple, [_check_of(part) for part in arguments])
    if origin in (list, Sequence):
        return partial(_sequence, _check_of(arguments[0]))
    return partial(_instance, hint) if isclass(hint) else _anything


def _anything(_: str, value: Any) -> Any:
    return value


def _instance(kind: type, name: str, value: Any) -> Any:
    if not isinstance(value, kind):
        word = kind.__name__
        maker = f", from {_MAKERS[word]}" if word in _MAKERS else ""
        raise InvalidParameterError(f"{name} = {shown(value)} is not a {word}: give one{maker}")
    return value


def _one_of(choices: tuple[str, ...], name: str, value: Any) -> Any:
    if not isinstance(value, str) or value not in choices:
        use = " or ".join(choices) if len(choices) < 3 else f"one of {', '.join(choices)}"
        raise InvalidParameterError(f"{name} = {shown(value)} is unknown: use {use}")
    return value


def _sequence(check: _Check, name: str, value: Any) -> list[Any]:
    if not isinstance(value, list | tuple):
        raise InvalidParameterError(f"{name} = {shown(value)} is not a list: give a list")
    return [check(f"{name}[{i}]", item) for i, item in enumerate(value)]


def _tuple(checks: list[_Check], name: str, value: Any) -> tuple[Any, ...]:
    if not isinstance(value, tuple) or len(value) != len(checks):
        raise InvalidParameterError(f"{name} = {shown(value)} is not a tuple of {len(checks)}")
    parts = zip(checks, value, strict=True)
    return tuple(check(f"{name}[{i}]", part) for i, (check, part) in enumerate(parts))


def _function(name: str, value: Any) -> Any:
    if not callable(value):
        raise InvalidParameterError(f"{name} = {shown(value)} is not a function: give one")
    return value


def _whole_number(name: str, value: Any) -> int:
    if type(value) is int and abs(value) <= _LARGEST_COUNT:
        return value
    if not isinstance(value, int | np.integer) or isinstance(value, bool):
        raise InvalidParameterError(f"{name} = {shown(value)} is not a whole number: give one")
    if abs(index(value)) > _LARGEST_COUNT:
        raise InvalidParameterError(f"{name} = {shown(value)} is too large: give a smaller one")
    return index(value)


def _text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise InvalidParameterError(f"{name} = {shown(value)} is not a string: give one")
    return value


def _truth(name: str, value: Any) -> bool:
    if not isinstance(value, bool | np.bool_):
        raise InvalidParameterError(f"{name} = {shown(value)} is not True or False: give one")
    return bool(value)


def _mask(name: str, value: ArrayLike) -> Mask:
    array = dense_array(name, value, "truth values")
    if array.dtype.kind != "b":
        raise InvalidParameterError(
            f"{name} = {shown(value)} is not an array of truth values: give one"
        )
    return array


_PLAIN: dict[Any, _Check] = {
    float: finite_number,
    int: _whole_number,
    str: _text,
    bool: _truth,
    object: _anything,
    Any: _anything,
    Array: real_array,
    Complex: complex_array,
    Numbers: number_array,
    ArrayLike: number_array,
    Mask: _mask,
}

RealLike = Annotated[ArrayLike, real_array]
# For functions whose own check of a range says more than that a number is not finite.
AnyFloat = Annotated[float, real_number]
RealRow = Annotated[ArrayLike, real_row]
Row = Annotated[Array, real_row]
ComplexRow = Annotated[Complex, complex_row]
Fraction = Annotated[float, fraction]
Positive = Annotated[float, positive_number]
Radians = Annotated[float, partial(real_number, remedy="give radians")]
