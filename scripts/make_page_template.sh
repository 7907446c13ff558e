#!/usr/bin/env bash
# Makes the page's template from viewer/ and from build/page_core: type check, bundle, report_template.html and page_core.base64.
# Usage: make_page_template.sh FOLDER
set -euo pipefail
folder=$(realpath -m "$1")
cd "$(dirname "$0")/../viewer"
# Exactly the packages that package-lock.json names, to the byte.
if [ ! -d node_modules ] || [ package-lock.json -nt node_modules/.package-lock.json ]; then npm ci --no-audit --no-fund --silent; fi
npx --no-install tsc --noEmit
mkdir -p "$folder"
node build.mjs ../build/page_core "$folder"
