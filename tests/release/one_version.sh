#!/usr/bin/env bash
# One version everywhere: that of include/condyle/version.hpp. Usage: one_version.sh SOURCE_FOLDER CONDYLE_BINARY
set -euo pipefail
source_folder=$1 condyle=$2
cd "$source_folder"
version=$(sed -nE 's/.*std::string_view version = "(.*)";/\1/p' include/condyle/version.hpp)
fail() { echo "$*" >&2; exit 1; }
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "version.hpp: '$version' is no semantic version"
"$condyle" --version | grep -qF "$version" || fail "the command is of another version than $version"
grep -qx "version: $version" CITATION.cff || fail "CITATION.cff is of another version than $version"
first=$(sed -nE 's/^## +//p' CHANGELOG.md | sed -n 1p)
released='^\[?'${version//./\\.}'\]? - [0-9]{4}-[0-9]{2}-[0-9]{2}$'
[[ $first =~ ^(\[Unreleased\]|Unreleased)$ || $first =~ $released ]] ||
  fail "CHANGELOG.md begins with '$first', not with Unreleased, nor with [$version] - YYYY-MM-DD"
for file in codemeta.json packaging/conda/recipe.yaml packaging/debian/changelog packaging/spack/package.py packaging/vcpkg/vcpkg.json; do
  grep -qE "(version\"?[:(] *\"|^condyle \()${version//./\\.}[-\"]" $file || fail "$file is of another version than $version"
done
[[ $first != *" - "* ]] || grep -qx "date-released: ${first##* }" CITATION.cff || fail "CITATION.cff is of another day than CHANGELOG.md"
echo "$version"
