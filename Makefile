# Thin front door; CMakePresets.json has the details.
.PHONY: demo describe command test test-all nightly build dependencies command_dependencies clang_dependencies format format-check clean fuzz sanitize clang bench bench-summary verify bench_dependencies docs docs_dependencies \
  package package-test wheel page-core page-core-alone page page-answers page-reports page-template sanitize-thread sanitize-some release label-limits rotation-queries static image static-test npm npm-test ro-crate mujoco-limits finite-elements growth

dependencies:
	@scripts/install_dependencies.sh

command_dependencies:
	@scripts/install_dependencies.sh command

clang_dependencies:
	@scripts/install_dependencies.sh clang

docs_dependencies:
	@scripts/install_dependencies.sh docs

bench_dependencies:
	@scripts/install_dependencies.sh bench

# The release build with all that is tested: a folder that `make demo` has begun knows the command alone. The bench and the libraries that it
# runs beside are a third of the time to compile it, and nothing that a user runs.
configure_all = cmake --preset release -DCONDYLE_TESTS=ON -DCONDYLE_BENCH=OFF -DCONDYLE_PYTHON=ON >/dev/null
configure_bench = cmake --preset release -DCONDYLE_TESTS=ON -DCONDYLE_BENCH=ON -DCONDYLE_PYTHON=ON >/dev/null

# Release build of the library, the command line and the Python module only.
build: dependencies
	@$(configure_all)
	@cmake --build --preset release --target condyle_cli condyle_python

# The command alone, without what tests and the Python module need: on a fresh machine a newcomer waits for it.
build/release/build.ninja: | command_dependencies
	@cmake --preset release -DCONDYLE_TESTS=OFF -DCONDYLE_BENCH=OFF -DCONDYLE_PYTHON=OFF >/dev/null

command: command_dependencies build/release/build.ninja
	@cmake --build --preset release --target condyle_cli

demo: command
	@scripts/demo.sh

# Runs the tests of a preset on two cores, without those that have one of these labels, and says last which cases were slow and, in one
# line, how many were skipped and why. Three at a time, since some wait for signals, jobs and processes.
run_tests = rm -rf build/$(1)/test_results; status=0; \
  ctest --preset $(1) --parallel 3 --output-junit test_results/ctest.junit -LE '^($(2))$$' || status=$$?; \
  $(if $(filter release,$(1)),scripts/slow_cases.py check build/$(1)/test_results || status=$$?;) \
  scripts/count_skipped.sh build/$(1)/test_results || status=$$?; exit $$status

# What a change is tried with: every suite, without the cases of tests/slow_cases.txt. All of them: test-all.
test: dependencies
	@$(configure_all)
	@cmake --build --preset release
	@$(call run_tests,release,slow|nightly)

# What has passed them is written down for make release: a commit, and nothing where files are changed.
test-all: dependencies
	@$(configure_all)
	@cmake --build --preset release
	@rm -f build/tested
	@$(call run_tests,release,nightly)
	@[ -n "$$(git status --porcelain 2>&1)" ] || git rev-parse HEAD >build/tested

# Writes what is made from the tables of records: classes of Python, types of the page, tables of docs/.
describe: dependencies
	@$(configure_all)
	@cmake --build --preset release --target condyle_describe
	@build/release/condyle_describe .

# All that takes hours: the longer forms of tests, valgrind, wheel and packages, the bench, clang, sanitizers.
nightly: bench_dependencies clang_dependencies
	@scripts/install_dependencies.sh wheel workflow docs
	@$(MAKE) ro-crate
	@$(configure_bench)
	@cmake --build --preset release
	@export CONDYLE_LONG_TESTS=1; $(call run_tests,release,none)
	@$(MAKE) static-test npm-test verify growth label-limits rotation-queries mujoco-limits finite-elements package clang sanitize sanitize-thread

clang: clang_dependencies
	@cmake --preset $@ -DCONDYLE_TESTS=ON -DCONDYLE_PYTHON=ON >/dev/null
	@cmake --build --preset $@
	@$(call run_tests,$@,nightly)

# Every test under sanitizers: address and undefined behaviour, then threads. An hour each.
sanitize sanitize-thread: clang_dependencies
	@cmake --preset $@ >/dev/null
	@cmake --build --preset $@
	@$(call run_tests,$@,nightly)

# Some of it: the library and the command built, and the tests of predicates and of every fuzz target on its corpus.
SOME_SANITIZED = core fuzz
sanitize-some: clang_dependencies
	@cmake --preset $@ >/dev/null
	@cmake --build --preset $@ --target condyle_cli $(SOME_SANITIZED:%=test_%)
	@ctest --preset $@ --parallel 2 -R '^($(subst $() ,|,$(SOME_SANITIZED)))$$'

