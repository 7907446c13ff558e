#!/usr/bin/env bash
# Packs the command for node as npm takes it, condyle-VERSION.tgz, from what `emcmake cmake -S npm` has built.
# Usage: npm_package.sh FOLDER_OF_BUILD FOLDER_OF_PAGE_CORE FOLDER
set -euo pipefail
built=$(realpath "$1")
core=$(realpath "$2")
folder=$(realpath -m "$3")
cd "$(dirname "$0")/.."
version=$(sed -n 's/.*std::string_view version = "\(.*\)".*/\1/p' include/condyle/version.hpp)
(cd viewer && if [ ! -d node_modules ] || [ package-lock.json -nt node_modules/.package-lock.json ]; then npm ci --no-audit --no-fund --silent; fi)
rm -rf "$folder" "$built/types"
(cd viewer && npx --no-install tsc -p ../npm/tsconfig.json --outDir "$built/types")
node npm/build.mjs "$built" "$core" "$folder/package" "$version"
cd "$folder"
npm pack --silent ./package
