#!/usr/bin/env bash
# Opens the reports of scripts/make_page_reports.sh in a real browser, from disk and without a network: tests/viewer/*.test.mjs. Pictures of
# what was seen are in build/page/seen.
set -euo pipefail
cd "$(dirname "$0")/.."
node --test --test-concurrency=1 tests/viewer/*.test.mjs
