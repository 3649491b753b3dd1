# make demo     the paper's figures and report in out/demo
# make test     lint, types, formatting, C++ tests, Python tests that are not slow
# make build    the package in .venv, rebuilt only where something changed
# make nightly  all that takes longer, row by row (tools/nightly.py); the table goes to docs/nightly.md
#                  (NIGHTLY_ROWS='site wheel': only these)
# make campaign NAME=atlas|faults|fuzz|lifts|stages|tables  what takes hours: the stability atlas, hostile files,
#                  what an accuracy promises of lifts in stages, every measured table
# make sanitized  C++ tests under the sanitizers, unless these very sources passed them (.ci/sanitized.txt)
# make bits     runs scenes again beside tests/bits.json: the same bits, or by how much they differ
#                  (BITS_ARGS=--record writes the file)
# make notebooks  the notebooks in JupyterLab, with everything they need (NOTEBOOKS_ARGS: arguments of jupyter lab)
# make stubs    python/seacrane/_core.pyi
# make docs     the site in out/site, its notebooks executed; any warning is an error, and so is anything that a page
#               would load from a network
# make bench    the tables of benchmarks/ whose sources have changed, one by one, written as they come; goes on
#                  where it stopped (BENCH_ARGS="--only speed-of-100-s": only these; on an idle machine)
# make wheel    dist/: the sdist, and a wheel for older Linux systems made from it, tried where no compiler is
# make wheel-trial  the same in dist/trial with one notebook, under a version that no index takes
# make viewer   the script of the three-dimensional page, bundled with three.js (needs npm)
# make fuzz     hostile files, guided by coverage: CASES for each kind of file (a million take hours), counts
#               and findings in out/fuzz; goes on where the last call stopped
# make release-check  documents whose tables are not as their files have them, and tables whose sources have changed
# make format   formats C++ and Python;  make clean  removes what was built (not .venv);  make distclean  all
#
# All of them install what is missing: system packages (apt, with sudo when needed) and .venv.
# Compiled modules are kept, whatever the shell says: tests start thousands of processes.
unexport PYTHONDONTWRITEBYTECODE
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.DEFAULT_GOAL := build
.PHONY: demo test build nightly campaign no-such-campaign random-lifts staged-accuracy sanitized bench bits release-check docs extremes \
        notebooks stubs viewer wheel wheel-trial format clean distclean \
        lint cpp-test cpp-allocations cpp-sanitize cpp-tsan python-test fuzz validation system-packages browser-packages \
        bundle-packages FORCE

ifndef PYTHON
PYTHON := $(shell .ci/find-python)
endif
JOBS ?= $(shell .ci/cores)
BIN := .venv/bin
# What is imported is compiled then: most of what is installed never is.
INSTALL := $(BIN)/python -m pip --disable-pip-version-check install -q --no-compile
STAMPS := build/stamps
PACKAGE_BUILD := build/package
SANITIZE_BUILD := build/sanitize
TSAN_BUILD := build/tsan
CPP_FILES = $(shell find cpp docs/additions -name '*.hpp' -o -name '*.cpp')
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)

system-packages:
	@.ci/system-packages $(PYTHON)
# What tests of pages need besides: Chromium; by night npm too, to bundle the pages' script again.
browser-packages: system-packages
	@.ci/system-packages $(PYTHON) browser
bundle-packages: system-packages
	@.ci/system-packages $(PYTHON) browser npm

# A new environment may hold another interpreter: what was compiled for the old one goes.
$(BIN)/python: | system-packages
	rm -rf .venv $(PACKAGE_BUILD)
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "seacrane needs Python 3.11 or newer, this is " + sys.version.split()[0])'
	$(PYTHON) -m venv .venv

# The stamps of what is inside .venv live inside it, so that they vanish with it. They have the time at which their
# work began: what is edited meanwhile is newer.
.venv/.installed-run: pyproject.toml .ci/requirements.py $(BIN)/python
	touch $@.began
	$(BIN)/python .ci/requirements.py build run > .venv/requirements-run.txt
	$(INSTALL) -r .venv/requirements-run.txt
	mv $@.began $@
.venv/.installed-dev: .venv/.installed-run
	touch $@.began
	$(BIN)/python .ci/requirements.py build run dev bench docs > .venv/requirements-dev.txt
	$(INSTALL) -r .venv/requirements-dev.txt
	mv $@.began $@

# The list changes when a file appears or goes; its members' dates tell of edits.
SOURCES = $(shell find cpp/seacrane cpp/bindings cpp/lanes cpp/CMakeLists.txt cmake licenses python/seacrane examples \
                  CMakeLists.txt pyproject.toml README.md LICENSE -type f -not -path '*/__pycache__/*' | LC_ALL=C sort)
$(STAMPS)/sources.txt: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' $(SOURCES) > $@.new
	@cmp -s $@.new $@ && rm $@.new || mv $@.new $@

