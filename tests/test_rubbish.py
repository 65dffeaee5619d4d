"""Every public function refuses arguments of a wrong kind by name, absurd values by typed errors.

Functions are found by walking the packages, what their arguments mean by the annotations.
"""

import inspect
import pkgutil
from collections.abc import Callable, Sequence
from contextlib import suppress
from decimal import Decimal
from functools import cache
from importlib import import_module
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import numpy as np
import pytest
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

import hopper
from hopper import Hopper, schur_form, solve_radial
from hopper.arrays import Array, Complex, Mask, Numbers
from hopper.design.material import Material
from hopper.domain.growth import Hoppers
from hopper.errors import HopperError, InvalidParameterError
from hopper.radial.grid import half_grid
from hopper.spectral.transient import ModalBasis, basis_of
from hopper.values import complex_array, number_array

# Modules of tools for writing functions, not for users. What steps of a march take may be no
# numbers: it is followed to where it ends.
TOOLS = {
    "hopper.arguments", "hopper.brief", "hopper.errors", "hopper.radial.steps", "hopper.values",
    "hopper.spectral.lanczos", "hopper.spectral.propagator", "hopper.spectral.sampling",
    *(f"hopper.march.{name}" for name in (
        "crossing", "equations", "fields", "history", "loop", "mapped", "net", "rays", "settling")),
}  # fmt: skip


class Unwilling:
    """Raises when it is made an array or a number."""

    def __array__(self, *_, **__):
        raise RuntimeError("no array")

    def __float__(self):
        raise RuntimeError("no number")


# What each kind may be meant as, so that it is no rubbish there.
RUBBISH: dict[str, tuple[Any, str]] = {
    "nothing": (None, "optional"),
    "numeric string": ("0.3", "text"),
    "bytes": (b"0.3", ""),
    "list of strings": (["0.1", "0.2"], ""),
    "array of strings": (np.array(["0.1", "0.2"]), ""),
    "ragged list": ([[1.0], [2.0, 3.0]], ""),
    "object array": (np.array([0.1, None], dtype=object), ""),
    "array of objects that are numbers": (np.array([0.1, 0.2], dtype=object), ""),
    "object": (object(), ""),
    "dictionary": ({"a": 1}, ""),
    "set": ({0.1, 0.2}, ""),
    "sparse matrix": (csr_array(np.eye(2)), ""),
    "masked array": (np.ma.array([0.1, 0.2], mask=[False, True]), ""),
    "dates": (np.array(["2000-01-01"], dtype="datetime64[D]"), ""),
    "records": (np.zeros(2, dtype=[("a", float), ("b", float)]), ""),
    "generator": ((x for x in (0.1, 0.2)), ""),
    "type": (float, "function"),
    "function": (np.sin, "function"),
    "truth value": (True, "truth"),
    "truth values": (np.array([True, False]), "mask"),
    "complex number": (0.3 + 1j, "complex array"),
    "matrix": (np.eye(2), "complex array, array"),
    "not a number": (np.nan, ""),
    "infinity": (-np.inf, ""),
    "array with nan": (np.array([0.1, np.nan]), ""),
    "array with inf": ([0.1, np.inf], ""),
    "integer beyond floating point": (10**400, ""),
    "decimal": (Decimal("0.3"), ""),
    "unwilling": (Unwilling(), ""),
    "module": (np, ""),
}


@cache
def instances() -> dict[type, Any]:
    """What functions read before they come to a bad argument."""
    cone = Hopper("cone", 0.5, 0.3)
    solution = solve_radial(cone, 0.1)
    return {
        Hopper: cone,
        type(solution): solution,
        type(solution.member): solution.member,
        type(cone.material): cone.material,
        Hoppers: Hoppers("cone", 0.3),
        Material: Material("cone", 0.5, 0.1),
        ModalBasis: basis_of(np.diag([-1.0, -2]), np.ones(2), np.array([-1, -2], dtype=complex)),
        hopper.SchurForm: schur_form(np.eye(2)),
        type(half_grid(8, 0.3)): half_grid(8, 0.3),
    }


def bare(kind: type) -> Any:
    """An instance that is good for a check of its type only."""
    if kind in instances():
        return instances()[kind]
    return tuple.__new__(kind, ()) if issubclass(kind, tuple) else object.__new__(kind)


