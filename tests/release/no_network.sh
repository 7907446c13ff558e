#!/usr/bin/env bash
# Nothing opens the network: the command imports nothing that could, and its commands give the same bytes where there is no
# network at all, not even the machine's own. Usage: no_network.sh CONDYLE_BINARY WORK_FOLDER
set -euo pipefail
condyle=$1 work=$2
fail() { echo "$*" >&2; exit 1; }
if nm -D --undefined-only "$condyle" | grep -wE 'socket|connect|bind|getaddrinfo|gethostbyname|curl_[a-z_]+'; then
  fail "$condyle imports these"
fi
if ! unshare -rn true 2>/dev/null; then
  echo "******** SKIPPED: no network namespace may be made here (unshare -rn) ********" >&2
  exit 77
fi
[ "$(unshare -rn cat /proc/net/dev | grep -c :)" = 1 ] || fail "unshare -rn leaves a network"
if unshare -rn bash -c 'exec 3<>/dev/tcp/127.0.0.1/9' 2>/dev/null; then fail "unshare -rn leaves this machine"; fi

rm -rf "$work"
mkdir -p "$work/with" "$work/without"
commands() {
  "$condyle" sample hip --out sample
  "$condyle" inspect sample/*.ply
  "$condyle" depth sample/hip.toml --pose "flexion=130"
  "$condyle" rom sample/hip.toml --out rom
  "$condyle" report sample/hip.toml --out report.html
}
export -f commands
export condyle
(cd "$work/with" && commands >said.txt)
(cd "$work/without" && unshare -rn bash -euo pipefail -c commands >said.txt)
diff -r "$work/with" "$work/without" || fail "another answer without a network"
