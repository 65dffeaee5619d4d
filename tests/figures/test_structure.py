"""Layer 2: what is drawn in each figure."""

import pytest

from tests.figures import structure


def test_structure(plot, storing):
    drawn, path = structure.describe(plot.draw()), structure.STORED / f"{plot.name}.yaml"
    found = ["there is no stored description"]
    if path.exists():
        found = structure.differences(drawn, structure.load(path))
    if storing and found:
        structure.store(drawn, path)
    elif found:
        pytest.fail(f"{plot.name}:\n  " + "\n  ".join(found), pytrace=False)
