"""The checks can fail: each layer finds a deliberate change of what it guards, figure by figure."""

import numpy as np
from matplotlib.testing.compare import compare_images

from hopper_workflow import plotting, reading
from tests.figures import images, numbers, structure


def test_a_wrong_sign_is_found(artifact):
    data, entry = reading.read(f"results/{artifact}", stored=True), numbers.entry_of(artifact)
    stored = numbers.stored(artifact)
    bounded = {name for rule in entry["rules"] if "below" in rule for name in rule["variables"]}
    compared = [
        name
        for name, values in data.data_vars.items()
        if values.dtype.kind == "f" and abs(values).max() > 0
    ]
    # A spectrum is symmetric: with the sign of all imaginary parts changed it is the same.
    for name in {*compared} - bounded - {"eigenvalue_imag"}:
        assert numbers.differences(data.assign({name: -data[name]}), stored, entry), name


def test_a_missing_curve_and_a_changed_colour_are_found(plot, tmp_path):
    stored = structure.load(structure.STORED / f"{plot.name}.yaml")
    figure = plot.draw()
    curve = max(figure.axes[0].lines, key=lambda line: np.isfinite(line.get_ydata()).sum())

    curve.set_color(plotting.AMBER)
    found = structure.differences(structure.describe(figure), stored)
    assert found
    assert all(".color" in line or ".face" in line for line in found)
    changed = tmp_path / "changed.png"
    figure.savefig(changed, **images.SAVING)
    baseline = str(images.BASELINE / f"{plot.name}.png")
    assert compare_images(baseline, str(changed), tol=images.TOLERANCE)

    curve.remove()
    found = structure.differences(structure.describe(figure), stored)
    assert any(line.startswith("figure.axes[0].artists: ") for line in found)
