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
first=$(sed -nE 's/^## (\[?[^] ]+\]?).*/\1/p' CHANGELOG.md | head -1)
[ "$first" = "$version" ] || [ "$first" = "Unreleased" ] || fail "CHANGELOG.md begins with $first, not with $version or Unreleased"
echo "$version"
