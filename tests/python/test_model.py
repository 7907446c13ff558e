"""Models of OpenSim in Python: poses against the reference evaluator, joints against the command's joint file."""

import json
import os
import pickle
import shutil
from pathlib import Path

import numpy as np
import pytest
from common import refused, run_command

import condyle

DATA = Path(os.environ["CONDYLE_DATA"])
GAIT = DATA / "osim_gait2354"

pytestmark = pytest.mark.skipif(not GAIT.exists(), reason="no shared data: set CONDYLE_DATA")


@pytest.fixture(scope="module")
def gait() -> condyle.Model:
    return condyle.read_model(GAIT / "gait2354_simbody.osim")


def test_has_joints_and_says_what_is_not_used(gait: condyle.Model) -> None:
    assert gait.name == "3DGaitModel2354" and gait.version == 40000
    assert "knee_r" in gait.joints and not gait.refused
    assert gait.ignored["Thelen2003Muscle"] == 54
    knee = gait.joint("knee_r")
    assert (knee.type, knee.parent_body, knee.child_body) == ("CustomJoint", "femur_r", "tibia_r")
    (angle,) = knee.coordinates
    assert angle.name == "knee_angle_r" and angle.motion == "rotational"
    found = {mesh.file: mesh.path for mesh in gait.meshes if mesh.body == "tibia_r"}
    assert found["tibia_r.vtp"] == str(GAIT / "Geometry" / "tibia_r.vtp")


def test_poses_are_those_of_the_reference(gait: condyle.Model) -> None:
    (of_model,) = [m for m in json.loads((GAIT / "reference_poses.json").read_text())["models"] if m["model"] == "gait2354_simbody.osim"]
    for expected in of_model["joints"]:
        joint = gait.joint(expected["joint"])
        rows = np.array([pose["q"] for pose in expected["poses"]])
        wanted = np.array([pose["child_in_parent"] for pose in expected["poses"]]).reshape(-1, 4, 4)
        np.testing.assert_allclose(joint.pose(rows), wanted, rtol=0, atol=1e-12)
        np.testing.assert_array_equal(joint.pose(rows[3]), joint.pose(rows)[3])
        columns = {coordinate.name + ("_m" if coordinate.motion == "translational" else "_rad"): rows[:, i]
                   for i, coordinate in enumerate(joint.coordinates)}
        np.testing.assert_array_equal(joint.pose(columns), joint.pose(rows))
        assert joint.pose().shape == (4, 4)


def test_coordinates_say_their_unit(gait: condyle.Model) -> None:
    knee, pelvis = gait.joint("knee_r"), gait.joint("ground_pelvis")
    wanted = knee.pose([-1.2])
    np.testing.assert_allclose(knee.pose({"knee_angle_r_deg": np.degrees(-1.2)}), wanted, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(knee.pose({"knee_angle_r_rad": -1.2}), wanted)
    with pytest.warns(condyle.JointRemark, match="knee_angle_r is in radians: say so, with _rad or _deg behind"):
        np.testing.assert_array_equal(knee.pose({"knee_angle_r": -1.2}), wanted)
    np.testing.assert_array_equal(pelvis.pose({"pelvis_ty_mm": 500})[:3, 3], pelvis.pose({"pelvis_ty_m": 0.5})[:3, 3])
    with pytest.warns(condyle.JointRemark, match="pelvis_ty is in metres"):
        pelvis.pose({"pelvis_ty": 0.5})
    refused(lambda: knee.pose({"knee_angle_r_deg": 1, "knee_angle_r_rad": 1}), "knee_angle_r_deg and knee_angle_r_rad are one coordinate")


def test_refuses_what_is_not_there(gait: condyle.Model) -> None:
    refused(lambda: gait.joint("kne_r"), "no joint 'kne_r'.*knee_r")
    refused(lambda: gait.joint("knee_r").pose({"knee": 0.1}), "no coordinate 'knee'", condyle.UnknownNameError)
    refused(lambda: gait.joint("knee_r").pose([0.1, 0.2]), "has 1 coordinates")
    refused(lambda: gait.joint("hip_r").pose({"hip_flexion_r_deg": [0, 1], "hip_adduction_r_deg": [0, 1, 2]}), "one length")
    refused(lambda: condyle.read_model("none.osim"), "none.osim", condyle.FileError)
    refused(lambda: condyle.Joint.from_model(gait, "hip_l"), "no mesh of body", condyle.FileError)


def test_joints_are_those_of_the_command(gait: condyle.Model, tmp_path: Path) -> None:
    toml = tmp_path / "hip.toml"
    run_command("init", GAIT / "gait2354_simbody.osim", "--joint", "hip_r", "-o", toml)
    assert toml.read_text() == gait.propose_joint("hip_r", toml).toml
    read, made = condyle.read_joint(toml), condyle.Joint.from_model(gait, "hip_r")
    np.testing.assert_array_equal(read.fixed.vertices, made.fixed.vertices)
    np.testing.assert_array_equal(read.mobile.vertices, made.mobile.vertices)
    assert made.kind == "ball" and made.joint == "hip" and made.side == "right"
    assert any("Thelen2003Muscle" in line for line in made.processing)
    again = pickle.loads(pickle.dumps(made))
    np.testing.assert_array_equal(again.mobile.vertices, made.mobile.vertices)


def test_a_motion_is_posed_by_the_model(gait: condyle.Model) -> None:
    walk = DATA / "motion_gait2354_walk" / "subject01_walk1_ik.mot"
    joint, knee = condyle.Joint.from_model(gait, "knee_r"), gait.joint("knee_r")
    motion = joint.motion(walk)
    angles = np.radians(condyle.read_motion_table(walk)["knee_angle_r"])
    poses, at_zero = knee.pose({"knee_angle_r_rad": angles}), knee.pose({"knee_angle_r_deg": 0})
    for poses_mm in (poses, at_zero):
        poses_mm[..., :3, 3] *= 1000
    X_WF = np.eye(4)
    X_WF[:3, 3] = at_zero[:3, 3]
    wanted = np.linalg.inv(X_WF) @ poses @ np.linalg.inv(at_zero) @ X_WF
    np.testing.assert_allclose(motion.X_FM, wanted, rtol=0, atol=1e-9)
    assert np.ptp(angles) > 0.5 and any("posed by joint 'knee_r'" in line for line in motion.processing)


def test_scaled_meshes_are_scaled(tmp_path: Path) -> None:
    scaled = condyle.read_model(GAIT / "subject01_simbody_adjusted.osim")
    plain = condyle.read_model(GAIT / "gait2354_simbody.osim")
    areas = [condyle.inspect(condyle.Joint.from_model(model, "ankle_r").mobile).area for model in (scaled, plain)]
    assert areas[0] / areas[1] == pytest.approx(1.11398**2, rel=1e-9)
    shutil.copy(GAIT / "gait2354_simbody.osim", tmp_path)
    moved = condyle.read_model(tmp_path / "gait2354_simbody.osim", geometry=GAIT / "Geometry")
    np.testing.assert_array_equal(condyle.Joint.from_model(moved, "hip_r").fixed.vertices, condyle.Joint.from_model(plain, "hip_r").fixed.vertices)
