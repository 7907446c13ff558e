"""Reports and pictures hold what the command's hold."""

import pickle
import subprocess
import warnings

import numpy as np
import pytest
from report_data import text_of

import condyle


def test_a_report_is_that_of_the_command_but_for_its_name(command, hip, hip_file, tmp_path):
    subprocess.run([command, "report", hip_file, "--band=20", "--past", "5", "--out", tmp_path / "theirs.html"], check=True,
                   capture_output=True)
    hip.range_of_motion().write_report(tmp_path / "ours.html", band_samples=20, past_deg=5)
    theirs, ours = text_of(tmp_path / "theirs.html"), text_of(tmp_path / "ours.html")
    for text in (theirs, ours):
        del text["rom"]["provenance"]["command"]
    assert ours == theirs


def test_a_report_shows_shape_and_plan_as_the_command_does(tmp_path, sampled, command):
    sampled(tmp_path, "hip", "--alpha-angle", "70")
    joint = condyle.read_joint(tmp_path / "hip.toml")
    with pytest.warns(condyle.JointRemark):
        plan = joint.resection({"internal_rotation_at_90_flexion": 45}, curve_points=1, margin_mm=0)
    plan.joint.range_of_motion().write_report(tmp_path / "python.html", measures=True, plan=plan)
    subprocess.run([command, "report", tmp_path / "hip.toml", "--measures", "--curve", "1", "--margin", "0", "--resect",
                    "internal_rotation_at_90_flexion=45", "--out", tmp_path / "command.html"], check=True, capture_output=True)
    ours, said = (text_of(tmp_path / name) for name in ("python.html", "command.html"))
    for block in (ours, said):
        del block["rom"]["provenance"]
    assert ours == said and said["plan"]["cuts"][0]["volume_mm3"] == plan.volume_mm3
    with pytest.raises(condyle.UsageError, match="plan.joint"):
        joint.range_of_motion(["flexion"]).write_report(tmp_path / "other.html", plan=plan)
    again = pickle.loads(pickle.dumps(plan))
    assert again.volume_mm3 == plan.volume_mm3
    with pytest.raises(condyle.UsageError, match="pickled"):
        again.joint.range_of_motion(["flexion"]).write_report(tmp_path / "other.html", plan=again)


def test_a_report_shows_the_safe_zone_of_a_sweep_as_the_command_does(tmp_path, sampled, command):
    sampled(tmp_path, "replacement")
    targets = tmp_path / "targets.csv"
    targets.write_text("name,motion,reach_deg\nsitting,flexion,110\npivoting,external_rotation,40\n")
    joint = condyle.read_joint(tmp_path / "hip.toml")
    zone = joint.sweep({"cup.inclination": (30, 60, 10), "cup.anteversion": (0, 30, 10)}, targets)
    joint.range_of_motion().write_report(tmp_path / "python.html", sweep=zone)
    subprocess.run([command, "report", tmp_path / "hip.toml", "--sweep", "cup.inclination=30:60:10 cup.anteversion=0:30:10", "--targets",
                    targets, "--out", tmp_path / "command.html"], check=True, capture_output=True)
    ours, said = (text_of(tmp_path / name) for name in ("python.html", "command.html"))
    for block in (ours, said):
        del block["rom"]["provenance"]
    assert ours == said and said["sweep"]["safe_designs"] == zone.safe.sum()
    other = joint.with_parameters({"cup.inclination": 45}).range_of_motion(["flexion"])
    with pytest.raises(condyle.UsageError, match="sweep: it is that of another joint"):
        other.write_report(tmp_path / "other.html", sweep=zone)
    with pytest.raises(condyle.UsageError, match="sweep: a condyle.Sweep is needed, not int"):
        other.write_report(tmp_path / "other.html", sweep=1)


def test_a_report_compares_joints_as_the_command_does(command, sampled, hip, hip_file, tmp_path):
    for folder, cam in (("before", []), ("left", ["--side", "left"])):
        sampled(tmp_path / folder, "hip", *cam)
    before_file = tmp_path / "before" / "hip.toml"
    subprocess.run([command, "report", before_file, hip_file, "--band=20", "--out", tmp_path / "theirs.html"], check=True,
                   capture_output=True)
    before, rom = condyle.read_joint(before_file), hip.range_of_motion()
    rom.write_report(tmp_path / "ours.html", band_samples=20, before=before)
    theirs, ours = text_of(tmp_path / "theirs.html"), text_of(tmp_path / "ours.html")
    for text in (theirs, ours):
        del text["rom"]["provenance"]["command"], text["before"]["rom"]["provenance"]["command"]
    # The command read the files of the joint before, too; Python is given joints.
    read = theirs["rom"]["provenance"].pop("other_files")
    assert {file["path"] for file in read} == {"hip.toml", "hip_bone.ply", "femur.ply"}
    assert ours == theirs
    limits = before.range_of_motion().limits
    assert [motion["limit_deg"] for motion in ours["before"]["rom"]["motions"]] == [limit.limit_deg for limit in limits]
    with pytest.raises(condyle.UsageError, match="the same kind, anatomy and side"):
        rom.write_report(tmp_path / "other.html", before=condyle.read_joint(tmp_path / "left" / "hip.toml"))
    with pytest.raises(condyle.UsageError, match="before: a joint is needed, not str"):
        rom.write_report(tmp_path / "other.html", before=str(before_file))
    (tmp_path / "before.html").hardlink_to(before_file)
    with pytest.raises(condyle.FileError, match="is read for this answer"):
        rom.write_report(tmp_path / "before.html", before=before)
    assert not (tmp_path / "other.html").exists()


