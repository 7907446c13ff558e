#!/usr/bin/env bash
# Opens the reports of scripts/make_page_reports.sh in a real browser, from disk and without a network: tests/viewer/*.test.mjs, or of every
# ten of these files the one that PART, 0 to 9, names. Pictures of what was seen are in build/page/seen. Usage: test_page.sh [PART]
set -euo pipefail
cd "$(dirname "$0")/.."
files=(tests/viewer/*.test.mjs)
for i in "${!files[@]}"; do
  [ $((i % 10)) = "${1:-$((i % 10))}" ] || unset "files[i]"
done
node --test --test-concurrency=1 "${files[@]}"
