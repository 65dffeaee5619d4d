"""Layer 4: each figure as a reader of the printed page sees it."""

import pytest

from tests.figures import printing


def test_printing(plot):
    if found := printing.faults(plot.draw()):
        pytest.fail(f"{plot.name}:\n  " + "\n  ".join(found), pytrace=False)
