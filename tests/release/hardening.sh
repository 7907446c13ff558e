#!/usr/bin/env bash
# Programs and shared libraries are built against faults: addresses that are bound at the start and read-only, code at any address, stacks
# that are watched, calls whose sizes are checked.
# Usage: hardening.sh FILE...
set -euo pipefail
fail() { echo "$*" >&2; exit 1; }
for file in "$@"; do
  headers=$(readelf -Wlhd "$file") names=$(nm -D --undefined-only "$file")
  grep -q 'Type: *DYN' <<<"$headers" || fail "$file: lies at fixed addresses"
  grep -q GNU_RELRO <<<"$headers" || fail "$file: has no GNU_RELRO"
  grep -qE 'BIND_NOW|Flags:.* NOW' <<<"$headers" || fail "$file: binds addresses late"
  grep -qE 'GNU_STACK.* RW ' <<<"$headers" || fail "$file: has a stack that runs"
  grep -q __stack_chk_fail <<<"$names" || fail "$file: does not watch its stack"
done
# Calls that are checked are those with an array of known size: the command has some.
names=$(nm -D --undefined-only "$1")
grep -qE ' __[a-z]+_chk(@|$)' <<<"$names" || fail "$1: checks no call"
