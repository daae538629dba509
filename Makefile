# Quadrance: every command a user or CI needs. `make help` lists them.
PYTHON ?= python3
ARM    ?= cobra600
CORE   ?= rational_fk1
N      ?= auto

# the long run takes the date where no seed is given
LONG_SEED := $(if $(filter file,$(origin SEED)),$(shell date -u +%Y%m%d),$(SEED))
VENV := .venv
PY   := $(VENV)/bin/python
export SEED
export PYTHONPATH := $(CURDIR):$(CURDIR)/models

.DEFAULT_GOAL := help
.PHONY: help setup lint test smoke report figures verdict report-check formal netlist coverage waves mutants exhaustive clean

help: ## this list
	@grep -hE '^[a-z-]+:.*##' Makefile | sed 's/:.*##/\t/' | expand -t 16
	@echo "options: ARM=name|file.toml  CORE=name  SEED=n  N=parallel jobs  FRESH=1"

setup: $(VENV)/ready ## .venv from the lock file, Icarus from the system's packages where it can

$(VENV)/ready: requirements.lock pyproject.toml ci/setup.sh
	@PYTHON=$(PYTHON) sh ci/setup.sh $(VENV)
	@touch $@

lint: setup ## Verilator, Icarus, Yosys and ruff without a warning; the list, pages and reports complete
	@$(PY) -m ci.lint

test: setup ## every bench in both simulators and every model test
	@$(PY) -m pytest -q -n $(N) --dist worksteal -m "not slow" --junitxml build/test.xml

smoke: setup ## the first parameter set of every core: cocotb bench under Icarus, bulk run
	@$(PY) -m pytest -q -n $(N) --dist worksteal -m smoke

report: setup ## latency, area, clock and accuracy of every core on ARM; FRESH=1 measures all again
	@$(PY) -m ci.report --arm $(ARM) $(if $(FRESH),--fresh)

figures: setup ## the pictures of the parallel robot's paper, and its claims beside ours
	@$(PY) -m ci.figures

verdict: setup ## the report, and who wins at equal accuracy: the shortest words of every core (half an hour)
	@$(PY) -m ci.report --verdict $(if $(FRESH),--fresh)

report-check: setup ## fails when the committed report no longer follows from the sources
	@$(PY) -m ci.report --check

formal: setup ## proofs of the arithmetic primitives and the handshakes that do not stand; FRESH=1 makes all again
	@$(PY) -m ci.formal $(if $(FRESH),--fresh)

netlist: setup ## every core's bench on its iCE40 and Cyclone V netlist
	@$(PY) -m ci.netlist

coverage: setup ## lines and bits of every core that its benches reach
	@$(PY) -m ci.coverage

waves: setup ## a waveform of CORE's bench and the command to open it
	@$(PY) -m ci.waves $(CORE)

mutants: setup ## break every core in 100 ways; the benches must notice
	@$(PY) -m ci.mutants $(if $(FRESH),--fresh)

exhaustive: setup ## the long run, a new seed every day: 10^6 vectors a core, pairs of cores, random parameters
	@echo "SEED=$(LONG_SEED) make exhaustive: repeats this run"
	@SEED=$(LONG_SEED) $(PY) -m pytest -q -n $(N) --dist worksteal -m slow --durations 10

clean: ## remove what the tools made; .venv stays
	rm -rf build
