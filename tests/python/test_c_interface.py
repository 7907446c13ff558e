"""The C interface by ctypes: a mesh of numpy arrays in, and the module's answers out."""

import ctypes
import os
from ctypes import POINTER, byref, c_double, c_int, c_size_t, c_uint8, c_uint32, c_void_p
from typing import Any

import numpy as np
import pytest

import condyle

LIBRARY = os.environ.get("CONDYLE_C_LIBRARY")
pytestmark = pytest.mark.skipif(LIBRARY is None, reason="CONDYLE_C_LIBRARY names no library")

FIXED, MOBILE = 0, 1
STIFFNESS, VERTEX_FORCES = 1, 2


class Pose(ctypes.Structure):
    _fields_ = [("rotation", c_double * 9), ("translation_mm", c_double * 3)]

    @classmethod
    def of(cls, matrix: np.ndarray) -> "Pose":
        return cls((c_double * 9)(*matrix[:3, :3].ravel()), (c_double * 3)(*matrix[:3, 3]))


class VerticesInside(ctypes.Structure):
    _fields_ = [("other_is_closed", c_int), ("count", c_size_t), ("vertex", POINTER(c_uint32)), ("state", POINTER(c_uint8)),
                ("depth_mm", POINTER(c_double)), ("triangle", POINTER(c_uint32)), ("direction", POINTER(c_uint8))]


class Feature(ctypes.Structure):
    _fields_ = [("kind", c_int), ("id", c_uint32), ("other_end", c_uint32)]


class RotationLimit(ctypes.Structure):
    _fields_ = [("turned_deg", c_double), ("error_bound_deg", c_double), ("reason", c_int), ("has_witness", c_int),
                ("fixed_feature", Feature), ("mobile_feature", Feature), ("fixed_point_mm", c_double * 3),
                ("mobile_point_mm", c_double * 3)]


class Wrench(ctypes.Structure):
    _fields_ = [("force_n", c_double * 3), ("moment_nmm", c_double * 3)]


class ForceLoad(ctypes.Structure):
    _fields_ = [("on_mobile", Wrench), ("energy_nmm", c_double), ("friction_power", c_double), ("damping_power", c_double),
                ("max_strain", c_double), ("factor", c_double)]


class VertexForces(ctypes.Structure):
    _fields_ = [("count", c_size_t), ("vertex", POINTER(c_uint32)), ("force_n", POINTER(c_double))]


@pytest.fixture(scope="module")
def library() -> Any:
    loaded = ctypes.CDLL(LIBRARY)
    for name in ("condyle_last_error", "condyle_version"):
        getattr(loaded, name).restype = ctypes.c_char_p
    return loaded


@pytest.fixture(scope="module")
def bones(coarse_bones: condyle.SampleHip) -> condyle.Joint:
    return condyle.Joint(coarse_bones.hip_bone, coarse_bones.femur)


def made(library: Any, kind: str, *arguments: Any) -> c_void_p:
    """What condyle_KIND_create gives, its errors raised."""
    handle = c_void_p()
    check(library, getattr(library, f"condyle_{kind}_create")(*arguments, byref(handle)))
    return handle


def check(library: Any, status: int) -> None:
    if status:
        raise ValueError(library.condyle_last_error().decode())


def mesh(library: Any, surface: condyle.TriMesh) -> c_void_p:
    vertices = np.ascontiguousarray(surface.vertices, dtype=np.float64)
    triangles = np.ascontiguousarray(surface.triangles, dtype=np.uint32)
    return made(library, "mesh", vertices.ctypes.data_as(c_void_p), c_size_t(len(vertices)), triangles.ctypes.data_as(c_void_p),
                c_size_t(len(triangles)))


def array(pointer: Any, count: int) -> np.ndarray:
    return np.ctypeslib.as_array(pointer, (count,)).copy() if count else np.empty(0)


def test_the_version_is_that_of_the_module(library: Any) -> None:
    assert library.condyle_version().decode() == condyle.__version__


