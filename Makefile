# make          build every figure          make test   set up if needed, check and test
# make report   results/report.html         make crate  results/hopper-crate.zip, of a finished run
# make verify   find damaged results        make resume go on after a kill or a loss of power
# make sbom     results/sbom.cdx.json, the packages of the locks; make audit: their known vulnerabilities
# make docs     results/site/index.html, the site; make test-docs: its tests, also in a browser
# make bench    measure the speed figures   make lock   resolve the dependencies anew (needs uv)
# make paper    the figures of the paper    make figures/fig_3_1.png  one figure
# make cluster  the environment with Snakemake's SLURM executor; docs/cluster.md tells more
# make slurm    build every figure with it
# make check    compare artifacts and figures with what is stored in tests/figures
# make references                           store them anew, after a deliberate change
# make CONFIG=my.yaml, make report CONFIG=my.yaml: with the numbers of another file

PYTHON ?= python3
BIN := .venv/bin
PIP := $(BIN)/python -m pip install -qq --disable-pip-version-check --no-user --require-hashes --no-build-isolation
# The configuration of a run with --configfile or CONFIG, which left it there.
RECORD := results/configuration.yaml
ifneq ($(origin CONFIG), command line)
override CONFIG :=
endif
OTHER := $(if $(CONFIG),"$(CONFIG)")
SNAKEMAKE := $(BIN)/python -m snakemake $(if $(CONFIG),--configfile $(OTHER))
AGAIN := $(if $(CONFIG),,$(addprefix --configfile ,$(wildcard $(RECORD))))
WORKFLOW := PYTHONPATH=scripts $(BIN)/python -m hopper_workflow

# What a user's shell has set for other projects: scripts/hopper_workflow/surroundings.py keeps the same from jobs.
unexport $(filter-out PYTHONDONTWRITEBYTECODE PYTHONPYCACHEPREFIX PYTHONUNBUFFERED MPLCONFIGDIR, $(filter \
    PYTHON% MPL% MATPLOTLIBRC% NPY_% NUMPY_% SCIPY_% OPENBLAS_% GOTO_% OMP_% GOMP_% KMP_% MKL_% BLIS_% VECLIB_% \
    NUMEXPR_% XARRAY_% HDF5_% NETCDF% NC_% GIT_DIR% GIT_WORK_TREE% GIT_INDEX_FILE% SNAKEMAKE_% BASH_ENV% SHELLOPTS% BASHOPTS% CDPATH% \
    SOURCE_DATE_EPOCH% GLIBC_TUNABLES%, $(.VARIABLES)))
export PYTHONUTF8 := 1
export OPENBLAS_NUM_THREADS := 1
# Snakemake asks for its user's name and keeps caches at home: a container may have neither.
export LOGNAME ?= nobody
ifneq ($(shell test -w "$${HOME:-/none}" && echo yes),yes)
export HOME := $(CURDIR)/.venv/home
endif

# Goals in the order given, also with -j: Snakemake runs jobs side by side.
.NOTPARALLEL:
.PHONY: figures paper resume test check references lint soak reliability bench gallery lock clean FORCE

figures: .venv/run.stamp
	@$(SNAKEMAKE)

paper: .venv/run.stamp
	@$(SNAKEMAKE) paper

# Snakemake locks a directory while it works; a run that was killed leaves the lock behind.
resume: .venv/run.stamp
	@$(WORKFLOW).live
	@$(SNAKEMAKE) $(AGAIN)

figures/%: .venv/run.stamp FORCE
	@$(SNAKEMAKE) $@

test: lint
	@$(BIN)/python -m pytest -n 2 --dist worksteal

# The HTML report opens offline as fig_comparison_basic.html. Images are drawn in processes of their
# own: after figures drawn in other styles the lines of legends lie a pixel off.
CHECKS := results/figure_checks
check: .venv/test.stamp
	@$(SNAKEMAKE) $(AGAIN)
	@$(BIN)/python -m pytest tests/figures/test_images.py -n 2 --mpl --mpl-results-path=$(CHECKS) --mpl-generate-summary=html,basic-html
	@$(BIN)/python -m pytest tests/figures --ignore=tests/figures/test_images.py -n 2

references: figures .venv/test.stamp
	@$(BIN)/python -m pytest -q tests/figures -k 'not deliberate' --mpl-generate-path=tests/figures/baseline
	@git status --short tests/figures

lint: .venv/test.stamp
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/snakefmt --check Snakefile workflow
	@$(BIN)/mypy
	@$(BIN)/lint-imports
	@$(BIN)/python -m snakemake --lint

.PHONY: report crate verify test-report

# Are all results and logs, byte for byte, what the jobs wrote? What is not is named.
verify: .venv/run.stamp
	@$(WORKFLOW).publish.verify $(OTHER)

report: .venv/run.stamp
	@$(WORKFLOW).publish.report $(OTHER)

crate: .venv/run.stamp
	@$(WORKFLOW).publish.crate $(OTHER)

.PHONY: sbom audit

