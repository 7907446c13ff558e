#!/usr/bin/env bash
# The C++ program of README.md is examples/penetration.cpp, letter for letter; the tests compile and run that file.
#   readme_example.sh SOURCE
set -euo pipefail
cd "$1"
program=$(awk '/^```cpp$/ { inside = 1; next } /^```$/ { inside = 0 } inside' README.md)
diff <(printf '%s\n' "$program") examples/penetration.cpp
