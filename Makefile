# SPDX-License-Identifier: Apache-2.0
# Thin targets over the CMake presets; `make help` lists them. The targets that run tools/setup, such as `make demo`
# and `make test`, install missing packages on Debian 12 and 13; other targets print which are missing.
PRESET ?= release
PREFIX ?= /usr/local
BUILD := build/$(PRESET)
# Programs for this machine alone have packs for its own instruction set only, which takes less time to build. If a
# release build exists, or PRESET is given, programs come from that build instead.
HERE := $(if $(filter file,$(origin PRESET)),$(if $(wildcard build/release/bin/flythrough),release,native),$(PRESET))
# $(call take,PRESET,PROGRAM...): copies programs from their build to bin. Running programs keep their old file.
put = cp --remove-destination
take = mkdir -p bin && $(put) $(addprefix build/$(1)/bin/,$(2)) bin/
DEMO := demo render imgdiff flythrough
# Copies all programs of a full build.
define take_all
$(call take,$(PRESET),$(DEMO) bench) && \
{ [ ! -e $(BUILD)/bin/explore ] || $(put) $(BUILD)/bin/explore bin/; } && \
$(put) $(BUILD)/bin/mandelbulb $(BUILD)/bin/mandelbox .
endef

.PHONY: $(shell sed -n 's/^\([a-z0-9][a-z0-9 -]*\):.*/\1/p' Makefile)

build: ## all programs, for every instruction set: bin/, mandelbulb, mandelbox (7 min)
	@tools/build $(PRESET) programs
	@$(take_all)

help: ## list the targets; times are for two cores, without the build unless stated (at once)
	@sed -En 's/^([a-z0-9][a-z0-9 -]*):.*## (.*)/\1|\2/p' Makefile | while IFS='|' read -r names text; do printf '  %-21s %s\n' "$$names" "$$text"; done

mandelbulb: ## the program that renders paramsBulb.dat (3 min with set-up and build)
mandelbox: ## the program that renders paramsBox.dat (3 min with set-up and build)
mandelbulb mandelbox:
	@tools/setup build || true
	@tools/build $(HERE) $@
	@$(put) build/$(HERE)/bin/$@ $@

demo: ## both official scenes on every backend of the build, compared and timed, a film and a viewer: demo/index.html (8 min with set-up and build)
	@tools/setup programs
	@tools/build $(HERE) $(DEMO) mandelbulb mandelbox
	@$(call take,$(HERE),$(DEMO))
	@$(put) build/$(HERE)/bin/mandelbulb build/$(HERE)/bin/mandelbox .
	@tools/demo bin demo/index.html

# The build that is tested: the one for this machine alone, unless PRESET is given.
TESTED := $(if $(filter file,$(origin PRESET)),native,$(PRESET))
test: ## all tests of a build for this machine (14 min with set-up and build, or 9 after `make demo`)
	@tools/setup tests
	@tools/build $(TESTED) all
	@tools/python_packages
	MANDELMARCH_NEED_PYTHON=1 ctest --preset $(TESTED)

check: ## the quick tests of the same build (2 min)
	@tools/build $(TESTED) all
	ctest --preset $(TESTED) -L quick

# The processors that test-all and cross emulate, by their Debian names.
CROSS := arm64 riscv64 s390x
test-all: ## tests of all instruction sets, processors, models, simulated GPUs and bundles; clang, sanitizers; fuzzing (35 min, estimated)
	@tools/setup
	@tools/build release all
	@tools/python_packages
	@tools/python_packages gpu_packages
	@tools/cross_root $(CROSS) || true
	ctest --preset release -L wide

cross: ## exact pictures by emulated ARM, RISC-V and big-endian processors, compared bit for bit (6 min with set-up and builds)
	@tools/setup cross
	@tools/build $(HERE) render imgdiff
	@for arch in $(CROSS); do bash tests/builds/cross.sh build/$(HERE)/bin $$arch || exit 1; done

