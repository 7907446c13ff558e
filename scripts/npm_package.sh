#!/usr/bin/env bash
# Packs the command for node as npm takes it, condyle-VERSION.tgz, from what `emcmake cmake -S npm` has built.
# Usage: npm_package.sh FOLDER_OF_BUILD FOLDER
set -euo pipefail
built=$(realpath "$1")
folder=$(realpath -m "$2")
cd "$(dirname "$0")/.."
version=$(sed -n 's/.*std::string_view version = "\(.*\)".*/\1/p' include/condyle/version.hpp)
(cd viewer && if [ ! -d node_modules ] || [ package-lock.json -nt node_modules/.package-lock.json ]; then npm ci --no-audit --no-fund --silent; fi)
rm -rf "$folder"
node npm/build.mjs "$built" "$folder/package" "$version"
cd "$folder"
npm pack --silent ./package
