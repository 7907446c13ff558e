#!/usr/bin/env bash
# Prints the SHA-256 of all that the page and its tests are made of, as it lies in the working tree: names and contents of the committed files.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files -z -- include src cli viewer tests/viewer tests/support cmake examples CMakeLists.txt CMakePresets.json Makefile \
  scripts/make_page_template.sh scripts/test_page.sh scripts/install_dependencies.sh ':!tests/viewer/passed.txt' |
  LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum | cut -d' ' -f1
