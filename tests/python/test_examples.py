"""The examples run, those of help() too, and show what the pages and their pictures say of them."""

import doctest
import functools
import importlib
import importlib.util
import os
import pkgutil
import re
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import condyle


def example(source, name):
    spec = importlib.util.spec_from_file_location(name, source / "examples/python" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look themselves up there
    spec.loader.exec_module(module)
    return module


def test_a_first_look_ends_with_limits(source, capsys):
    runpy.run_path(str(source / "examples/python/first_look.py"))
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("MeshReport(3086 vertices")
    assert sum(line.endswith(("contact", "end_of_range")) for line in lines) == 12


def test_the_first_look_is_quoted_in_the_documentation(source):
    code = (source / "examples/python/first_look.py").read_text().split('"""')[2].strip()
    assert code in (source / "docs/python.md").read_text()


def test_the_deformable_cartilage_leaves_no_depth_and_keeps_its_bone(source, tmp_path):
    module = example(source, "deformable_cartilage")
    coupling = module.press(steps=3, travel_mm=0.5)
    history, tissue = coupling.history, coupling.tissue
    assert len(history.step_ends) == 3
    for end in history.step_ends:
        assert history.depth_left_mm[end - 1] <= module.DEEPEST_MM and history.moved_mm[end - 1] <= module.STILL_MM
    # The clearance is 0.2 mm, so 0.3 mm of tissue must have given way where the load goes; its bony side has not moved.
    indentation = np.linalg.norm(tissue.rest, axis=1) - np.linalg.norm(tissue.at, axis=1)
    assert 0.2 < indentation.max() < 0.5
    np.testing.assert_array_equal(tissue.at[tissue.is_held], tissue.rest[tissue.is_held])
    # The table that followed gives the results of a new one.
    fresh = condyle.RadialTable((tissue.at, coupling.mesh.triangles))
    coupling.tissue_table.update(tissue.at)
    points = coupling.socket_vertices - coupling.place
    np.testing.assert_array_equal(coupling.tissue_table.query(points).gap_mm, fresh.query(points).gap_mm)
    module.draw(coupling, tmp_path)
    assert len(list(tmp_path.glob("*.png"))) == 2


def test_the_program_of_the_readme_runs(source, capsys):
    """And answers what its command line and its C++ do."""
    readme = (source / "README.md").read_text()
    code, = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert printed == code.splitlines()[-1].partition("  # ")[2] + "\n"
    # One joint and one pose, so one depth.
    depth, = re.findall(r"^  depth: ([0-9.]+) mm to the nearest surface", readme, re.MULTILINE)
    in_cpp, = re.findall(r"^It prints `depth ([0-9.]+) mm to the surface, ", readme, re.MULTILINE)
    assert printed.startswith(f"{depth} mm, ") and f"{float(depth):.2f}" == in_cpp


def run(source: Path, name: str, *arguments: object, **environment: str) -> str:
    ran = subprocess.run([sys.executable, source / "examples/python" / name, *map(str, arguments)], capture_output=True,
                         text=True, env={**os.environ, "MPLBACKEND": "Agg", **environment})
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def test_a_cam_takes_internal_rotation_from_every_hip(source: Path, tmp_path: Path):
    said = run(source, "cam_and_internal_rotation.py", tmp_path / "cam.pdf", 2)
    numbers = [float(number) for number in re.findall(r"-?\d+\.\d", said)]
    assert said.startswith("2 hips: ") and len(numbers) == 4
    without, with_cam, least, most = numbers
    assert without > with_cam and 0 < least <= most
    assert (tmp_path / "cam.pdf").read_bytes().startswith(b"%PDF")


def test_the_knee_is_that_which_was_published(source: Path, tmp_path: Path):
    data = Path(os.environ["CONDYLE_DATA"])
    if not (data / "osim_lenhart2015").is_dir():
        pytest.skip("no shared data: set CONDYLE_DATA")
    subprocess.run([sys.executable, data / "osim_lenhart2015/make_geometry.py", tmp_path / "Geometry"], check=True, capture_output=True)
    said = run(source, "knee_over_motion.py", tmp_path / "Geometry", tmp_path / "knee.svg", 50, CONDYLE_DATA=str(data))
    # Single precision on the publisher's side leaves 2e-5 open: docs/knee.md.
    assert said.startswith("6 frames, 8 numbers each") and float(said.split("at most ")[1].split(" ")[0]) <= 2e-5
    assert (tmp_path / "knee.svg").read_bytes().startswith(b"<?xml")


MODULES = ["condyle"] + [f"condyle.{found.name}" for found in pkgutil.iter_modules(condyle.__path__)
                         if found.name.startswith("_") and not found.name.startswith(("_native", "__"))]
# Nothing can change a mesh, so that the examples share theirs.
shared_hip = functools.cache(condyle.sample_hip)


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_help(name, monkeypatch):
    monkeypatch.setattr(condyle, "sample_hip", shared_hip)
    module = importlib.import_module(name)
    with np.printoptions(legacy=False):
        assert doctest.testmod(module, optionflags=doctest.ELLIPSIS).failed == 0
