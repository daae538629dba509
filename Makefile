# Quadrance: every command a user or CI needs. `make help` lists them.
PYTHON ?= python3
ARM    ?= cobra600
CORE   ?= rational_fk1
N      ?= auto

# the long run takes the date where no seed is given
LONG_SEED := $(if $(filter file,$(origin SEED)),$(shell date -u +%Y%m%d),$(SEED))
VENV := .venv
ifneq ($(words $(CURDIR)),1)
$(error the path "$(CURDIR)" has a space, with which make and Verilator cannot work: move the checkout)
endif
PY   := $(VENV)/bin/python
# CORE, where it was given and is not the default above; names instead of dots on a long run
CHOSEN := $(if $(filter file,$(origin CORE)),,--core $(CORE)) $(if $(SIM),--sim $(SIM)) $(if $(SHARD),--shard $(SHARD))
# tests of what stands around cores and models: make test CORE=name has those of that core
AROUND := ci tb/lib tb/test_instances.py $(patsubst %,models/test/test_%.py,cli import program registers)
TESTS  := $(PY) -m pytest -q -n $(N) --dist worksteal --names
export SEED
export SIM
export FARM
# where the shell forbids compiled Python, every simulation would compile its libraries again: a third of make test
unexport PYTHONDONTWRITEBYTECODE
export PYTHONPATH := $(CURDIR):$(CURDIR)/models

.DEFAULT_GOAL := help
.PHONY: help setup lint test test-scripts smoke report accuracy figures verdict report-check packages formal netlist coverage cover cover-check waves mutants exhaustive worker dist clean

help: ## this list
	@grep -hE '^[a-z-]+:.*##' Makefile | sed 's/:.*##/\t/' | expand -t 16
	@echo "options: ARM=name|file.toml  OUT=folder  CORE=name  SIM=icarus|verilator  TEST=name  SEED=n  N=parallel jobs  SHARD=k/n  FARM=tls://host:8786  FRESH=1"

setup: $(VENV)/ready ## .venv from the lock file, Icarus from the system's packages where it can
	@( mkdir -p build && : > build/.writable ) 2> /dev/null || { \
		echo "$(CURDIR)/build cannot be written to: copy or clone the checkout to where you may write" >&2; exit 1; }

$(VENV)/ready: requirements.lock pyproject.toml ci/setup.sh
	@PYTHON=$(PYTHON) sh ci/setup.sh $(VENV)
	@touch $@

lint: setup ## Verilator, Icarus, Yosys and ruff without a warning; the list, pages and reports complete; CORE=name: one core
	@$(PY) -m ci.lint $(if $(filter file,$(origin CORE)),,--core $(CORE)) $(if $(FRESH),--fresh)

test: setup ## benches and bulk runs of every core, tests of all models; CORE=name: all sets of that core; SIM=icarus|verilator: those of them
	@$(TESTS) -m "not slow" --junitxml build/test.xml $(CHOSEN) $(or $(PATHS),models tb $(if $(filter --core,$(CHOSEN)),,$(AROUND:%=--ignore=%)))

test-scripts: setup ## lint, benches, proofs, mutants and report find what they must; command line, importer, tutorials, drivers, soft CPU
	@$(TESTS) -m "not slow" --junitxml build/test-scripts.xml $(AROUND)

smoke: setup ## the first parameter set of every core: what make test has of its bench under Icarus, bulk run
	@$(TESTS) -m smoke $(CHOSEN) models tb

report: setup ## latency, area, clock and accuracy of every core on ARM (another one: a minute); FRESH=1 measures all again
	@$(PY) -m ci.report --arm "$(ARM)" $(if $(OUT),--out "$(OUT)") $(if $(FRESH),--fresh)

accuracy: setup ## errors of one CORE on ARM, by its bit-true model, in seconds
	@$(PY) -m quadrance accuracy $(CORE) --arm "$(ARM)"

figures: setup ## the pictures of the papers from our models, and their claims beside ours
	@$(PY) -m ci.figures

verdict: setup ## the report, and who wins at equal accuracy: the shortest words of every core (half an hour)
	@$(PY) -m ci.report --verdict $(if $(FRESH),--fresh)

report-check: setup ## fails when the committed report no longer follows from the sources
	@$(PY) -m ci.report --check

packages: setup ## manifests of FuseSoC and Bender: written from the Verilog
	@$(PY) -m ci.packages

formal: setup ## proofs of the primitives and the handshakes that do not stand; CORE=name; FRESH=1 all, WITHIN=minutes
	@$(PY) -m ci.formal $(if $(filter file,$(origin CORE)),,$(CORE)) $(if $(FRESH),--fresh) $(if $(WITHIN),--within $(WITHIN))

netlist: setup ## every core's bench on its iCE40 and Cyclone V netlist
	@$(PY) -m ci.netlist

coverage: setup ## lines and bits of every core that its benches reach
	@$(PY) -m ci.coverage

cover: setup ## every core at its further sets, the ends of its legal parameters and some between; CORE=name; FRESH=1 runs all again
	@$(PY) -m ci.cover $(if $(filter file,$(origin CORE)),,--core $(CORE)) $(if $(FRESH),--fresh)

cover-check: setup ## fails where a verdict of make cover is missing or stale, and runs 20 sets drawn by the commit
	@$(PY) -m ci.cover --check

waves: setup ## a waveform of CORE's bench, of its tests TEST, and the command to open it
	@$(PY) -m ci.waves $(CORE) $(if $(TEST),--test $(TEST)) $(if $(SIM),--sim $(SIM))

mutants: setup ## break every core in 100 ways; the benches must notice
	@$(PY) -m ci.mutants $(if $(FRESH),--fresh)

# robots as their makers published them, and Pinocchio, which judges what is imported: 0.6 GB, for the long run alone
exhaustive: setup ## the long run, a new seed every day: 10^6 vectors a core, pairs of cores, random parameters, real robots
	@$(PY) -m pip install --quiet --disable-pip-version-check -c requirements.lock rtb-data==2.0.0 pin==4.1.0 \
		2> build/robots.log || echo "real robots and Pinocchio are left out: build/robots.log" >&2
	@echo "SEED=$(LONG_SEED) make exhaustive: repeats this run"
	@SEED=$(LONG_SEED) $(TESTS) -m slow --durations 10 $(CHOSEN)

worker: setup ## a Dask worker for the scheduler FARM=tls://host:8786 (ci/farm.py says how), whose runs carry the same FARM=
	@test -n "$(FARM)" || { echo "make worker: give FARM=tls://host:8786, the address of a dask scheduler" >&2; exit 1; }
	@$(PY) -m ci.farm "$(FARM)"
	@DASK_DISTRIBUTED__WORKER__DAEMON=False $(PY) -m distributed.cli.dask_worker $(FARM) --nthreads 1 --nworkers $(if $(filter auto,$(N)),auto,$(N)) --no-dashboard

dist: setup ## the release of the last commit in build/dist: the source distribution and the wheel made of it
	@rm -rf build/dist && mkdir -p build/dist/source && git archive HEAD | tar -x -C build/dist/source
	@cd build/dist/source && ../../../$(PY) -c "from setuptools import build_meta; build_meta.build_sdist('..')" > ../log
	@$(PY) -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir build/dist build/dist/*.tar.gz
	@ls -d build/dist/*.*

clean: ## remove what the tools made; .venv stays
	rm -rf build