.venv/.installed-seacrane: .venv/.installed-run $(STAMPS)/sources.txt $(SOURCES) | system-packages
	touch $@.began
	@echo "building seacrane: a few minutes the first time, seconds afterwards"
	SKBUILD_BUILD_DIR=$(PACKAGE_BUILD) SKBUILD_CMAKE_DEFINE='SEACRANE_WERROR=ON;SEACRANE_TESTS=ON' \
	  $(INSTALL) --no-deps --no-build-isolation .
	mv $@.began $@

build: .venv/.installed-seacrane

demo: build
	$(BIN)/seacrane paper --out out/demo --overwrite
	@echo
	@echo "figures and data: $(CURDIR)/out/demo/figure_*.png, figure_*.csv"
	@echo "report:           $(CURDIR)/out/demo/report.html"

lint: .venv/.installed-dev
	$(BIN)/ruff check .
	$(BIN)/mypy
	@$(BIN)/clang-format --dry-run --Werror $(CPP_FILES)

# The package's build folder already holds the compiled core: only the tests themselves are added.
cpp-test: build
	cmake --build $(PACKAGE_BUILD) --target seacrane_tests
	ctest --test-dir $(PACKAGE_BUILD) --output-on-failure --no-tests=error -j $(JOBS)

cpp-allocations: build
	cmake --build $(PACKAGE_BUILD) --target seacrane_allocation_tests
	$(PACKAGE_BUILD)/cpp/tests/seacrane_allocation_tests

