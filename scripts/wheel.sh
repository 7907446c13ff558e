#!/usr/bin/env bash
# Makes a wheel of the Python module that a build folder holds, and tries it: wheel.sh BUILD OUT.
set -euo pipefail
scripts=$(cd "$(dirname "$0")" && pwd)
python=$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' "$1/CMakeCache.txt")
wheel=$("$python" "$scripts/make_wheel.py" "$1" "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$python" "$scripts/../tests/release/wheel_test.py" "$1" "$work" "$wheel"
