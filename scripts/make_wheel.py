#!/usr/bin/python3
"""Packs the Python module that a build folder holds as a wheel: make_wheel.py BUILD OUT. Prints its path.

For the Python that it was built for, on machines with the shared libraries it was linked with (oneTBB, HDF5, zlib, LZ4): pip
does not bring those. Nothing is compiled; `python3 -m wheel pack` of Debian's python3-wheel writes the archive and its list
of contents.
"""

import re
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
from pathlib import Path

from make_sbom import SOURCE, version


def metadata(project: dict) -> str:
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version()}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {package}" for package in project["dependencies"]]
    for extra, packages in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {package}; extra == "{extra}"' for package in packages]
    readme = (SOURCE / project["readme"]).read_text(encoding="utf-8")
    return "\n".join(lines) + "\nDescription-Content-Type: text/markdown\n\n" + readme


def main(build: Path, out: Path) -> None:
    project = tomllib.loads((SOURCE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    name = f"condyle-{version()}"
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    with tempfile.TemporaryDirectory() as folder:
        installed, unpacked = Path(folder) / "installed", Path(folder) / name
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", installed], check=True,
                       stdout=subprocess.DEVNULL)
        package, = (path.parent for path in installed.rglob("condyle/__init__.py"))
        unpacked.mkdir()
        package.rename(unpacked / "condyle")
        info = unpacked / f"{name}.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(metadata(project), encoding="utf-8")
        (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: condyle {version()}\nRoot-Is-Purelib: false\n"
                                    f"Tag: {tag}\n", encoding="utf-8")
        (info / "LICENSE").write_bytes((SOURCE / "LICENSE").read_bytes())
        out.mkdir(parents=True, exist_ok=True)
        subprocess.run([sys.executable, "-m", "wheel", "pack", unpacked, "--dest-dir", out], check=True,
                       stdout=subprocess.DEVNULL)
    print(out / f"{name}-{tag}.whl")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
