#!/usr/bin/env bash
# Makes the page's template from viewer/ and from build/page_core: type check, bundle, one file.
# Usage: make_page_template.sh TEMPLATE
set -euo pipefail
template=$(realpath -m "$1")
cd "$(dirname "$0")/../viewer"
# Exactly the packages that package-lock.json names, to the byte.
if [ ! -d node_modules ] || [ package-lock.json -nt node_modules/.package-lock.json ]; then npm ci --no-audit --no-fund --silent; fi
npx --no-install tsc --noEmit
mkdir -p "$(dirname "$template")"
node build.mjs ../build/page_core "$template"
