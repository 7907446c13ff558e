"""Wrong inputs end in one line that says what is wrong, and nothing crashes."""

import gc
import math
from types import SimpleNamespace

import numpy as np
import pytest
from common import CORNERS as V
from common import FACES as T
from common import lifted, refused, soup

import condyle

TETRAHEDRON = condyle.TriMesh(V - 0.1, T)

CASES = {
    "flat vertices": (lambda hip: condyle.TriMesh(V.ravel(), T), r"\(12,\)"),
    "two columns": (lambda hip: condyle.TriMesh(V[:, :2], T), r"\(4, 2\)"),
    "masked vertices": (lambda hip: condyle.TriMesh(masked(V), T), "vertices: a masked array"),
    "masked triangles": (lambda hip: condyle.TriMesh(V, masked(T)), "triangles: a masked array"),
    "masked faces of another package": (lambda hip: condyle.inspect(SimpleNamespace(vertices=V, faces=masked(T))), "faces: a masked array"),
    "a masked pose": (lambda hip: hip.penetration(masked(np.eye(4))), "pose: a masked array"),
    "masked angles": (lambda hip: hip.pose(flexion_deg=masked(np.arange(3))), "pose: flexion_deg: a masked array"),
    "a masked centre": (lambda hip: joint(hip, centre=masked(np.zeros(3))), "centre: a masked array"),
    "a masked number": (lambda hip: condyle.DepthRange(hip, np.ma.masked), "allowed_depth_mm: a masked array"),
    "masked points of a table": (lambda hip: condyle.RadialTable(hip.fixed).query(masked(V)), "masked array"),
    "masked thicknesses": (lambda hip: pressed(hip, 1, 0.3, masked(np.ones(len(hip.fixed.vertices)))), "masked array"),
    "complex vertices": (lambda hip: condyle.TriMesh(V + 1j, T), "complex128"),
    "vertices of text": (lambda hip: condyle.TriMesh(V.astype(str), T), "real numbers"),
    "ragged vertices": (lambda hip: condyle.TriMesh([[0, 0, 0], [1, 0]], T), "vertices"),
    "a vertex that is no number": (lambda hip: condyle.TriMesh(np.where(V == 1, np.nan, V), T), "vertex 1", condyle.MeshError),
    "triangles of floats": (lambda hip: condyle.TriMesh(V, T.astype(float)), "integers"),
    "an index too high": (lambda hip: condyle.TriMesh(V, T + 1), "triangle 1 uses vertex 4 of 4", condyle.MeshError),
    "a negative index": (lambda hip: condyle.TriMesh(V, T - 1), "triangle 0 uses vertex -1 of 4", condyle.MeshError),
    "an index beyond int64": (lambda hip: condyle.TriMesh(V, np.full((1, 3), 2**64 - 1, np.uint64)), "beyond"),
    "no mesh at all": (lambda hip: condyle.inspect(3), "int is none"),
    "no such file": (lambda hip: condyle.read_mesh("nowhere.stl"), "nowhere.stl: no such file", condyle.FileError),
    "a closed file": (lambda hip: condyle.read_mesh(closed_file()), "path"),
    "a path with 0": (lambda hip: condyle.read_mesh("a\0b.stl"), "character 0"),
    "a 3 x 3 pose": (lambda hip: hip.penetration(np.eye(3)), r"\(3, 3\)"),
    "a pose of NaN": (lambda hip: hip.penetration(np.full((4, 4), math.nan)), "finite"),
    "a reflection": (lambda hip: hip.in_contact(np.diag([1.0, 1.0, -1.0, 1.0])), "reflection"),
    "one bad pose among many": (lambda hip: hip.penetration([np.eye(4), np.zeros((4, 4))]), "pose 1"),
    "an angle given twice": (lambda hip: hip.pose(flexion_deg=3, extension_deg=3), "twice"),
    "angles of different lengths": (lambda hip: hip.pose(flexion_deg=[1, 2], adduction_deg=[1, 2, 3]), "2, 3"),
    "an infinite angle": (lambda hip: hip.pose(flexion_deg=math.inf), "finite"),
    "a reference pose of two angles": (lambda hip: joint(hip, reference_pose={"flexion": [10, 20]}), "reference_pose: flexion is a number"),
    "a waypoint of two angles": (lambda hip: hip.path_limit([{}, {"flexion": [10, 20]}]), "waypoints: flexion is a number"),
    "waypoints that are no list": (lambda hip: hip.path_limit(3), "waypoints: .* not int"),
    "a waypoint that is no mapping": (lambda hip: hip.path_limit([3, 4]), "waypoints: .* not int"),
    "rows of different lengths for a soup": (lambda hip: condyle.RadialTable(soup(TETRAHEDRON)).update([[0, 0, 0], [1, 0]]),
                                             r"vertices: an array of shape \(12, 3\) is needed"),
    "samples beyond memory": (lambda hip: hip.range_of_motion([]).bands(samples=2**31 - 1), "samples: 2147483647 is not in 20 to 100000"),
    "a complex centre": (lambda hip: joint(hip, centre=[1j, 0, 0]), "centre: three numbers are needed"),
    "a landmark named by a line end": (lambda hip: joint(hip, landmarks={"\n": ""}), r"landmarks: '\\n': three numbers"),
    "a measure named by a line end": (lambda hip: condyle.sample_hip(**{"\n": 1}), r"measure of the hip: no '\\n'"),
    "a ball of one number": (lambda hip: condyle.find_sphere(hip.mobile, within=3), "within: a centre and a radius are needed"),
    "a frame of two poses": (lambda hip: joint(hip, fixed_in_W=[np.eye(4)] * 2),
                             r"fixed_in_W: an array of shape \(4, 4\) is needed, not \(2, 4, 4\)"),
    "no frame": (lambda hip: joint(hip, mobile_in_W=np.empty((0, 4, 4))), "mobile_in_W: an array"),
    "an unknown method": (lambda hip: hip.penetration(np.eye(4), "magic"), "magic"),
    "about without a circle": (lambda hip: hip.penetration(np.eye(4), about="flexion"), "about"),
    "a circle of a translated pose": (lambda hip: hip.penetration(lifted(1), "tangential"), "translated"),
    "a grid without step": (lambda hip: hip.range_of_motion([]).map({"flexion": (0, 9, 0)}, {"adduction": (0, 9, 9)}), "step"),
    "a progress that is none": (lambda hip: hip.pairs(np.eye(4), progress=3), "progress"),
    "an open surface asked for its inside": (lambda hip: condyle.RadialTable((V + 1, T[:3])).query(V), "the surface is open", condyle.MeshError),
    "a centre on the surface": (lambda hip: condyle.RadialTable((V, T)), "the joint centre lies on the surface, in triangle 0", condyle.MeshError),
    "another number of vertices": (lambda hip: condyle.RadialTable(TETRAHEDRON).update(V[:3]), "update of 4 vertices gives 3"),
    "a vertex that is no vertex": (lambda hip: condyle.RadialTable(TETRAHEDRON).update(V[:1], moved=[9]), "vertex 9 of 4"),
    "an axis without direction": (lambda hip: condyle.RingTable((V, T), [0, 0, 0], [0, 0, 0]), "its direction is zero"),
    "an axis beyond all bounds": (lambda hip: condyle.RingTable((V, T), [1e308, 0, 0], [0, 0, 1]), "beyond 1e30 mm"),
    "a mesh beyond all bounds": (lambda hip: condyle.RingTable((1e307 * V, T), [0, 0, 0], [0, 0, 1]), "beyond 1e30", condyle.MeshError),
    "a hinge asked beside its axis": (lambda hip: hinge(hip).range_of_motion([]).free_angles("adduction"), "vary: a hinge rotates in flexion only"),
    "a hinge started beside its axis": (lambda hip: hinge(hip).range_of_motion([]).contact_set("flexion", {"adduction": 3}),
                                        "start_deg: a hinge rotates in flexion only"),
    "a hinge placed beside its axis": (lambda hip: condyle.DepthRange(hinge(hip), 1.0).deepest({"adduction": 3}),
                                       "start_deg: a hinge rotates in flexion only"),
    "a hinge given beside its axis": (lambda hip: hinge(hip, reference_pose={"adduction": 3}), "reference_pose: a hinge rotates in flexion only"),
    "a moment that nothing balances": (lambda hip: pressed(hip, 1, 0.3, 1).balance([0, 1, 0], moment_nmm=[1, 0, 0]),
                                       "moment_nmm: needs free_rotations"),
    "a layer like rubber": (lambda hip: pressed(hip, 1, 0.5, 1), "Poisson's ratio must be"),
    "a flat sphere": (lambda hip: condyle.fit_sphere(V[:3]), "at least 4 vertices, not 3", condyle.MeshError),
    "an unknown side": (lambda hip: joint(hip, side="up"), "up"),
}


def masked(values):
    return np.ma.masked_array(values, mask=np.arange(np.size(values)).reshape(np.shape(values)) == 1)


def joint(hip, **options):
    return condyle.Joint(hip.fixed, hip.mobile, **options)


def hinge(hip, **options):
    return joint(hip, kind="hinge", joint="knee", **options)


def pressed(hip, *layer):
    return condyle.ElasticContact(hip.fixed, hip.mobile, fixed_layer=condyle.ElasticLayer(*layer))


def closed_file():
    with open(__file__) as file:
        pass
    return file


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_input_is_one_line(case, hip):
    act, *expected = CASES[case]
    assert len(refused(lambda: act(hip), *expected)) < 400


def test_answers_outlive_all_that_they_were_made_of():
    bones = condyle.sample_hip(scenario=1)
    joint = condyle.Joint(*bones)
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
    table = condyle.RadialTable(TETRAHEDRON)
    before = table.query([[0.3, 0.3, 0.3]]).gap_mm
    refused(lambda: table.update(V), kind=condyle.MeshError)  # a corner in the origin
    np.testing.assert_array_equal(table.query([[0.3, 0.3, 0.3]]).gap_mm, before)
