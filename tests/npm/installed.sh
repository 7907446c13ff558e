#!/usr/bin/env bash
# Installs the npm package where nothing can be fetched, in a folder with blanks and umlauts, and runs it there as another user with another
# locale: exit codes, a report, a study, a file that cannot be written, and an interruption.
# Then the module: its examples, its types, and its answers against the command's, in node and in a browser.
# Usage: installed.sh CONDYLE PACKAGE.tgz
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
condyle=$(realpath "$1")
package=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "installed.sh: $*" >&2; exit 1; }

[ "$(stat -c %s "$package")" -lt 4000000 ] || fail "the package has $(stat -c %s "$package") bytes, and may have 4,000,000"
place="$folder/ein Ordner für Hüften"
mkdir "$place"
chmod 755 "$folder"
cp "$package" "$place/"
cd "$place"
npm install --offline --no-audit --no-fund --silent "./$(basename "$package")"
node -e '
  const { dependencies, scripts } = JSON.parse(require("fs").readFileSync("node_modules/condyle/package.json", "utf8"));
  if (dependencies || scripts) throw new Error("the package has dependencies or scripts");'
[ -z "$(find node_modules -mindepth 1 -maxdepth 1 ! -name condyle ! -name .bin ! -name .package-lock.json)" ] || fail "more than the package was installed"

run=(env LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 npx --offline --no-install condyle)
if [ "$(id -u)" -eq 0 ]; then
  chmod 777 .
  run=(setpriv --reuid nobody --regid nogroup --clear-groups env HOME="$place" LC_ALL=de_DE.UTF-8 npx --offline --no-install condyle)
fi
expect() {
  local code=$1 got=0
  shift
  "${run[@]}" "$@" >answer.txt 2>errors.txt || got=$?
  [ "$got" -eq "$code" ] || fail "condyle $*: exit code $got and not $code: $(cat errors.txt)"
}
expect 0 --version
# One with a cam too, whose place a fault of clang 14 changed (0033).
for cam in "" "--alpha-angle 70"; do
  rm -rf native
  # shellcheck disable=SC2086
  expect 0 sample hip $cam --out "Hüfte eins$cam"
  # shellcheck disable=SC2086
  "$condyle" sample hip $cam --out native >/dev/null
  diff -r native "Hüfte eins$cam" || fail "a sample${cam:+ with $cam} differs from the native command's"
done
processor_s() {
  local TIMEFORMAT="%U %S"
  { time "$@" >/dev/null 2>&1; } 2>&1 | awk '{ print $1 + $2 }'
}
# Compiled for size, whole samples took thirty times as long: no small step of theirs was inlined.
ours=$(processor_s "${run[@]}" sample hip --out again)
theirs=$(processor_s "$condyle" sample hip --out native_again)
awk "BEGIN { exit !($ours < 4 * $theirs) }" || fail "a sample takes $ours s of processor time, and $theirs natively"
# What is deflated has the bytes of zlib.
expect 0 picture "Hüfte eins/hip.toml" --measures --colour none --out shape.png
"$condyle" picture "Hüfte eins/hip.toml" --measures --colour none --out native.png >/dev/null 2>&1
cmp native.png shape.png || fail "a picture differs from the native command's"
for words in rom "rom --json --band" "measure --json" "measure --json --band=40"; do
  # shellcheck disable=SC2086
  expect 0 $words "Hüfte eins/hip.toml"
  # shellcheck disable=SC2086
  "$condyle" $words "Hüfte eins/hip.toml" 2>/dev/null | cmp - answer.txt || fail "$words differs from the native command's"
done
expect 0 report "Hüfte eins/hip.toml" --out Bericht.html
"$condyle" report "Hüfte eins/hip.toml" --out native.html 2>/dev/null
# The command line is part of a report.
cmp <(sed 's/native\.html/Bericht.html/' native.html | head -c 1000) <(head -c 1000 Bericht.html)
expect 2 rom
expect 3 rom nothing.toml
grep -q 'nothing.toml: no such file' errors.txt || fail "a file that is not there: $(cat errors.txt)"
[ "$(wc -l <errors.txt)" -eq 1 ] || fail "more than one line: $(cat errors.txt)"
printf 'solid\n' >broken.stl
expect 3 inspect broken.stl
echo "text" | "${run[@]}" rom /dev/stdin >/dev/null 2>errors.txt && fail "standard input is no joint" || true

