#!/usr/bin/env bash
# The command for Windows (make windows), run by Wine, gives the bytes of the native one: answers, files, messages and exit codes; with
# lines that end as on Windows, names in any script, results that are replaced, and an interruption.
# Usage: same_bytes.sh WINDOWS_COMMAND NATIVE_COMMAND WORK_FOLDER
set -euo pipefail
windows=$1 native=$2 work=$3
# shellcheck source=wine.sh
. "$(dirname "$0")/wine.sh" "$work" "$windows"
imported=$(x86_64-w64-mingw32-objdump -p "$windows" | sed -n 's/.*DLL Name: //p' | tr '[:upper:]' '[:lower:]' | sort)
# Those that every Windows has.
[ -z "$(comm -23 <(echo "$imported") <(printf '%s\n' kernel32.dll msvcrt.dll shell32.dll user32.dll))" ] ||
  fail "$windows asks for other files: $imported"

rm -rf "$work/windows" "$work/native" "$work/cohort"
mkdir -p "$work/windows" "$work/native"
windows=$(realpath "$windows")
native=$(realpath "$native")
work=$(realpath "$work")
in_windows() { (cd "$work/windows" && wine "$windows" "$@" </dev/null); }
in_native() { (cd "$work/native" && "$native" "$@" </dev/null); }
in_both() { (cd "$work/native" && "$@") && (cd "$work/windows" && "$@"); }

number=0
# One command line by both builds: the exit code, and what each says, without what only a terminal or a slow machine sees.
both() {
  local code=$1 build got
  shift
  number=$((number + 1))
  for build in windows native; do
    got=0
    "in_$build" "$@" >"$work/$build/out_$number.txt" 2>"$work/$build/all_errors.txt" || got=$?
    [ "$got" = "$code" ] || fail "$build: condyle $*: exit code $got and not $code: $(cat "$work/$build/all_errors.txt")"
    grep -vE '^[a-z ]+: [0-9]+ of [0-9]+ \(' "$work/$build/all_errors.txt" >"$work/$build/errors_$number.txt" || true
    rm "$work/$build/all_errors.txt"
  done
}

# The words of a line are those of a shell.
while IFS= read -r line; do
  eval "words=($line)"
  both 0 "${words[@]}"
done <<'COMMANDS'
--version
help rom
sample hip --scenario 1 --voxel 2 --out sample
rom sample/hip.toml
rom sample/hip.toml --json --band=20
rom sample/hip.toml --band=20 --out rom
rom sample/hip.toml --map flexion=0:120:20 adduction=-30:20:10 --threads 1 --json
measure sample/hip.toml --json
measure sample/hip.toml --out measure
depth sample/hip.toml --pose "flexion=100 internal_rotation=30" --json
depth sample/hip.toml --pose "flexion=100 internal_rotation=30" --out depth
resect sample/hip.toml --reach "internal_rotation_at_90_flexion=+3" --out resect
picture sample/hip.toml --pose "flexion=100" --out picture.png
report sample/hip.toml --out report.html
sample cohort --n 4 --seed 1 --out cohort
study cohort/cohort.csv --out study
init sample/labels.nii.gz --task total --fixed hip_right --mobile femur_right -o init/hip.toml
depth init/hip.toml --pose "flexion=90" --out init_depth
rom sample/hip.toml --write-limits limits.csv
frame sample/hip.toml
inspect sample/femur.ply --json
COMMANDS
both 2 rom
both 2 rom sample/hip.toml --nothing
both 3 rom nothing.toml
both 3 rom sample
both 3 inspect sample/hip.toml

# Names with blanks, umlauts and letters outside Latin, in what is read, written and said.
both 0 sample hip --out "Hüfte eins/тазобедренный 股関節"
both 0 rom "Hüfte eins/тазобедренный 股関節/hip.toml" --out "Hüfte eins/Ω→∞"
in_both mv "Hüfte eins/тазобедренный 股関節/femur.ply" "Hüfte eins/тазобедренный 股関節/大腿骨 ü.ply"
in_both sed -i 's/femur\.ply/大腿骨 ü.ply/' "Hüfte eins/тазобедренный 股関節/hip.toml"
both 0 depth "Hüfte eins/тазобедренный 股関節/hip.toml" --pose flexion=100 --json
both 3 rom "Hüfte eins/ничего.toml"