def meaning(hint: Any) -> tuple[set[str], Any]:
    """What an annotation means, and an example."""
    parts, origin = get_args(hint), get_origin(hint)
    if origin is Annotated and parts[1] in (number_array, complex_array):
        return {"complex array"}, np.array([0.1, 0.2])
    if origin is Annotated:
        return ({"array"}, np.array([0.1, 0.2])) if parts[0] == ArrayLike else meaning(parts[0])
    if hint in (Complex, Numbers, ArrayLike):
        return {"complex array"}, np.array([0.1, 0.2])
    for kind, found in (
        (Array, ({"array"}, np.array([0.1, 0.2]))),
        (Mask, ({"mask"}, np.array([True]))),
        (float, (set(), 0.3)),
        (int, (set(), 16)),
        (str, ({"text"}, "wedge")),
        (bool, ({"truth"}, False)),
    ):
        if hint == kind:
            return found
    if origin is Literal:
        return set(), parts[0]
    if origin in (Union, UnionType):
        kinds, example = meaning(parts[0])
        return kinds | ({"optional"} if type(None) in parts else set()), example
    if origin is Callable:
        return {"function"}, lambda *_: 0.0
    if origin is Sequence:
        return set(), [meaning(parts[0])[1]]
    if origin is tuple:
        return set(), tuple(meaning(part)[1] for part in parts)
    assert inspect.isclass(hint), f"what does {hint} mean?"
    return set(), bare(hint)


def public_functions() -> dict[str, tuple[Callable[..., Any], type | None]]:
    """Functions, methods with their class, and constructors that check, by name."""
    found: dict[str, tuple[Callable[..., Any], type | None]] = {}
    for module in pkgutil.walk_packages(hopper.__path__, "hopper."):
        if module.name in TOOLS:
            continue
        for name, member in vars(import_module(module.name)).items():
            if name.startswith("_") or getattr(member, "__module__", "") != module.name:
                continue
            place = f"{module.name}.{name}"
            if not inspect.isclass(member):
                found |= {place: (member, None)} if callable(member) else {}
                continue
            if "__post_init__" in vars(member):
                found[place] = member, None
            for method, function in vars(member).items():
                if inspect.isfunction(function) and not method.startswith("_"):
                    found[f"{place}.{method}"] = function, member
    return found


FUNCTIONS = {
    name: item
    for name, item in public_functions().items()
    if set(inspect.signature(item[0]).parameters) - {"self"}
}


def test_the_walk_finds_functions_methods_and_constructors():
    names = {name.removeprefix("hopper.") for name in FUNCTIONS}
    assert {"spectral.schur.schur_form", "problem.Hopper", "radial.solution.solve_radial"} <= names
    assert {"radial.solution.RadialSolution.fields", "assessment.summary.assess"} <= names


@pytest.mark.parametrize("place", FUNCTIONS)
def test_rubbish_is_refused_by_name(place):
    function, owner = FUNCTIONS[place]
    hints = {
        name: parameter.annotation
        for name, parameter in inspect.signature(function).parameters.items()
        if name != "self"
    }
    good = {name: meaning(hint)[1] for name, hint in hints.items()}
    bound = [] if owner is None else [bare(owner)]
    for name, hint in hints.items():
        for value, meant in RUBBISH.values():
            if meaning(hint)[0] & set(meant.split(", ")):
                continue
            # Functions that take names of things speak of the thing.
            named = None if name == "name" else rf"^{name}\b"
            with pytest.raises(InvalidParameterError, match=named) as info:
                function(*bound, **(good | {name: value}))
            assert "\n" not in str(info.value)
            assert len(str(info.value)) < 250


# Values of the right kind that make no sense, or little.
ABSURD: dict[type, list[Any]] = {
    float: [0.0, -1.0, 1.5, 5e-324, 1e308, -1e308],
    int: [0, -3, 1, 2],
    str: ["", "nonsense"],
    np.ndarray: [[], 3, [-1.0, 0.0], [5e-324], [1e308, -1e308], np.eye(2), np.zeros((0, 3))],
    list: [[]],
}
# A call that comes to a result takes seconds there.
SLOW = (
    "hopper.assessment", "hopper.domain.neutral", "hopper.domain.borders",
    "hopper.domain.coupled", "hopper.von_mises.neutral",
)  # fmt: skip


def is_complete(hint: Any) -> bool:
    """Whether the example of an annotation is good for more than a check of its type."""
    kind = type(meaning(hint)[1])
    return kind in instances() or not kind.__module__.startswith("hopper.")


@pytest.mark.parametrize(
    "place",
    [
        pytest.param(place, marks=[pytest.mark.soak] if place.startswith(SLOW) else [])
        for place in FUNCTIONS
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_absurd_values_give_results_or_typed_errors(place):
    function, owner = FUNCTIONS[place]
    parameters = inspect.signature(function).parameters.values()
    hints = {p.name: p.annotation for p in parameters if p.name != "self"}
    if (owner and owner not in instances()) or not all(map(is_complete, hints.values())):
        pytest.skip("takes results of other functions")
    good = {name: meaning(hint)[1] for name, hint in hints.items()}
    bound = [] if owner is None else [instances()[owner]]
    for name in hints:
        for value in ABSURD.get(type(good[name]), []):
            with suppress(HopperError):
                function(*bound, **(good | {name: value}))
