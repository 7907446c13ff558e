"""Strokes of a brush on a bone."""

import pickle

import numpy as np
import pytest
from common import refused

import condyle
from condyle import BrushStroke

pytestmark = pytest.mark.filterwarnings("ignore::condyle.JointRemark")

MOTION = "internal_rotation_at_90_flexion"


@pytest.fixture(scope="module")
def cam():
    bones = condyle.sample_hip(alpha_angle_deg=70)
    return condyle.Joint(*bones)


def there(joint, body="mobile"):
    """The vertex at which the motion ends."""
    end = joint.range_of_motion()[MOTION].contact
    mesh, point = (joint.mobile, end.mobile_point) if body == "mobile" else (joint.fixed, end.fixed_point)
    return int(np.linalg.norm(mesh.vertices - point, axis=1).argmin())


def limit_of(limits, name=MOTION):
    return next(limit for limit in limits if limit.motion.name == name)


@pytest.mark.parametrize("body", ["mobile", "fixed"])
def test_a_stroke_lowers_the_bone_by_no_more_than_its_depth_and_gives_degrees(cam, body):
    done = cam.brushed([BrushStroke(there(cam, body), 8, 2)], body=body)
    before = cam.mobile if body == "mobile" else cam.fixed
    moved = np.linalg.norm(done.mesh.vertices - before.vertices, axis=1)
    assert 0 < moved.max() <= 2 + 1e-12
    assert (done.depth_mm[moved == 0] == 0).all() and (done.depth_mm <= moved + 1e-9).all()
    assert done.deepest_mm == done.depth_mm.max() and done.volume_mm3 > 0
    assert np.array_equal(done.mesh.triangles, before.triangles)
    assert limit_of(done.after).limit_deg > limit_of(done.before).limit_deg + 0.5
    assert done.strokes[0].moved == (moved > 0).sum()
    assert repr(done).startswith("Brushed(1 strokes; ")


def test_limits_before_are_those_of_the_joint_and_without_strokes_nothing_changes(cam):
    done = cam.brushed([])
    known = cam.range_of_motion()
    for before, after in zip(done.before, done.after):
        assert before.limit_deg == after.limit_deg == known[before.motion.name].limit_deg
    assert done.volume_mm3 == 0 and done.strokes == ()


def test_what_is_put_back_is_the_bone_as_it_was(cam):
    vertex = there(cam)
    done = cam.brushed([BrushStroke(vertex, 5, 2), BrushStroke([vertex], 12, action="restore")])
    assert np.array_equal(done.mesh.vertices, cam.mobile.vertices)
    assert done.deepest_mm == 0


def test_the_bearing_surface_and_what_is_kept_stay(cam):
    head = int(np.abs(cam.mobile.vertices - [0, 24, 0]).sum(axis=1).argmin())
    done = cam.brushed([BrushStroke(head, 10, 3)])
    assert done.strokes[0].kept > 0 and done.depth_mm[head] == 0
    kept = cam.brushed([BrushStroke(there(cam), 8, 2)], keep=np.ones(len(cam.mobile.vertices), bool))
    assert kept.volume_mm3 == 0 and kept.strokes[0].moved == 0


def test_results_are_kept_by_pickle(cam):
    done = cam.brushed([BrushStroke(there(cam))])
    again = pickle.loads(pickle.dumps(done))
    assert again.volume_mm3 == done.volume_mm3
    assert again.joint.range_of_motion()[MOTION].limit_deg == done.joint.range_of_motion()[MOTION].limit_deg


@pytest.mark.parametrize("strokes, said", [
    ([BrushStroke(10**6)], "along: "), ([BrushStroke([])], "brush: a stroke needs a vertex that it passes over"),
    ([BrushStroke(0, action="push")], "action: "), ([(0, 5, 1)], "strokes: a BrushStroke is needed, not tuple"),
])
def test_what_is_no_stroke_is_refused_in_one_line(cam, strokes, said):
    assert refused(lambda: cam.brushed(strokes)).startswith(said)
