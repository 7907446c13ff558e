#!/usr/bin/env bash
# Every public header compiles as the only line of a file, with what a user of its library sees and nothing else, two at a time:
# each_alone.sh INCLUDE COMPILER FLAG...
set -euo pipefail
cd "$1"
shift
headers=$(find condyle -name '*.hpp' | sort)
[ "$(wc -w <<<"$headers")" -ge 40 ] || { echo "only $headers were found" >&2; exit 1; }
xargs -P 2 -I {} sh -c 'echo "#include <{}>" | "$@" -std=c++20 -I. -x c++ -S -o /dev/null -' _ "$@" <<<"$headers"
