#!/usr/bin/env bash
# Runs the README's commands in an empty folder, as they stand, and checks that its make targets and its C++ exist.
# Usage: readme_commands.sh SOURCE_FOLDER CONDYLE_BINARY
set -euo pipefail
source_folder=$1
. "$source_folder/tests/docs/commands.sh"
in_empty_folder "$2"

while IFS= read -r line; do
  command=${line%%#*}
  case "$command" in
    make\ *)
      # Running make here would build what is just being tested; that the target is there is what can be wrong.
      run "make -s -n -C '$source_folder' ${command#make }"
      ;;
    condyle\ *)
      run "$command"
      ;;
    "") continue ;;
    *)
      echo "README.md: a command this test does not know: $command" >&2
      exit 1
      ;;
  esac
done < <(awk '/^```sh$/ { on = 1; next } /^```$/ { on = 0 } on' "$source_folder/README.md")
[ "$ran" -ge 8 ] || { echo "README.md: only $ran commands found" >&2; exit 1; }

# Every line of C++ in the README stands in an example that the tests run.
quoted=0
while IFS= read -r line; do
  text=$(sed 's/^ *//' <<<"$line")
  [ -n "$text" ] || continue
  grep -rqF -- "$text" "$source_folder/examples" || { echo "README.md: not in examples/: $text" >&2; exit 1; }
  quoted=$((quoted + 1))
done < <(awk '/^```cpp$/ { on = 1; next } /^```$/ { on = 0 } on' "$source_folder/README.md")
[ "$quoted" -ge 5 ] || { echo "README.md: only $quoted lines of C++ found" >&2; exit 1; }
echo "$ran commands, $quoted lines of C++"
