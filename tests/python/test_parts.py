"""Parts with a pose of their own, as the command has them."""

import functools
import json
import pickle
import subprocess

import numpy as np
import pytest

import condyle
from report_data import text_of

PARTS = """
[[part]]
name = "pelvis"
body = "fixed"
[[part.parameter]]
name = "tilt"
range = [-20, 20]
sigma = 3
[[part]]
name = "femur"
body = "mobile"
[[part.parameter]]
name = "version"
range = [-30, 30]
"""

CUT = """
[[part]]
name = "fragment"
body = "fixed"
cut = [{ point = [0, 46, 0], normal = [0, 0.96, -0.28] }, { point = [-44, 0, 0], normal = [-1, 0, 0] }]
[[part.parameter]]
name = "frontal"
range = [-20, 20]
"""


@pytest.fixture
def joint(tmp_path):
    return written_joint(tmp_path, PARTS)


made_hip = functools.cache(condyle.sample_hip)


def written_joint(tmp_path, parts):
    bones = made_hip()
    for name, mesh in (("hip_bone", bones.hip_bone), ("femur", bones.femur)):
        condyle.write_mesh(tmp_path / f"{name}.ply", mesh)
    (tmp_path / "hip.toml").write_text(
        'condyle = 1\nname = "hip"\nkind = "ball"\nside = "right"\nunits = "mm"\n[fixed]\nmesh = "hip_bone.ply"\n'
        '[mobile]\nmesh = "femur.ply"\n[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n' + parts)
    return condyle.read_joint(tmp_path / "hip.toml")


def limits_of(joint):
    return {limit.motion.name: limit.limit_deg for limit in joint.range_of_motion().limits}


def test_parameters_are_those_of_the_file(joint):
    assert list(joint.parameters) == ["pelvis.tilt", "femur.version"]
    tilt = joint.parameters["pelvis.tilt"]
    assert (tilt.kind, tilt.body, tilt.value, tilt.unit, tilt.range, tilt.sigma) == (
        "tilt", "fixed", 0, "deg", (-20, 20), 3)


def test_a_tilt_takes_its_angle_off_flexion_and_a_version_adds_it_to_internal_rotation(joint):
    before = limits_of(joint)
    moved = joint.with_parameters({"pelvis.tilt": 10})
    assert moved.parameters["pelvis.tilt"].value == 10 and moved.parameters["pelvis.tilt"].in_joint_file == 0
    assert limits_of(moved)["flexion"] == pytest.approx(before["flexion"] - 10, abs=1e-9)
    turned = limits_of(joint.with_parameters({"femur.version": 8}))
    assert turned["internal_rotation_at_90_flexion"] == pytest.approx(
        before["internal_rotation_at_90_flexion"] + 8, abs=1e-9)


def test_a_pickled_joint_keeps_its_parts(joint):
    moved = pickle.loads(pickle.dumps(joint.with_parameters({"pelvis.tilt": 10})))
    assert moved.parameters["pelvis.tilt"].value == 10
    back = moved.with_parameters({"pelvis.tilt": 0})
    assert np.array_equal(back.fixed.vertices, joint.fixed.vertices)


def test_a_part_is_cut_from_its_bone(tmp_path, command):
    joint = written_joint(tmp_path, CUT)
    rest, fragment = joint.fixed_parts
    assert (rest.name, fragment.name) == ("fixed", "fragment")
    assert rest.cut_triangles == fragment.cut_triangles > 0
    pieces = [joint.part(each.name, "fixed") for each in joint.fixed_parts]
    assert all(each.is_closed for each in pieces)
    turned = pickle.loads(pickle.dumps(joint)).with_parameters({"fragment.frontal": 10})
    assert np.array_equal(turned.part("fixed", "fixed").vertices, pieces[0].vertices)
    ran = subprocess.run([command, "rom", tmp_path / "hip.toml", "--set", "fragment.frontal=10", "--json"], check=True,
                         capture_output=True, text=True)
    answer = json.loads(ran.stdout)
    assert {m["name"]: m["limit_deg"] for m in answer["motions"]} == limits_of(turned)
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
    with pytest.raises(condyle.UsageError, match=words) as error:
        joint.with_parameters(values)
    assert "\n" not in str(error.value)


def test_the_command_and_a_study_say_the_same(joint, command, tmp_path):
    expected = limits_of(joint.with_parameters({"pelvis.tilt": 7}))["flexion"]
    ran = subprocess.run([command, "rom", tmp_path / "hip.toml", "--set", "pelvis.tilt=7", "--json"], check=True,
                         capture_output=True, text=True)
    answer = json.loads(ran.stdout)
    assert {m["name"]: m["limit_deg"] for m in answer["motions"]}["flexion"] == expected
    assert answer["provenance"]["parameters"][0]["value"] == 7
    (tmp_path / "table.csv").write_text("id,joint,parameters\na,hip.toml,pelvis.tilt=7\nb,hip.toml,pelvis.tilt=70\n")
    subprocess.run([command, "study", tmp_path / "table.csv", "--out", tmp_path / "out"], check=False,
                   capture_output=True)
    lines = [line.split(",") for line in (tmp_path / "out/limits.csv").read_text().splitlines() if line[0] != "#"]
    row = next(line for line in lines if line[0] == "a" and "flexion" in line)
    assert float(row[lines[0].index("limit_deg")]) == expected
    assert "pelvis.tilt: 70 deg is outside of its range" in (tmp_path / "out/failures.csv").read_text()


def test_a_report_says_the_same(joint, command, tmp_path):
    page = tmp_path / "hip.html"
    subprocess.run([command, "report", tmp_path / "hip.toml", "--set", "pelvis.tilt=7", "--out", page], check=True,
                   capture_output=True)
    rom = text_of(page)["rom"]
    assert {m["name"]: m["limit_deg"] for m in rom["motions"]}["flexion"] == limits_of(
        joint.with_parameters({"pelvis.tilt": 7}))["flexion"]
    assert rom["provenance"]["parameters"][0]["value"] == 7