def test_a_report_has_the_motions_asked_for_and_the_title_given(hip, tmp_path):
    rom = hip.range_of_motion(["flexion", "fadir"])
    rom.write_report(tmp_path / "hip.html", title="Hip & <more>")
    text = text_of(tmp_path / "hip.html")
    assert text["title"] == "Hip & <more>"
    assert [motion["limit_deg"] for motion in text["rom"]["motions"]] == [limit.limit_deg for limit in rom.limits]
    assert text["zones"] == []


def test_a_report_plays_a_motion_and_has_pressure_as_the_command_does(command, tmp_path):
    subprocess.run([command, "sample", "hip", "--scenario", "1", "--out", tmp_path], check=True, capture_output=True)
    joint_file, swing = tmp_path / "hip.toml", tmp_path / "swing.csv"
    joint_file.write_text(joint_file.read_text() + '[contact]\ncasting = "fixed"\n[contact.fixed]\nyoungs_modulus_mpa = 12\n'
                          "poisson_ratio = 0.45\nthickness = 2\n")
    swing.write_text("time,flexion_deg\n0,0\n0.1,10\n0.2,\n0.3,30\n")
    subprocess.run([command, "report", joint_file, "--motion", swing, "--load", "--out", tmp_path / "theirs.html"], check=True,
                   capture_output=True)
    rom = condyle.read_joint(joint_file).range_of_motion()
    with pytest.warns(condyle.JointWarning):
        rom.write_report(tmp_path / "ours.html", motion=swing, load=True)
    theirs, ours = text_of(tmp_path / "theirs.html"), text_of(tmp_path / "ours.html")
    for text in (theirs, ours):
        del text["rom"]["provenance"]["command"]
    assert ours == theirs and ours["recorded"]["name"] == "swing.csv" and ours["layers"]["fixed"]["poisson_ratio"] == 0.45
    with pytest.raises(condyle.FileError, match="none.csv"):
        rom.write_report(tmp_path / "other.html", motion=tmp_path / "none.csv")
    assert not (tmp_path / "other.html").exists()


def test_a_joint_of_arrays_has_a_report_without_files(tmp_path, coarse_bones):
    rom = condyle.Joint(coarse_bones.hip_bone, coarse_bones.femur, name="made of arrays").range_of_motion(["flexion"])
    rom.write_report(tmp_path / "hip.html")
    text = text_of(tmp_path / "hip.html")
    assert text["title"] == "made of arrays"
    assert text["rom"]["provenance"] is None


def test_a_report_without_what_was_asked_for_is_none(tmp_path):
    # A face of the mobile body runs through the joint centre: it has limits, and no zones.
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    triangles = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6],
                 [1, 3, 5], [3, 7, 5]]
    arm, post = (condyle.TriMesh(low + corners * size, triangles) for low, size in (([-3, -100, -5], [7, 100, 11]),
                                                                                    ([40, -80, -10], [20, 20, 20])))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", condyle.JointWarning)
        rom = condyle.Joint(post, arm).range_of_motion(["flexion"])
    with pytest.raises(condyle.MeshError, match="joint centre lies on the surface"):
        rom.write_report(tmp_path / "arm.html", past_deg=5)
    assert not (tmp_path / "arm.html").exists()


def test_pressure_needs_layers(hip, tmp_path):
    with pytest.raises(condyle.UsageError, match="no layers"):
        hip.range_of_motion(["flexion"]).write_report(tmp_path / "hip.html", load=True)


def test_a_report_that_cannot_be_written_leaves_nothing(hip, tmp_path):
    rom = hip.range_of_motion(["flexion"])
    with pytest.raises(condyle.FileError):
        rom.write_report(tmp_path)
    with pytest.raises(condyle.UsageError, match="a page is written, FILE.html"):
        rom.write_report(tmp_path / "hip.pdf")
    with pytest.raises(condyle.UsageError, match="band_samples"):
        rom.write_report(tmp_path / "hip.html", band_samples=3)
    with pytest.raises(condyle.UsageError, match="past"):
        rom.write_report(tmp_path / "hip.html", past_deg=-1)
    assert list(tmp_path.iterdir()) == []


def test_a_picture_is_that_of_the_command(command, hip, hip_file, tmp_path):
    image = pytest.importorskip("matplotlib.image")
    subprocess.run([command, "picture", hip_file, "--pose", "flexion=140", "--view", "lateral", "--hide", "fixed", "--size", "320x240",
                    "--measures", "--out", tmp_path / "hip.png"], check=True, capture_output=True)
    theirs = np.round(255 * image.imread(tmp_path / "hip.png")[:, :, :3]).astype(np.uint8)
    drawn = {"view": "lateral", "fixed": "hidden", "width": 320, "height": 240, "measures": True}
    ours = hip.picture({"flexion_deg": 140}, **drawn)
    assert ours.dtype == np.uint8 and np.array_equal(ours, theirs)
    assert not np.array_equal(hip.picture({"flexion_deg": 140}, field_mm="all", **drawn), ours)


def test_wrong_pictures_are_refused(hip):
    for wrong in ({"view": "askew"}, {"colour": "red"}, {"fixed": "gone"}, {"width": 1}, {"range_mm": -1}, {"field_mm": np.nan}, {"field_mm": "some"}):
        with pytest.raises(condyle.UsageError):
            hip.picture({"flexion_deg": 0}, **wrong)
