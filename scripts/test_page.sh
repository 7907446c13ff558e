#!/usr/bin/env bash
# Makes reports of joints and opens them in a real browser, from disk and without a network: tests/viewer/*.test.mjs. Pictures of
# what was seen are in build/page/seen.
set -euo pipefail
cd "$(dirname "$0")/.."
condyle=$PWD/build/release/condyle
data=${CONDYLE_DATA:-$PWD/../shared/data}
out=build/page
mkdir -p "$out/seen"

"$condyle" sample hip --out "$out/sample" >/dev/null
"$condyle" report "$out/sample/hip.toml" --band=20 --map flexion=0:120:20 adduction=-30:20:10 --out "$out/sample.html"
"$condyle" sample hip --scenario 3 --out "$out/scenario_3" >/dev/null
"$condyle" report "$out/scenario_3/hip.toml" --out "$out/scenario_3.html"
real_hip() {
  rm -f "$out/$1.toml"
  "$condyle" init "$data/$2/hip_bone.ply" "$data/$2/femur.ply" --out "$out/$1.toml" 2>/dev/null
  "$condyle" report "$out/$1.toml" --out "$out/$1.html"
}
if [ -d "$data/hip_vhf_right" ]; then
  real_hip vhf_right hip_vhf_right
  real_hip libhip_left hip_libhip_m1_left
  {
    cat "$out/vhf_right.toml"
    printf '[recorded_motion]\nflexion = "hip_flexion_r"\nadduction = "hip_adduction_r"\ninternal_rotation = "hip_rotation_r"\n'
  } >"$out/walk.toml"
  "$condyle" report "$out/walk.toml" --motion "$data/motion_gait2354_walk/subject01_walk1_ik.mot" --out "$out/walk.html"
else
  echo "real hips are skipped: $data/hip_vhf_right is not there" >&2
fi
node --test --test-concurrency=1 tests/viewer/*.test.mjs
