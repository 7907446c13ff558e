#!/usr/bin/env bash
# Makes and tests the page if anything that it is made of has changed since `make page` last passed: that run left the digest of its inputs in
# tests/viewer/passed.txt, which is committed with the template.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "$(scripts/page_inputs.sh)" = "$(cat tests/viewer/passed.txt)" ]; then
  echo "page: nothing that it is made of has changed since it passed in a browser, at $(git log -1 --format='%h of %cs' -- tests/viewer/passed.txt)"
  exit 0
fi
echo "page: what it is made of has changed since tests/viewer/passed.txt was written"
make page
