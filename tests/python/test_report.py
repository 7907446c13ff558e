"""Reports and pictures hold what the command's hold."""

import pickle
import warnings

import numpy as np
import pytest
from common import box, changed, refused, run_command, text_of

import condyle


def reports(folder, ours, *theirs, from_files=True, **written):
    """What a range of motion writes and what the command does, but for its name, or for all of where it comes from."""
    ours.write_report(folder / "ours.html", **written)
    run_command("report", *theirs, "--out", folder / "theirs.html")
    texts = [text_of(folder / f"{whose}.html") for whose in ("ours", "theirs")]
    for text in texts:
        del text["rom"]["provenance"]["command"]
        if not from_files:
            del text["rom"]["provenance"]
    return texts


def test_a_report_is_that_of_the_command_but_for_its_name(hip, hip_file, tmp_path):
    ours, theirs = reports(tmp_path, hip.range_of_motion(), hip_file, "--band=20", "--past", "5", band_samples=20, past_deg=5)
    assert ours == theirs


def test_a_report_shows_shape_and_plan_as_the_command_does(tmp_path, sampled):
    joint = condyle.read_joint(sampled(tmp_path, "hip", "--alpha-angle", "70") / "hip.toml")
    with pytest.warns(condyle.JointRemark):
        plan = joint.resection({"internal_rotation_at_90_flexion": 45}, curve_points=1, margin_mm=0)
    ours, said = reports(tmp_path, plan.joint.range_of_motion(), tmp_path / "hip.toml", "--measures", "--curve", "1", "--margin", "0", "--resect",
                         "internal_rotation_at_90_flexion=45", from_files=False, measures=True, plan=plan)
    assert ours == said and said["plan"]["cuts"][0]["volume_mm3"] == plan.volume_mm3
    refused(lambda: joint.range_of_motion(["flexion"]).write_report(tmp_path / "other.html", plan=plan), "plan.joint")
    again = pickle.loads(pickle.dumps(plan))
    assert again.volume_mm3 == plan.volume_mm3
    refused(lambda: again.joint.range_of_motion(["flexion"]).write_report(tmp_path / "other.html", plan=again), "pickled")


def test_a_report_shows_the_safe_zone_of_a_sweep_as_the_command_does(tmp_path, sampled):
    sampled(tmp_path, "replacement")
    targets = tmp_path / "targets.csv"
    targets.write_text("name,motion,reach_deg\nsitting,flexion,110\npivoting,external_rotation,40\n")
    joint = condyle.read_joint(tmp_path / "hip.toml")
    zone = joint.sweep({"cup.inclination": (30, 60, 10), "cup.anteversion": (0, 30, 10)}, targets)
    ours, said = reports(tmp_path, joint.range_of_motion(), tmp_path / "hip.toml", "--sweep", "cup.inclination=30:60:10 cup.anteversion=0:30:10",
                         "--targets", targets, from_files=False, sweep=zone)
    assert ours == said and said["sweep"]["safe_designs"] == zone.safe.sum()
    other = joint.with_parameters({"cup.inclination": 45}).range_of_motion(["flexion"])
    refused(lambda: other.write_report(tmp_path / "other.html", sweep=zone), "sweep: it is that of another joint")
    refused(lambda: other.write_report(tmp_path / "other.html", sweep=1), "sweep: a condyle.Sweep is needed, not int")


def test_a_report_compares_joints_as_the_command_does(sampled, hip, hip_file, tmp_path):
    for folder, cam in (("before", []), ("left", ["--side", "left"])):
        sampled(tmp_path / folder, "hip", *cam)
    before_file = tmp_path / "before" / "hip.toml"
    before, rom = condyle.read_joint(before_file), hip.range_of_motion()
    ours, theirs = reports(tmp_path, rom, before_file, hip_file, "--band=20", band_samples=20, before=before)
    for text in (theirs, ours):
        del text["before"]["rom"]["provenance"]["command"]
    # The command read the files of the joint before, too; Python is given joints.
    read = theirs["rom"]["provenance"].pop("other_files")
    assert {file["path"] for file in read} == {"hip.toml", "hip_bone.ply", "femur.ply"}
    assert ours == theirs
    limits = before.range_of_motion().limits
    assert [motion["limit_deg"] for motion in ours["before"]["rom"]["motions"]] == [limit.limit_deg for limit in limits]
    refused(lambda: rom.write_report(tmp_path / "other.html", before=condyle.read_joint(tmp_path / "left" / "hip.toml")),
            "the same kind, anatomy and side")
    refused(lambda: rom.write_report(tmp_path / "other.html", before=str(before_file)), "before: a joint is needed, not str")
    (tmp_path / "before.html").hardlink_to(before_file)
    refused(lambda: rom.write_report(tmp_path / "before.html", before=before), "is read for this answer", condyle.FileError)
    assert not (tmp_path / "other.html").exists()


