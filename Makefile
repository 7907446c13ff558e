# Thin front door; CMakePresets.json has the details.
.PHONY: demo test build dependencies format clean fuzz sanitize clang

dependencies:
	@scripts/install_dependencies.sh

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

sanitize clang: dependencies
	@cmake --preset $@ >/dev/null
	@cmake --build --preset $@
	@ctest --preset $@ --parallel 2

format:
	@git ls-files '*.hpp' '*.cpp' | xargs clang-format -i

clean:
	@rm -rf build out