# Lines that end by two characters, in joint files, meshes of text and tables.
cat >"$work/native/cube.obj" <<'OBJ'
v 0 0 0
v 10 0 0
v 10 10 0
v 0 10 0
v 0 0 10
v 10 0 10
v 10 10 10
v 0 10 10
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
cat >"$work/native/tetrahedron.stl" <<'STL'
solid tetrahedron
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 9 0
vertex 9 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 9 0 0
vertex 0 0 9
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 9
vertex 0 9 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 9 0 0
vertex 0 9 0
vertex 0 0 9
endloop
endfacet
endsolid tetrahedron
STL
printf 'time,flexion_deg\n0,0\n0.5,15\n1,30\n' >"$work/native/walk.csv"
cp "$work/native/"{cube.obj,tetrahedron.stl,walk.csv} "$work/windows/"
both 0 inspect cube.obj --polygons split
both 0 inspect tetrahedron.stl --json
both 0 motion sample/hip.toml --motion walk.csv --json
in_both sed -i 's/$/\r/' cube.obj tetrahedron.stl walk.csv sample/hip.toml cohort/cohort.csv
both 0 inspect cube.obj --polygons split
both 0 inspect tetrahedron.stl --json
both 0 motion sample/hip.toml --motion walk.csv --json
both 0 rom sample/hip.toml
both 0 study cohort/cohort.csv --out study_crlf
cmp "$work/windows/study/limits.csv" "$work/windows/study_crlf/limits.csv"

# Results take the place of those of an earlier run, and what is read is never replaced: by another name of it neither.
both 0 rom sample/hip.toml --out rom
both 0 picture sample/hip.toml --out picture.png
both 3 picture sample/hip.toml --out sample/hip.toml
in_both ln sample/hip.toml other_name.png
both 3 picture sample/hip.toml --out other_name.png
both 0 depth sample/hip.toml --pose flexion=100 --out "Hüfte eins/Ω→∞"

# The command for Windows has no HDF5, so that a study has one file less, in its record too.
[ -s "$work/native/study/study.h5" ] || fail "no study.h5 of the native command"
rm "$work/native/"{study,study_crlf}/study.h5
perl -0pi -e 's/,\n *"study\.h5": \{[^}]*\}//' "$work/native/"{study,study_crlf}/study.json
sed -i 's|, study[a-z_]*/study\.h5||' "$work/native/"errors_*.txt
[ "$(find "$work/windows" -type f | wc -l)" -gt 100 ] || fail "the commands wrote few files"
diff -r "$work/native" "$work/windows" >"$work/differ.txt" || fail "other bytes: $(head -c 3000 "$work/differ.txt")"
code=0
in_windows motion sample/hip.toml --motion walk.csv --jam --out jam 2>"$work/jam.txt" || code=$?
[ $code = 3 ] && grep -q 'has no HDF5' "$work/jam.txt" || fail "--jam: exit code $code: $(cat "$work/jam.txt")"

# Ctrl-C ends long work with 130, one line and nothing half-written.
cd "$work/windows"
wine "$windows" rom sample/hip.toml --map flexion=0:120:0.1 adduction=-30:20:0.1 --out interrupted </dev/null >/dev/null 2>"$work/interrupted.txt" &
sleep 5
kill -INT $!
code=0
wait $! || code=$?
[ $code = 130 ] || fail "interrupted: exit code $code: $(cat "$work/interrupted.txt")"
grep -q '^condyle: interrupted' "$work/interrupted.txt" || fail "interrupted: $(cat "$work/interrupted.txt")"
[ ! -e interrupted ] || fail "interrupted: $(find interrupted)"
left=$(find "$work" -name '.condyle-*' -o -name '*.tmp' -not -path '*/prefix/*')
[ -z "$left" ] || fail "left behind: $left"
echo "$number commands: the same bytes"
