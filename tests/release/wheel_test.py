"""A wheel answers as the built module does, in an empty virtual environment with numpy alone; it loads what it brings and the C
and C++ runtime: wheel_test.py BUILD WORK [WHEEL]. Without WHEEL one is made of the build. Where matplotlib is there, a figure is drawn.
"""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
ANSWERS = Path(__file__).with_name("wheel_answers.py")
build, work = map(Path, sys.argv[1:3])
build, work = build.resolve(), work.resolve()

for needed in (["patchelf", "--version"], [sys.executable, "-c", "import ensurepip, pip, wheel"]):
    if not shutil.which(needed[0]) or subprocess.run(needed, capture_output=True, check=False).returncode != 0:
        print(f"******** SKIPPED: {' '.join(needed)} fails; scripts/install_dependencies.sh wheel ********", file=sys.stderr)
        sys.exit(77)


def run(*words: object, **options) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "LD_", "PIP_"))}
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, cwd=work,
                          env={**environment, "PYTHONDONTWRITEBYTECODE": "1", **options})
    assert done.returncode == 0, f"{' '.join(map(str, words))}:\n{done.stdout}{done.stderr}"
    return done


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
if len(sys.argv) > 3:
    wheel = Path(sys.argv[3]).resolve()
else:
    # A module linked with a shared HDF5 cannot be a wheel.
    if not re.search(r"^CONDYLE_HDF5_INSIDE:\w+=TRUE$", (build / "CMakeCache.txt").read_text(), re.MULTILINE):
        print("******** SKIPPED: HDF5 is not linked in here, since no static one was found ********", file=sys.stderr)
        sys.exit(77)
    wheel = Path(run(sys.executable, SOURCE / "scripts/make_wheel.py", build, work).stdout.strip())
version = re.search(r'std::string_view version = "(.*)"', (SOURCE / "include/condyle/version.hpp").read_text()).group(1)
tag = re.fullmatch(rf"condyle-{re.escape(version)}-cp\d+-cp\d+-manylinux_2_(\d+)_[a-z0-9_]+\.whl", wheel.name)
assert tag, wheel.name

# From outside nothing but the C and the C++ runtime, none of it newer than the tag says.
with zipfile.ZipFile(wheel) as archive:
    archive.extractall(work / "unpacked")
    names = archive.namelist()
objects = [work / "unpacked" / name for name in names if ".so" in Path(name).name]
brought = {path.name for path in objects}
assert len(brought) == len(objects)
for path in objects:
    of_path = run("readelf", "--dynamic", "--version-info", "--wide", path).stdout
    for needed in re.findall(r"\(NEEDED\).*\[(.*)\]", of_path):
        runtime = re.fullmatch(r"lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)\.so\.\d+|ld-linux-.*", needed)
        assert needed in brought or runtime, f"{path.name} needs {needed}"
    for path_list in re.findall(r"\(R(?:UN)?PATH\).*\[(.*)\]", of_path):
        assert path_list in ("$ORIGIN", "$ORIGIN/../condyle.libs"), f"{path.name} looks in {path_list}"
    newest = max((int(minor) for minor in re.findall(r"Name: GLIBC_2\.(\d+)", of_path)), default=0)
    assert newest <= int(tag.group(1)), f"{path.name} needs glibc 2.{newest}"

# Types and licences.
licences = {Path(name).name for name in names if ".dist-info/licenses/" in name}
assert {"LICENSE", "NOTICE", "libhdf5-dev.copyright", "libaec-dev.copyright"} <= licences, licences
for library in ("tbb", "fmt", "lz4", "zlib", "hwy", "toml"):
    assert any(library in name for name in licences), f"no licence of {library} among {licences}"
assert {"condyle/py.typed", "condyle/_native.pyi"} <= set(names)

# Numpy 2 is asked for by a module only whose pybind11 knows it.
metadata, = (work / "unpacked").glob("*.dist-info/METADATA")
pybind11 = run("dpkg-query", "-W", "-f", "${Version}", "pybind11-dev").stdout
numpy_1_alone = tuple(map(int, pybind11.split(".")[:2])) < (2, 12)
assert f"\nRequires-Dist: numpy>=1.24{',<2' if numpy_1_alone else ''}\n" in metadata.read_text(encoding="utf-8"), pybind11

# Nothing there but numpy: no other package of the system's Python is seen.
environment = work / "environment"
run(sys.executable, "-m", "venv", environment)
python = environment / "bin/python"
lent = work / "lent"
lent.mkdir()
import numpy  # noqa: E402

numpy_folder = Path(numpy.__file__).parent
for found in (numpy_folder, *numpy_folder.parent.glob("numpy.libs"), *numpy_folder.parent.glob("numpy-*-info")):
    (lent / found.name).symlink_to(found)
site_packages, = environment.glob("lib/python*/site-packages")
(site_packages / "numpy_alone.pth").write_text(f"{lent}\n")
run(python, "-m", "pip", "install", "--no-index", wheel)

expected = run(sys.executable, ANSWERS, SOURCE / "README.md", work / "built.pdf", PYTHONPATH=str(build / "python"))
alone = run(python, ANSWERS, SOURCE / "README.md", work / "alone.pdf")
assert len(expected.stdout.splitlines()) >= 6 and str(build) in expected.stderr
assert alone.stdout == expected.stdout, f"{alone.stdout}\nis not\n{expected.stdout}"
assert f"installed {version}\n" in alone.stderr and f"module {site_packages}/condyle/" in alone.stderr
assert "no figures: figures need matplotlib: install " in alone.stderr, alone.stderr
loaded = re.findall(r"^loaded (.*)$", alone.stderr, re.MULTILINE)
ours = {Path(path).name for path in loaded if path.startswith(str(site_packages / "condyle"))}
assert brought == ours, f"not loaded of what was brought: {brought - ours}"
for path in loaded:
    stem = re.split(r"[-.]", Path(path).name)[0]
    assert path.startswith(str(site_packages)) or stem == "libz" or stem not in {re.split(r"[-.]", name)[0] for name in brought}, path

# With the system's packages beside, the wheel's module stays the one that is found.
(environment / "pyvenv.cfg").write_text((environment / "pyvenv.cfg").read_text().replace("= false", "= true"))
if subprocess.run([sys.executable, "-c", "import matplotlib"], capture_output=True, check=False).returncode == 0:
    drawn = run(python, ANSWERS, SOURCE / "README.md", work / "alone.pdf")
    assert drawn.stdout == expected.stdout and f"module {site_packages}/condyle/" in drawn.stderr
    assert (work / "alone.pdf").stat().st_size > 1000, drawn.stderr
print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, {len(objects)} shared objects, {len(licences)} licences")
