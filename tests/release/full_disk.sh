#!/usr/bin/env bash
# On a disk that fills up, at any moment: exit code 3 and one line, the earlier result whole and nothing beside it; with room
# again the bytes of a run that was never disturbed. The disk is a small tmpfs. Usage: full_disk.sh CONDYLE_BINARY WORK_FOLDER
# [FILLS of each command]
set -euo pipefail
if [ "${4:-}" != mounted ]; then
  if ! unshare -rm true 2>/dev/null || ! unshare -rm mount -t tmpfs none /mnt 2>/dev/null; then
    echo "******** SKIPPED: no disk may be mounted here (unshare -rm) ********" >&2
    exit 77
  fi
  exec unshare -rm "$0" "$1" "$2" "${3:-6}" mounted
fi
condyle=$1 work=$2 fills=$3
fail() { echo "$*" >&2; exit 1; }
rm -rf "$work"
mkdir -p "$work/disk" "$work/room"
cd "$work"
"$condyle" sample hip --out sample 2>/dev/null >&2
printf 'time,flexion_deg\n0,0\n0.5,40\n1,80\n' >squat.csv
printf 'id,joint\na,sample/hip.toml\nb,nothere.toml\n' >hips.csv

# Existing files and files to be written, into the folder $out.
before() { case $1 in
  rom) "$condyle" rom sample/hip.toml --motion flexion --out "$out" ;;
  report) "$condyle" report sample/hip.toml --title earlier --out "$out/page.html" ;;
  motion) "$condyle" motion sample/hip.toml --motion squat.csv --casting fixed --out "$out" ;;
  study) "$condyle" study hips.csv --motion extension --out "$out" ;;
  sample) "$condyle" sample hip --out "$out" ;;
  hip) ;; # its folder has to be empty
esac; }
after() { case $1 in
  rom) "$condyle" rom sample/hip.toml --out "$out" ;;
  report) "$condyle" report sample/hip.toml --out "$out/page.html" ;;
  motion) "$condyle" motion sample/hip.toml --motion squat.csv --out "$out" ;;
  study) "$condyle" study hips.csv --motion flexion --out "$out" ;;
  sample) "$condyle" sample hip --scenario 3 --out "$out" ;;
  hip) "$condyle" hip sample/hip_bone.ply sample/femur.ply --samples 0 --out "$out" ;;
esac; }

full=0
for command in rom report motion study sample hip; do
  rm -rf room/*
  out=room/result
  mkdir -p "$out"
  before "$command" >/dev/null 2>&1
  cp -r "$out" room/before
  after "$command" >/dev/null 2>&1
  needs=$(du -s --block-size=4096 --apparent-size "$out" | cut -f1)
  for ((i = 0; i < fills; ++i)); do
    mount -t tmpfs -o size=64m none disk
    out=disk/result
    cp -r room/before "$out"
    # The rest of the disk but for a share of what is to be written.
    free=$(df --block-size=4096 --output=avail disk | tail -n 1)
    head -c $(((free - needs * i / (fills + 1)) * 4096)) /dev/zero >disk/filler
    code=0
    after "$command" >/dev/null 2>said.txt || code=$?
    [ "$code" = 3 ] || fail "$command, fill $i: exit code $code: $(cat said.txt)"
    [ "$(grep -c 'No space left on device$' said.txt)" = 1 ] || fail "$command, fill $i: $(cat said.txt)"
    diff -r -x .condyle-rows room/before "$out" || fail "$command, fill $i: the earlier result is another"
    [ "$(ls -A disk | sort | xargs)" = "filler result" ] || fail "$command, fill $i: left $(ls -A disk)"
    rm disk/filler
    after "$command" >/dev/null 2>&1
    # Files of hip name its folder, packed in some.
    packed=()
    [ "$command" != hip ] || { packed=(-x '*.html' -x '*.vtp') && find "$out" -type f -exec sed -i 's#disk/result#room/result#g' {} +; }
    diff -r -x .condyle-rows "${packed[@]}" room/result "$out" || fail "$command, fill $i: other bytes after the disk was full"
    umount disk
    full=$((full + 1))
  done
done
echo "$full of $full full disks: nothing lost"
