"""Sign changes and jumps of functions whose own are known."""

from math import cos, nan, sqrt

import numpy as np
import pytest

from hopper.errors import InvalidParameterError
from hopper.evidence.sign_changes import sign_changes

PLACES = np.linspace(0, 10, 11)
WIDTH = 0.01


def brackets(found, places):
    assert len(found) == len(places), found
    for change, place in zip(found, places, strict=True):
        assert change.error <= WIDTH / 2
        assert abs(change.place - place) <= change.error * (1 + 1e-9)


def test_a_smooth_sign_change_takes_few_evaluations():
    """The places, two for each of three steps around it, and two or three to narrow it."""
    seen = []
    (found,) = sign_changes(lambda x: seen.append(x) or x**3 - 120, PLACES, WIDTH)  # type: ignore[func-returns-value]
    brackets([found], [120 ** (1 / 3)])
    assert len(set(seen)) <= PLACES.size + 6 + 3


@pytest.mark.parametrize("root", [0.3, 3.14, 5, 9.9])
def test_a_continuous_sign_change(root):
    for slope in (-1.0, 0.3):
        (found,) = sign_changes(lambda x: slope * (x - root) * (1 + x / 50), PLACES, WIDTH)  # noqa: B023
        brackets([found], [root])
        assert not found.jump
        assert (found.before > 0) != (found.after > 0)


def test_every_sign_change_of_a_cosine():
    found = sign_changes(cos, PLACES, WIDTH)
    brackets(found, [np.pi / 2, 3 * np.pi / 2, 5 * np.pi / 2])
    assert not any(change.jump for change in found)


@pytest.mark.parametrize("at", [2.22, 5.55, 7.77])
def test_a_sign_change_that_is_a_jump(at):
    (found,) = sign_changes(lambda x: 1 - x / 20 if x < at else -1 - x / 20, PLACES, WIDTH)
    brackets([found], [at])
    assert found.jump
    assert (found.before, found.after) == pytest.approx((1 - at / 20, -1 - at / 20), abs=1e-3)


@pytest.mark.parametrize("at", [4.4, 5.4])
def test_a_jump_beside_a_sign_change(at):
    """A falling line that jumps up by a third of a step of the scan, as the paper's abscissa."""
    function = lambda x: 5 - x + 0.33 * (x > at)  # noqa: E731
    found = sign_changes(function, PLACES, WIDTH)
    root = 5.33 if at < 5 else 5
    brackets(found, sorted([at, root]))
    assert [change.jump for change in found] == [place == at for place in sorted([at, root])]


def test_a_kink_is_no_jump():
    for function in (lambda x: max(5 - x, 4.6 - 0.3 * x - 0.5), lambda x: abs(x - 4.3) - 0.9):
        assert not any(change.jump for change in sign_changes(function, PLACES, WIDTH))


@pytest.mark.parametrize("bend", [4.1, 4.45, 5.6, 6.2])
def test_a_bend_takes_few_evaluations(bend):
    """It is told from a jump after a step or two, not at the width of a bracket."""
    seen = []

    def function(x):
        seen.append(x)
        return 5.05 - x - 0.3 * np.arctan(8 * (x - bend)) * (x - bend) + 0.1 * (x - bend) ** 2

    (found,) = sign_changes(function, PLACES, WIDTH)
    assert not found.jump
    assert len(set(seen)) <= PLACES.size + 6 + 3 + 4


def test_gaps_are_no_sign_changes():
    function = lambda x: nan if 4 < x < 6 else 5 - x  # noqa: E731
    assert sign_changes(function, PLACES, WIDTH) == []
    (found,) = sign_changes(lambda x: nan if x < 4.9 else sqrt(x) - 2.5, PLACES, WIDTH)
    brackets([found], [6.25])


@pytest.mark.parametrize("places", [[1.0], [1.0, 1.0], [2.0, 1.0], [[1.0, 2.0]]])
def test_wrong_places(places):
    with pytest.raises(InvalidParameterError, match="places must be two or more increasing"):
        sign_changes(cos, places, WIDTH)


@pytest.mark.parametrize("width", [0.0, -1.0, nan])
def test_a_wrong_width(width):
    with pytest.raises(InvalidParameterError, match=r"width = .* must be (positive|finite)"):
        sign_changes(cos, PLACES, width)
