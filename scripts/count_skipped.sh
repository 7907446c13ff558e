#!/usr/bin/env bash
# How many tests were skipped, and why, in one line: count_skipped.sh RESULTS, the folder of the files that GoogleTest
# (*.xml) and ctest (ctest.junit) wrote. Tests skip where something is not there (real joints, another library, rights). In CI real joints are
# there: a test that was skipped for them ends it with 1.
set -euo pipefail
results=$1
tests=$( (grep -soh '<testcase ' "$results"/*.xml 2>/dev/null || true) | wc -l)

# GoogleTest: message="FILE:LINE&#x0A;REASON", of tests that a run leaves passed; pytest: type="..." message="REASON". ctest:
# whole runs without a reason.
reasons() {
  (grep -sohE '<skipped [^>]*message="[^"]*"' "$results"/*.xml || true) | sed -E 's/.*message="([^"]*)"/\1/; s/^[^&]*&#x0A;//; s/&#x0A;/ /g'
  sed -nE '/<testcase name="[^"]*".*status="notrun"/ s/.*<testcase name="([^"]*)".*/\1 did not run/p' \
    "$results/ctest.junit"
}
lines=$(reasons | sed -E 's/&quot;/"/g; s/&apos;/'"'"'/g; s/&lt;/</g; s/&gt;/>/g; s/&amp;/\&/g' | sort | uniq -c | sort -rn)
if [ -z "$lines" ]; then
  echo "no test was skipped ($tests tests)"
  exit 0
fi
count=$(awk '{ n += $1 } END { print n }' <<<"$lines")
why=$(awk '{ n = $1; $1 = ""; printf "%s%d x%s", (NR > 1 ? "; " : ""), n, $0 }' <<<"$lines")
echo "******** $count of $tests tests were SKIPPED: $why ********"
if grep -qiE 'not installed|no module|could not import' <<<"$lines"; then
  echo "scripts/install_dependencies.sh clang bench docs page wheel workflow installs what they need; real joints: CONDYLE_DATA"
fi
if [ "${CI:-}" = true ] && grep -qE 'CONDYLE_DATA|shared|real |not here|no models' <<<"$lines"; then
  echo "real joints have to be there in CI: CONDYLE_DATA, or shared/data beside the repository"
  exit 1
fi
