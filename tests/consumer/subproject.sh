#!/usr/bin/env bash
# Condyle as a part of another project: what that project decides for itself stays as it was, and its program compiles, links
# and runs.
# Usage: subproject.sh SOURCE_FOLDER COMPILER WORK_FOLDER, with BUILD=yes in the environment to compile its source too. The library that it
# links is compiled with it if CONDYLE_LONG_TESTS is set: two minutes, for what the same sources and another consumer show.
set -euo pipefail
sources=$1 compiler=$2 work=$3
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() { echo "$*" >&2; exit 1; }
configure() {
  cmake -S "$here/subproject" -B . -G Ninja -DCONDYLE_SOURCES="$sources" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CXX_FLAGS="${CONSUMER_FLAGS:-}" "$@" >configure.txt || fail "$(cat configure.txt)"
}

configure
grep -q '^CMAKE_BUILD_TYPE:[A-Z]*=$' CMakeCache.txt || fail "the parent's build type was changed"
if grep -qE '^(VTK|GTest|CLI11)_DIR' CMakeCache.txt; then fail "packages were looked for that the core does not use"; fi
if grep -qE -- '-Werror| -O[0-9]' build.ninja; then fail "the parent's flags were changed"; fi
targets=$(ninja -t targets all | sed 's/:.*//')
if grep -E '(^|/)(test_|condyle-|example_|condyle_cli)' <<<"$targets"; then fail "these are built for nobody"; fi
[ "$(ctest -N | tail -1)" = "Total Tests: 0" ] || fail "there are tests in the parent"
[ -z "$(DESTDIR="$PWD/installed" cmake --install . | grep Installing)" ] || fail "the parent installs Condyle"

[ -n "${BUILD:-}" ] || { echo "configured, not built"; exit 0; }
if [ -z "${CONDYLE_LONG_TESTS:-}" ]; then
  cmake --build . --target "$(ninja -t targets all | sed -n 's/^\(.*main\.cpp\.o\):.*/\1/p')" >build.txt || fail "$(cat build.txt)"
  exit 0
fi
# Not optimised, as the parent wants it: what it links and does is the same. Several sources at a time take a fraction of the time.
configure -DCONDYLE_WERROR=ON -DCONDYLE_PRECOMPILED_HEADERS=ON -DCONDYLE_UNITY=ON -DCMAKE_RUNTIME_OUTPUT_DIRECTORY="$PWD/programs"
cmake --build . --target consumer >build.txt || fail "$(cat build.txt)"
programs/consumer | tee /dev/stderr | grep -qx "flexion ends at 30.000 degrees"
