"""Parts with a pose of their own, as the command has them."""

import pickle

import numpy as np
import pytest
from common import joint_file, json_of_command, refused, rows_of, run_command, text_of

import condyle

PARTS = """part = [{ name = "pelvis", body = "fixed", parameter = [{ name = "tilt", range = [-20, 20], sigma = 3 }] },
        { name = "femur", body = "mobile", parameter = [{ name = "version", range = [-30, 30] }] }]
"""
CUT = """part = [{ name = "fragment", body = "fixed", parameter = [{ name = "frontal", range = [-20, 20] }], cut = [
        { point = [0, 46, 0], normal = [0, 0.96, -0.28] }, { point = [-44, 0, 0], normal = [-1, 0, 0] }] }]
"""


@pytest.fixture(scope="module")
def file(tmp_path_factory, default_bones):
    return joint_file(tmp_path_factory.mktemp("parts"), PARTS, fixed=default_bones.hip_bone, mobile=default_bones.femur)


@pytest.fixture(scope="module")
def joint(file):
    return condyle.read_joint(file)


def limits_said_by(answer):
    return {motion["name"]: motion["limit_deg"] for motion in answer["motions"]}


def limits_of(joint):
    return {limit.motion.name: limit.limit_deg for limit in joint.range_of_motion().limits}


def test_parameters_are_those_of_the_file(joint):
    assert list(joint.parameters) == ["pelvis.tilt", "femur.version"]
    tilt = joint.parameters["pelvis.tilt"]
    assert (tilt.kind, tilt.body, tilt.value, tilt.unit, tilt.range, tilt.sigma) == ("tilt", "fixed", 0, "deg", (-20, 20), 3)


def test_a_tilt_takes_its_angle_off_flexion_and_a_version_adds_it_to_internal_rotation(joint):
    before = limits_of(joint)
    moved = joint.with_parameters({"pelvis.tilt": 10})
    assert moved.parameters["pelvis.tilt"].value == 10 and moved.parameters["pelvis.tilt"].in_joint_file == 0
    assert limits_of(moved)["flexion"] == pytest.approx(before["flexion"] - 10, abs=1e-9)
    turned = limits_of(joint.with_parameters({"femur.version": 8}))
    assert turned["internal_rotation_at_90_flexion"] == pytest.approx(before["internal_rotation_at_90_flexion"] + 8, abs=1e-9)


def test_a_pickled_joint_keeps_its_parts(joint):
    moved = pickle.loads(pickle.dumps(joint.with_parameters({"pelvis.tilt": 10})))
    assert moved.parameters["pelvis.tilt"].value == 10
    back = moved.with_parameters({"pelvis.tilt": 0})
    assert np.array_equal(back.fixed.vertices, joint.fixed.vertices)


def test_a_part_is_cut_from_its_bone(tmp_path, default_bones):
    path = joint_file(tmp_path, CUT, fixed=default_bones.hip_bone, mobile=default_bones.femur)
    joint = condyle.read_joint(path)
    rest, fragment = joint.fixed_parts
    assert (rest.name, fragment.name) == ("fixed", "fragment")
    assert rest.cut_triangles == fragment.cut_triangles > 0
    pieces = [joint.part(each.name, "fixed") for each in joint.fixed_parts]
    assert all(each.is_closed for each in pieces)
    turned = pickle.loads(pickle.dumps(joint)).with_parameters({"fragment.frontal": 10})
    assert np.array_equal(turned.part("fixed", "fixed").vertices, pieces[0].vertices)
    answer = json_of_command("rom", path, "--set", "fragment.frontal=10")
    assert limits_said_by(answer) == limits_of(turned)
    assert [each["part"] for each in answer["provenance"]["cuts"]] == ["fragment"]


def test_bands_know_how_wide_parameters_make_them(joint):
    band = joint.range_of_motion().bands(["flexion"], samples=40)[0]
    assert band.width_from_parameters_deg > 5


@pytest.mark.parametrize("values, words", [
    ({"pelvis.tlit": 1}, 'did you mean "pelvis.tilt"'),
    ({"pelvis.tilt": 21}, "pelvis.tilt: 21 deg is outside of its range, -20 to 20"),
    ({"pelvis.tilt": float("nan")}, "finite number"),
    ({"pelvis.tilt": "a"}, "a number is needed"),
    ({3: 1}, "a text is needed"),
    ([1], "mapping"),
])
def test_what_is_no_value_is_refused(joint, values, words):
    refused(lambda: joint.with_parameters(values), words)


def test_the_command_and_a_study_say_the_same(file, joint, tmp_path):
    expected = limits_of(joint.with_parameters({"pelvis.tilt": 7}))["flexion"]
    answer = json_of_command("rom", file, "--set", "pelvis.tilt=7")
    assert limits_said_by(answer)["flexion"] == expected
    assert answer["provenance"]["parameters"][0]["value"] == 7
    (tmp_path / "table.csv").write_text(f"id,joint,parameters\na,{file},pelvis.tilt=7\nb,{file},pelvis.tilt=70\n")
    run_command("study", tmp_path / "table.csv", "--out", tmp_path / "out", check=False)
    assert [float(row["limit_deg"]) for row in rows_of(tmp_path / "out/limits.csv") if row["motion"] == "flexion"] == [expected]
    assert "pelvis.tilt: 70 deg is outside of its range" in (tmp_path / "out/failures.csv").read_text()


def test_a_report_says_the_same(file, joint, tmp_path):
    run_command("report", file, "--set", "pelvis.tilt=7", "--out", tmp_path / "hip.html")
    rom = text_of(tmp_path / "hip.html")["rom"]
    assert limits_said_by(rom)["flexion"] == limits_of(joint.with_parameters({"pelvis.tilt": 7}))["flexion"]
    assert rom["provenance"]["parameters"][0]["value"] == 7
