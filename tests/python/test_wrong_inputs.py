"""Wrong inputs end in one line that says what is wrong, and nothing crashes."""

import gc
import math
from types import SimpleNamespace

import numpy as np
import pytest

import condyle

V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
T = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def reflected():
    return np.diag([1.0, 1.0, -1.0, 1.0])


CASES = {
    "flat vertices": (lambda hip: condyle.TriMesh(V.ravel(), T), condyle.UsageError, r"\(12,\)"),
    "two columns": (lambda hip: condyle.TriMesh(V[:, :2], T), condyle.UsageError, r"\(4, 2\)"),
    "masked vertices": (lambda hip: condyle.TriMesh(masked(V), T), condyle.UsageError, "vertices: a masked array"),
    "masked triangles": (lambda hip: condyle.TriMesh(V, masked(T)), condyle.UsageError, "triangles: a masked array"),
    "masked faces of another package": (lambda hip: condyle.inspect(SimpleNamespace(vertices=V, faces=masked(T))),
                                        condyle.UsageError, "faces: a masked array"),
    "a masked pose": (lambda hip: hip.penetration(masked(np.eye(4))), condyle.UsageError, "pose: a masked array"),
    "masked angles": (lambda hip: hip.pose(flexion_deg=masked(np.arange(3))), condyle.UsageError,
                      "pose: flexion_deg: a masked array"),
    "a masked centre": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, centre=masked(np.zeros(3))),
                        condyle.UsageError, "centre: a masked array"),
    "a masked number": (lambda hip: condyle.DepthRange(hip, np.ma.masked), condyle.UsageError,
                        "allowed_depth_mm: a masked array"),
    "masked points of a table": (lambda hip: condyle.RadialTable(hip.fixed).query(masked(V)), condyle.UsageError,
                                 "masked array"),
    "masked thicknesses": (lambda hip: condyle.ElasticContact(hip.fixed, hip.mobile, fixed_layer=condyle.ElasticLayer(
        1, 0.3, masked(np.ones(len(hip.fixed.vertices))))), condyle.UsageError, "masked array"),
    "complex vertices": (lambda hip: condyle.TriMesh(V + 1j, T), condyle.UsageError, "complex128"),
    "vertices of text": (lambda hip: condyle.TriMesh(V.astype(str), T), condyle.UsageError, "real numbers"),
    "ragged vertices": (lambda hip: condyle.TriMesh([[0, 0, 0], [1, 0]], T), condyle.UsageError, "vertices"),
    "a vertex that is no number": (lambda hip: condyle.TriMesh(np.where(V == 1, np.nan, V), T), condyle.MeshError,
                                   "vertex 1"),
    "triangles of floats": (lambda hip: condyle.TriMesh(V, T.astype(float)), condyle.UsageError, "integers"),
    "an index too high": (lambda hip: condyle.TriMesh(V, T + 1), condyle.MeshError, "triangle 1 uses vertex 4 of 4"),
    "a negative index": (lambda hip: condyle.TriMesh(V, T - 1), condyle.MeshError, "triangle 0 uses vertex -1 of 4"),
    "an index beyond int64": (lambda hip: condyle.TriMesh(V, np.full((1, 3), 2**64 - 1, np.uint64)), condyle.UsageError,
                              "beyond"),
    "no mesh at all": (lambda hip: condyle.inspect(3), condyle.UsageError, "int is none"),
    "no such file": (lambda hip: condyle.read_mesh("nowhere.stl"), condyle.FileError, "nowhere.stl: no such file"),
    "a closed file": (lambda hip: condyle.read_mesh(closed_file()), condyle.UsageError, "path"),
    "no such joint": (lambda hip: condyle.read_joint("nowhere.toml"), condyle.FileError, "nowhere.toml"),
    "a path with 0": (lambda hip: condyle.read_mesh("a\0b.stl"), condyle.UsageError, "character 0"),
    "a 3 x 3 pose": (lambda hip: hip.penetration(np.eye(3)), condyle.UsageError, r"\(3, 3\)"),
    "a pose of NaN": (lambda hip: hip.penetration(np.full((4, 4), math.nan)), condyle.UsageError, "finite"),
    "a pose that scales": (lambda hip: hip.pairs(np.diag([2.0, 2, 2, 1])), condyle.UsageError, "orthonormal"),
    "a reflection": (lambda hip: hip.in_contact(reflected()), condyle.UsageError, "reflection"),
    "one bad pose among many": (lambda hip: hip.penetration([np.eye(4), np.zeros((4, 4))]), condyle.UsageError,
                                "pose 1"),
    "an unknown angle": (lambda hip: hip.pose(flexoin_deg=3), condyle.UsageError, "flexoin_deg"),
    "an angle given twice": (lambda hip: hip.pose(flexion_deg=3, extension_deg=3), condyle.UsageError, "twice"),
    "angles of different lengths": (lambda hip: hip.pose(flexion_deg=[1, 2], adduction_deg=[1, 2, 3]),
                                    condyle.UsageError, "2, 3"),
    "an infinite angle": (lambda hip: hip.pose(flexion_deg=math.inf), condyle.UsageError, "finite"),
    "a reference pose of two angles": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, reference_pose={
        "flexion": [10, 20]}), condyle.UsageError, "reference_pose: flexion is a number"),
    "a waypoint of two angles": (lambda hip: hip.path_limit([{}, {"flexion": [10, 20]}]), condyle.UsageError,
                                 "waypoints: flexion is a number"),
    "waypoints that are no list": (lambda hip: hip.path_limit(3), condyle.UsageError, "waypoints: .* not int"),
    "a waypoint that is no mapping": (lambda hip: hip.path_limit([3, 4]), condyle.UsageError, "waypoints: .* not int"),
    "rows of different lengths for a soup": (lambda hip: soup_table().update([[0, 0, 0], [1, 0]]), condyle.UsageError,
                                             r"vertices: an array of shape \(12, 3\) is needed"),
    "samples beyond memory": (lambda hip: hip.range_of_motion([]).bands(samples=2**31 - 1), condyle.UsageError,
                              "samples: 2147483647 is not in 20 to 100000"),
    "a complex centre": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, centre=[1j, 0, 0]), condyle.UsageError,
                         "centre: three numbers are needed"),
    "a landmark named by a line end": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, landmarks={"\n": ""}),
                                       condyle.UsageError, r"landmarks: '\\n': three numbers"),
    "a measure named by a line end": (lambda hip: condyle.sample_hip(**{"\n": 1}), condyle.UsageError,
                                      r"measure of the hip: no '\\n'"),
    "a ball of one number": (lambda hip: condyle.find_sphere(hip.mobile, within=3), condyle.UsageError,
                             "within: a centre and a radius are needed"),
    "a frame of two poses": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, fixed_in_W=[np.eye(4)] * 2),
                             condyle.UsageError, r"fixed_in_W: an array of shape \(4, 4\) is needed, not \(2, 4, 4\)"),
    "no frame": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, mobile_in_W=np.empty((0, 4, 4))),
                 condyle.UsageError, "mobile_in_W: an array"),
    "an unknown method": (lambda hip: hip.penetration(np.eye(4), "magic"), condyle.UsageError, "magic"),
    "about without a circle": (lambda hip: hip.penetration(np.eye(4), about="flexion"), condyle.UsageError, "about"),
    "a circle of a translated pose": (lambda hip: hip.penetration(translated(), "tangential"), condyle.UsageError,
                                      "translated"),
    "an unknown motion": (lambda hip: hip.range_of_motion(["flexoin"]), condyle.UsageError, "flexoin"),
    "a grid without step": (lambda hip: hip.range_of_motion([]).map({"flexion": (0, 9, 0)}, {"adduction": (0, 9, 9)}),
                            condyle.UsageError, "step"),
    "a grid of one angle": (lambda hip: hip.range_of_motion([]).map({"flexion": (0, 9, 9)}, {"flexion": (0, 9, 9)}),
                            condyle.UsageError, "one is named twice"),
    "a grid beyond memory": (lambda hip: hip.range_of_motion([]).map({"flexion": (0, 99, 1e-4)},
                                                                     {"adduction": (0, 99, 1e-4)}),
                             condyle.UsageError, "980101980001 points are more than"),
    "few samples": (lambda hip: hip.range_of_motion([]).bands(samples=3), condyle.UsageError, "samples: 3 is not in"),
    "a progress that is none": (lambda hip: hip.pairs(np.eye(4), progress=3), condyle.UsageError, "progress"),
    "times that do not ascend": (lambda hip: hip.recorded_contact([1, 0], [np.eye(4)] * 2), condyle.UsageError,
                                 "sample 1: its time is not after"),
    "times for other poses": (lambda hip: hip.recorded_contact([0, 1, 2], [np.eye(4)] * 2), condyle.UsageError,
                              "3 times and 2 poses"),
    "an open surface asked for its inside": (lambda hip: condyle.RadialTable((V + 1, T[:3])).query(V),
                                             condyle.MeshError, "the surface is open"),
    "a centre on the surface": (lambda hip: condyle.RadialTable((V, T)), condyle.MeshError,
                                "the joint centre lies on the surface, in triangle 0"),
    "another number of vertices": (lambda hip: condyle.RadialTable((V - 0.1, T)).update(V[:3]), condyle.UsageError,
                                   "update of 4 vertices gives 3"),
    "a vertex that is no vertex": (lambda hip: condyle.RadialTable((V - 0.1, T)).update(V[:1], moved=[9]),
                                   condyle.UsageError, "vertex 9 of 4"),
    "an axis without direction": (lambda hip: condyle.RingTable((V, T), [0, 0, 0], [0, 0, 0]), condyle.UsageError,
                                  "its direction is zero"),
    "an axis beyond all bounds": (lambda hip: condyle.RingTable((V, T), [1e308, 0, 0], [0, 0, 1]), condyle.UsageError,
                                  "beyond 1e30 mm"),
    "a mesh beyond all bounds": (lambda hip: condyle.RingTable((1e307 * V, T), [0, 0, 0], [0, 0, 1]),
                                 condyle.MeshError, "beyond 1e30"),
    "a hinge asked beside its axis": (lambda hip: hinge(hip).range_of_motion([]).free_angles("adduction"),
                                      condyle.UsageError, "vary: a hinge rotates in flexion only"),
    "a hinge started beside its axis": (lambda hip: hinge(hip).range_of_motion([]).contact_set(
        "flexion", {"adduction": 3}), condyle.UsageError, "start_deg: a hinge rotates in flexion only"),
    "a hinge placed beside its axis": (lambda hip: condyle.DepthRange(hinge(hip), 1.0).deepest({"adduction": 3}),
                                       condyle.UsageError, "start_deg: a hinge rotates in flexion only"),
    "a hinge given beside its axis": (lambda hip: condyle.Joint(
        hip.fixed, hip.mobile, kind="hinge", joint="knee", reference_pose={"adduction": 3}), condyle.UsageError,
                                      "reference_pose: a hinge rotates in flexion only"),
    "a hinge of a shoulder": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, kind="hinge", joint="shoulder"),
                              condyle.UsageError, "a shoulder is no hinge"),
    "a ball that translates": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, translation_frame="joint_axes"),
                               condyle.UsageError, "a ball does not translate"),
    "a moment that nothing balances": (lambda hip: condyle.ElasticContact(
        hip.fixed, hip.mobile, fixed_layer=condyle.ElasticLayer(1, 0.3, 1)).balance([0, 1, 0], moment_nmm=[1, 0, 0]),
                                       condyle.UsageError, "moment_nmm: needs free_rotations"),
    "no layer": (lambda hip: condyle.ElasticContact(hip.fixed, hip.mobile), condyle.UsageError,
                 "one of them needs a layer"),
    "a layer like rubber": (lambda hip: condyle.ElasticContact(
        hip.fixed, hip.mobile, fixed_layer=condyle.ElasticLayer(1, 0.5, 1)), condyle.UsageError,
                            "Poisson's ratio must be"),
    "thicknesses of another mesh": (lambda hip: condyle.ElasticContact(
        hip.fixed, hip.mobile, fixed_layer=condyle.ElasticLayer(1, 0.3, np.ones(3))), condyle.UsageError,
                                    "3 thicknesses for 4884 vertices"),
    "a head beyond its range": (lambda hip: condyle.sample_hip(head_radius_mm=100), condyle.UsageError, "head"),
    "an unknown measure": (lambda hip: condyle.sample_hip(haed_radius_mm=24), condyle.UsageError, "haed"),
    "a flat sphere": (lambda hip: condyle.fit_sphere(V[:3]), condyle.MeshError, "at least 4 vertices, not 3"),
    "an unknown side": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, side="up"), condyle.UsageError, "up"),
    "axes that are none": (lambda hip: condyle.Joint(hip.fixed, hip.mobile, anterior=[1, 1, 0], superior=[0, 1, 0]),
                           condyle.UsageError, "anterior has length 1.41421, not 1"),
}


