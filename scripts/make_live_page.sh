#!/usr/bin/env bash
# Makes docs/live.html anew, the report of the sample hip that the README links: before a release. Needs a release build.
set -euo pipefail
cd "$(dirname "$0")/.."
condyle=$PWD/build/release/condyle
mkdir -p out/docs/live
cd out/docs/live
"$condyle" sample hip --scenario 2 --out sample >/dev/null
"$condyle" report sample/hip.toml --band=40 --past 5 --map flexion=0:120:10 adduction=-30:20:10 --out ../../../docs/live.html
