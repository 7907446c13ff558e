"""Meshes come in as other packages have them, and vertices keep their numbers."""

from types import SimpleNamespace

import numpy as np
import pytest
from common import CORNERS, FACES, refused, soup

import condyle

TETRAHEDRON = condyle.TriMesh(CORNERS, FACES)


class VtkArray:
    """A vtkDataArray as numpy sees it: something with the buffer protocol."""

    def __init__(self, values):
        self.values = values

    def __array__(self, dtype=None):
        return np.asarray(self.values, dtype)


def vtk_like(vertices, triangles, with_offsets):
    cells = {"GetOffsetsArray": lambda: VtkArray(3 * np.arange(len(triangles) + 1)),
             "GetConnectivityArray": lambda: VtkArray(triangles.ravel())} if with_offsets else {
                 "GetData": lambda: VtkArray(np.column_stack([np.full(len(triangles), 3), triangles]).ravel())}
    return SimpleNamespace(GetPoints=lambda: SimpleNamespace(GetData=lambda: VtkArray(vertices)), GetPolys=lambda: SimpleNamespace(**cells))


@pytest.mark.parametrize("like", [
    lambda v, t: (v, t),
    lambda v, t: SimpleNamespace(vertices=v, faces=t),
    lambda v, t: SimpleNamespace(points=v, faces=np.column_stack([np.full(len(t), 3), t]).ravel()),
    lambda v, t: SimpleNamespace(points=v, cells=[SimpleNamespace(type="vertex", data=np.array([[0]])), SimpleNamespace(type="triangle", data=t[:1]),
                                                  SimpleNamespace(type="triangle", data=t[1:])]),
    lambda v, t: SimpleNamespace(points=v, cells=[("triangle", t)]),
    lambda v, t: SimpleNamespace(points=v, cells={"triangle": t}),
    lambda v, t: vtk_like(v, t, True),
    lambda v, t: vtk_like(v, t, False),
], ids=["pair", "trimesh", "PyVista", "meshio", "old meshio", "meshio's dictionary", "VTK 9", "VTK 8"])
def test_meshes_of_other_packages_are_taken_with_their_numbers(like):
    mesh = condyle.TriMesh.of(like(CORNERS, FACES))
    np.testing.assert_array_equal(mesh.vertices, CORNERS)
    np.testing.assert_array_equal(mesh.triangles, FACES)
    assert mesh.is_closed and mesh.vertex_map is None


@pytest.mark.parametrize("vertices", [
    CORNERS, CORNERS.astype(np.float32), CORNERS.astype(np.int32), np.asfortranarray(CORNERS), CORNERS.tolist(),
    np.repeat(CORNERS, 2, axis=0)[::2], np.ascontiguousarray(CORNERS[::-1])[::-1], CORNERS.astype(">f8"),
    np.lib.stride_tricks.as_strided(CORNERS, writeable=False),
], ids=["C", "float32", "int32", "Fortran", "list", "every second row", "backwards", "big-endian", "read-only"])
@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32, np.uint64, np.uint8])
def test_any_layout_and_type_gives_the_same_mesh(vertices, kind):
    mesh = condyle.TriMesh(vertices, np.asfortranarray(FACES.astype(kind)))
    np.testing.assert_array_equal(mesh.vertices, CORNERS)
    np.testing.assert_array_equal(mesh.triangles, FACES)


def test_a_soup_is_merged_and_vertex_k_stays_vertex_k():
    mesh = condyle.TriMesh(*soup(TETRAHEDRON))
    assert mesh.is_closed
    np.testing.assert_array_equal(mesh.vertices, CORNERS[FACES].reshape(-1, 3))
    np.testing.assert_array_equal(mesh.triangles, np.arange(12).reshape(4, 3))
    merged = np.unique(mesh.vertex_map)
    assert len(merged) == 4
    for k in range(12):  # the same number exactly where the coordinates are the same
        same = (mesh.vertices == mesh.vertices[k]).all(axis=1)
        np.testing.assert_array_equal(mesh.vertex_map == mesh.vertex_map[k], same)


