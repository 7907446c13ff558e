"""Label maps, surfaces of arrays, and joints of bones that were segmented."""

import pickle

import numpy as np
import pytest
from common import refused, run_command

import condyle


@pytest.fixture(scope="module")
def scan(tmp_path_factory, sampled):
    return sampled(tmp_path_factory.mktemp("scan"), "hip", "--scenario", "2", "--voxel", "1.5")


@pytest.fixture(scope="module")
def labels(scan):
    return condyle.read_labels(scan / "labels.nii.gz")


@pytest.fixture(scope="module")
def hip(scan):
    return condyle.Joint.from_labels(scan / "labels.nii.gz", "hip_right", "femur_right", task="total")


def test_labels_are_listed(labels):
    assert [each.label for each in labels.labels] == [76, 78]
    assert labels.voxels().shape == labels.size
    assert [int((labels.voxels() == each.label).sum()) for each in labels.labels] == [each.voxels for each in labels.labels]
    assert (np.diag(labels.lps_from_index)[:3] == 1.5).all()


def test_surfaces_of_arrays_are_those_of_files(labels):
    of_file = labels.surface(76)
    of_array = condyle.surface(labels.voxels(), labels.lps_from_index, 76)
    assert (of_file.mesh.vertices == of_array.mesh.vertices).all()
    assert (of_file.mesh.triangles == of_array.mesh.triangles).all()
    assert of_array.voxels == of_file.voxels
    ras = np.diag([-1, -1, 1, 1]) @ labels.lps_from_index
    mirrored_twice = condyle.surface(labels.voxels(), ras, 76).mesh.vertices * (-1, -1, 1)
    assert np.abs(np.sort(mirrored_twice, axis=0) - np.sort(of_file.mesh.vertices, axis=0)).max() < 1e-9


def test_joints_are_those_that_the_command_proposes(scan, hip, tmp_path):
    run_command("init", scan / "labels.nii.gz", "--task", "total", "--fixed", "hip_right", "--mobile", "femur_right", "-o", tmp_path / "hip.toml")
    of_file = condyle.read_joint(tmp_path / "hip.toml")
    assert (of_file.mobile.vertices == hip.mobile.vertices).all() and (of_file.fixed.vertices == hip.fixed.vertices).all()
    assert of_file.name == hip.name and of_file.side == hip.side == "right"
    motions = ["flexion", "fadir"]
    ranges = of_file.range_of_motion(motions), hip.range_of_motion(motions)
    assert [limit.limit_deg for limit in ranges[0].limits] == [limit.limit_deg for limit in ranges[1].limits]
    bands = [each.bands(samples=20) for each in ranges]
    assert bands[0] == bands[1] != ranges[1].bands(samples=20, sigma_surface_mm=0.25)


def test_copies_keep_their_image(hip):
    copy = pickle.loads(pickle.dumps(hip))
    band, = hip.range_of_motion(["flexion"]).bands(samples=20)
    assert copy.range_of_motion(["flexion"]).bands(samples=20) == (band,)


def test_what_the_image_cuts_is_no_limit(labels):
    k = int(round((0 - labels.lps_from_index[2, 3]) / 1.5))
    cut = labels.voxels()[:, :, k - 30:k + 30]
    affine = labels.lps_from_index.copy()
    affine[2, 3] += 1.5 * (k - 30)
    bones = [condyle.surface(cut, affine, label) for label in (78, 76)]
    assert {(each.axis, each.side) for bone in bones for each in bone.cuts} == {("k", "first"), ("k", "last")}
    for bone in bones:
        for each in bone.cuts:
            corners = bone.mesh.vertices[bone.mesh.triangles[each.triangles]]
            assert np.abs(corners @ each.normal - each.offset_mm).max() < 1e-9
    joint = condyle.Joint(*bones, axes="LPS", centre="fit", side="right")
    assert [note.code for note in joint.notes].count("cut_by_view") == 2
    whole = condyle.Joint.from_labels(labels, "hip_right", "femur_right", task="total")
    with pytest.warns(condyle.JointWarning):
        shorter = joint.range_of_motion()
    for limit, other in zip(shorter.limits, whole.range_of_motion().limits):
        assert limit.limit_deg > other.limit_deg - 1, limit.motion.name
    ends = {limit.motion.name for limit in shorter.limits if limit.contact is not None and limit.contact.kind == "cut"}
    noted = [note.text for note in shorter.notes if note.code == "limit_on_cut"]
    assert all(any(name in text for text in noted) for name in ends) and bool(ends) == bool(noted)


@pytest.mark.parametrize("given, says", [
    (dict(labels=np.zeros((5, 5)), affine=np.eye(4)), "labels: an array of shape"),
    (dict(labels=np.zeros((5, 5, 5), int), affine=np.eye(4)), "labels: no voxel"),
    (dict(labels=np.ones((5, 5, 5)), affine=np.eye(4)), "labels: an array of shape"),
    (dict(labels=np.ones((5, 5, 5), int), affine=np.eye(3)), "affine: "),
    (dict(labels=np.ones((5, 5, 5), int), affine=np.zeros((4, 4))), "affine: "),
    (dict(labels=np.ones((5, 5, 5), int), affine=np.diag([0.0, 1, 1, 1])), "grid"),
    (dict(labels=np.ones((5, 5, 5), int), affine=np.eye(4), label=-1), "label: "),
    (dict(labels=np.ones((5, 5, 5), int), affine=np.eye(4), sigma_voxels=9), "sigma_voxels: "),
])
def test_bad_arrays_are_refused(given, says):
    refused(lambda: condyle.surface(**given), says)


def test_bad_labels_are_refused(labels, scan):
    refused(lambda: labels.surface("femur"), "femur")
    refused(lambda: condyle.Joint.from_labels(labels, 76, 76), "both bodies")
    refused(lambda: condyle.read_labels(scan / "femur.ply"), kind=condyle.FileError)
