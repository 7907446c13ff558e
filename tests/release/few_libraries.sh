#!/usr/bin/env bash
# The command and the Python module load few libraries, and none that reaches the network or draws: a program that is run for
# every joint of a study starts often. Highway's measures its clock for 3 ms when it is loaded. They ask for no C library newer than 2.34. Usage: few_libraries.sh HDF5_INSIDE COMMAND [MODULE]
set -euo pipefail
inside=$1
shift
fail() { echo "$*" >&2; exit 1; }
if [ "$inside" != TRUE ]; then
  echo "******** SKIPPED: HDF5 is not linked in here, since no static one was found ********" >&2
  exit 77
fi
for program in "$@"; do
  loaded=$(ldd "$program" | awk '{ print $1 }')
  heavy=$(grep -E '^lib(hwy|hdf5|curl|ssl|crypto|vtk|gnutls|krb5)' <<<"$loaded" || true)
  [ -z "$heavy" ] || fail "$program loads $(xargs <<<"$heavy")"
  count=$(wc -l <<<"$loaded")
  [ "$count" -le 15 ] || fail "$program loads $count libraries: $(xargs <<<"$loaded")"
  # Clusters with a C library of 2021 can start it, as far as Debian 12 (glibc 2.36) can tell.
  newest=$(objdump -T "$program" | grep -o 'GLIBC_2\.[0-9]*' | sort -uV | tail -1)
  [[ $(getconf GNU_LIBC_VERSION) != *2.36 || ${newest#GLIBC_2.} -le 34 ]] || fail "$program needs $newest: 2.34 is the newest"
  # Another HDF5 of the same process (h5py's) and this one must not take each other's functions.
  if nm -D --defined-only "$program" | grep -E ' (H5|SZ_|aec_)[A-Za-z_]*$'; then fail "$program shows these to others"; fi
done