def masked(values):
    return np.ma.masked_array(values, mask=np.arange(np.size(values)).reshape(np.shape(values)) == 1)


def soup_table():
    centred = V - 0.1
    return condyle.RadialTable((centred[T].reshape(-1, 3), np.arange(12).reshape(-1, 3)))


def hinge(hip):
    return condyle.Joint(hip.fixed, hip.mobile, kind="hinge", joint="knee")


def closed_file():
    with open(__file__) as file:
        pass
    return file


def translated():
    pose = np.eye(4)
    pose[0, 3] = 1
    return pose


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_input_is_one_line(case, hip):
    act, kind, says = CASES[case]
    with pytest.raises(kind, match=says) as raised:
        act(hip)
    assert "\n" not in str(raised.value) and 0 < len(str(raised.value)) < 400
    assert issubclass(condyle.FileError, OSError) and issubclass(condyle.MeshError, ValueError)
    assert issubclass(condyle.UsageError, ValueError)


def test_answers_outlive_all_that_they_were_made_of():
    bones = condyle.sample_hip(scenario=1)
    joint = condyle.Joint(bones.hip_bone, bones.femur)
    poses = joint.pose(flexion_deg=[140, 145])
    many = joint.penetration(poses)
    expected = [each.mobile.depth_mm.tolist() for each in many]
    views = [many[n].mobile.depth_mm for n in range(2)]
    pairs = joint.pairs(poses)[1]
    faces = joint.normal_contact(poses[0], casting="mobile").mobile.area_mm2
    copies = pairs.copy(), faces.copy()
    del bones, joint, poses, many
    gc.collect()
    condyle.sample_hip(scenario=1)  # writes over freed memory
    assert [view.tolist() for view in views] == expected
    np.testing.assert_array_equal(pairs, copies[0])
    np.testing.assert_array_equal(faces, copies[1])


def test_arrays_freed_after_the_call_do_not_matter():
    bones = condyle.sample_hip(scenario=1)
    vertices = np.array(bones.femur.vertices)
    mesh = condyle.TriMesh(vertices, bones.femur.triangles)
    table = condyle.RadialTable(mesh)
    before = table.query(bones.hip_bone.vertices).gap_mm
    table.update(vertices)
    vertices[:] = np.nan
    del vertices
    gc.collect()
    np.testing.assert_array_equal(table.query(bones.hip_bone.vertices).gap_mm, before)


def test_no_angles_are_no_poses(hip):
    assert hip.pose(flexion_deg=[]).shape == (0, 4, 4)
    assert len(hip.penetration(hip.pose(flexion_deg=[]))) == 0


def test_a_refused_update_leaves_the_table_as_it_was():
    table = condyle.RadialTable((V - 0.1, T))
    before = table.query([[0.3, 0.3, 0.3]]).gap_mm
    with pytest.raises(condyle.MeshError):
        table.update(V)  # a corner in the origin
    np.testing.assert_array_equal(table.query([[0.3, 0.3, 0.3]]).gap_mm, before)