def test_vertices_pairs_and_gaps_are_those_of_the_module(library: Any, bones: condyle.Joint) -> None:
    fixed, mobile = mesh(library, bones.fixed), mesh(library, bones.mobile)
    contact, results = made(library, "joint_contact", fixed, mobile), made(library, "contact_results")
    library.condyle_mesh_destroy(fixed)
    library.condyle_mesh_destroy(mobile)
    for flexion, are_in_contact in ((0, False), (140, True)):
        matrix = np.asarray(bones.pose(flexion_deg=flexion))
        pose = Pose.of(matrix)
        check(library, library.condyle_joint_contact_at(contact, byref(pose), results))
        expected = bones.penetration(matrix)
        for body, inside in ((FIXED, expected.fixed), (MOBILE, expected.mobile)):
            found = VerticesInside()
            check(library, library.condyle_contact_results_vertices(results, body, byref(found)))
            assert found.count == len(inside)
            np.testing.assert_array_equal(array(found.vertex, found.count), inside.vertex)
            np.testing.assert_array_equal(array(found.depth_mm, found.count), inside.depth_mm)
            np.testing.assert_array_equal(array(found.triangle, found.count), inside.triangle)
        pairs, count, in_contact = POINTER(c_uint32)(), c_size_t(), c_int(-1)
        check(library, library.condyle_contact_results_pairs(results, byref(pairs), byref(count)))
        np.testing.assert_array_equal(array(pairs, 2 * count.value).reshape(-1, 2), bones.pairs(matrix))
        check(library, library.condyle_joint_contact_in_contact(contact, byref(pose), byref(in_contact)))
        assert in_contact.value == are_in_contact
        gaps = np.empty(len(bones.mobile.vertices))
        check(library, library.condyle_joint_contact_radial_gaps(contact, byref(pose), MOBILE, gaps.ctypes.data_as(c_void_p),
                                                                 c_size_t(len(gaps))))
        np.testing.assert_array_equal(gaps, bones.gaps(matrix).mobile.gap_mm)
    library.condyle_contact_results_destroy(results)
    library.condyle_joint_contact_destroy(contact)


def test_a_rotation_ends_where_the_modules_does(library: Any, bones: condyle.Joint) -> None:
    fixed, mobile = mesh(library, bones.fixed), mesh(library, bones.mobile)
    point, direction = np.array([1.0, 0.5, 0.0]), np.array([0.1, 0.2, 1.0])
    rotation = made(library, "first_contact", fixed, mobile, point.ctypes.data_as(c_void_p), direction.ctypes.data_as(c_void_p))
    negative, positive = RotationLimit(), RotationLimit()
    check(library, library.condyle_first_contact_limits(rotation, byref(Pose.of(np.eye(4))), c_double(-360), c_double(360),
                                                        byref(negative), byref(positive)))
    expected = condyle.FirstContact(bones.fixed, bones.mobile, point, direction).limits()
    assert [negative.turned_deg, positive.turned_deg] == [expected.negative.limit_deg, expected.positive.limit_deg]
    assert 0 < positive.turned_deg < 360 and positive.has_witness == 1
    for handle, kind in ((rotation, "first_contact"), (fixed, "mesh"), (mobile, "mesh")):
        getattr(library, f"condyle_{kind}_destroy")(handle)


def test_layers_push_as_those_of_the_module_do(library: Any) -> None:
    layers = condyle.sample_cartilages(clearance_mm=0)
    fixed, mobile, options = mesh(library, layers.acetabular), mesh(library, layers.femoral), made(library, "elastic_options")
    check(library, library.condyle_elastic_options_set_layer(options, MOBILE, c_double(12), c_double(0.42),
                                                             byref(c_double(1.65)), c_size_t(1)))
    contact, results = made(library, "elastic_contact", fixed, mobile, options), made(library, "elastic_results")
    matrix = np.eye(4)
    matrix[1, 3] = 0.3
    check(library, library.condyle_elastic_contact_at(contact, byref(Pose.of(matrix)), results))
    load, energy = Wrench(), c_double()
    check(library, library.condyle_elastic_results_load(results, byref(load), byref(energy)))
    expected = condyle.ElasticContact(layers.acetabular, layers.femoral,
                                      mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65)).at(matrix)
    assert list(load.force_n) == expected.force_n.tolist() and load.force_n[1] < -100
    assert list(load.moment_nmm) == expected.moment_nmm.tolist()
    assert energy.value == expected.energy_nmm
    for handle, kind in ((results, "elastic_results"), (contact, "elastic_contact"), (options, "elastic_options"),
                         (fixed, "mesh"), (mobile, "mesh")):
        getattr(library, f"condyle_{kind}_destroy")(handle)


def pointer(numbers: np.ndarray) -> c_void_p:
    return numbers.ctypes.data_as(c_void_p)


