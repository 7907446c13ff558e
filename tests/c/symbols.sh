#!/usr/bin/env bash
# The shared library shows its declared functions and no other name, under its version, and loads the C++ runtime, oneTBB and Highway
# only.
# Usage: symbols.sh SOURCE_FOLDER LIBRARY
set -euo pipefail
sources=$1 library=$2
fail() { echo "$*" >&2; exit 1; }
shown=$(nm -D --defined-only "$library" | awk '$2 != "A" { print $3 }' | sort)
declared=$(grep -oE '^CONDYLE_API .*' -A1 "$sources/include/condyle/condyle.h" | tr '\n' ' ' |
           grep -oE 'condyle_[a-z_]+\(' | tr -d '(' | sed 's/$/@@CONDYLE_1/' | sort)
[ -n "$declared" ] || fail "condyle.h declares nothing?"
diff <(echo "$declared") <(echo "$shown") || fail "< declared, > shown"
[ "$(objdump -p "$library" | awk '/SONAME/ { print $2 }')" = libcondyle_c.so.1 ] || fail "the library has another name"
others=$(objdump -p "$library" | awk '/NEEDED/ { print $2 }' | grep -vE '^(libtbb\.so\.12|libstdc\+\+\.so\.6|libm\.so\.6|libgcc_s\.so\.1|libc\.so\.6|ld-linux.*)$' || true)
[ -z "$others" ] || fail "the library loads $(xargs <<<"$others")"
