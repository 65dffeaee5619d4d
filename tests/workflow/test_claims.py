"""The claims ledger: complete, computed, and sensitive to every number it rests on."""

import csv
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
import xarray as xr
import yaml

from hopper_workflow import reading
from hopper_workflow.claims.finding import (
    FAILS,
    HOLDS,
    LIMITED,
    UNDECIDED,
    VERDICTS,
    Printed,
    above,
    below,
    counted,
    limited,
    rounded_up,
    rounds,
    upper_bound,
)
from hopper_workflow.claims.ledger import COLUMNS, JUDGES, judge
from hopper_workflow.claims.results import parameters
from hopper_workflow.claims.words import read_claims
from hopper_workflow.configuration import ConfigurationError
from render_claims import cell, figure, symbols
from tests.workflow.conftest import ROOT

CLAIMS = read_claims(ROOT / "resources/claims.yaml", ROOT / "workflow/schemas/claims.schema.yaml")
IDS = [claim.id for claim in CLAIMS]
needs_artifacts = pytest.mark.workflow


# From numbers to verdicts.


@pytest.mark.parametrize(
    ("printed", "value", "error", "verdict"),
    [
        ("33.75", 33.748989, 0, HOLDS),
        ("33.75", 33.848989, 0, FAILS),
        ("33.75", 33.7551, 1e-3, HOLDS),
        ("33.75", 33.7551, 1e-5, FAILS),
        ("155", 155.2386, 0, HOLDS),
        ("155", 155.6, 0, FAILS),
        ("0.9159", 0.915933, 0, HOLDS),
    ],
)
def test_a_printed_number_holds_if_the_computed_one_rounds_to_it(printed, value, error, verdict):
    assert rounds(Printed.parse(printed), value, error, "").verdict == verdict


def test_an_exact_number_allows_for_rounding_only():
    exact = Printed.exact(3.0)
    assert rounds(exact, 3 + 1e-14, 0, "").verdict == HOLDS
    assert rounds(exact, 3 + 1e-9, 0, "").verdict == FAILS


def test_bounds():
    assert below(1.0, 2.0, 0.1, "").verdict == HOLDS
    assert below(2.05, 2.0, 0.1, "").verdict == UNDECIDED
    assert below(2.2, 2.0, 0.1, "").verdict == FAILS
    assert above(2.2, 2.0, 0.1, "") == replace(below(-2.2, -2.0, 0.1, ""), computed=2.2)
    assert above(1.0, 2.0, 0.1, "").verdict == FAILS


def test_counts():
    assert [counted(n, 3, "").verdict for n in (3, 2, 1, 0)] == [HOLDS, LIMITED, LIMITED, FAILS]
    held, failed = counted(3, 3, ""), counted(0, 3, "")
    assert limited(held, True).verdict == LIMITED
    assert limited(held, False) == held
    assert limited(failed, True) == failed


# The words.


def test_every_claim_has_its_function_and_every_function_its_claim():
    assert len(CLAIMS) >= 40
    assert sorted(IDS) == sorted(JUDGES)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("id", "Not An Id", r"claims.yaml key 'claims\[0\]\.id': .* does not match"),
        ("test", "", r"key 'claims\[0\]\.test': '' should be non-empty"),
        ("typo", 1, r"key 'claims\[0\]': .*'typo' was unexpected"),
        ("artifacts", {"a": "../x.nc"}, r"key 'claims\[0\]\.artifacts\.a': .* does not match"),
        ("thresholds", {"a": 3}, r"key 'claims\[0\]\.thresholds\.a': 3 is not of type 'object'"),
        ("id", IDS[1], f"claims.yaml: 2 claims have the id '{IDS[1]}'"),
    ],
)
def test_bad_words_are_named(tmp_path, key, value, message):
    content = yaml.safe_load((ROOT / "resources/claims.yaml").read_text(encoding="utf-8"))
    content["claims"][0] |= {key: value}
    path = tmp_path / "claims.yaml"
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
    with pytest.raises(ConfigurationError, match=message):
        read_claims(path, ROOT / "workflow/schemas/claims.schema.yaml")


