#!/usr/bin/env bash
# Installs every Debian package that Condyle builds and tests with. Quick when nothing is missing.
#   install_dependencies.sh command   for make demo: the command alone; before another group, that one without what tests need
#   install_dependencies.sh           for that and make test
#   install_dependencies.sh clang     and for make clang, make sanitize, make fuzz and make format
#   install_dependencies.sh bench     and for make bench; groups can be named together
#   install_dependencies.sh docs      and for make docs and make package
#   install_dependencies.sh node      and for make ro-crate
#   install_dependencies.sh emscripten   and for make npm
#   install_dependencies.sh page      and for make page-core, make page and make page-template
#   install_dependencies.sh package-test   and for make package-test
#   install_dependencies.sh wheel     for make wheel; with docs, for make release
#   install_dependencies.sh image     and for the test of make image, which unpacks it by umoci too
#   install_dependencies.sh finite-elements   and for make finite-elements
#   install_dependencies.sh snakemake and for the test of workflow/ without Slurm
#   install_dependencies.sh workflow  and for all of it
set -euo pipefail

packages=(
  g++ cmake make ninja-build pkg-config
  libeigen3-dev libtbb-dev libboost-dev libhwy-dev   # the core
  libhdf5-dev libaec-dev zlib1g-dev liblz4-dev libfmt-dev nlohmann-json3-dev   # condyle_io
  libcli11-dev libtomlplusplus-dev                   # the command line and the joint file
)
tests=(
  libgtest-dev librapidcheck-dev libcgal-dev         # CGAL is an oracle there, and a peer
  libvtk9-dev                                        # the reader of what is written, and a peer
  libfcl-dev libbullet-dev                           # whose meshes docs/coming-from.md takes, and peers
  valgrind                                           # for leaks of programs that use the C interface
  pybind11-dev python3-dev python3-numpy             # the Python module
  python3-pytest python3-hypothesis mypy             # its tests
  python3-matplotlib python3-vtk9                    # its figures, and those of surfaces in .vtp files
  python3-pandas python3-xarray                      # tables and arrays that it gives where these are there
)

if [ "${1:-}" != command ]; then packages+=("${tests[@]}"); fi
for group in "$@"; do
  case $group in
    command) ;;
    clang) packages+=(clang libclang-rt-14-dev clang-format llvm-14) ;;
    bench)
      # Peers; CGAL, VTK, FCL and Bullet are above.
      packages+=(libembree-dev libopenvdb-dev libode-dev libsimbody-dev)
      packages+=(python3 git)
      ;;
    docs) packages+=(doxygen) ;;
    page)
      packages+=(chromium)
      ;&
    emscripten)
      packages+=(emscripten)
      ;&
    node)
      packages+=(nodejs)
      # Debian's npm brings its own nodejs, which another one on the machine may rule out; that one has an npm.
      command -v npm >/dev/null || packages+=(npm)
      ;;
    package-test) packages+=(debootstrap) ;;
    wheel) packages+=(patchelf python3-pip python3-venv python3-wheel) ;;
    image) packages+=(umoci) ;;
    finite-elements) packages+=(python3-getfem) ;;
    workflow)
      packages+=(slurmctld slurmd slurm-client munge)
      ;&
    snakemake) packages+=(snakemake) ;;
    *)
      echo "install_dependencies.sh: no group '$group'; there are command, clang, bench, docs, node, emscripten, page, package-test, wheel, image, finite-elements, snakemake, workflow" >&2
      exit 2
      ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "condyle: no dpkg here, so nothing is installed: which packages are missing, CMake says" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed'; then
    missing+=("$package")
  fi
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

if ! command -v apt-get >/dev/null; then
  echo "condyle: apt-get not found; install by hand: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
echo "Installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