def test_a_report_has_the_motions_asked_for_and_the_title_given(hip, tmp_path):
    rom = hip.range_of_motion(["flexion", "fadir"])
    rom.write_report(tmp_path / "hip.html", title="Hip & <more>")
    text = text_of(tmp_path / "hip.html")
    assert text["title"] == "Hip & <more>"
    assert [motion["limit_deg"] for motion in text["rom"]["motions"]] == [limit.limit_deg for limit in rom.limits]
    assert text["zones"] == []


def test_a_report_plays_a_motion_and_has_pressure_as_the_command_does(coarse_hip_file, tmp_path):
    joint_file = changed(coarse_hip_file, tmp_path, more='[contact]\ncasting = "fixed"\n[contact.fixed]\nyoungs_modulus_mpa = 12\n'
                         "poisson_ratio = 0.45\nthickness = 2\n")
    swing = tmp_path / "swing.csv"
    swing.write_text("time,flexion_deg\n0,0\n0.1,10\n0.2,\n0.3,30\n")
    rom = condyle.read_joint(joint_file).range_of_motion()
    with pytest.warns(condyle.JointWarning):
        ours, theirs = reports(tmp_path, rom, joint_file, "--motion", swing, "--load", motion=swing, load=True)
    assert ours == theirs and ours["recorded"]["name"] == "swing.csv" and ours["layers"]["fixed"]["poisson_ratio"] == 0.45
    refused(lambda: rom.write_report(tmp_path / "other.html", motion=tmp_path / "none.csv"), "none.csv", condyle.FileError)
    assert not (tmp_path / "other.html").exists()


def test_a_joint_of_arrays_has_a_report_without_files(tmp_path, coarse_bones):
    rom = condyle.Joint(*coarse_bones, name="made of arrays").range_of_motion(["flexion"])
    rom.write_report(tmp_path / "hip.html")
    text = text_of(tmp_path / "hip.html")
    assert text["title"] == "made of arrays"
    assert text["rom"]["provenance"] is None


def test_a_report_without_what_was_asked_for_is_none(tmp_path):
    # A face of the mobile body runs through the joint centre: it has limits, and no zones.
    arm, post = box((-3, -100, -5), (4, 0, 6)), box((40, -80, -10), (60, -60, 10))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", condyle.JointWarning)
        rom = condyle.Joint(post, arm).range_of_motion(["flexion"])
    refused(lambda: rom.write_report(tmp_path / "arm.html", past_deg=5), "joint centre lies on the surface", condyle.MeshError)
    assert not (tmp_path / "arm.html").exists()


def test_a_report_that_cannot_be_written_leaves_nothing(hip, tmp_path):
    rom = hip.range_of_motion(["flexion"])
    refused(lambda: rom.write_report(tmp_path), kind=condyle.FileError)
    refused(lambda: rom.write_report(tmp_path / "hip.pdf"), "a page is written, FILE.html")
    for wrong, words in (({"band_samples": 3}, "band_samples"), ({"past_deg": -1}, "past"), ({"load": True}, "no layers")):
        refused(lambda: rom.write_report(tmp_path / "hip.html", **wrong), words)
    assert list(tmp_path.iterdir()) == []


def test_a_picture_is_that_of_the_command(hip, hip_file, tmp_path):
    image = pytest.importorskip("matplotlib.image")
    run_command("picture", hip_file, "--pose", "flexion=140", "--view", "lateral", "--hide", "fixed", "--size", "320x240", "--measures", "--out",
                tmp_path / "hip.png")
    theirs = np.round(255 * image.imread(tmp_path / "hip.png")[:, :, :3]).astype(np.uint8)
    drawn = {"view": "lateral", "fixed": "hidden", "width": 320, "height": 240, "measures": True}
    ours = hip.picture({"flexion_deg": 140}, **drawn)
    assert ours.dtype == np.uint8 and np.array_equal(ours, theirs)
    assert not np.array_equal(hip.picture({"flexion_deg": 140}, field_mm="all", **drawn), ours)


def test_wrong_pictures_are_refused(hip):
    for wrong in ({"view": "askew"}, {"colour": "red"}, {"fixed": "gone"}, {"width": 1}, {"range_mm": -1}, {"field_mm": np.nan}, {"field_mm": "some"}):
        refused(lambda: hip.picture({"flexion_deg": 0}, **wrong))