sbom: .venv/test.stamp
	@$(WORKFLOW).publish.sbom

# Exit code 1 (of make: 2) for known vulnerabilities; without pip-audit or network it says so and ends with 0.
audit: .venv/run.stamp
	@$(WORKFLOW).publish.audit

# Opens results/report.html in a headless Chromium.
test-report: .venv/test.stamp
	@HOPPER_REPORT=results/report.html $(BIN)/python -m pytest tests/workflow/test_browser.py

# The long tests of reliability, and what all tests of it find as a page.
RELIABILITY := artifacts corruption interruptions mutated_configurations processors supply_chain surroundings
soak: .venv/test.stamp
	@$(BIN)/python -m pytest -m soak

reliability: .venv/test.stamp .venv/cluster.stamp
	@rm -rf .reliability
	@$(BIN)/python -m pytest -m '' tests/radial/test_coverage.py $(RELIABILITY:%=tests/workflow/test_%.py) tests/slurm
	@$(BIN)/python -m tests.reliability > docs/reliability.md

# Pages from README, docs, schema, parsers, captions and docstrings; before a run without its figures.
.PHONY: docs test-docs
docs: .venv/docs.stamp
	@$(WORKFLOW).site $(OTHER)

test-docs: docs .venv/test.stamp
	@$(BIN)/python -m pytest -m site tests/site

# On a SLURM of its own, which it installs and starts: Debian, root, some ten minutes.
.PHONY: cluster slurm test-slurm requests
cluster: .venv/cluster.stamp

slurm: .venv/cluster.stamp
	@$(SNAKEMAKE) --workflow-profile profiles/slurm

test-slurm: .venv/test.stamp .venv/cluster.stamp
	@$(BIN)/python -m pytest -m slurm tests/slurm

# Costs of all rules, from the last run's benchmarks, which should have been undisturbed.
requests: figures
	@$(BIN)/python -m benchmarks.requests

bench: .venv/test.stamp
	@$(BIN)/python -m benchmarks

# Copies of the figures and of the claims ledger for those who read the sources.
gallery: figures
	@mkdir -p docs/gallery && cp figures/*.png docs/gallery/ && cp results/claims.md docs/

clean:
	rm -rf results figures/*.png figures/*.pdf logs .snakemake .site

# An environment knows its place and its Python: moved, copied, or without that Python it is made anew.
.venv/place: FORCE
	@test "$$(cat $@ 2>&1)" = "$$(pwd -P)" && $(BIN)/python -Ic 'import pip' 2>/dev/null || \
	  { rm -rf .venv && mkdir .venv && pwd -P > $@; }

# Build tools first, so that nothing is fetched beyond the hashed locks.
.venv/run.stamp: .venv/place requirements-build.lock requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.version_info >= (3, 11) or sys.exit("Python 3.11 or newer is needed: make PYTHON=...")'
	@echo "Setting up .venv from requirements.lock (about a minute)"
	@$(PYTHON) -m venv .venv
	@elsewhere=$$($(BIN)/python -m pip config list | grep -E '[.](target|prefix|root|python|dry-run)=' | tr '\n' ' '); \
	  test -z "$$elsewhere" || { echo "pip is configured to install elsewhere: leave out $$elsewhere" >&2; exit 1; }
	@$(PIP) -r requirements-build.lock
	@$(PIP) -r requirements.lock
	@$(BIN)/python -m pip install -qq --disable-pip-version-check --no-user --no-deps --no-build-isolation -e .
	@touch $@

# cffconvert brings the schema of CITATION.cff; what it needs itself is too old for the other tools.
.venv/test.stamp: .venv/run.stamp requirements-dev.lock requirements-cff.lock
	@echo "Adding the test tools from requirements-dev.lock"
	@$(PIP) -r requirements-dev.lock
	@$(PIP) --no-deps -r requirements-cff.lock
	@touch $@

.venv/cluster.stamp: .venv/run.stamp requirements-cluster.lock
	@echo "Adding Snakemake's SLURM executor from requirements-cluster.lock"
	@$(PIP) -r requirements-cluster.lock
	@touch $@

.venv/docs.stamp: .venv/run.stamp requirements-docs.lock
	@echo "Adding Sphinx from requirements-docs.lock"
	@$(PIP) -r requirements-docs.lock
	@touch $@

COMPILE := uv pip compile --universal --generate-hashes --no-header --no-annotate -q
lock:
	echo 'setuptools>=80' | $(COMPILE) - -o requirements-build.lock
	$(COMPILE) pyproject.toml --extra workflow -c requirements-build.lock -o requirements.lock
	$(COMPILE) pyproject.toml --extra workflow --extra dev -c requirements.lock -o requirements-dev.lock
	echo 'cffconvert==2.0.0' | $(COMPILE) --no-deps - -o requirements-cff.lock
	$(COMPILE) pyproject.toml --extra workflow --extra cluster -c requirements.lock -o requirements-cluster.lock
	$(COMPILE) pyproject.toml --extra workflow --extra docs -c requirements-dev.lock -o requirements-docs.lock
