#!/usr/bin/env bash
# Makes the reports that the page is tried with, in build/page, and prints the SHA-256 of what they hold: their data, without where it came from.
set -euo pipefail
cd "$(dirname "$0")/.."
condyle=$PWD/build/release/condyle
data=${CONDYLE_DATA:-$PWD/../shared/data}
out=build/page
rm -f "$out"/*.html
mkdir -p "$out/seen"

"$condyle" sample hip --out "$out/sample" >/dev/null
"$condyle" report "$out/sample/hip.toml" --band=20 --map flexion=0:120:10 adduction=-30:20:10 --out "$out/sample.html"
# Turned about a point beside the head's centre, head and socket touch before the rim does.
sed 's/^centre = .*/centre = [-2, -2, 0]/' "$out/sample/hip.toml" >"$out/sample/shifted.toml"
"$condyle" report "$out/sample/shifted.toml" --out "$out/shifted.html"
"$condyle" report "$out/sample/shifted.toml" --bearing count --out "$out/counted.html"
sed 's/^kind = .*/kind = "free"\njoint = "hip"/' "$out/sample/hip.toml" >"$out/sample/free.toml"
"$condyle" report "$out/sample/free.toml" --map x=-1:1:0.5 flexion=0:90:30 adduction=5 --vary y --out "$out/translated.html"
"$condyle" report "$out/sample/hip.toml" --past 5 --out "$out/zones.html"
"$condyle" report "$out/sample/hip.toml" --measures --band=20 --resect "fadir=50 flexion=138" --curve 4 --out "$out/plan.html"
"$condyle" sample hip --alpha-angle 70 --out "$out/cam" >/dev/null
"$condyle" report "$out/cam/hip.toml" "$out/sample/hip.toml" --band=20 --map flexion=0:120:10 adduction=-30:20:10 \
  --out "$out/compared.html"
printf '[[part]]\nname = "pelvis"\nbody = "fixed"\n[[part.parameter]]\nname = "tilt"\nrange = [-20, 20]\nsigma = 3\n' | cat "$out/sample/hip.toml" - >"$out/sample/tilts.toml"
"$condyle" report "$out/sample/tilts.toml" --set pelvis.tilt=10 --band=20 --out "$out/tilted.html"
parameter() { printf '[[part.parameter]]\nname = "%s"\nkind = "%s"\nrange = [%s]\n%s\n' "$@"; }
{
  cat "$out/sample/hip.toml"
  printf '[[part]]\nname = "pelvis"\nbody = "fixed"\ncentre = [3, 40, -5]\n'
  for kind in frontal tilt version; do parameter $kind $kind '-20, 20' ''; done
  parameter size size '0.9, 1.1' ''
  parameter lateral translation '-5, 5' 'along = "lateral"'
  printf '[[part]]\nname = "femur"\nbody = "mobile"\n'
  for kind in version frontal; do parameter $kind $kind '-30, 30' 'sigma = 2'; done
} >"$out/sample/turned.toml"
"$condyle" report "$out/sample/turned.toml" --out "$out/turned.html"
"$condyle" implant "$out/sample/hip.toml" --facets 72 --out "$out/placed" >/dev/null
"$condyle" report "$out/placed/hip.toml" --out "$out/placed.html"
printf 'name,motion,reach_deg\nsitting,flexion,125\npivoting,external_rotation,50\nturning,internal_rotation_at_90_flexion,35\n' >"$out/targets.csv"
"$condyle" report "$out/placed/hip.toml" --sweep "cup.inclination=30:60:5 cup.anteversion=-5:35:5" --targets "$out/targets.csv" --out "$out/swept.html"
"$condyle" report "$out/sample/tilts.toml" --set pelvis.tilt=10 --sweep "pelvis.tilt=-20:20:4" --targets "$out/targets.csv" --out "$out/swept_tilt.html"
printf '[recorded_motion]\n%s = { column = "flexion", unit = "deg" }\n%s = { column = "adduction", unit = "deg" }\n%s = { column = "rotation", unit = "deg" }\n' flexion adduction internal_rotation | cat "$out/sample/hip.toml" - >"$out/sample/moves.toml"
printf 'time,flexion,adduction,rotation\n0,0,0,0\n0.1,20,5,0\n0.2,40,5,10\n' >"$out/sample/moves.csv"
"$condyle" report "$out/sample/moves.toml" --motion "$out/sample/moves.csv" --out "$out/moves.html"
"$condyle" sample cartilages --scenario 5 --out "$out/cartilages" >/dev/null
sed -e 's|^mesh = "femur.ply"|meshes = [{ name = "bone", mesh = "femur.ply" }, { name = "cartilage", mesh = "../cartilages/femoral_cartilage.ply", bearing = true }]|' \
  "$out/sample/hip.toml" >"$out/sample/parts.toml"
"$condyle" report "$out/sample/parts.toml" --out "$out/parts.html"
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
knee=$data/knee_lenhart2015_right
if [ -d "$knee" ]; then
  CONDYLE_DATA=$data "$condyle" report tests/support/knee_by_hand/tibiofemoral.toml --load --accept-reference-contact \
    --motion "$knee/passive_flexion_states.sto" --out "$out/knee.html"
  # Its bones, which are closed.
  sed -e '/^\[contact\]/,$d' -e 's/femur_cartilage/femur_bone/; s/tibia_cartilage/tibia_bone/; s/femoral cartilage/femur/; s/tibial cartilage/tibia/' \
    tests/support/knee_by_hand/tibiofemoral.toml >"$out/knee_bones.toml"
  CONDYLE_DATA=$data "$condyle" report "$out/knee_bones.toml" --out "$out/knee_bones.html"
else
  echo "the knee is skipped: $knee is not there" >&2
fi
scripts/digest_of_reports.py "$out"/*.html
