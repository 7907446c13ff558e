#!/usr/bin/env bash
# Installs a build, as it is, into an empty prefix; configures, builds and runs the consumer against it, and its main
# program once more by pkg-config alone. Imports the Python module, where the build has one, from the prefix.
# Usage: installed.sh BUILD_FOLDER COMPILER BUILD_TYPE WORK_FOLDER
set -euo pipefail
build=$1 compiler=$2 build_type=$3 work=$4
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() { echo "$*" >&2; exit 1; }
says() { "$1" | tee /dev/stderr | grep -qx "$2" || fail "$1 must say: $2"; }

for component in development command documentation; do
  cmake --install "$build" --prefix prefix --component "$component" >/dev/null
done
# Nothing of a build folder or of the sources is needed, or known.
if grep -rlF "$(cd "$here/../.." && pwd)" prefix/lib*/cmake prefix/lib*/pkgconfig; then fail "these name the source folder"; fi
prefix/bin/condyle --version
# Bundled parts come with their licences.
if ! ldd prefix/bin/condyle | grep -q libhdf5; then
  grep -q "The HDF Group" prefix/share/doc/condyle/libhdf5-dev.copyright || fail "the licence of HDF5 is not installed"
fi

cmake -S "$here" -B installed -G Ninja -DCMAKE_PREFIX_PATH="$PWD/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_BUILD_TYPE="$build_type" -DCMAKE_CXX_FLAGS="${CONSUMER_FLAGS:-}" >configure.txt || fail "$(cat configure.txt)"
cmake --build installed >build.txt || fail "$(cat build.txt)"
says installed/consumer "flexion ends at 30.000 degrees"
says installed/consumer_of_files "773 vertices"
says installed/consumer_by_library "a file of OpenSim-JAM"

# A version that is not this one is refused.
sed -E 's/\(condyle [0-9.]+/(condyle 0.99/' "$here/CMakeLists.txt" >CMakeLists.txt
cp "$here"/*.cpp .
if cmake -S . -B other_version -G Ninja -DCMAKE_PREFIX_PATH="$PWD/prefix" >/dev/null 2>&1; then fail "0.99 was found"; fi

PKG_CONFIG_PATH=$(dirname "$(find "$PWD/prefix" -name condyle.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046,SC2086
"$compiler" ${CONSUMER_FLAGS:-} main.cpp -o by_pkg_config $(pkg-config --cflags --libs condyle)
says ./by_pkg_config "flexion ends at 30.000 degrees"

in_cache() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
if [ "$(in_cache CONDYLE_C)" = ON ]; then
  cmake --install "$build" --prefix prefix --component library >/dev/null
  # The C compiler beside that of C++.
  c_compiler=$(sed -E 's/clang\+\+/clang/; s/g\+\+/gcc/; s/c\+\+/cc/' <<<"$compiler")
  needle=$here/../../examples/c/needle.c
  cmake -S "$here/c" -B in_c -G Ninja -DCMAKE_PREFIX_PATH="$PWD/prefix" -DCMAKE_C_COMPILER="$c_compiler" -DNEEDLE="$needle" \
    -DCMAKE_C_FLAGS="${CONSUMER_FLAGS:-}" >configure.txt || fail "$(cat configure.txt)"
  cmake --build in_c >build.txt || fail "$(cat build.txt)"
  says in_c/needle "vertex 3 is 3.750 mm inside"
  # shellcheck disable=SC2046,SC2086
  "$c_compiler" ${CONSUMER_FLAGS:-} -std=c99 "$needle" -o needle_by_pkg_config $(pkg-config --cflags --libs condyle-c)
  LD_LIBRARY_PATH=$(pkg-config --variable=libdir condyle-c) says ./needle_by_pkg_config "vertex 3 is 3.750 mm inside"
fi
if [ "$(in_cache CONDYLE_PYTHON)" = ON ]; then
  cmake --install "$build" --prefix prefix --component python >/dev/null
  module=$(find "$PWD/prefix" -type d -path '*/*-packages/condyle')
  preloaded=()
  if [ -n "${CONSUMER_PRELOAD:-}" ]; then
    # Only of the test's Python: programs that it starts are linked with the library, or have nothing to do with it.
    preloaded=(env LD_PRELOAD="$CONSUMER_PRELOAD" ASAN_OPTIONS=detect_leaks=0)
  fi
  cat >import.py <<'EOF'
import sys
import condyle
assert condyle.__file__.startswith(sys.argv[1]), condyle.__file__
mesh = condyle.sample_hip(scenario=1).femur
print(len(mesh.vertices), "vertices in Python")
EOF
  imported() { PYTHONPATH=$(dirname "$module") "${preloaded[@]}" "$(in_cache Python_EXECUTABLE)" import.py "$module"; }
  says imported "773 vertices in Python"
fi
