#!/usr/bin/env bash
# Every relative link of the documentation leads to a file. Usage: links.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"
broken=0
checked=0
while IFS=: read -r file target; do
  path=${target%%#*}
  [ -n "$path" ] || continue
  checked=$((checked + 1))
  [ -e "$(dirname "$file")/$path" ] || { echo "$file: broken link to $target" >&2; broken=1; }
done < <(grep -oE '\]\([^)]+\)' README.md CONTRIBUTING.md docs/*.md docs/*/*.md bench/tables/*.md --with-filename |
         sed -E 's/\]\(([^)]*)\)/\1/' | grep -vE ':(https?|mailto):')
[ "$checked" -gt 0 ]
exit "$broken"
