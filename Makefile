# SPDX-License-Identifier: Apache-2.0
# Thin targets over the CMake presets. `make demo`, `make test` and `make setup` install what is missing on Debian 12; all
# others say what is missing.
PRESET ?= release
PREFIX ?= /usr/local
BUILD := build/$(PRESET)

.PHONY: build bundle check mandelbulb mandelbox demo test bench equivalence fuzz intel-opencl lint k40 loop-mix docs-figures flythrough video video-preview contact-sheet flight-study kill-test report report-check install clean setup python

build:
	@tools/build $(PRESET) programs
	@mkdir -p bin && cp $(BUILD)/bin/render $(BUILD)/bin/imgdiff $(BUILD)/bin/demo $(BUILD)/bin/bench $(BUILD)/bin/flythrough bin/
	@cp $(BUILD)/bin/mandelbulb $(BUILD)/bin/mandelbox .

mandelbulb mandelbox:
	@tools/build $(PRESET) $@
	@cp $(BUILD)/bin/$@ $@

# A folder and a .tar.xz that run where nothing can be installed: build/bundle. DRIVERS=OFF leaves out the drivers for CPUs,
# FFMPEG=FILE carries a static ffmpeg. docs/bundle.md says the rest.
DRIVERS ?= ON
FFMPEG ?=
bundle:
	@tools/build $(PRESET) bundle_program
	@packaging/bundle $(BUILD) build/bundle $(DRIVERS) "$(FFMPEG)"

# Draws both official scenes on every backend, proves that they agree and prints the times.
demo: setup
	@$(MAKE) --no-print-directory build
	@bin/demo

# The standard study, by three processes one after the other: some eight minutes. docs/benchmarking.md explains it.
LAUNCHES ?= 3
bench: build
	@mkdir -p report/results
	@bin/bench --backend all --launches $(LAUNCHES) --json report/results/bench.json --csv report/results/bench.csv

# Exact pictures of random scenes at the edges of the format on every backend, bit for bit: some minutes.
# SCENES=5000, SCENES_SEED=2; the parameter files of scenes that differ come into build/equivalence.
SCENES ?= 1000
SCENES_SEED ?= 1
equivalence: build
	@bin/bench equivalence --scenes $(SCENES) --seed $(SCENES_SEED) --folder build/equivalence

flythrough:
	@tools/build $(PRESET) flythrough
	@mkdir -p bin && cp $(BUILD)/bin/flythrough bin/

# The film: a title, then four minutes. An interrupted run goes on where it stopped. AUTHORS is the title's second line.
FRACTAL ?= bulb
SEED ?= 1
FRAMES ?= 7200
SIZE ?= 1920x1080
TITLE ?= $(if $(filter box mandelbox,$(FRACTAL)),Inside the Mandelbox,Inside the Mandelbulb)
AUTHORS ?= made with mandelmarch
video: flythrough
	bin/flythrough film video-path.json --fractal $(FRACTAL) --seed $(SEED) --frames $(FRAMES) --size $(SIZE) \
	    --title "$(TITLE)" --authors "$(AUTHORS)" --json video-audit.json \
	    --summary video-summary.json --output video.mp4

# A first look: ten seconds, small.
video-preview: flythrough
	bin/flythrough film --fractal $(FRACTAL) --seed $(SEED) --frames 300 --size 640x360 --title "$(TITLE)" \
	    --authors "$(AUTHORS)" --output video-preview.mp4

# A small frame of every tenth second of video.mp4, the title first, and what the film's making said, for the report.
contact-sheet:
	ffmpeg -v error -y -ss 2 -i video.mp4 -vf "select='isnan(prev_selected_t)+gte(t-prev_selected_t\,10)',scale=320:-2,tile=5x5" \
	    -frames:v 1 report/results/contact.jpg
	cp video-summary.json report/results/film.json
	cp video-audit.json report/results/flight_bulb.json

# Ten seeds of both fractals planned and audited, in a table; what anti-aliasing is worth and costs; what a segment costs.
SEEDS ?= 10
flight-study: build
	@python3 tools/flight_seeds.py bin/flythrough report/results $(SEEDS)
	@python3 tools/flight_samples.py bin/flythrough bin/imgdiff report/results
	@python3 tools/flight_overhead.py bin/flythrough report/results

# A film killed at twenty random moments is the same film.
kill-test: flythrough
	@bash tests/flight/resume_test.sh bin/flythrough 20

# Everything, the builds with clang++ and under sanitizers and a minute of each fuzzer included.
test: setup
	@tools/build $(PRESET) all
	@$(MAKE) --no-print-directory build python
	ctest --preset $(PRESET)

# The quick tests, in two minutes on a built tree.
check:
	@tools/build $(PRESET) all
	ctest --preset $(PRESET) -L quick

# A longer search for inputs that break the readers: make fuzz SECONDS=3600
SECONDS ?= 600
fuzz:
	@tools/build asan fuzzers render
	@bash tests/fuzz/run.sh $(CURDIR)/build/asan/bin $(CURDIR) $(CURDIR)/build/fuzz $(SECONDS) \
	    $(patsubst tests/fuzz/%_fuzz.cpp,%,$(wildcard tests/fuzz/*_fuzz.cpp))

# The equivalence tests with a second OpenCL CPU device, which this installs (large).
intel-opencl: build
	@tools/intel_opencl $(BUILD)

lint:
	@tools/lint

# What NVIDIA's assembler makes of the OpenACC kernels for the Tesla K40, and the time of a frame that follows from it.
k40: mandelbulb python
	@python3 tools/k40.py mandelbulb --table report/results/k40_ptxas.txt
	@python3 tools/k40_expected.py mandelbulb report/results/1080p.json report/results/box-vs-bulb.json \
	    --table report/results/k40_expected.txt

# What the loops of openmp's estimators consist of on this build, and how near the multiply-add peak that lets them come.
loop-mix: build
	@python3 tools/loop_mix.py $(BUILD)/backends/openmp/CMakeFiles/mandelmarch_openmp.dir --table report/results/loop_mix.txt

# The figures of README and docs, from report/results.
docs-figures:
	@python3 tools/figures.py README.md docs/*.md

# The report on what report/results has, with the pictures that bin/render draws: report/out. docs/report.md explains it.
RESULTS ?= report/results
report: build python
	@report/setup
	@PYTHONPATH=report build/venv/bin/python -m mandelreport --results $(RESULTS)
	@report/docs

# The report in a headless browser: no errors, the slider, the viewer beside bin/render. Screenshots in build/report/check.
report-check:
	@report/setup
	@PYTHONPATH=report build/venv/bin/python -m mandelreport.check report/out/report.html

install: build
	cmake --install $(BUILD) --prefix $(PREFIX)

clean:
	rm -rf build bin mandelbulb mandelbox video*.mp4.parts

setup:
	@tools/setup

python:
	@tools/python_packages