# DRIVERS=OFF leaves out drivers for CPUs; FFMPEG=FILE bundles a static ffmpeg. See docs/bundle.md.
DRIVERS ?= ON
FFMPEG ?=
bundle: ## a folder and a .tar.xz that run without installation: build/bundle (4 min)
	@tools/build $(PRESET) bundle_program
	@packaging/bundle $(BUILD) build/bundle $(DRIVERS) "$(FFMPEG)"

# docs/bench.md explains the study.
RUNS ?= 3
bench: build ## the standard study in three processes, one after the other: results/bench.json (8 min)
	@mkdir -p results
	@bin/bench --backend all --runs $(RUNS) --json results/bench.json

march-native: ## render as a user may build it, with -march=native, by g++ and clang++ (20 min, estimated)
	@tools/build march-native render
	@tools/build march-native-clang render

# Parameter files of scenes that differ are written to build/equivalence.
SCENES ?= 1000
SCENES_SEED ?= 1
# FILES="bench.json simd-widths.json" selects results from the list in tools/results.txt.
FILES ?=
results: build march-native ## the results that tools/results.txt lists, from one clean revision; resumes if interrupted (3 hours, estimated)
	@python3 tools/results.py $(FILES)

equivalence: build ## compare exact pictures of SCENES=1000 random scenes bit for bit on every backend (5 min, estimated)
	@bin/bench equivalence --scenes $(SCENES) --seed $(SCENES_SEED) --folder build/equivalence

flythrough: ## the program that makes films (the time of its build)
	@tools/build $(HERE) flythrough
	@$(call take,$(HERE),flythrough)

explore: ## the interactive explorer: bin/explore (1 min with set-up, estimated)
	@tools/setup explore
	@tools/build $(HERE) explore
	@$(call take,$(HERE),explore)

# Running it again resumes an interrupted film. AUTHORS is the second line of the title.
FRACTAL ?= bulb
SEED ?= 1
FRAMES ?= 7200
SIZE ?= 1080p
OPTIONS ?=
TITLE ?= $(if $(filter box mandelbox,$(FRACTAL)),Inside the Mandelbox,Inside the Mandelbulb)
AUTHORS ?= made with mandelmarch
video: flythrough ## a four-minute film: video.mp4; FRACTAL=box SEED=7 FRAMES=7200 SIZE=4k TITLE="..." OPTIONS=--stereo (20 min)
	bin/flythrough film video-path.json --fractal $(FRACTAL) --seed $(SEED) --frames $(FRAMES) --size $(SIZE) $(OPTIONS) \
	    $(if $(TITLE),--title "$(TITLE)") $(if $(AUTHORS),--authors "$(AUTHORS)") --json video-audit.json \
	    --summary video-summary.json --output video.mp4

video-preview: flythrough ## ten seconds from the middle of a four-minute film, in 640x360: video-preview.mp4 (1 min, estimated)
	bin/flythrough film video-preview-path.json --fractal $(FRACTAL) --seed $(SEED) --from 115 --to 125 \
	    --size 640x360 $(if $(TITLE),--title "$(TITLE)") $(if $(AUTHORS),--authors "$(AUTHORS)") --output video-preview.mp4

contact-sheet: ## frames of video.mp4, its summary and its audit, for the report (10 s, estimated)
	ffmpeg -v error -y -ss 2 -i video.mp4 -vf "select='isnan(prev_selected_t)+gte(t-prev_selected_t\,10)',scale=320:-2,tile=5x5" \
	    -frames:v 1 results/contact.jpg
	cp video-summary.json results/film.json
	cp video-audit.json results/flight_bulb.json

gallery: build ## the pictures of docs/gallery.md and README, and the path of the demo's film (10 min, estimated)
	@tools/gallery bin docs/pictures

SEEDS ?= 10
flight-study: build ## plan and audit SEEDS=10 flights through both fractals, for docs/flight.md (an hour, estimated)
	@python3 tools/flight_study.py bin results --seeds $(SEEDS)

