# Thin front door; CMakePresets.json has the details.
.PHONY: demo test build dependencies clang_dependencies format clean fuzz sanitize clang

dependencies:
	@scripts/install_dependencies.sh

clang_dependencies:
	@scripts/install_dependencies.sh clang

build/release/build.ninja: | dependencies
	@cmake --preset release >/dev/null

# Release build of the library and the command line alone.
build: dependencies build/release/build.ninja
	@cmake --build --preset release --target condyle_cli

demo: build
	@scripts/demo.sh

test: dependencies build/release/build.ninja
	@cmake --build --preset release
	@ctest --preset release --parallel 2

sanitize clang: clang_dependencies
	@cmake --preset $@ >/dev/null
	@cmake --build --preset $@
	@ctest --preset $@ --parallel 2

# A minute of coverage-guided fuzzing of the mesh readers; FUZZ_SECONDS=3600 for longer.
FUZZ_SECONDS ?= 60
fuzz: clang_dependencies
	@cmake --preset fuzz >/dev/null
	@cmake --build --preset fuzz --target fuzz_mesh_reader mesh_seeds
	@mkdir -p build/fuzz/corpus
	@build/fuzz/mesh_seeds build/fuzz/corpus
	@build/fuzz/fuzz_mesh_reader -max_total_time=$(FUZZ_SECONDS) -malloc_limit_mb=256 build/fuzz/corpus

format: clang_dependencies
	@git ls-files '*.hpp' '*.cpp' | xargs clang-format -i

clean:
	@rm -rf build out
