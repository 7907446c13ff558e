#!/usr/bin/env bash
# Makes the built-in sample hip, asks it a handful of poses, and writes a report of it. Results go to out/demo.
set -euo pipefail
cd "$(dirname "$0")/.."
condyle=build/release/condyle
out=out/demo

"$condyle" sample hip --scenario 2 --out "$out/sample"
echo
while IFS='|' read -r name pose; do
  "$condyle" depth "$out/sample/hip.toml" --pose "$pose" --out "$out/$name"
done <<'POSES'
neutral|
sitting|flexion=90
deep_flexion|flexion=140
flexion_adduction_internal_rotation|flexion=110 adduction=15 internal_rotation=35
extension_external_rotation|extension=25 external_rotation=50
abduction|abduction=65
POSES

echo
echo "The same deep pose by the tangential method, about the flexion axis:"
"$condyle" depth "$out/sample/hip.toml" --pose "flexion=140" --method tangential --out "$out/deep_flexion_tangential"

echo
echo "How far it turns in each clinical direction:"
"$condyle" rom "$out/sample/hip.toml" --out "$out/range_of_motion"

# Drawn where the Python module was built, as make test does, and matplotlib is there.
draw() { PYTHONPATH=build/release/python /usr/bin/python3 "$@"; }
if draw -c 'import condyle.plot' 2>/dev/null; then
  echo
  draw -m condyle.plot "$out/range_of_motion"
fi

echo
echo "Results are in $out, a folder for each pose: fixed.vtp and mobile.vtp (open them in ParaView or 3D Slicer),"
echo "pairs.csv and depth.json. Limits and their figures are in $out/range_of_motion. The joint itself is"
echo "$out/sample/hip.toml."
echo "The bones of the sample hip only: soft tissue is not modelled. Research software, not a medical device."

"$condyle" report "$out/sample/hip.toml" --band=40 --map flexion=0:120:10 adduction=-30:20:10 \
  --out "$out/report.html"
echo
echo "Open $out/report.html in a browser: the joint, its range of motion, and the same computations live."