kill-test: flythrough ## check that a film killed at twenty random moments resumes unchanged (10 min, estimated)
	@bash tests/cases.sh tests/flight/plans_test.sh killed $(CURDIR)/bin $(CURDIR) 20

SECONDS ?= 600
fuzz: ## run the fuzzer of each file format for SECONDS=600 (50 min on two cores)
	@tools/build asan fuzz render
	@FUZZ_SECONDS=$(SECONDS) ctest --preset asan -R '^fuzz[.]'

compilers: build ## check for the same bits with every other installed g++-N and clang++-N (2 min each)
	@tools/compilers bin

lint: ## check the format of sources, licence lines, and links of pages (10 s)
	@tools/lint

tidy: ## clang-tidy on every source (over 10 min)
	@tools/lint tidy

results-page: python ## write docs/results.md and the figures of README from results/ (3 s)
	@tools/build $(HERE) bench
	@$(call take,$(HERE),bench)
	@PYTHONPATH=report build/venv/bin/python -m mandelreport.results_page

RESULTS ?= results
report: python ## a report on results/, with new pictures: report/out/report.html (2 min, estimated)
	@tools/setup report
	@tools/build $(HERE) bench render imgdiff
	@$(call take,$(HERE),bench render imgdiff)
	@PYTHONPATH=report build/venv/bin/python -m mandelreport --results $(RESULTS)

report-check: ## check the report in a headless browser: errors, the slider, the viewer (3 min, estimated)
	@tools/setup report
	@PYTHONPATH=report build/venv/bin/python -m mandelreport.check report/out/report.html

# On a machine with just a GPU: bash gpu_check mandelmarch-*.tar.gz OUT; then here: make gpu-results FILE=results.tgz.
gpu-quarter: ## an archive and a script that test and measure a GPU within 450 s: build/gpu-quarter (8 min, estimated)
	@$(MAKE) --no-print-directory build
	@tools/build $(PRESET) bundle_program
	@rm -rf build/gpu-quarter
	@ARCHIVE=$(if $(FFMPEG),xz,gz) packaging/bundle $(BUILD) build/gpu-quarter OFF "$(FFMPEG)"
	@rm -r build/gpu-quarter/mandelmarch-*/
	@cp packaging/gpu_check build/gpu-quarter/

gpu-hashes: build ## hashes of exact pictures, from the CPU, for gpu_check (10 s, estimated)
	@packaging/gpu_check --hashes bin build/gpu-hashes >packaging/gpu_check.sha256.part && mv packaging/gpu_check.sha256.part packaging/gpu_check.sha256

FILE ?= results.tgz
gpu-results: ## unpack FILE=results.tgz from a GPU into results/DEVICE, with a summary page (at once)
	@python3 tools/gpu_results.py $(FILE) results

# STEPS="bands film" repeats these steps. MANDELMARCH_REHEARSAL=1 treats any device as a GPU and puts results into
# build.
STEPS ?=
gpu-hour: build ## gpu-quarter's and longer steps, on this machine; resumes if interrupted: results/DEVICE (an hour)
	@packaging/gpu_check --hour --work build/gpu-hour bin build/gpu-hour $(STEPS); code=$$?; \
	    python3 tools/gpu_results.py build/gpu-hour/results.tgz $(if $(MANDELMARCH_REHEARSAL),build,results) && exit $$code

install: build ## programs, libraries and headers into PREFIX=/usr/local (10 s, estimated)
	cmake --install $(BUILD) --prefix $(PREFIX)

clean: ## remove the builds, the programs, the demo page and unfinished films (at once)
	rm -rf build bin demo mandelbulb mandelbox video*.mp4.parts

setup: ## install the packages needed to build and test (2 min, estimated)
	@tools/setup

python: ## the report's pinned Python packages, into build/venv (1 min, estimated)
	@tools/python_packages
