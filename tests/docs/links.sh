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
done < <(awk 'FNR == 1 || /^```/ { code = /^```/ && !code }  # code has no links
              !code { while (match($0, /\]\([^)]+\)/)) { print FILENAME ":" substr($0, RSTART + 2, RLENGTH - 3)
                                                         $0 = substr($0, RSTART + RLENGTH) } }' \
         README.md CONTRIBUTING.md docs/*.md docs/*/*.md bench/tables/*.md | grep -vE ':(https?|mailto):')
[ "$checked" -gt 0 ]
exit "$broken"
