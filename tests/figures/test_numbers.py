"""Layer 1: the numbers behind the figures."""

import pytest

from hopper_workflow import reading
from tests.figures import numbers


def test_artifact(artifact, storing):
    data, entry = reading.read(f"results/{artifact}", stored=True), numbers.entry_of(artifact)
    path = numbers.REFERENCES / artifact
    found = ["there is no reference"]
    if path.exists():
        found = numbers.differences(data, numbers.stored(artifact), entry)
    if storing and found:
        numbers.store(numbers.reference(data, entry), path)
    elif found:
        pytest.fail(f"results/{artifact}:\n  " + "\n  ".join(found), pytrace=False)
