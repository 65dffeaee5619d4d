"""No two commands disagree on mass flow: random hoppers, asked by all of them."""

import json
import re
from math import degrees

import numpy as np
import pytest

from hopper.design.design import design
from hopper.errors import HopperError
from hopper_cli import sentences, sheets
from hopper_cli.columns import Columns
from hopper_data.hopper_lists import HopperList
from hopper_data.inputs import Case
from hopper_data.walls import Wall

YES = re.compile("^Mass flow: yes")
SPARE = re.compile(r"with ([\d.e-]+) deg of half angle|half angle is ([\d.e-]+) deg too large")


def hoppers(count, seed):
    random = np.random.default_rng(seed)
    for _ in range(count):
        geometry = str(random.choice(["cone", "wedge"]))
        delta, half_angle = random.uniform(22, 65), random.uniform(4, 55)
        phi = random.uniform(0, 0.9 * delta)
        yield geometry, *(round(angle, 3) for angle in (delta, half_angle, phi))


def row_of(geometry, delta, half_angle, phi):
    titles = ("geometry", "delta", "half-angle", "phi")
    cells = dict(zip(titles, map(str, (geometry, delta, half_angle, phi)), strict=True))
    listed = HopperList(titles, (cells,), {name: name for name in titles})
    return sheets.row_answer(listed, 0, Columns([]))


def agree(run, hopper, others):
    """Compare what the commands say of a hopper; ``others`` are those that take long."""
    geometry, delta, half_angle, phi = hopper
    row = row_of(*hopper)
    given = f"--geometry {geometry} --delta {delta} --half-angle {half_angle} --phi {phi} --json"
    for command in ("radial", *others):
        code, out, _ = run(f"{command} {given}")
        if code == 0:
            assert json.loads(out)["sentence"] == row["sentence"], hopper
        else:
            # Without a radial solution there is no mass flow.
            assert row["verdict"] is None, hopper
            assert not YES.match(row["sentence"] or ""), hopper
    if others:
        limit_agrees(hopper, row["sentence"])


def limit_agrees(hopper, sentence):
    geometry, delta, half_angle, phi = hopper
    case = Case(geometry, "mohr-coulomb", delta, half_angle, Wall.of(phi_deg=phi))
    try:
        found = design(case.material, 0.05)
    except HopperError:
        return
    limit = found.half_angles.mass_flow
    assert sentences.design_sentence(found).startswith("Mass flow: up to") == (limit is not None)
    spare = SPARE.search(sentence)
    # A limit beyond the last radial solution is none that a design speaks of.
    if limit and spare:
        said = float(spare[1] or spare[2]) * (1 if spare[1] else -1)
        assert degrees(limit.value) - half_angle == pytest.approx(said, rel=6e-3), hopper
        assert bool(YES.match(sentence)) == (limit.value > case.hopper.half_angle)


@pytest.mark.parametrize("seed", range(8))
def test_commands_agree(run, seed):
    *cheap, whole = hoppers(5, seed)
    for hopper in cheap:
        agree(run, hopper, ())
    agree(run, whole, ("stability",))


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(100, 200))
def test_commands_agree_on_many(run, seed):
    for hopper in hoppers(10, seed):
        agree(run, hopper, ("stability",))
