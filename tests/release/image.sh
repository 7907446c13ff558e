#!/usr/bin/env bash
# The image of the static command (make image) is what its format asks for, and small; unpacked and entered as its configuration says,
# it starts at once and a study in it gives the bytes of one outside. umoci unpacks it, if it is there, and tar does.
# Usage: image.sh FOLDER_OF_IMAGE SHARED_COMMAND WORK_FOLDER
set -euo pipefail
folder=$1 shared=$2 work=$3
fail() { echo "$*" >&2; exit 1; }
version=$("$shared" --version | cut -d' ' -f2)
image=$folder/condyle-$version.oci.tar
if [ ! -f "$image" ]; then
  echo "******** SKIPPED: no image was made: make image ********" >&2
  exit 77
fi
[ "$(stat -c %s "$image")" -lt 12000000 ] || fail "$image has $(stat -c %s "$image") bytes: 12 MB at most"
rm -rf "$work"
mkdir -p "$work/image" "$work/root" "$work/shared"
tar -C "$work/image" -xf "$image"
(cd "$work/image/blobs/sha256" && for blob in *; do echo "$blob  $blob"; done | sha256sum --check --quiet)
# Prints the value at a path of keys, of JSON.
value() { /usr/bin/python3 -c 'import functools, json, sys
value = json.load(open(sys.argv[1]))
for key in sys.argv[2:]: value = value[int(key) if isinstance(value, list) else key]
print(*value if isinstance(value, list) else [value], sep="\n")' "$@"; }
blob() { echo "$work/image/blobs/sha256/${1#sha256:}"; }
[ "$(value "$work/image/oci-layout" imageLayoutVersion)" = 1.0.0 ] || fail "no layout of OCI"
manifest=$(blob "$(value "$work/image/index.json" manifests 0 digest)")
[ "$(value "$work/image/index.json" manifests 0 size)" = "$(stat -c %s "$manifest")" ] || fail "the index gives another size"
config=$(blob "$(value "$manifest" config digest)")
layer=$(blob "$(value "$manifest" layers 0 digest)")
[ "$(value "$manifest" layers 0 size)" = "$(stat -c %s "$layer")" ] || fail "the manifest gives another size"
[ "$(value "$config" rootfs diff_ids 0)" = "sha256:$(gzip -dc "$layer" | sha256sum | cut -d' ' -f1)" ] || fail "the layer is another one"
for where in "$manifest annotations" "$config config Labels"; do
  # shellcheck disable=SC2086
  [ "$(value $where org.opencontainers.image.version)" = "$version" ] || fail "$where: another version"
done
entry=$(value "$config" config Entrypoint)
tar -C "$work/root" -xzf "$layer"
for licence in LICENSE NOTICE libhdf5-dev.copyright libaec-dev.copyright libc6-dev.copyright common-licenses/LGPL-2.1; do
  [ -s "$work/root/usr/share/doc/condyle/$licence" ] || fail "the image has no $licence"
done
if command -v umoci >/dev/null; then
  umoci unpack --rootless --image "$work/image:$version" "$work/bundle"
  diff -r "$work/bundle/rootfs" "$work/root" || fail "umoci finds another tree"
fi
if ! unshare -r chroot / true 2>/dev/null; then
  echo "******** SKIPPED: no root directory may be changed here (unshare -r chroot) ********" >&2
  exit 77
fi

least=1000000
for _ in 1 2 3 4 5 6 7 8 9 10; do
  before=$(date +%s%N)
  unshare -r chroot "$work/root" "$entry" --version >"$work/version.txt"
  took=$((($(date +%s%N) - before) / 1000))
  [ "$took" -ge "$least" ] || least=$took
done
grep -qF "$version" "$work/version.txt" || fail "the command in the image is of another version"
[ "$least" -lt 50000 ] || fail "it starts in $least microseconds at best: 50 ms at most"
(cd "$work/shared" && "$shared" sample cohort --n 12 --seed 1 --out data/cohort && "$shared" study data/cohort/cohort.csv --out data/study) >/dev/null
mkdir -p "$work/root/data"
cp -r "$work/shared/data/cohort" "$work/root/data/cohort"
unshare -r chroot "$work/root" "$entry" study data/cohort/cohort.csv --out data/study >"$work/study.txt"
[ "$(cat "$work/study.txt")" = "12 answered, 0 failed" ] || fail "$(cat "$work/study.txt")"
diff -r "$work/shared/data" "$work/root/data" || fail "other bytes in the image"
echo "$(stat -c %s "$image") bytes; starts in $((least / 1000)).$((least % 1000 / 100)) ms; a study of 12: the same bytes"
