#!/usr/bin/env bash
# Makes and tests the page if what a browser is given has changed since `make page` last passed, or if its core no longer answers as the native one does. That
# run left the digest of what the browser was given in tests/viewer/passed.txt, which is committed with the template. A change of sources that changes neither
# the answers of the core nor the data of a report changes nothing that a browser could see. The file is a digest that anybody could write: a tenth of the
# tests, which one by the commit, runs in a browser all the same.
set -euo pipefail
cd "$(dirname "$0")/.."
digest=$(make --no-print-directory -s page-reports | tail -1)
if [ "$(scripts/page_inputs.sh "$digest")" = "$(cat tests/viewer/passed.txt)" ]; then
  make page-answers
  echo "page: nothing that a browser is given has changed since it passed in one, at $(git log -1 --format='%h of %cs' -- tests/viewer/passed.txt)"
  scripts/install_dependencies.sh page
  # What else these tests need is only there where the page has been made: what drives the browser, and a core, here the committed one.
  if [ ! -d viewer/node_modules ]; then (cd viewer && npm ci --no-audit --no-fund --silent); fi
  if [ ! -e build/page_core/page_core.js ]; then mkdir -p build/page_core && cp build/page/committed/page_core.* build/page_core; fi
  scripts/test_page.sh $((16#$(git rev-parse HEAD | cut -c1-7) % 10))
  exit 0
fi
echo "page: what a browser is given has changed since tests/viewer/passed.txt was written"
make page