# Coverage-guided fuzzing, a minute of each target; FUZZ_SECONDS=600 for longer, FUZZ_TARGETS="radial pairs" for some. New
# inputs gather in build/fuzz/corpus; what is found stays in build/fuzz/found and belongs, cut down, in tests/fuzz/corpus.
FUZZ_SECONDS ?= 60
FUZZ_TARGETS ?=
fuzz: clang_dependencies
	@cmake --preset fuzz >/dev/null
	@cmake --build --preset fuzz --target fuzz_programs
	@scripts/fuzz.sh $(FUZZ_SECONDS) $(FUZZ_TARGETS)

# Condyle beside other libraries; bench/tables gets the figures of this run, and ratios worse than the stored ones are reported.
bench: bench_dependencies
	@$(configure_bench)
	@cmake --build --preset release --target condyle_bench condyle_python
	@mkdir -p out/bench docs/images/bench
	@build/release/condyle-bench --json out/bench/run.json --csv out/bench/experiment.csv --save-baseline out/bench/baseline.json \
	  --add-run bench/runs.json
	@PYTHONPATH=build/release/python bench/draw_experiment.py out/bench/experiment.csv docs/images/bench
	@PYTHONPATH=build/release/python bench/draw_experiment.py out/bench/run.json docs/images/bench
	@bench/update_page.py out/bench/run.json bench/tables/performance.md bench/tables/experiment.md bench/tables/beside-others.md

# The part that a newcomer reads first, in minutes: six questions to Condyle and to the others, and the use of threads.
bench-summary: bench_dependencies
	@$(configure_bench)
	@cmake --build --preset release --target condyle_bench condyle_python
	@mkdir -p out/bench docs/images/bench
	@build/release/condyle-bench --summary --json out/bench/summary.json --add-run bench/runs.json
	@PYTHONPATH=build/release/python bench/draw_experiment.py out/bench/summary.json docs/images/bench
	@bench/update_page.py out/bench/summary.json bench/tables/beside-others.md

# Limits from label maps against those of the meshes that were made into voxels; bench/tables/label-maps.md gets the figures.
label-limits: bench_dependencies
	@$(configure_bench)
	@cmake --build --preset release --target condyle_label_limits
	@mkdir -p out/bench
	@build/release/condyle-label-limits --json out/bench/label_limits.json
	@bench/update_page.py out/bench/label_limits.json bench/tables/label-maps.md

# A hundred thousand rotation queries and the degenerate ones; bench/tables/rotation-queries.md gets misses, false alarms and times.
rotation-queries: dependencies
	@$(configure_all)
	@cmake --build --preset release --target condyle_answer_rotations
	@mkdir -p out/bench/rotations
	@bench/rotations/run.py build/release/condyle-answer-rotations out/bench/rotations
	@bench/update_page.py out/bench/rotations/run.json bench/tables/rotation-queries.md

# How each command grows with meshes four times as large, of nine shapes; worse than a square fails.
growth: dependencies
	@$(configure_all)
	@cmake --build --preset release --target condyle_cli
	@bench/growth_of_commands.py build/release/condyle --triangles 2500 --most 20

# The fast paths against the plain ones: a hundred million vertices, on each instruction set in turn.
verify: bench_dependencies
	@$(configure_bench)
	@cmake --build --preset release --target condyle_verify
	@build/release/condyle-verify

# The core compiled to WebAssembly. Emscripten's linker looks for Debian's modules of node by NODE_PATH.
# Not a python that a version manager looks up at each of some hundred calls.
page-core-alone: export EMSDK_PYTHON = /usr/bin/python3
page-core-alone:
	@scripts/install_dependencies.sh command emscripten
	@emcmake cmake -S viewer/core -B build/page_core -G Ninja >/dev/null
	@NODE_PATH=/usr/share/nodejs cmake --build build/page_core

# Its answers held against the native ones bit for bit.
page-core: page-core-alone dependencies
	@scripts/install_dependencies.sh page
	@$(configure_all)
	@cmake --build --preset release --target page_core_answers
	@mkdir -p build/page_core/test
	@build/release/page_core_answers --sample build/page_core/test
	@node tests/viewer/same_bits.mjs build/page_core/page_core.js build/page_core/test
	@node tests/viewer/same_edits.mjs build/page_core/page_core.js build/page_core/test

# The committed core held against the native answers of today's sources: while they are the same bits it may stay.
page-answers: dependencies
	@$(configure_all)
	@cmake --build --preset release --target page_core_answers
	@mkdir -p build/page/committed
	@build/release/page_core_answers --sample build/page/committed
	@base64 -d viewer/page_core.base64 | gunzip >build/page/committed/page_core.wasm
	@cp viewer/page_core.js build/page/committed
	@for file in same_bits same_edits; do node tests/viewer/$$file.mjs build/page/committed/page_core.js build/page/committed || \
	  { echo "the page's core answers otherwise than these sources: make page-template" >&2; exit 1; }; done

