"""Roots against closed forms and SciPy's, and how many values they take."""

from math import atan, cos, exp, inf, nan, pi

import numpy as np
import pytest
from scipy.optimize import brentq

from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.roots import root_between

FUNCTIONS = [
    (lambda x: x - 1, -2.0, 5.0, 1.0),
    (lambda x: x**3, -1.0, 1.5, 0.0),
    (lambda x: x**2 - 2, 0.0, 2.0, 2**0.5),
    (lambda x: cos(x), 0.0, 3.0, pi / 2),
    (lambda x: exp(20 * x) - 1, -3.0, 1.0, 0.0),
    (lambda x: atan(1e3 * (x - 0.3)), -1.0, 1.0, 0.3),
    (lambda x: -1.0 if x < 0.7 else 1.0, 0.0, 1.0, 0.7),
    (lambda x: -inf if x < 0.1 else x - 0.5, 0.0, 1.0, 0.5),
    (lambda x: abs(x - 0.2) ** 0.5 * np.sign(x - 0.2), 0.0, 1.0, 0.2),
    (lambda x: 1e200 * (x - 0.25), 0.0, 1.0, 0.25),
]


@pytest.mark.parametrize("case", FUNCTIONS)
@pytest.mark.parametrize("xtol", [1e-3, 1e-9, 1e-14])
def test_roots_are_as_close_as_asked(case, xtol):
    function, low, high, root = case
    for ends in ((low, high), (high, low)):
        assert abs(root_between(function, *ends, xtol) - root) <= xtol + 1e-15


def test_roots_take_no_more_values_than_those_of_scipy():
    rng, ours, theirs = np.random.default_rng(5), 0, 0
    for _ in range(300):
        series, low = rng.normal(size=6), rng.uniform(-2, 0)
        places: list[float] = []

        def polynomial(x, series=series, places=places):
            places.append(x)
            return float(np.polyval(series, x))

        high = low + rng.uniform(0.1, 2)
        if polynomial(low) * polynomial(high) >= 0:
            continue
        places.clear()
        found, count = root_between(polynomial, low, high, 1e-12), len(places)
        places.clear()
        expected = brentq(polynomial, low, high, xtol=1e-12)
        ours, theirs = ours + count, theirs + len(places)
        # Where there are three roots, either may be found.
        assert abs(found - expected) < 3e-12 or abs(polynomial(found)) < 1e-9
    assert ours <= theirs


def test_a_root_at_an_end_is_that_end():
    assert root_between(lambda x: x, 0.0, 1.0) == 0.0
    assert root_between(lambda x: x - 1, 0.0, 1.0) == 1.0


@pytest.mark.parametrize(
    "function",
    [lambda x: x + 2, lambda x: 1e-200 * (x + 1), lambda _: nan, lambda x: nan if x else -1.0],
)
def test_without_a_change_of_sign_there_is_an_error(function):
    with pytest.raises(InvalidParameterError):
        root_between(function, 0.0, 1.0)


def test_a_function_that_never_settles_is_an_error(monkeypatch):
    monkeypatch.setattr("hopper.roots._MOST_STEPS", 5)
    with pytest.raises(ConvergenceError, match="5 steps"):
        root_between(lambda x: x**9, -1.0, 1.5, 1e-14)
