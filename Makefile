# The commands of everyday work. `make` lists them; CMakePresets.json has the details.

JOBS      ?= $(shell nproc)
WERROR    := $(if $(CI),ON,OFF)
CONFIGURE := cmake -DTRAJET_WERROR=$(WERROR) >/dev/null --preset
BUILD     := cmake --build --parallel $(JOBS) --preset
DEMO      := build/demo

.PHONY: help setup build demo python docs test asan clang tidy bench scaling format
.DEFAULT_GOAL := help

help: ## list these targets
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1	\2/p' Makefile | expand -t 16

setup: ## install the Debian packages that are missing
	@scripts/setup

build: ## the program: build/release/trajet
	@$(CONFIGURE) release
	@$(BUILD) release --target trajet_cli

demo: setup build ## set up, build, and fly the rifle shot; its files go to build/demo/
	@mkdir -p $(DEMO)
	build/release/trajet run examples/notes/rifle_shot.toml --json $(DEMO)/rifle_shot.json --csv $(DEMO)/rifle_shot.csv

python: setup ## the Python package: PYTHONPATH=build/release/python
	@scripts/setup python
	@$(CONFIGURE) release -DTRAJET_PYTHON=ON
	@$(BUILD) release --target trajet_python

docs: setup build ## remake the pages and the gallery of docs/: outputs and pictures
	@for page in README.md docs/first_scene.md docs/cookbook.md docs/notes/*.md; do python3 -B tests/docs/readme.py refresh $$page build/release/trajet; done
	@scripts/setup browser
	@node viewer/tools/gallery.mjs build/release/trajet $$(command -v chromium)

test: setup ## set up, build, and run all tests
	-@scripts/setup browser
	@scripts/setup python
	@$(CONFIGURE) release -DTRAJET_PYTHON=ON
	@$(BUILD) release
	@scripts/run_tests build/release

asan: setup ## build with address and undefined-behaviour sanitizers, and run all tests
	@$(CONFIGURE) asan
	@$(BUILD) asan
	@scripts/run_tests build/asan

clang: setup ## build with clang++ and run all tests
	@scripts/setup tidy
	@$(CONFIGURE) clang
	@$(BUILD) clang
	@scripts/run_tests build/clang

tidy: setup ## build under clang-tidy
	@scripts/setup tidy
	@$(CONFIGURE) tidy
	@$(BUILD) tidy

bench: setup ## build and run the benchmarks, beside Boost.odeint, GSL, SUNDIALS, Bullet and ODE
	@scripts/setup bench
	@$(CONFIGURE) release -DTRAJET_BUILD_BENCH=ON
	@$(BUILD) release --target trajet_bench
	@build/release/trajet_bench

scaling: setup ## measure how the costs of the program grow: bench/README.md
	@$(CONFIGURE) release
	@$(BUILD) release --target trajet_cli
	@python3 bench/scaling.py build/release/trajet

format: ## format every C++ file with clang-format
	@scripts/setup format
	@git ls-files '*.cpp' '*.hpp' | xargs clang-format -i