def test_a_body_that_deforms_is_followed_as_by_the_module(library: Any) -> None:
    layers = condyle.sample_cartilages(clearance_mm=0.1)
    fixed, mobile = mesh(library, layers.acetabular), mesh(library, layers.femoral)
    contact, results = made(library, "joint_contact", fixed, mobile), made(library, "contact_results")
    module, pose = condyle.JointContact(layers.acetabular, layers.femoral), Pose.of(np.eye(4))
    larger = np.ascontiguousarray(1.01 * layers.femoral.vertices)
    some = np.arange(3, len(larger), 7, dtype=np.uint32)
    places = np.ascontiguousarray(1.005 * layers.femoral.vertices[some])
    counts = []
    for moved, positions in ((None, larger), (some, places)):
        if moved is None:
            check(library, library.condyle_joint_contact_update(contact, MOBILE, pointer(positions), c_size_t(len(positions))))
        else:
            check(library, library.condyle_joint_contact_update_some(contact, MOBILE, pointer(moved), c_size_t(len(moved)),
                                                                     pointer(positions)))
        module.update("mobile", positions, moved=moved)
        check(library, library.condyle_joint_contact_at(contact, byref(pose), results))
        found, expected = VerticesInside(), module.penetration(np.eye(4)).mobile
        check(library, library.condyle_contact_results_vertices(results, MOBILE, byref(found)))
        order, expected_order = np.argsort(array(found.vertex, found.count)), np.argsort(expected.vertex)
        np.testing.assert_array_equal(array(found.vertex, found.count)[order], expected.vertex[expected_order])
        np.testing.assert_array_equal(array(found.depth_mm, found.count)[order], expected.depth_mm[expected_order])
        counts.append(found.count)
    assert counts[0] > counts[1] > 0
    with pytest.raises(ValueError, match="^an update of [0-9]+ vertices gives 3$"):
        check(library, library.condyle_joint_contact_update(contact, MOBILE, pointer(larger), c_size_t(3)))
    for handle, kind in ((results, "contact_results"), (contact, "joint_contact"), (fixed, "mesh"), (mobile, "mesh")):
        getattr(library, f"condyle_{kind}_destroy")(handle)


def test_forces_are_those_of_the_module(library: Any) -> None:
    layers = condyle.sample_cartilages(clearance_mm=0)
    fixed, mobile, layer = mesh(library, layers.acetabular), mesh(library, layers.femoral), made(library, "elastic_options")
    check(library, library.condyle_elastic_options_set_layer(layer, MOBILE, c_double(12), c_double(0.42), byref(c_double(1.65)),
                                                             c_size_t(1)))
    contact = made(library, "elastic_contact", fixed, mobile, layer)
    options, results = made(library, "force_options"), made(library, "force_results")
    velocity, angular_velocity = np.array([3.0, -2.0, 1.5]), np.array([0.1, -0.2, 0.15])
    matrix = np.eye(4)
    matrix[1, 3] = 0.3
    pose = Pose.of(matrix)
    module = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
    module_ramp, ramp = condyle.ContactRamp(module, matrix, 0.05), made(library, "ramp", contact, byref(pose), c_double(0.05))
    library.condyle_ramp_factor_at.restype = c_double
    factor = library.condyle_ramp_factor_at(ramp, c_double(0.02))
    assert factor == module_ramp.factor_at(0.02)
    for status in (library.condyle_force_options_set_motion(options, pointer(velocity), pointer(angular_velocity)),
                   library.condyle_force_options_set_friction(options, c_double(0.1), c_double(2)),
                   library.condyle_force_options_set_damping(options, c_double(0.01)),
                   library.condyle_force_options_set_factor(options, c_double(factor)),
                   library.condyle_force_options_set_parts(options, STIFFNESS | VERTEX_FORCES)):
        check(library, status)
    check(library, library.condyle_elastic_contact_forces(contact, byref(pose), options, results))
    load, stiffness, vertices = ForceLoad(), np.empty((6, 6)), VertexForces()
    check(library, library.condyle_force_results_load(results, byref(load)))
    check(library, library.condyle_force_results_stiffness(results, pointer(stiffness)))
    check(library, library.condyle_force_results_vertices(results, FIXED, byref(vertices)))
    expected = module.forces(matrix, velocity_mm_s=velocity, angular_velocity_rad_s=angular_velocity, friction=0.1, slip_velocity_mm_s=2,
                             damping_s_per_mm=0.01, factor=factor, stiffness=True, vertex_forces=True)
    assert list(load.on_mobile.force_n) == expected.force_n.tolist() and load.on_mobile.force_n[1] < -10
    assert list(load.on_mobile.moment_nmm) == expected.moment_nmm.tolist()
    assert [load.energy_nmm, load.friction_power, load.damping_power, load.factor] == [
        expected.energy_nmm, expected.friction_power, expected.damping_power, factor]
    np.testing.assert_array_equal(stiffness, expected.stiffness)
    np.testing.assert_array_equal(array(vertices.vertex, vertices.count), expected.on_fixed.vertex)
    np.testing.assert_array_equal(array(vertices.force_n, 3 * vertices.count).reshape(-1, 3), expected.on_fixed.force_n)
    for handle, kind in ((ramp, "ramp"), (results, "force_results"), (options, "force_options"), (contact, "elastic_contact"),
                         (layer, "elastic_options"), (fixed, "mesh"), (mobile, "mesh")):
        getattr(library, f"condyle_{kind}_destroy")(handle)


def test_errors_are_a_status_and_a_line(library: Any) -> None:
    vertices, triangles = np.zeros((3, 3)), np.array([[0, 1, 3]], dtype=np.uint32)
    with pytest.raises(ValueError, match="^triangle 0 uses vertex 3 of 3$"):
        made(library, "mesh", vertices.ctypes.data_as(c_void_p), c_size_t(3), triangles.ctypes.data_as(c_void_p), c_size_t(1))