def test_a_soup_gives_each_of_its_vertices_what_the_joined_mesh_gives(coarse_bones):
    bones = coarse_bones
    joined = condyle.Joint(*bones)
    souped = condyle.Joint(soup(bones.hip_bone), soup(bones.femur))
    np.testing.assert_array_equal(souped.mobile.vertices, joined.mobile.vertices[bones.femur.triangles].reshape(-1, 3))
    corner_of = bones.femur.triangles.ravel()
    poses = joined.pose(flexion_deg=[0, 100, 130], adduction_deg=20)
    for method in ("radial", "tangential"):
        one, other = joined.penetration(poses, method), souped.penetration(poses, method)
        assert max(len(each.mobile) for each in one) > 0
        for a, b in zip(one, other):
            expected = {k: depth for v, depth in zip(a.mobile.vertex, a.mobile.depth_mm) for k in np.flatnonzero(corner_of == v)}
            assert dict(zip(b.mobile.vertex.tolist(), b.mobile.depth_mm.tolist())) == expected
            assert len(b.mobile) == len(expected) == len(b.mobile.triangle)
    np.testing.assert_array_equal(joined.gaps(poses[2]).mobile.gap_mm[corner_of], souped.gaps(poses[2]).mobile.gap_mm)
    np.testing.assert_array_equal(joined.depths(poses[2]).mobile.depth_mm[corner_of], souped.depths(poses[2]).mobile.depth_mm)
    np.testing.assert_array_equal(joined.pairs(poses[2]), souped.pairs(poses[2]))


def test_a_soup_read_from_stl_is_joined_with_a_map_from_its_corners(tmp_path):
    path = tmp_path / "tetrahedron.stl"
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in CORNERS[face])
                     + "endloop\nendfacet\n" for face in FACES)
    path.write_text(f"solid t\n{facets}endsolid t\n")
    mesh = condyle.read_mesh(path)
    assert mesh.is_closed and len(mesh.vertices) == 4 and mesh.processing
    np.testing.assert_array_equal(mesh.vertices[mesh.triangles], CORNERS[FACES])


def test_polygons_are_split_where_it_is_asked_for(tmp_path):
    comb, path = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)], tmp_path / "comb.obj"
    path.write_text("".join(f"v {x} {y} {0.25 * (-1) ** i}\n" for i, (x, y) in enumerate(comb)) + "f 1 2 3 4 5 6 7 8\n")
    for polygons, words, kind in (("refuse", "only triangles", condyle.FileError), ("split", "twisted", condyle.FileError),
                                  ("fan", "polygons", condyle.UsageError)):
        refused(lambda: condyle.read_mesh(path, polygons=polygons), words, kind)
    twisted = condyle.read_mesh(path, polygons="guess")
    assert len(twisted.triangles) == 6 and "by a guess: their corners are up to 0.25 off one plane" in twisted.processing[0]


def test_arrays_cannot_be_written_and_outlive_their_mesh():
    mesh = condyle.TriMesh(CORNERS, FACES)
    vertices, triangles = mesh.vertices, mesh.triangles
    del mesh
    for array in (vertices, triangles):
        with pytest.raises(ValueError):
            array[0] = 0
    np.testing.assert_array_equal(vertices, CORNERS)
    np.testing.assert_array_equal(triangles, FACES)


def test_a_mesh_does_not_follow_the_arrays_it_was_made_of():
    vertices = CORNERS.copy()
    mesh = condyle.TriMesh(vertices, FACES)
    vertices[:] = 7
    np.testing.assert_array_equal(mesh.vertices, CORNERS)


def test_a_written_mesh_is_read_bit_by_bit(tmp_path):
    mesh = condyle.TriMesh(CORNERS / 3, FACES)
    condyle.write_mesh(tmp_path / "mesh.vtp", mesh)
    assert condyle.read_mesh(tmp_path / "mesh.vtp") == mesh