# Checks of every reference for null and alignment more than double the time of compiling; what reads through a
# null pointer ends under AddressSanitizer too. `make nightly` has them, and compiles every file by itself.
SANITIZE_NOT ?= null,alignment
UNITY ?= ON
cpp-sanitize: system-packages
	cmake -S . -B $(SANITIZE_BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG='-O1 -g1' \
	  -DSEACRANE_PYTHON=OFF -DSEACRANE_TESTS=ON -DSEACRANE_SANITIZE=address,undefined \
	  -DSEACRANE_SANITIZE_NOT=$(SANITIZE_NOT) -DSEACRANE_UNITY=$(UNITY)
	cmake --build $(SANITIZE_BUILD) --target seacrane_tests
	ctest --test-dir $(SANITIZE_BUILD) --output-on-failure --no-tests=error -j $(JOBS)
	$(PYTHON) .ci/sanitized write

sanitized:
	@.ci/sanitized check || .ci/quiet sanitizers $(MAKE) --no-print-directory cpp-sanitize

# Threads that share one model. Where it is allowed, addresses are not randomised: ThreadSanitizer of older
# compilers cannot map its shadow memory where newer kernels put things.
cpp-tsan: system-packages
	cmake -S . -B $(TSAN_BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG='-O1 -g1' \
	  -DSEACRANE_PYTHON=OFF -DSEACRANE_TESTS=ON -DSEACRANE_SANITIZE=thread
	cmake --build $(TSAN_BUILD) --target seacrane_thread_tests
	$$(setarch -R true 2>/dev/null && echo setarch -R) $(TSAN_BUILD)/cpp/tests/seacrane_thread_tests

# Files stay whole, so that what a module makes for its tests is made once.
python-test: build .venv/.installed-dev browser-packages
	$(BIN)/python -m pytest -q --brief -n $(JOBS) --dist loadfile $(PYTEST_ARGS)

# Steps print a line each; what they said stands in out/test, and here where they fail.
test: build .venv/.installed-dev
	@for step in lint cpp-allocations cpp-test; do .ci/quiet $$step $(MAKE) --no-print-directory $$step || exit; done
	@$(MAKE) --no-print-directory --silent python-test

nightly: build .venv/.installed-dev bundle-packages
	$(BIN)/python tools/nightly.py $(NIGHTLY_ROWS)

campaign_atlas := extremes
campaign_faults := seeded-faults
campaign_fuzz := fuzz
campaign_lifts := random-lifts
campaign_stages := staged-accuracy
campaign_tables := bench
campaign: $(or $(campaign_$(NAME)),no-such-campaign)
no-such-campaign:
	@echo "make campaign NAME=atlas|faults|fuzz|lifts|stages|tables; there is none called '$(NAME)'" >&2; exit 1

extremes: build .venv/.installed-dev
	PYTHONPATH=studies $(BIN)/python -m stability_atlas --out out/extremes $(EXTREMES_ARGS)

validation: build .venv/.installed-dev
	$(BIN)/python -W ignore benchmarks/validation.py
	$(BIN)/python -W ignore benchmarks/measurements.py

# Without the peers, which come from a package index, their table is left as it is.
bench: build .venv/.installed-dev
	-$(MAKE) out/peers/.installed
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -W ignore benchmarks/run.py $(BENCH_ARGS)

out/peers/.installed: benchmarks/peers/requirements.txt
	$(PYTHON) -m venv out/peers
	out/peers/bin/python -m pip install -q -r $<
	touch $@

bits: build .venv/.installed-dev
	PYTHONPATH=tools $(BIN)/python -m bits $(BITS_ARGS)

release-check: build .venv/.installed-dev
	$(BIN)/python benchmarks/documents.py --check
	$(BIN)/python -W ignore benchmarks/run.py --check

# Read afresh each time: what stayed unread would keep its warnings to itself.
docs: build .venv/.installed-dev
	$(BIN)/python -m sphinx --fresh-env --fail-on-warning --keep-going --quiet -c docs -d build/doctrees . out/site
	$(BIN)/python docs/site/offline.py out/site
	@echo "the site: $(CURDIR)/out/site/index.html"

# Which test finds what is put wrong; what is in out/faults/found.csv already is not tried again.
seeded-faults: build .venv/.installed-dev
	PYTHONPATH=tools $(BIN)/python -m seeded_faults $(FAULTS_ARGS)

LIFTS ?= 1000
random-lifts: build .venv/.installed-dev
	$(BIN)/python tests/scenes/random_lifts.py $(LIFTS)

STAGED ?= 400
staged-accuracy: build .venv/.installed-dev
	$(BIN)/python tests/scenes/staged_accuracy.py $(STAGED)

CASES ?= 1000000
fuzz: build .venv/.installed-dev
	$(BIN)/python .ci/requirements.py fuzz > .venv/requirements-fuzz.txt
	$(INSTALL) -r .venv/requirements-fuzz.txt
	$(BIN)/python tools/fuzzing/run.py --cases $(CASES) $(FUZZ_ARGS)

# Notebooks are kept as text; what opens in JupyterLab are copies, made again where the text has changed.
.venv/.installed-notebooks: .venv/.installed-run
	touch $@.began
	$(BIN)/python .ci/requirements.py notebooks > .venv/requirements-notebooks.txt
	$(INSTALL) -r .venv/requirements-notebooks.txt
	mv $@.began $@

out/notebooks/%.ipynb: notebooks/%.md .venv/.installed-notebooks
	@mkdir -p $(@D)
	$(BIN)/python -m jupytext --quiet --to ipynb --output $@ $<

notebooks: build $(patsubst %.md,out/%.ipynb,$(wildcard notebooks/*.md))
	$(BIN)/python -m jupyterlab --notebook-dir=out/notebooks $(NOTEBOOKS_ARGS)

# Default arguments that are objects print as `...`; tests/project/test_packaging.py runs the same command.
STUB_OPTIONS := --exit-code --ignore-invalid-expressions '<seacrane\._core\.\w+ object at 0x[0-9a-f]+>'
stubs: build .venv/.installed-dev
	$(BIN)/python -m pybind11_stubgen seacrane._core --output-dir build/stubs $(STUB_OPTIONS)
	cp build/stubs/seacrane/_core.pyi python/seacrane/_core.pyi

# tests/answers/test_view_bundle.py compares the committed bundle with what this makes.
viewer:
	tools/viewer/build.sh python/seacrane/pictures/assets

.venv/.installed-wheel: .venv/.installed-run
	touch $@.began
	$(BIN)/python .ci/requirements.py wheel > .venv/requirements-wheel.txt
	$(INSTALL) -r .venv/requirements-wheel.txt
	mv $@.began $@

# Notebooks with their outputs, which the wheel holds; run again where their text or the package has changed.
EXECUTED := $(patsubst notebooks/%.md,build/executed/%.ipynb,$(wildcard notebooks/*.md))
build/executed/%.ipynb: notebooks/%.md tools/wheel/notebooks.py .venv/.installed-seacrane .venv/.installed-wheel
	$(BIN)/python tools/wheel/notebooks.py $< $@

# What cibuildwheel would build elsewhere is printed, so that a mistake in its configuration is found here.
wheel: build .venv/.installed-wheel $(EXECUTED)
	$(BIN)/python tools/wheel/build.py dist
	$(BIN)/python tools/wheel/check.py dist/seacrane-*.whl
	for system in linux macos windows; do \
	  $(BIN)/python -m cibuildwheel --print-build-identifiers --platform $$system --archs all; done

# The notebook that asks for most: it runs pytest.
TRIED := build/executed/10_tested_lift.ipynb
wheel-trial: build .venv/.installed-wheel $(TRIED)
	$(BIN)/python tools/wheel/build.py dist/trial --trial $(TRIED)
	$(BIN)/python tools/wheel/check.py dist/trial/seacrane-*.whl --notebooks $(basename $(notdir $(TRIED)))

format: .venv/.installed-dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(CPP_FILES)

clean:
	rm -rf build out dist docs/api .pytest_cache .mypy_cache .ruff_cache .hypothesis .venv/.installed-seacrane
distclean: clean
	rm -rf .venv
