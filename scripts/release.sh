#!/usr/bin/env bash
# Makes a release from the commit that is checked out, in out/release: the sources, Debian packages, a wheel, the static command, its
# container image, the npm package, the template of reports, a list of materials of each (SPDX), notes and checksums. Everything is built
# from the unpacked sources, and run; what is left to a person is said last. The tree must be clean, and make test-all has to have passed on it.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "release: $*" >&2; exit 1; }
[ -z "$(git status --porcelain)" ] || fail "the tree is not clean: commit or remove what git status names"
commit=$(git rev-parse HEAD)
[ "$(cat build/tested 2>/dev/null)" = "$commit" ] || fail "make test-all has not passed on this commit"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
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
scripts/make_sbom.py build/release "$out/$name-wheel.spdx.json" "$(cd build/release && echo python/condyle/_native*.so)"
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

# What needs nothing of this machine: one file for every Linux, an image of it, a package for node.
cd "$work/$name"
{ make static image && make npm; } >"$work/alone.txt" 2>&1 || fail "$(tail "$work/alone.txt")"
cp build/static/condyle "$out/$name-linux-x86_64"
cp out/image/*.tar out/npm/*.tgz "$out/"
scripts/make_sbom.py build/static "$out/$name-linux-x86_64.spdx.json" condyle
scripts/make_sbom.py build/npm "$out/$name-npm.spdx.json" condyle.js
"$out/$name-linux-x86_64" --version | grep -qF "$version" || fail "the static command is of another version"
mkdir "$work/node"
(cd "$work/node" && npm install --silent --no-audit --no-fund "$out/$name.tgz" && npx --no-install condyle --version) | grep -qF "$version" ||
  fail "the npm package is of another version"

# The notes are the version's part of the changelog.
sed -n "/^## \[\?$version/,/^## \[\?[0-9]/p" CHANGELOG.md | sed '$d' >"$out/$name-notes.md"
(cd "$out" && sha256sum -- * >SHA256SUMS && cat SHA256SUMS)
cat <<END
release: $name is in out/release. What is left to a person:
  git tag -s v$version $commit && git push origin v$version
  an address in SECURITY.md and names in CITATION.cff, if they are to be there
  the files of out/release beside the tag, with $name-notes.md as its text
  npm publish $name.tgz: until then the name condyle is free there, and whoever takes it gets our users' shells
  packaging/README.md: the checksum of $name.tar.gz into the recipes
END