def test_inspection_finds_what_is_wrong():
    report = condyle.inspect((CORNERS, FACES[:3]))
    assert not report.is_closed and report.signed_volume is None
    assert report.findings["boundary_edges"].count == 3
    closed = condyle.inspect((CORNERS, FACES))
    assert closed.signed_volume == pytest.approx(1 / 6, rel=1e-15) and not closed.defects


def test_repairs_are_made_by_name():
    mesh = condyle.TriMesh(*soup(TETRAHEDRON), merge=False)
    assert not mesh.is_closed
    assert mesh.repaired("weld").is_closed
    refused(lambda: mesh.repaired("magic"), "weld")


def test_a_sphere_is_fitted_where_the_points_lie():
    random = np.random.default_rng(1)
    directions = random.normal(size=(100, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    fit = condyle.fit_sphere([1, 2, 3] + 24 * directions)
    np.testing.assert_allclose(fit.centre, [1, 2, 3], atol=1e-12)
    assert fit.radius == pytest.approx(24, abs=1e-12)


def test_a_cylinder_is_found_and_fitted_where_it_is():
    turn, along = np.meshgrid(np.linspace(0, 2 * np.pi, 73)[:-1], np.linspace(-30, 30, 31))
    points = np.column_stack([12 * np.cos(turn.ravel()), 12 * np.sin(turn.ravel()), along.ravel()]) + [1, 2, 3]
    fit = condyle.fit_cylinder(points, [0, 0, 0], [0, 0.1, 2], 10)
    np.testing.assert_allclose(fit.direction, [0, 0, 1], atol=1e-9)
    np.testing.assert_allclose(fit.point, [1, 2, 3], atol=1e-9)
    assert fit.radius == pytest.approx(12, abs=1e-9) and fit.coverage > 0.9 and fit.direction_bound_deg is None
    corner = np.arange(72 * 30).reshape(30, 72)
    right, up = (corner // 72) * 72 + (corner + 1) % 72, corner + 72
    quads = np.stack([corner, right, right + 72, up], axis=-1).reshape(-1, 4)
    tube = condyle.TriMesh(points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))
    found = condyle.find_cylinder(tube)
    assert found.radius == pytest.approx(12, abs=0.05) and found.direction_bound_deg < 1
    np.testing.assert_allclose(found.direction, [0, 0, 1], atol=0.01)
    refused(lambda: condyle.fit_cylinder(points[:4], [0, 0, 0], [0, 0, 1], 10), kind=condyle.MeshError)
    refused(lambda: condyle.fit_cylinder(points, [0, 0, 0], [0, 0, 0], 10), "direction")


def test_a_centre_and_an_axis_are_found_of_poses():
    turn = np.linspace(0, 6, 40)
    joint = condyle.Joint(*condyle.sample_hip())
    poses = joint.pose(flexion_deg=30 * np.sin(turn), adduction_deg=20 * np.sin(2 * turn), internal_rotation_deg=20 * np.sin(3 * turn))
    moved = np.eye(4)
    moved[:3, 3] = [1, 2, 3]
    with_gaps = moved @ np.concatenate([poses, np.full((2, 4, 4), np.nan)])
    found = condyle.functional_centre(with_gaps)
    np.testing.assert_allclose(found.in_fixed, [1, 2, 3], atol=1e-9)
    np.testing.assert_allclose(found.in_mobile, 0, atol=1e-9)
    assert found.poses == 40 and found.residual_mm < 1e-9
    refused(lambda: condyle.functional_centre(joint.pose(flexion_deg=turn)), "off it", kind=condyle.MeshError)
    refused(lambda: condyle.functional_axis(poses), "no one axis", kind=condyle.MeshError)
    refused(lambda: condyle.functional_axis(poses[:5]), "there are 5", kind=condyle.MeshError)


def test_the_head_of_the_sample_femur_is_found():
    fit = condyle.find_sphere(condyle.sample_hip(head_radius_mm=22).femur)
    # A vertex of the mesh lies on the head to rounding, the fit's patch may reach a little past it.
    assert fit.radius == pytest.approx(22, abs=0.1) and np.linalg.norm(fit.centre) < 0.1