# Names as Windows gives them, of a drive too.
windows() { node --require "$root/tests/npm/windows_names.cjs" node_modules/condyle/command.cjs "$@" >/dev/null 2>errors.txt || fail "on Windows $*: $(cat errors.txt)"; }
drive="Z:${PWD//\//\\}\\"
"$condyle" rom "Hüfte eins/hip.toml" --out native_rom >/dev/null 2>&1
windows rom 'Hüfte eins\hip.toml' --out 'windows\rom'
windows rom "${drive}Hüfte eins\\hip.toml" "--out=${drive}drive"
for out in windows/rom drive; do diff <(grep -v '^#' native_rom/limits.csv) <(grep -v '^#' "$out/limits.csv") || fail "limits in $out differ"; done

# Ctrl-C during long work ends it with 130, one line and nothing half-written.
setsid "${run[@]}" rom "Hüfte eins/hip.toml" --map flexion=0:120:1 adduction=-30:20:1 --out interrupted >answer.txt 2>errors.txt &
for _ in $(seq 60); do ! pgrep -s $! -x node >/dev/null || break; sleep 0.5; done
sleep 3
pkill -INT -s $! node || fail "the work was over before it could be interrupted"
code=0
wait $! || code=$?
[ "$code" -eq 130 ] || fail "interrupted: exit code $code: $(cat errors.txt)"
grep -q 'condyle: interrupted' errors.txt || fail "interrupted: $(cat errors.txt)"
[ ! -e interrupted ] || fail "interrupted: $(find interrupted)"
[ -z "$(find . -name '.condyle-*')" ] || fail "interrupted: $(find . -name '.condyle-*')"

cp "$root"/npm/examples/*.mjs .
node limits.mjs "Hüfte eins/hip.toml" >limits.txt
[ "$(wc -l <limits.txt)" -eq 13 ] || fail "limits.mjs: $(cat limits.txt)"
node depths.mjs "Hüfte eins/hip.toml" >depths.csv
[ "$(wc -l <depths.csv)" -eq 9 ] || fail "depths.mjs: $(cat depths.csv)"
"$condyle" rom "Hüfte eins/hip.toml" --json >rom.json
"$condyle" depth "Hüfte eins/hip.toml" --pose "flexion=90 internal_rotation=60" --json >depth.json
cat >same.mjs <<'MODULE'
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { depth, rangeOfMotion, readJoint } from "condyle";

const read = (name) => JSON.parse(readFileSync(name, "utf8"));
const joint = await readJoint("Hüfte eins/hip.toml");
const ends = (motions) => motions.map(({ name, reason, limit_deg }) => [name, reason, limit_deg]);
const same = (ours, theirs) => assert.deepEqual(ends(ours), ends(theirs));
same(rangeOfMotion(joint).motions, read("rom.json").motions);
const [ours, theirs] = [depth(joint, { flexion: 90, internal_rotation: 60 }).deepest.depth_mm, read("depth.json").reliable_depth.depth_mm];
assert.equal(ours, theirs);
const files = Object.fromEntries(["hip.toml", "hip_bone.ply", "femur.ply"].map((name) => [name, readFileSync(`Hüfte eins/${name}`)]));
same(rangeOfMotion(await readJoint(files)).motions, read("rom.json").motions);
await assert.rejects(readJoint("nothing.toml"), /nothing\.toml/);
delete files["femur.ply"];
await assert.rejects(readJoint(files), /femur\.ply/);
assert.throws(() => depth(joint, { flexoin: 3 }), RangeError);
MODULE
node same.mjs
cat >typed.ts <<'MODULE'
import { contact, depth, rangeOfMotion, readJoint, type Joint } from "condyle";

export async function ends(path: string): Promise<number[]> {
  const joint: Joint = await readJoint(path);
  const deepest: number | undefined = depth(joint, { flexion: 90 }).deepest?.depth_mm;
  const pairs: Uint32Array = contact(joint).pairs;
  return [deepest ?? 0, pairs.length, ...(rangeOfMotion(joint)?.motions ?? []).map(({ limit_deg }) => limit_deg)];
}
MODULE
(cd "$root/viewer" && npx --no-install tsc --ignoreConfig --noEmit --strict --skipLibCheck --target es2022 --lib es2022,dom --module esnext --moduleResolution bundler "$place/typed.ts")
node "$root/tests/npm/browser.mjs" . "Hüfte eins/hip.toml" >lists.txt
[ "$(wc -l <lists.txt)" -eq 24 ] || fail "browser.mjs: $(cat lists.txt)"
head -12 lists.txt | cmp - <(tail -12 lists.txt)
echo "installed.sh: passed"
