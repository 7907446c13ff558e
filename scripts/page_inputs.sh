#!/usr/bin/env bash
# Prints the SHA-256 of all that a browser is given by the page's tests: the committed files of the page, its template and its tests as they lie in the working
# tree, and DIGEST, what scripts/make_page_reports.sh printed. Usage: page_inputs.sh DIGEST
set -euo pipefail
cd "$(dirname "$0")/.."
{
  echo "$1"
  git ls-files -z -- viewer tests/viewer tests/support/knee_by_hand scripts/make_page_template.sh scripts/make_page_reports.sh scripts/test_page.sh \
    ':!tests/viewer/passed.txt' | LC_ALL=C sort -z | xargs -0 sha256sum
} | sha256sum | cut -d' ' -f1
