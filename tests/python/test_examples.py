"""The examples run, and show what the pages say of them."""

import importlib.util
import runpy
import sys

import numpy as np

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