# How it reads.


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("psi_w < pi/4 + delta/2 at 10 deg", "\u03c8_w < \u03c0/4 + \u03b4/2 at 10\u00b0"),
        ("T_phiphi = sigma_1, psi1/2", "T_\u03c6\u03c6 = \u03c3_1, \u03c81/2"),
        ("r^-2 <= sqrt(12) mu", "r\u207b\u00b2 \u2264 \u221a12 \u03bc"),
        ("a spine, a muse and some degrees", "a spine, a muse and some degrees"),
    ],
)
def test_symbols(text, shown):
    assert symbols(text) == shown


@pytest.mark.parametrize("kernel", [1.0, 0.4, 1.9])
def test_rounding_is_a_bound_that_does_not_depend_on_the_machine(kernel):
    assert figure(f"{4.44089e-16 * kernel:.10g}", "1.0e-14", "1e-10") == "< 1e-10"
    assert figure("0", f"{3e-13 * kernel:.1e}", "1e-12") == "< 1e-12"
    assert figure("0.0212284", f"{1e-13 * kernel:.1e}", "0.025") == "0.0212284"


@pytest.mark.parametrize("error", [5.04e-10, 9.96e-3, 1.0, 0.1, 1e-320, 2.5e-7])
def test_an_error_in_two_digits_still_covers(error):
    assert error <= float(rounded_up(error)) <= 1.1 * error + 5e-324


def test_what_rounding_leaves_has_no_digits_of_its_own():
    assert upper_bound(4e-16, 1e-10) == "< 1e-10"
    for modulus in (2.9e-9, 3.0e-9):
        folds = {"modulus": modulus, "modulus_error": 8e-8, "before": 1, "behind": 0}
        data = xr.Dataset({f"fold_{name}": ("fold", [value]) for name, value in folds.items()})
        found = JUDGES["folds_are_neutral"](data, zero=1e-9)
        assert found.verdict == HOLDS
        assert "Largest |lambda| < 1e-08;" in found.remark
    residual = 5.04e-10
    assert figure(f"{residual:.10g}", rounded_up(residual), "1e-07") == "< 1e-07"
    for share in (0.0, 4 / 399):
        assert figure(f"{share:.10g}", rounded_up(max(share, 1 / 399)), "0.05") == "< 0.05"


def test_what_exceeds_its_bound_is_told():
    assert upper_bound(0.032, 1e-10) == "3.2e-02"
    assert upper_bound(float("nan"), 1e-10) == "nan"


def test_figures_and_cells():
    assert figure("33.74898860", "3.4e-13", "none") == "33.749"
    assert figure("0.5541531", "0.0904", "none") == "0.55 \u00b1 0.09"
    assert figure("-0.0009022551", "4e-05", "none") == "-0.00090 \u00b1 4e-05"
    assert figure("15.9455", "1.2", "none") == "16 \u00b1 1"
    assert figure("0", "0", "none") == "0"
    assert figure("798", "0", "none") == "798"
    assert figure("none", "none", "none") == "none"
    assert cell("|a_1| < 2*b") == "\\|a\\_1\\| \\< 2\\*b"


# The ledger of the coarse workflow.


