#!/usr/bin/env bash
# The static command (make static) asks for no library and no interpreter, and its commands give the bytes of the shared build from
# within an empty folder as root directory, where there is it and its input and nothing else.
# Usage: static_command.sh STATIC_COMMAND SHARED_COMMAND WORK_FOLDER
set -euo pipefail
static=$1 shared=$2 work=$3
fail() { echo "$*" >&2; exit 1; }
if [ ! -x "$static" ]; then
  echo "******** SKIPPED: no static command was built: make static ********" >&2
  exit 77
fi
headers=$(readelf -Wldh "$static")
grep -qE 'INTERP|NEEDED' <<<"$headers" && fail "$static asks for other files: $(grep -E 'INTERP|NEEDED' <<<"$headers")"
grep -q 'Type: *DYN' <<<"$headers" || fail "$static lies at fixed addresses"
grep -qE 'GNU_STACK.* RW ' <<<"$headers" || fail "$static has a stack that runs"
needed=$(objdump -T "$static" 2>/dev/null | grep -o 'GLIBC_[0-9.]*' || true)
[ -z "$needed" ] || fail "$static needs $needed"
if ! unshare -r chroot / true 2>/dev/null; then
  echo "******** SKIPPED: no root directory may be changed here (unshare -r chroot) ********" >&2
  exit 77
fi

rm -rf "$work"
mkdir -p "$work/static" "$work/shared"
cp "$static" "$work/static/condyle"
in_static() { unshare -r chroot "$work/static" /condyle "$@"; }
in_shared() { (cd "$work/shared" && "$shared" "$@"); }
unshare -r chroot "$work/static" /bin/true 2>/dev/null && fail "the root directory has more than the command"

number=0
while IFS= read -r line; do
  eval "words=($line)"
  number=$((number + 1))
  for build in static shared; do
    code=0
    # Progress on standard error is as quick as the machine.
    "in_$build" "${words[@]}" >"$work/$build/out_$number.txt" 2>"$work/$build.txt" || code=$?
    [ $code = 0 ] || fail "$build: condyle $line: exit code $code: $(cat "$work/$build.txt")"
  done
done <<'COMMANDS'
sample hip --scenario 1 --voxel 2 --out sample
rom sample/hip.toml --band=20 --out rom
rom sample/hip.toml --map flexion=0:120:20 adduction=-30:20:10 --threads 1 --json
measure sample/hip.toml --out measure
resect sample/hip.toml --reach "internal_rotation_at_90_flexion=+3" --out resect
picture sample/hip.toml --pose "flexion=100" --out picture.png
report sample/hip.toml --out report.html
sample cohort --n 4 --seed 1 --out cohort
study cohort/cohort.csv --out study
init sample/labels.nii.gz --task total --fixed hip_right --mobile femur_right -o init/hip.toml
depth init/hip.toml --pose "flexion=90" --out depth
COMMANDS
rm "$work/static/condyle"
[ -s "$work/static/study/study.h5" ] || fail "no study.h5"
[ "$(find "$work/static" -type f | wc -l)" -gt 40 ] || fail "the commands wrote few files"
diff -r "$work/static" "$work/shared" >"$work/differ.txt" || fail "other bytes: $(head -c 2000 "$work/differ.txt")"

# A bad file is refused in the words of the shared build: exceptions find their handlers.
printf 'no joint\n' | tee "$work/shared/bad.toml" >"$work/static/bad.toml"
cp "$static" "$work/static/condyle"
for build in static shared; do
  code=0
  "in_$build" depth bad.toml 2>"$work/$build.txt" || code=$?
  [ $code = 3 ] || fail "$build: a bad file ends with exit code $code"
done
cmp "$work/static.txt" "$work/shared.txt"
echo "$number commands: the same bytes"
