#!/usr/bin/env bash
# Programs in C: each example compiles as C99 and as C++ without a warning, and answers as its closed forms do. With the program
# of the tests, under valgrind, without errors or leaks, and so do the tests of what is passed in wrong
# and of memory that ends.
# Usage: programs.sh SOURCE_FOLDER LIBRARY CXX_COMPILER WORK_FOLDER [TESTS]
set -euo pipefail
sources=$1 library=$2 compiler=$3 work=$4 tests=${5:-}
fail() { echo "$*" >&2; exit 1; }
if [ -n "$tests" ] && ! command -v valgrind >/dev/null; then
  echo "******** SKIPPED: there is no valgrind ********" >&2
  exit 77
fi
# The C compiler beside that of C++.
c_compiler=$(sed -E 's/clang\+\+/clang/; s/g\+\+/gcc/; s/c\+\+/cc/' <<<"$compiler")
command -v "$c_compiler" >/dev/null || c_compiler=cc
folder=$(dirname "$library")
mkdir -p "$work"
warnings=(-Wall -Wextra -pedantic -Werror)
linked=(-I "$sources/include" "$library" "-Wl,-rpath,$folder" "-Wl,-rpath-link,$folder")
# shellcheck disable=SC2206
sanitized=(${PROGRAM_FLAGS:-})
# Sanitizers of C++ come with its compiler.
linker=$c_compiler
[ -z "${PROGRAM_FLAGS:-}" ] || linker=$compiler
cat >"$work/needle.txt" <<'TEXT'
turns 30.000 degrees, then vertex 3 of the needle meets the wall at x = 5.000 mm
vertex 3 is 3.750 mm inside
180.000 N on 100.000 mm2, 27.000 N mm stored
TEXT
cat >"$work/falling_ball.txt" <<'TEXT'
starts 0.50 mm deep
carries 9.81 N at 0.23 mm
grown, carries 9.81 N at 0.22 mm, with 90 N/mm
TEXT
# Threads of oneTBB go on to the end of the process: what only they hold may be lost, and is none of the library's.
checked=()
[ -z "$tests" ] || checked=(valgrind --quiet --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite --error-exitcode=1)
for name in needle falling_ball; do
  "$c_compiler" -std=c99 "${warnings[@]}" -O1 -g "${sanitized[@]}" -I "$sources/include" -c "$sources/examples/c/$name.c" -o "$work/$name.o"
  "$linker" "${sanitized[@]}" "$work/$name.o" "${linked[@]}" -lm -o "$work/$name"
  "${checked[@]}" "$work/$name" >"$work/answers.txt"
  diff "$work/$name.txt" "$work/answers.txt" || fail "these are the answers of $name"
  [ -z "$tests" ] || continue
  "$compiler" -x c++ -std=c++11 "${warnings[@]}" -Wno-missing-field-initializers "${sanitized[@]}" "$sources/examples/c/$name.c" -x none \
    "${linked[@]}" -o "$work/${name}_in_cpp"
  "$work/${name}_in_cpp" | diff "$work/$name.txt" -
done
[ -n "$tests" ] || exit 0
# With the program's own operator new, which fails where the tests say.
"${checked[@]}" --soname-synonyms=somalloc=nouserintercepts "$tests" '--gtest_filter=CErrors.*:CMemory.*:CForces.*' --gtest_brief=1
