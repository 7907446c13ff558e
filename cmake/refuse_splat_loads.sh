#!/usr/bin/env bash
# Fails if a WebAssembly program loads numbers into vectors by the instruction that clang 14 may misplace: frozen_lanes.py has none made.
# Usage: refuse_splat_loads.sh PROGRAM.wasm
set -euo pipefail
count=$(wasm-dis "$1" | grep -c 'v128\.load[0-9]*_splat' || [ "${PIPESTATUS[*]}" = "0 1" ])
[ "$count" -eq 0 ] || { echo "$1: $count loads into vectors may be misplaced" >&2; exit 1; }
