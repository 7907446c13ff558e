#!/usr/bin/env bash
# How long what a developer waits for takes from an empty folder, packages installed: measure_times.sh [TARGET...], by default demo and test. Clones the last
# commit into a folder of its own, makes each target in turn, and prints a row for the table of CONTRIBUTING.md. Nothing else should run meanwhile.
set -euo pipefail
source=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CONDYLE_DATA=${CONDYLE_DATA:-$source/../shared/data}
git clone --quiet "$source" "$work/condyle"
cd "$work/condyle"
row="| $(date +%F), $(nproc) x $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(git log -1 --format=%h) |"
if [ $# -eq 0 ]; then set -- demo test; fi
for target in "$@"; do
  begun=$SECONDS
  make "$target" >"$work/$target.log" 2>&1 || { tail -40 "$work/$target.log" >&2; echo "make $target failed" >&2; exit 1; }
  tail -3 "$work/$target.log" >&2
  row+=$(printf ' %s %d:%02d |' "$target" $(((SECONDS - begun) / 60)) $(((SECONDS - begun) % 60)))
done
echo "$row"
