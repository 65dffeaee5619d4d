"""Other processors round differently: numbers agree within the tolerances, verdicts are the same.

OpenBLAS takes the kernels of another processor when told to, and NumPy leaves out the instruction
sets that processor lacks.
"""

import csv

import pytest

from hopper_workflow import artifacts, reading
from tests.figures import numbers
from tests.reliability import record
from tests.workflow.conftest import interpreter

pytestmark = pytest.mark.workflow
_AVX512 = "X86_V4 AVX512_ICL AVX512_SPR"
# OPENBLAS_CORETYPE: NPY_DISABLE_CPU_FEATURES
PROCESSORS = {
    "Prescott": f"X86_V3 {_AVX512}",
    "Sandybridge": f"X86_V3 {_AVX512}",
    "Haswell": _AVX512,
    "SkylakeX": "",
}
SOME = (
    "results/radial/fig_3_2.nc",
    "results/spectrum/fig_4_2/cone.nc",
    "results/borders/cone_30.nc",
)


def build(workflow, processor, *targets):
    """Build with a Python that sets the variables by itself: from a user jobs do not take them."""
    variables = {
        "OPENBLAS_CORETYPE": processor,
        "NPY_DISABLE_CPU_FEATURES": PROCESSORS[processor],
        "PYTHONWARNINGS": "ignore",
    }
    code = f"import os; os.environ.update({variables})"
    workflow.python = str(interpreter(workflow.path.parent / f"python {processor}", code))
    workflow.build(*targets)


@pytest.mark.soak
def test_an_old_processor_agrees_within_the_tolerances(built, fresh):
    build(fresh, "Prescott", *SOME)
    changed = 0
    for path in SOME:
        artifact = path.removeprefix("results/")
        entry = numbers.entry_of(artifact)
        ours, other = (reading.read(each.path / path, stored=True) for each in (built, fresh))
        assert numbers.differences(other, numbers.reference(ours, entry), entry) == [], path
        changed += artifacts.checksum(built.path / path) != artifacts.checksum(fresh.path / path)
    # Where no byte differs the processor was not another one.
    assert changed > 0


@pytest.mark.soak
def test_every_processor_agrees_with_the_references(copy_workflow, tmp_path):
    verdicts: dict[str, list[tuple[str, str]]] = {}
    contents: dict[str, set[str]] = {}
    ledgers: set[str] = set()
    compared = 0
    for processor in PROCESSORS:
        workflow = copy_workflow(tmp_path / processor, coarse=False)
        build(workflow, processor, "results/claims.md")
        ledgers.add((workflow.path / "results/claims.md").read_text(encoding="utf-8"))
        for path in sorted((workflow.path / "results").rglob("*.nc")):
            artifact = str(path.relative_to(workflow.path / "results"))
            contents.setdefault(artifact, set()).add(artifacts.checksum(path))
            if not (numbers.REFERENCES / artifact).exists():
                continue
            entry = numbers.entry_of(artifact)
            found = numbers.differences(
                reading.read(path, stored=True), numbers.stored(artifact), entry
            )
            assert found == [], f"{processor}: {artifact}"
            compared += 1
        with (workflow.path / "results/claims.csv").open(encoding="utf-8", newline="") as file:
            verdicts[processor] = [(row["id"], row["verdict"]) for row in csv.DictReader(file)]
    first, *_ = verdicts.values()
    assert first
    unlike = sum(
        one != other
        for others in verdicts.values()
        for one, other in zip(first, others, strict=True)
    )
    assert unlike == 0, verdicts
    assert len(ledgers) == 1
    differing = sum(len(checksums) > 1 for checksums in contents.values())
    assert differing > 0
    record(
        "processors",
        f"The workflow was run in full with the BLAS kernels and instruction sets of "
        f"{', '.join(PROCESSORS)}: all numbers agree with the stored references within the "
        "tolerances of `make check`, and the ledger is the same, character by character.",
        {"processors": len(PROCESSORS), "artifacts compared": compared,
         "artifacts whose bytes depend on the processor": f"{differing} of {len(contents)}",
         "verdicts compared": len(first) * len(verdicts), "verdicts that differ": unlike},
    )  # fmt: skip
