#!/usr/bin/env bash
# Makes a release from the commit that is checked out, in out/release: the sources, Debian packages, a wheel, the template of
# reports, the list of materials (SPDX) and checksums. Everything is built from the unpacked sources, and run. The tree must be
# clean.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "release: $*" >&2; exit 1; }
[ -z "$(git status --porcelain)" ] || fail "the tree is not clean: commit or remove what git status names"
version=$(sed -nE 's/.*std::string_view version = "(.*)";/\1/p' include/condyle/version.hpp)
name=condyle-$version
out=$PWD/out/release
rm -rf "$out"
mkdir -p "$out"
git archive --format=tar.gz --prefix="$name/" -o "$out/$name.tar.gz" HEAD

# Below the sources: a compiler cache with a base folder knows its files again.
work=$PWD/out/release-work
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT
tar -C "$work" -xf "$out/$name.tar.gz"
cd "$work/$name"
# Not the test programs: make test is for them.
cmake --preset release -DCONDYLE_TESTS=OFF -DCONDYLE_BENCH=OFF >"$work/configure.txt" || fail "$(tail "$work/configure.txt")"
cmake --build --preset release >"$work/build.txt" || fail "$(tail "$work/build.txt")"
cmake --build --preset release --target docs >"$work/docs.txt" 2>&1 || fail "$(tail "$work/docs.txt")"
cpack --config build/release/CPackConfig.cmake >"$work/package.txt" || fail "$(tail "$work/package.txt")"
scripts/make_sbom.py build/release "$out/$name.spdx.json"
cp out/packages/*.deb "$out/"
cp build/release/report_template.html "$out/$name-report_template.html"
python=$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' build/release/CMakeCache.txt)

# The packages' own files, run from a folder: their dependencies are those of this machine.
for package in "$out"/*.deb; do dpkg-deb -x "$package" "$work/installed"; done
export PATH=$work/installed/usr/bin:$PATH PYTHONPATH
PYTHONPATH=$(dirname "$(find "$work/installed" -type d -path '*-packages/condyle')")
cd "$work"
condyle --version | grep -qF "$version" || fail "the packaged command is of another version"
condyle sample hip --out sample >/dev/null
condyle depth sample/hip.toml --pose "flexion=130" >/dev/null
condyle report sample/hip.toml --out report.html >/dev/null
[ "$(wc -c <report.html)" -gt "$(wc -c <"$out/$name-report_template.html")" ] || fail "the report is not the template with data"
"$python" -c "import condyle; assert condyle.__version__ == '$version'; condyle.read_joint('sample/hip.toml')"
test -e installed/usr/share/doc/condyle-doc/api/index.html || fail "condyle-doc has no page"

"$name/scripts/wheel.sh" "$name/build/release" "$out" >"$work/wheel.txt" 2>&1 || fail "$(cat "$work/wheel.txt")"
(cd "$out" && sha256sum -- * >SHA256SUMS && cat SHA256SUMS)
