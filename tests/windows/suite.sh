#!/usr/bin/env bash
# A suite of tests, compiled for Windows (make windows-test) and run by Wine. All that is in the program has to pass or to be skipped.
# Usage: suite.sh PROGRAM WORK_FOLDER LEAST_CASES [FILTER]
set -euo pipefail
program=$1 work=$2 least=$3 filter=${4:-*}
# shellcheck source=wine.sh
. "$(dirname "$0")/wine.sh" "$work" "$program"
code=0
wine "$program" --gtest_brief=1 --gtest_filter="$filter" </dev/null >"$work/output.txt" 2>&1 || code=$?
tail -n 20 "$work/output.txt"
[ $code = 0 ] || fail "exit code $code"
passed=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) tests\?\..*/\1/p' "$work/output.txt")
[ "${passed:-0}" -ge "$least" ] || fail "${passed:-no} cases passed and not $least"
