#!/usr/bin/env bash
# Runs fuzz targets one after the other, built by the preset fuzz: fuzz.sh SECONDS [TARGET]...; all of them where none is named.
# A line for each reports how many inputs were tried. Ends at the first finding, with the input kept in build/fuzz/found.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=$1
shift
[ $# -gt 0 ] || set -- $(cd tests/fuzz/corpus && ls)
for target in "$@"; do
  corpus=build/fuzz/corpus/$target
  mkdir -p "$corpus" build/fuzz/found
  if [ "$target" = mesh_reader ]; then build/fuzz/mesh_seeds "$corpus"; fi
  log=build/fuzz/$target.log
  words=()
  if [ -f "tests/fuzz/dictionaries/$target.dict" ]; then words=("-dict=tests/fuzz/dictionaries/$target.dict"); fi
  # An input of 4 kB takes milliseconds and less than 40 MB: hangs and floods are findings too.
  ASAN_OPTIONS=allocator_may_return_null=1 "build/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=4096 -timeout=20 -malloc_limit_mb=256 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$target-" "${words[@]}" "$corpus" "tests/fuzz/corpus/$target" \
    >"$log" 2>&1 || { tail -n 30 "$log" >&2; exit 1; }
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s, none broken"
done
