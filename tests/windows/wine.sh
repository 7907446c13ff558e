# Sourced by the tests of what was compiled for Windows: runs it by Wine, in a prefix of its own. Skips where either is missing.
#   wine.sh WORK_FOLDER PROGRAM
fail() { echo "$*" >&2; exit 1; }
skip() { echo "******** SKIPPED: $* ********" >&2; exit 77; }
[ -x "$2" ] || skip "$(basename "$2") was not built: make windows"
command -v wine >/dev/null && command -v wineserver >/dev/null || skip "Wine is not installed: scripts/install_dependencies.sh windows"
mkdir -p "$1"
export WINEPREFIX=${WINEPREFIX:-$(realpath "$1")/prefix} WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=" LC_ALL=C.UTF-8
unset DISPLAY WAYLAND_DISPLAY
wine cmd /c exit 0 >/dev/null 2>&1 </dev/null || skip "Wine does not start here"
trap 'wineserver -k 2>/dev/null || true' EXIT
