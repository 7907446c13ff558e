"""C++, the command line and Python give the same doubles at random poses of three scenes."""

import os
import re
import subprocess

import numpy as np
import pytest
from common import json_of_command

import condyle

LONG = bool(os.environ.get("CONDYLE_LONG_TESTS"))
SCENES = {"coarse hip": ["hip"], "hip": ["hip", "--scenario", "2"],
          "cartilages that overlap": ["cartilages", "--scenario", "5", "--clearance", "-0.3"]}


@pytest.fixture(scope="module", params=SCENES)
def scene(request, sampled, tmp_path_factory):
    folder = sampled(tmp_path_factory.mktemp("scene"), *SCENES[request.param])
    path, = folder.glob("*.toml")
    return path, condyle.read_joint(path)


def random_angles(count):
    random = np.random.default_rng(14)
    return {"flexion_deg": random.uniform(-30, 150, count), "adduction_deg": random.uniform(-60, 50, count),
            "internal_rotation_deg": random.uniform(-80, 80, count)}


def test_python_gives_the_doubles_of_cpp(scene, tmp_path):
    path, joint = scene
    poses = joint.pose(**random_angles(1000))
    poses.tofile(tmp_path / "poses")
    subprocess.run([os.environ["CONDYLE_REFERENCE"], path, tmp_path / "poses", tmp_path / "answers"], check=True)
    expected = np.fromfile(tmp_path / "answers")

    found = []

    def add(values):
        values = np.asarray(values, float).ravel()
        found.append([float(len(values))])
        found.append(values)

    inside = 0
    for n, (penetration, pairs) in enumerate(zip(joint.penetration(poses), joint.pairs(poses))):
        inside += len(penetration.mobile) > 0
        for body in (penetration.mobile, penetration.fixed):
            add(body.vertex)
            add(body.depth_mm)
        add(pairs)
        if n % 10 == 0:
            for gaps in (joint.gaps(poses[n]), joint.gaps(poses[n], "tangential")):
                add(gaps.mobile.gap_mm)
                add(gaps.fixed.gap_mm)
            cast = joint.normal_contact(poses[n], casting="mobile").mobile
            add(np.column_stack([cast.face, cast.area_mm2, cast.max_depth_mm, cast.overlap_mm3]))
    found = np.concatenate(found)
    assert inside > 100
    assert found.tobytes() == expected.tobytes()


def test_one_pose_gives_what_it_gives_among_many(scene):
    _, joint = scene
    poses = joint.pose(**random_angles(300))  # more than are computed at once
    for method in ("radial", "tangential"):
        for n, among in enumerate(joint.penetration(poses, method)):
            if n % 7 == 0:
                alone = joint.penetration(poses[n], method)
                for one, other in ((alone.mobile, among.mobile), (alone.fixed, among.fixed)):
                    for name, values in one._columns().items():
                        np.testing.assert_array_equal(values, getattr(other, name))
    np.testing.assert_array_equal(joint.in_contact(poses), [joint.in_contact(pose) for pose in poses])


@pytest.mark.parametrize("method", ["radial", "tangential", "normal", "reliable"])
def test_the_command_gives_the_doubles_of_python(scene, method):
    path, joint = scene
    angles = random_angles(1000 if LONG else 8)
    for degrees in zip(*angles.values()):
        named = dict(zip(angles, degrees))
        pose = " ".join(f"{name[:-4]}={float(value)!r}" for name, value in named.items())
        said = json_of_command("depth", path, "--pose", pose, "--method", method)
        compare = {"radial": compare_inside, "tangential": compare_inside, "normal": compare_normal, "reliable": compare_reliable}[method]
        compare(said, joint, named, method)


def compare_inside(said, joint, named, method):
    found = joint.penetration(named, method)
    for name, body in (("mobile", found.mobile), ("fixed", found.fixed)):
        theirs = said["bodies"][name]
        assert theirs["vertices_inside"] == (body.state == condyle.INSIDE).sum()
        finite = body.depth_mm[np.isfinite(body.depth_mm)]
        assert theirs[f"max_{method}_depth_mm"] == (finite.max() if len(finite) else 0)
        if method == "radial" and len(body):
            assert theirs["deepest_vertex"] == body.deepest
    assert said["triangle_pairs"] == len(joint.pairs(named))
    assert said["in_contact"] == joint.in_contact(named)


def compare_reliable(said, joint, named, method):
    found = joint.depths(named)
    assert said["vertices_without_depth"] == found.mobile.without + found.fixed.without
    deepest = said["reliable_depth"]
    depths = {name: 0 if body.deepest is None else body.depth_mm[body.deepest] for name, body in (("mobile", found.mobile), ("fixed", found.fixed))}
    assert (0 if deepest is None else deepest["depth_mm"]) == max(depths.values())
    if deepest is not None:
        assert deepest["vertex"] == getattr(found, deepest["body"]).deepest
    measures = joint.contact_measures(named)
    assert said["nearest_distance_mm"] == measures.smallest_gap_mm
    assert said["contact"]["volume_mm3"] == measures.volume_mm3
    assert said["contact"]["volume_error_mm3"] == measures.volume_error_mm3
    if measures.volume_mm3 is not None:  # its bound is rounded up in words
        in_words = float(re.search(r"to within (.+?)[;)]", repr(measures))[1])
        assert measures.volume_error_mm3 <= in_words <= 2 * measures.volume_error_mm3
    assert said["contact"]["mobile"]["area_mm2"] == measures.mobile.area_mm2
    assert said["contact"]["fixed"]["mean_depth_mm"] == measures.fixed.mean_depth_mm


def compare_normal(said, joint, named, method):
    found = joint.normal_contact(named)
    for name, body in (("mobile", found.mobile), ("fixed", found.fixed)):
        theirs = said["bodies"][name]
        assert theirs["triangles_in_contact"] == body.totals.triangles == len(body)
        assert theirs["area_mm2"] == body.totals.area_mm2
        assert theirs["max_normal_depth_mm"] == body.totals.max_depth_mm
