#!/usr/bin/env bash
# Runs the commands of docs/tutorial.md in an empty folder, as they stand, and looks for what they leave.
# Usage: tutorial_commands.sh SOURCE_FOLDER CONDYLE_BINARY
set -euo pipefail
source_folder=$1
. "$source_folder/tests/docs/commands.sh"
in_empty_folder "$2"

while IFS= read -r command; do
  run "$command"
done < <(sed -n 's/^    \(condyle .*\)$/\1/p' "$source_folder/docs/tutorial.md")
[ "$ran" -eq 5 ] || { echo "docs/tutorial.md: $ran commands found, not 5" >&2; exit 1; }
for file in hip.toml range/rom.json range/limits.csv deep/fixed.vtp deep/mobile.vtp; do
  [ -s "$file" ] || { echo "docs/tutorial.md: its commands left no $file" >&2; exit 1; }
done
echo "$ran commands"