# The reports that the page is tried with; prints the digest of their data.
page-reports: dependencies
	@$(configure_all)
	@cmake --build --preset release --target condyle_cli
	@scripts/make_page_reports.sh

# The page of condyle report, made anew: its committed template has to be what its sources make. Then in a real browser.
page: page-core
	@scripts/make_page_template.sh build/page/template
	@for file in report_template.html page_core.base64 page_core.js; do cmp build/page/template/$$file viewer/$$file || \
	  { echo "viewer/$$file is not what its sources make: make page-template" >&2; exit 1; }; done
	@cmake --build --preset release --target condyle_cli
	@scripts/make_page_reports.sh >build/page/digest
	@scripts/test_page.sh
	@scripts/page_inputs.sh "$$(cat build/page/digest)" >tests/viewer/passed.txt

# After a change of the page or of the core: the template that condyle report fills in.
page-template: page-core
	@scripts/make_page_template.sh viewer

# The API page and every other page: out/api/index.html.
docs: docs_dependencies
	@$(configure_all)
	@cmake --build --preset release --target docs

# The npm package in out/npm: the command compiled to WebAssembly for node, and the page's core as a module.
npm: export EMSDK_PYTHON = /usr/bin/python3
npm: page-core-alone
	@emcmake cmake -S npm -B build/npm -G Ninja >/dev/null
	@NODE_PATH=/usr/share/nodejs cmake --build build/npm
	@scripts/npm_package.sh build/npm build/page_core out/npm

# Installed in an empty folder and run there, its limits and depths beside those of the native command.
npm-test: npm dependencies
	@$(configure_all)
	@cmake --build --preset release --target condyle_cli
	@tests/npm/installed.sh build/release/condyle out/npm/condyle-*.tgz

# Limits written for MuJoCo, posed by MuJoCo itself: the npm package mujoco-js. Without it they are not.
mujoco-limits:
	@scripts/install_dependencies.sh node
	@cmake --build --preset release --target condyle_cli
	@mkdir -p build/mujoco && cp tests/npm/mujoco.mjs build/mujoco
	@cd build/mujoco && if npm install --no-audit --no-fund --silent mujoco-js@0.0.7; then node mujoco.mjs "$(CURDIR)/build/release/condyle"; \
	 else echo "mujoco-limits: skipped: npm has no mujoco-js"; fi

# Layers of GetFEM's finite elements with our contact, held against closed forms; a picture in out/finite_elements.
finite-elements:
	@scripts/install_dependencies.sh finite-elements
	@$(configure_all)
	@cmake --build --preset release --target condyle_python
	@mkdir -p out/finite_elements
	@PYTHONPATH=build/release/python /usr/bin/python3 examples/python/finite_element_contact.py out/finite_elements || [ $$? -eq 77 ]

# The npm package ro-crate (1.7 MB), by which the test ro_crate reads what --crate writes: without it that test is skipped.
ro-crate:
	@scripts/install_dependencies.sh node
	@cd tests/crate && npm ci --no-audit --no-fund --silent

# Debian packages in out/packages: the command, python3-condyle, libcondyle-dev, condyle-doc.
package: build docs
	@cmake --build --preset release --target condyle condyle_sample condyle_io
	@rm -rf out/packages
	@cpack --config build/release/CPackConfig.cmake >out/package.log || { cat out/package.log; exit 1; }
	@ls out/packages/*.deb

# A wheel of the Python module in out/wheel, which brings the libraries that it needs; tried in an empty virtual environment.
wheel: build
	@scripts/install_dependencies.sh wheel
	@rm -rf out/wheel
	@scripts/wheel.sh build/release out/wheel

# The command as one file that runs on every Linux of this processor: build/static/condyle.
static: command_dependencies
	@cmake --preset static >/dev/null
	@cmake --build --preset static --target condyle_cli

# A container image of it: out/image/condyle-VERSION.oci.tar.
image: static
	@scripts/make_image.py build/static out/image

# Both beside the shared build, with nothing else in their root directory.
static-test: image dependencies
	@scripts/install_dependencies.sh image
	@$(configure_all)
	@cmake --build --preset release --target condyle_cli
	@ctest --preset release -R '^(static_command|image)$$' --no-tests=error

# A release in out/release from a clean tree that has passed make test-all: every artefact with its list of materials; each is run.
release: dependencies docs_dependencies
	@scripts/install_dependencies.sh wheel emscripten
	@scripts/release.sh

# The packages on a bare Debian, and the wheel on another.
package-test: package wheel
	@scripts/install_dependencies.sh package-test
	@scripts/package_test.sh

format: clang_dependencies
	@git ls-files '*.hpp' '*.cpp' '*.h' '*.c' | xargs clang-format -i

format-check: clang_dependencies
	@git ls-files '*.hpp' '*.cpp' '*.h' '*.c' | xargs clang-format --dry-run -Werror

clean:
	@rm -rf build out
