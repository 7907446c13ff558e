#!/usr/bin/python3
"""Packs the Python module that a build folder holds as a wheel: make_wheel.py BUILD OUT. Prints its path.

For the Python that it was built for; it brings every shared library that is not of the C or C++ runtime, with its licence:
docs/decisions/0022-wheel.md. Nothing is compiled: patchelf lets what was built find what comes along, and `python3 -m wheel
pack` of Debian's python3-wheel writes the archive and its list of contents.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
from pathlib import Path

from make_sbom import SOURCE, archives_of, debian_packages, headers_of, libraries_of, output_of, version

# The C and the C++ runtime, which the tag of a wheel (PEP 600) promises to whoever installs it.
RUNTIME = re.compile(r"(lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)\.so\.\d+|ld-linux.*|linux-vdso.*)")
# oneTBB looks for it by this name.
KEEPS_NAME = "libtbbmalloc.so.2"
# Packages whose headers a compiled program may contain without their licences: the C and the C++ runtime, Python, Boost.
NEED_NO_LICENCE = re.compile(r"(libc6|linux-libc|lib(stdc\+\+|gcc)-\d+|libpython[0-9.]+|libboost[0-9.]*)-dev")


def patchelf(*words: object) -> None:
    subprocess.run(["patchelf", *map(str, words)], check=True)


def needed_by(program: Path) -> list[str]:
    return output_of("patchelf", "--print-needed", str(program)).split()


def newest_version_needed(prefix: str, programs: list[Path]) -> tuple[int, ...]:
    """Newest version that versioned symbols require, such as 2.34 for GLIBC_2.34."""
    found = re.findall(rf"Name: {prefix}_([0-9.]+)", output_of("readelf", "--version-info", "--wide", *map(str, programs)))
    return max(tuple(map(int, number.split("."))) for number in found)


def platform_tag(programs: list[Path]) -> str:
    """manylinux_2_N: Linux distributions whose C library is glibc 2.N or newer (PEP 600)."""
    glibc = newest_version_needed("GLIBC", programs)
    own = tuple(map(int, os.confstr("CS_GNU_LIBC_VERSION").split()[1].split(".")))
    # Distributions with glibc 2.34 have the C++ library of GCC 11; with a newer one, those that are no older than this machine.
    glibc = max(glibc, (2, 34)) if newest_version_needed("GLIBCXX", programs) <= (3, 4, 29) else max(glibc, own)
    return f"manylinux_{glibc[0]}_{glibc[1]}_{sysconfig.get_platform().split('-', 1)[1]}"


def bring_libraries(module: Path, folder: Path) -> list[str]:
    """Copies what the module needs into the folder and lets it find that. Gives the paths of what was copied.

    Each under a name that no other library of the process has, with a digest: the loader takes what is loaded already for a
    name, and another module's library of that name may be another version.
    """
    origins = {Path(path).name: path for path in libraries_of(module) if not RUNTIME.fullmatch(Path(path).name)}
    if any(name.startswith("libhdf5") for name in origins):
        sys.exit("make_wheel.py: the module was linked with a shared HDF5, which brings 29 libraries: cmake/Hdf5.cmake")
    folder.mkdir()
    own_names = {}
    for name, origin in origins.items():
        digest = hashlib.sha256(Path(origin).read_bytes()).hexdigest()[:8]
        stem, ending = name.split(".so", 1)
        own_names[name] = name if name == KEEPS_NAME else f"{stem}-{digest}.so{ending}"
    copies = {folder / own_names[name]: origin for name, origin in origins.items()}
    for copy, origin in copies.items():
        shutil.copyfile(origin, copy)
        copy.chmod(0o755)
        patchelf("--set-soname", copy.name, copy)
    for program in (module, *copies):
        for name in filter(own_names.__contains__, needed_by(program)):
            patchelf("--replace-needed", name, own_names[name], program)
        patchelf("--set-rpath", "$ORIGIN" if program in copies else f"$ORIGIN/../{folder.name}", program)
    return list(copies.values())


def write_licences(folder: Path, packages: set[str]) -> None:
    """Ours, and of each Debian package that came along, was linked in or had headers compiled in."""
    folder.mkdir()
    for name in ("LICENSE", "NOTICE"):
        shutil.copyfile(SOURCE / name, folder / name)
    texts: set[bytes] = set()  # a library and its headers have the same
    for name in sorted(package.split(":")[0] for package in packages):
        text = Path(f"/usr/share/doc/{name}/copyright").read_bytes()
        if not NEED_NO_LICENCE.fullmatch(name) and text not in texts:
            texts.add(text)
            (folder / f"{name}.copyright").write_bytes(text)


def knows_numpy_2(headers: list[str]) -> bool:
    """Whether the module's pybind11 is 2.12 or newer: an older one reads the descriptions of types where numpy 1 has them."""
    header, = (path for path in headers if path.endswith("/pybind11/detail/common.h"))
    numbers = dict(re.findall(r"#define PYBIND11_VERSION_(MAJOR|MINOR)\s+(\d+)", Path(header).read_text(encoding="utf-8")))
    return (int(numbers["MAJOR"]), int(numbers["MINOR"])) >= (2, 12)


def metadata(project: dict, licences: list[str], numpy_2: bool) -> str:
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version()}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"License-File: {name}" for name in licences]
    lines += [f"Requires-Dist: {package}{'' if numpy_2 or not package.startswith('numpy') else ',<2'}"
              for package in project["dependencies"]]
    for extra, packages in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {package}; extra == "{extra}"' for package in packages]
    readme = (SOURCE / project["readme"]).read_text(encoding="utf-8")
    return "\n".join(lines) + "\nDescription-Content-Type: text/markdown\n\n" + readme


def main(build: Path, out: Path) -> None:
    project = tomllib.loads((SOURCE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    name = f"condyle-{version()}"
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    with tempfile.TemporaryDirectory() as folder:
        installed, unpacked = Path(folder) / "installed", Path(folder) / name
        subprocess.run(["cmake", "--install", build, "--component", "python", "--strip", "--prefix", installed], check=True,
                       stdout=subprocess.DEVNULL)
        package, = (path.parent for path in installed.rglob("condyle/__init__.py"))
        unpacked.mkdir()
        package.rename(unpacked / "condyle")
        module = unpacked / "condyle" / f"_native{sysconfig.get_config_var('EXT_SUFFIX')}"
        if not module.exists():
            sys.exit(f"make_wheel.py: {build} has no module for {sys.executable}")
        libraries = bring_libraries(module, unpacked / "condyle.libs")
        inside = archives_of(build, [build / "python/condyle" / module.name]) + headers_of(build, ("src/", "python/"))
        info = unpacked / f"{name}.dist-info"
        info.mkdir()
        write_licences(info / "licenses", set(debian_packages(libraries + inside).values()))
        tag = f"{python}-{python}-{platform_tag([module, *(unpacked / 'condyle.libs').iterdir()])}"
        licences = sorted(path.name for path in (info / "licenses").iterdir())
        (info / "METADATA").write_text(metadata(project, licences, knows_numpy_2(inside)), encoding="utf-8")
        (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: condyle {version()}\nRoot-Is-Purelib: false\n"
                                    f"Tag: {tag}\n", encoding="utf-8")
        out.mkdir(parents=True, exist_ok=True)
        # The same files give the same bytes; zip knows no time before 1980.
        subprocess.run([sys.executable, "-m", "wheel", "pack", unpacked, "--dest-dir", out], check=True,
                       stdout=subprocess.DEVNULL, env={"SOURCE_DATE_EPOCH": "315532800", **os.environ})
    print(out / f"{name}-{tag}.whl")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