@pytest.fixture(scope="module")
def ledger(built):
    with (built.path / "results/claims.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@needs_artifacts
def test_the_ledger_is_complete(built, ledger):
    assert [row["id"] for row in ledger] == IDS
    assert [row["number"] for row in ledger] == [str(n) for n in range(1, len(IDS) + 1)]
    for row in ledger:
        assert tuple(row) == COLUMNS
        assert all(row.values()), f"{row['id']}: an empty column"
        assert row["verdict"] in VERDICTS
        for path in row["artifact"].split("; "):
            assert (built.path / path).is_file()
        if row["verdict"] != UNDECIDED:
            assert float(row["error"]) >= 0
            assert np.isfinite(float(row["computed"]))


@needs_artifacts
def test_the_artifacts_know_the_parameters_a_claim_asks_for(data):
    for claim in CLAIMS:
        known = [parameters(data[path]) for path in claim.paths]
        for name in claim.parameters:
            assert any(name in made_with for made_with in known), f"{claim.id}: {name}"


@needs_artifacts
def test_other_parameters_than_those_of_the_claim_leave_it_undecided(ledger):
    row = next(row for row in ledger if row["id"] == "matrix_size")
    assert row["verdict"] == UNDECIDED
    assert (row["computed"], row["error"]) == ("none", "none")
    assert "the claim is about nodes = 400, the artifact has 80" in row["remark"]


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.text, self.tags, self.addresses = [], [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self.addresses += [value for name, value in attrs if name in ("src", "href")]

    def handle_data(self, data):
        self.text.append(data)


@needs_artifacts
def test_the_page_shows_every_claim_and_needs_nothing_else(built, ledger):
    page = Page()
    html = (built.path / "results/claims.html").read_text(encoding="utf-8")
    page.feed(html)
    text = " ".join("".join(page.text).split())
    for row in ledger:
        for column in ("place", "claim", "test", "remark"):
            assert symbols(row[column]) in text
        for path in row["artifact"].split("; "):
            assert path.removeprefix("results/") in text
    cells = [attrs["class"] for tag, attrs in page.tags if tag == "td" and "class" in attrs]
    assert [name.split()[0] for name in cells] == ["verdict"] * len(ledger)
    styles = {row["verdict"]: cell for row, cell in zip(ledger, cells, strict=True)}
    assert len(set(styles.values())) == len(styles), "one colour for each verdict"
    for verdict in styles:
        assert verdict in text, "the words, too"
    assert not [tag for tag, _ in page.tags if tag in ("script", "link", "img", "iframe")]
    targets = {attrs["id"] for _, attrs in page.tags if "id" in attrs}
    here = {address for address in page.addresses if address.startswith("#")}
    assert {address[1:] for address in here} <= targets
    for address in set(page.addresses) - here:
        assert (built.path / "results" / address).is_file(), address


@needs_artifacts
def test_the_markdown_shows_every_claim(built, ledger):
    lines = (built.path / "results/claims.md").read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if line.startswith("| ") and line[2].isdigit()]
    assert len(rows) == len(ledger)
    for line, row in zip(rows, ledger, strict=True):
        assert line.replace("\\|", "").count("|") == 8
        assert row["verdict"] in line


# Every verdict can change.


@pytest.fixture(scope="module")
def data(built):
    """Artifacts by path, and claims about whatever parameters they were made with."""
    paths = {path for claim in CLAIMS for path in claim.paths}
    return {path: reading.read(built.path / path) for path in paths}


def without_parameters(name):
    return replace(CLAIMS[IDS.index(name)], parameters={})


def changed(claim, data, changes):
    """Artifacts with variables changed; ``changes`` maps (artifact, variable) to a function."""
    result = dict(data)
    for (argument, variable), function in changes.items():
        path = f"results/{claim.artifacts[argument]}"
        array = result[path][variable]
        result[path] = result[path].assign({variable: array.copy(data=function(array.values))})
    return result


def constant(value):
    return lambda x: np.full_like(x, value)


def plus(value):
    return lambda x: x + value


def times(value):
    return lambda x: x * value


def of_model(index, value):
    """Set the values of one model, the first dimension."""

    def change(x):
        x = x.copy()
        x[index] = value
        return x

    return change


def each(arguments, variable, function):
    return {(argument, variable): function for argument in arguments}


def tilted(slope):
    """Add a slope along the last dimension."""
    return lambda x: x + slope * np.arange(x.shape[-1])


def exchanged(x):
    return np.where(x == "sine", "cosine", "sine")


def taller(x):
    """Stretch complex numbers in the imaginary direction."""
    return x.real + 1.01j * x.imag


def variants_apart(x):
    """Pull the wavenumbers of Kummer and Legendre away from those of Bessel."""
    return x * np.array([1, 1.1, 1.2])[:, None, None]


SHAPES = ("wedge", "cone")
ROOTS = {("smooth", "neutral_delta"): plus(0.1), ("linear", "neutral_root"): plus(0.1)}
RUN = {("spectrum", "run_start"): constant(0), ("spectrum", "run_stop"): constant(250)}
MAPS = ("wedge_10", "cone_10", "wedge_30", "cone_30")
WEDGES, MIRRORED = ("wedge_10", "wedge_30"), constant("mirrored")
# For each claim a change of its artifacts that must change the verdict.
CHANGES = {
    "solutions_exist": {("moderate", "error_radial"): constant(1)},
    "jenike_tabulated_them": {("chart", "rms_deviation"): constant(0.03)},
    "stress_falls_and_particles_accelerate": {("rough", "u"): times(-1)},
    "radial_stress_is_autonomous": {("models", "coupling_radial"): constant(0.1)},
    "stress_decouples_for_mohr_coulomb_only": {("models", "coupling"): constant(0)},
    "mohr_coulomb_is_hyperbolic": {("models", "real_characteristics"): constant(2)},
    "log_r_is_like_time": each(MAPS, "psi_max", constant(1)),
    "von_mises_is_not_always_hyperbolic": {("models", "real_characteristics"): constant(4)},
    "thresholds_carry_over": {("smooth", "neutral_delta"): plus(0.2)},
    "sharp_and_reliable": each(SHAPES, "check_as_worded", plus(100)),
    "principal_stress_ratio": {("models", "ratio_residual"): constant(1e-3)},
    "mohr_coulomb_yields": {("models", "yield_residual"): of_model(0, 1e-3)},
    "von_mises_yields": {("models", "yield_residual"): of_model(1, 1e-3)},
    "hoop_stress_is_major": {("models", "hoop_residual"): of_model(0, 1e-3)},
    "levy_factor_is_positive": {("models", "levy_least"): times(-1)},
    "wall_angle_of_mohr_coulomb": {("models", "wall_mu"): of_model(0, 0.1)},
    "wall_angle_of_von_mises": {("models", "wall_mu"): of_model(1, 0.1)},
    "von_mises_hoop_stress": {("models", "hoop_residual"): of_model(1, 1e-3)},
    "mohr_coulomb_is_nonsingular": {("models", "singular_psi"): of_model(0, 50)},
    "von_mises_is_nonsingular": {("models", "singular_psi"): of_model(1, 50)},
    "von_mises_condition_is_more_stringent": {("models", "singular_psi"): of_model(1, 89)},
    "exponent_of_mohr_coulomb": {("models", "exponent"): plus(1e-3)},
    "exponent_of_von_mises": {("models", "exponent"): plus(1e-3)},
    "comparable_at_moderate_roughness": {("moderate", "sigma"): of_model(0, 3)},
    "different_at_large_roughness": {("rough", "u"): constant(0.5)},
    "non_radial_solutions_break_down": {("marches", "breakdown_kind"): constant("none")},
    "flow_is_approximately_radial": {("marches", "settled"): times(0.1)},
    "velocity_differs_most": {("rough", "sigma"): of_model(0, 0.001)},
    "stagnant_zone_of_mohr_coulomb": {("rough", "u"): plus(0.1)},
    "no_stagnant_zone_of_von_mises": {("rough", "u"): times(0.1)},
    "psi_comes_close_to_quarter_pi": {("rough", "psi_max"): times(0.9)},
    "psi_peaks_at_the_edge": {("rough", "theta_psi_max"): constant(18)},
    "one_field_for_each_friction": {("models", "solutions"): constant(1)},
    "solutions_can_be_linearised": {
        ("models", "mohr_coulomb_singular_psi"): constant(1)
    },
    "mohr_coulomb_is_more_conservative": {("moderate", "u_wall"): of_model(0, 0.1)},
    "mohr_coulomb_is_more_conservative_on_stability": {
        **each(("coulomb_10", "coulomb_30"), "abscissa", constant(1.0)),
        **each(("von_mises_10", "von_mises_30"), "region", constant("stable")),
    },
    "von_mises_is_more_challenging": each(("cone_10", "cone_30"), "region", constant("stable")),
    "equations_as_printed": {("linear", "printed_ratio"): constant(1)},
    "spectrum_as_printed": {("linear", "printed_ratio"): plus(1e-3)},
    "negative_means_stable": {("cone", "abscissa"): times(-1)},
    "psi_is_small": {("linear", "smooth_psi_max"): plus(10)},
    "wedge_formula": {("linear", "formula_error"): constant(1e-3)},
    "wedge_eigenvalues_form_pairs": {("linear", "missing"): constant(0)},
    "neutral_wedge": ROOTS,
    "wedge_unstable_below": {("smooth", "neutral_delta"): plus(2)},
    "only_sine_modes_are_physical": {("exact", "kind"): exchanged},
    "cone_formula": {("linear", "formula_error"): constant(1e-3)},
    "cone_eigenvalues_form_pairs": {("linear", "missing_real"): constant(1)},
    "cotangent_may_be_approximated": {("smooth", "wavenumber"): variants_apart},
    "only_regular_bessel_modes_are_physical": {("cone", "half"): MIRRORED},
    "zeros_of_the_discriminant": {("linear", "onset_sine"): plus(1e-3)},
    "largest_half_angle_in_radians": {("smooth", "largest_half_angle"): plus(0.1)},
    "largest_half_angle_in_degrees": {("smooth", "largest_half_angle"): plus(0.3)},
    "f_decreases": {("linear", "threshold"): lambda x: x[::-1]},
    "f_at_zero": {("linear", "threshold"): plus(1e-6)},
    "f_at_quarter_pi": {("linear", "threshold"): plus(1e-4), ("linear", "onset_sine"): plus(1e-4)},
    "real_eigenvalues_only_above": {("linear", "onset"): plus(0.1)},
    "all_complex_below": {("linear", "real_below_onset"): constant(2)},
    "neutral_cone": ROOTS,
    "cone_stable_above": {("smooth", "abscissa"): times(-1)},
    "curves_cross": {
        ("smooth", "crossing_delta"): plus(0.1), ("linear", "crossing_root"): plus(0.1)
    },
    "both_unstable_cone_more": {("smooth", "abscissa"): times(-1)},
    "both_stable_cone_more": {("smooth", "abscissa"): times(-1)},
    "confluent_hypergeometric_solution": {("linear", "kummer_residual"): constant(0.1)},
    "virtually_unchanged": {("smooth", "wavenumber"): variants_apart},
    "smooth_wedge_at_35_is_unstable": {("smooth", "abscissa"): times(-1)},
    "smooth_cone_at_35_is_stable": {("smooth", "abscissa"): times(-1)},
    "figure_wedge_is_unstable": {("stability", "abscissa"): times(-1)},
    "figure_cone_is_stable": {("stability", "abscissa"): times(-1)},
    "first_250_of_the_wedge": RUN,
    "first_250_of_the_cone": RUN,
    "displayed_wedge_is_converged": {("spectrum", "kept"): constant("no")},
    "displayed_cone_is_converged": {("spectrum", "kept"): constant("no")},
    "filter_removes_false_growth": {("stability", "abscissa"): constant(-4.380356)},
    "wedge_agrees_with_theory": {("exact", "eigenvalue"): taller},
    "cone_agrees_with_theory": {("exact", "eigenvalue"): taller},
    "first_derivative_is_sensitive": {
        ("linear", "derivative_digits_lost"): constant(1),
        ("linear", "derivative_digits_lost_error"): constant(0.1),
    },
    "first_derivative_has_no_eigenvalues": {("linear", "derivative_agreeing"): constant(60)},
    "like_a_second_order_operator": {
        **each(SHAPES, "run_start", constant(0)), **each(SHAPES, "run_stop", constant(255))
    },
    "wedge_is_mildly_sensitive": {("paper", "condition"): constant(1e4)},
    "cone_is_mildly_sensitive": {("paper", "condition"): constant(1e4)},
    "norms_obey_the_bounds": {("wedge", "upper_bound"): times(0.5)},
    "matrix_is_not_normal": each(SHAPES, "condition", plus(1)),
    "wedge_spectrum_is_vertical": {("spectrum", "eigenvalue"): tilted(0.01)},
    "cone_spectrum_is_vertical": {
        ("spectrum", "eigenvalue"): lambda x: -0.2 + 1j * (x.imag + 1)
    },
    "unstable_wedge_oscillates": {("linear", "oscillation"): constant(0.1)},
    "stable_cone_oscillates": {("linear", "oscillation"): constant(1)},
    "convergence_is_not_monotone": {("cone", "growth"): np.sort},
    "friction_range_is_regular": each(MAPS, "limit_mu", constant(1)),
    "log_r_is_a_time_for_all": each(MAPS, "tangency_mu", constant(2)),
    "symmetric_disturbances_suffice": each(WEDGES, "abscissa_symmetric", constant(100)),
    "small_friction_stabilises": each(MAPS, "abscissa", tilted(10)),
    "large_friction_destabilises": each(MAPS, "abscissa", tilted(-100)),
    "figure_wedge_is_less_stable": {("cone_10", "abscissa"): plus(10)},
    "wedge_is_less_stable": each(("cone_10", "cone_30"), "abscissa", plus(100)),
    "domain_is_inside_the_curve": {("narrow", "neutral_end"): constant("not_converged")},
    "folds_are_neutral": {("linear", "fold_modulus"): plus(1)},
    "domain_shrinks_with_opening": {("domain", "area"): constant(500)},
}  # fmt: skip


def test_every_claim_has_a_change():
    # The size of M cannot be changed by changing values.
    assert sorted(CHANGES) == sorted(set(IDS) - {"matrix_size"})


@needs_artifacts
@pytest.mark.parametrize("name", CHANGES)
def test_a_changed_artifact_changes_the_verdict(data, name):
    claim = without_parameters(name)
    before = judge(claim, data)
    after = judge(claim, changed(claim, data, CHANGES[name]))
    assert after.verdict != before.verdict, f"{before} {after}"
    assert after.verdict != UNDECIDED, after.remark


@needs_artifacts
def test_the_size_of_the_matrix_is_counted(data):
    claim = without_parameters("matrix_size")
    assert judge(claim, data).verdict == FAILS
    index = np.arange(798) % 158
    grown = {path: data[path].isel(mode=index) for path in claim.paths}
    assert judge(claim, {**data, **grown}).verdict == HOLDS


@needs_artifacts
@pytest.mark.parametrize("name", IDS)
def test_without_values_nothing_can_be_decided(data, name):
    claim = without_parameters(name)
    blank = {}
    for path in claim.paths:
        empty = data[path].copy(deep=True)
        for variable in empty.data_vars.values():
            if variable.dtype.kind in "fc":
                variable.values = np.full_like(variable.values, np.nan)
        # Integers and names have no NaN.
        others = [name for name, v in empty.data_vars.items() if v.dtype.kind in "iO"]
        blank[path] = empty.drop_vars(others)
    finding = judge(claim, blank)
    assert finding.verdict == UNDECIDED
    assert "has no" in finding.remark


@needs_artifacts
@pytest.mark.parametrize("name", IDS)
def test_without_variables_nothing_can_be_decided(data, name):
    claim = without_parameters(name)
    bare = {path: data[path].drop_vars(list(data[path].data_vars)) for path in claim.paths}
    assert judge(claim, bare).verdict == UNDECIDED


@needs_artifacts
@pytest.mark.parametrize("edited", ["resources/claims.yaml", "section_2.py", "finding.py"])
def test_editing_a_claim_reruns_the_ledger_only(rebuilt, edited):
    folder = "" if "/" in edited else "scripts/hopper_workflow/claims"
    path = rebuilt.path / folder / edited
    path.write_text(path.read_text(encoding="utf-8") + "\n# edited\n", encoding="utf-8")
    assert rebuilt.reruns() == {"judge_claims", "render_claims"}


@needs_artifacts
def test_bad_words_stop_the_workflow_before_any_job(fresh):
    fresh.edit("resources/claims.yaml", "  - id: solutions_exist\n", "  - id: Solutions\n")
    done = fresh.snakemake("-n")
    assert done.returncode != 0
    assert "claims.yaml key 'claims[0].id'" in done.stdout + done.stderr
