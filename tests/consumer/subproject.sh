#!/usr/bin/env bash
# Condyle as a part of another project: what that project decides for itself stays as it was, and its program links and
# runs. Built only where a compiler cache keeps what it compiles for the next time.
# Usage: subproject.sh SOURCE_FOLDER COMPILER WORK_FOLDER, with COMPILER_CACHE in the environment
set -euo pipefail
sources=$1 compiler=$2 work=$3 cache=${COMPILER_CACHE:-}
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
if grep -q ccache build.ninja; then fail "the parent's compiler launcher was changed"; fi
targets=$(ninja -t targets all | sed 's/:.*//')
if grep -E '(^|/)(test_|condyle-|example_|condyle_cli)' <<<"$targets"; then fail "these are built for nobody"; fi
[ "$(ctest -N | tail -1)" = "Total Tests: 0" ] || fail "there are tests in the parent"
[ -z "$(DESTDIR="$PWD/installed" cmake --install . | grep Installing)" ] || fail "the parent installs Condyle"

[ -n "$cache" ] || { echo "configured, not built: there is no compiler cache"; exit 0; }
# Not optimised, as the parent wants it: what it links and does is the same. Precompiled headers halve the time; builds by
# clang do without.
configure -DCONDYLE_WERROR=ON -DCONDYLE_PRECOMPILED_HEADERS=ON -DCMAKE_CXX_COMPILER_LAUNCHER="$cache" -DCMAKE_RUNTIME_OUTPUT_DIRECTORY="$PWD/programs"
cmake --build . --target consumer >build.txt || fail "$(cat build.txt)"
programs/consumer | tee /dev/stderr | grep -qx "flexion ends at 30.000 degrees"
