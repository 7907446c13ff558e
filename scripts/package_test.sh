#!/usr/bin/env bash
# Installs the packages of out/packages on a bare Debian 12 in a folder of its own, with what they ask for from Debian, and
# runs what they bring; the wheel of out/wheel on another, which has Python and numpy only. The bare system is kept in
# build/bare.tar for the next time. Needs root.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "$(id -u)" -ne 0 ]; then exec sudo "$0" "$@"; fi
work=$(mktemp -d)
trap 'umount "$work/root/proc" 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
root=$work/root

mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
if [ ! -e build/bare.tar ]; then
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.txt" ||
    { tail "$work/debootstrap.txt" >&2; exit 1; }
  tar -C "$root" -cf build/bare.tar .
fi
# A bare Debian in $root, in place of the last one.
bare() {
  umount "$root/proc" 2>/dev/null || true
  rm -rf --one-file-system "$root"
  mkdir "$root"
  tar -C "$root" -xf build/bare.tar
  # How this machine reaches the mirror.
  cp -a /etc/apt/apt.conf.d "$root/etc/apt/"
  cp /etc/resolv.conf "$root/etc/"
  mkdir "$root/packages"
  mount -t proc proc "$root/proc" 2>/dev/null || true
  inside apt-get update -qq
}

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive \
  ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"; }
install() { inside apt-get install -y -qq --no-install-recommends "$@" >"$work/apt.txt" 2>&1 ||
  { tail -20 "$work/apt.txt" >&2; exit 1; }; }

bare
cp out/packages/*.deb "$root/packages/"
install "/$(cd "$root" && ls ./packages/condyle_*.deb)" "/$(cd "$root" && ls ./packages/condyle-doc_*.deb)"
inside condyle --version
inside condyle sample hip --out /tmp/sample >/dev/null
inside condyle depth /tmp/sample/hip.toml --pose "flexion=130" | head -3
install "/$(cd "$root" && ls ./packages/python3-condyle_*.deb)"
inside python3 -c "import condyle; print(condyle.read_joint('/tmp/sample/hip.toml'))"
test -e "$root/usr/share/doc/condyle-doc/api/index.html"

bare
cp out/packages/libcondyle*.deb examples/c/needle.c "$root/packages/"
install gcc libc6-dev pkg-config "/$(cd "$root" && ls ./packages/libcondyle1_*.deb)" "/$(cd "$root" && ls ./packages/libcondyle-dev_*.deb)"
# shellcheck disable=SC2016
inside sh -c 'gcc -std=c99 /packages/needle.c $(pkg-config --cflags --libs condyle-c) -o /tmp/needle && /tmp/needle'

bare
cp out/wheel/*.whl tests/release/wheel_answers.py README.md "$root/packages/"
install python3-venv python3-numpy
inside python3 -m venv --system-site-packages /tmp/environment
inside /tmp/environment/bin/pip install --quiet --no-index "/$(cd "$root" && ls ./packages/*.whl)"
inside /tmp/environment/bin/python /packages/wheel_answers.py /packages/README.md /tmp/limits.pdf \
  2> >(grep -v '^loaded ' >&2)
