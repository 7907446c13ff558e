"""One family of errors: each says what there is, and is what people expect of such a question in Python too."""

import ast
from pathlib import Path

import numpy as np
import pytest
from common import refused

import condyle
import condyle.plot


@pytest.fixture(scope="module")
def rom(hip: condyle.Joint) -> condyle.RangeOfMotion:
    return hip.range_of_motion(["flexion", "fadir"])


NAMES = {
    "a limit": (lambda hip, rom: rom["flexoin"], "limit: no 'flexoin': did you mean 'flexion'? there are flexion, fadir"),
    "a motion": (lambda hip, rom: rom.limit("flexoin"), "motion: no 'flexoin': did you mean 'flexion'? there are flexion, "),
    "an angle of a pose": (lambda hip, rom: hip.pose(flexoin_deg=3), "pose: no 'flexoin_deg': did you mean 'flexion_deg'? there are flexion_deg, "),
    "an angle about which": (lambda hip, rom: hip.penetration(np.eye(4), "tangential", about="x"),
                             "about: no 'x'; there are flexion, adduction, internal_rotation"),
    "an angle of a start": (lambda hip, rom: rom.free_angles("flexion", {"adducton": 3}),
                            "start_deg: no 'adducton': did you mean 'adduction'? there are flexion, "),
    "a part": (lambda hip, rom: hip.part("labrum"), "mobile part: no 'labrum'; there are none"),
    "a finding": (lambda hip, rom: condyle.inspect(hip.fixed).findings["holes"], "finding: no 'holes'; there are boundary_edges, boundary_loops, "),
    "an angle of a limit": (lambda hip, rom: rom["flexion"].at_limit_deg["flexoin"],
                            "angle: no 'flexoin': did you mean 'flexion'? there are flexion, adduction, "),
    "a column of a motion": (lambda hip, rom: condyle.MotionTable({"time": np.zeros(1)}, None, ())["tmie"],
                             "column: no 'tmie': did you mean 'time'? there are time"),
    "a column of a study": (lambda hip, rom: condyle.StudyTable({"id": np.zeros(1)}, {}, {})["limit_deg"], "column: no 'limit_deg'; there are id"),
    "a measure": (lambda hip, rom: condyle.sample_hip(haed_radius_mm=24),
                  "measure of the hip: no 'haed_radius_mm': did you mean 'head_radius_mm'? there are head_radius_mm, "),
    "a name that is no text": (lambda hip, rom: rom[3.0], "limit: no float; there are flexion, fadir"),
}


@pytest.mark.parametrize("case", NAMES)
def test_a_name_that_there_is_not_is_a_key_error_that_says_which_there_are(case, hip, rom):
    ask, says = NAMES[case]
    with pytest.raises(condyle.UnknownNameError) as raised:
        ask(hip, rom)
    assert isinstance(raised.value, KeyError) and isinstance(raised.value, condyle.UsageError)
    assert str(raised.value).startswith(says)


def test_a_pose_beyond_the_last_is_an_index_error(hip, coarse_bones):
    many = hip.penetration(hip.pose(flexion_deg=[0, 140]))
    assert len(many[-1].mobile) == 41
    for n in (2, -3):
        refused(lambda: many[n], f"pose: there are 2, counted from 0, and no {n}", IndexError)
    arcs = condyle.RingTable(coarse_bones.femur, [0, 0, 0], [0, 0, 1]).occupied_arcs([[1, 0, 0]])
    for n in (2, -3):
        refused(lambda: hip.range_of_motion(["flexion", "fadir"])[n], f"limit: there are 2, counted from 0, and no {n}", IndexError)
    refused(lambda: arcs.of(1), "point: there are 1, counted from 0, and no 1", condyle.OutOfRangeError)


def test_a_column_that_is_not_there_is_none_of_a_mapping():
    table = condyle.StudyTable({"id": np.zeros(1)}, {}, {})
    assert "limit_deg" not in table and table.get("limit_deg") is None


def test_errors_are_one_family_and_python_s_own():
    kinds = [each for each in vars(condyle).values() if isinstance(each, type)]
    family = {each for each in kinds if issubclass(each, condyle.CondyleError)}
    assert {each.__name__ for each in family} == {
        "CondyleError", "FileError", "MeshError", "OutOfRangeError", "ReferenceContactError", "UnknownNameError",
        "UsageError"}
    assert issubclass(condyle.FileError, OSError) and issubclass(condyle.MeshError, ValueError)
    assert issubclass(condyle.UsageError, ValueError)
    assert issubclass(condyle.plot.ReadError, (condyle.FileError, ValueError))


def test_nothing_but_the_family_is_raised_on_purpose(source: Path):
    kept = {"ImportError", "SystemExit", "TypeError", "NotImplemented", "AttributeError"}  # of what is not installed, caught at once, and frozen
    for path in (source / "python/condyle").rglob("*.py"):
        tree = ast.parse(path.read_text())
        for node in ast.walk(tree):
            if isinstance(node, ast.Raise) and node.exc is not None:
                called = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
                name = called.attr if isinstance(called, ast.Attribute) else called.id
                kind = getattr(condyle._errors, name, None) or (condyle.plot.ReadError if name == "ReadError" else None)
                is_ours = name == "unknown" or (isinstance(kind, type) and issubclass(kind, condyle.CondyleError))
                assert is_ours or name in kept, f"{path.name}:{node.lineno}: {name}"
