"""The C interface by ctypes: a mesh of numpy arrays in, and the module's answers out."""

import ctypes
import os
from ctypes import POINTER, byref, c_double, c_int, c_size_t, c_uint32, c_void_p
from typing import Any

import numpy as np
import pytest
from common import refused

import condyle

LIBRARY = os.environ.get("CONDYLE_C_LIBRARY")
pytestmark = pytest.mark.skipif(LIBRARY is None, reason="CONDYLE_C_LIBRARY names no library")

MOBILE = 1


class Pose(ctypes.Structure):
    _fields_ = [("rotation", c_double * 9), ("translation_mm", c_double * 3)]

    @classmethod
    def of(cls, matrix: np.ndarray) -> "Pose":
        return cls((c_double * 9)(*matrix[:3, :3].ravel()), (c_double * 3)(*matrix[:3, 3]))


@pytest.fixture(scope="module")
def library() -> Any:
    loaded = ctypes.CDLL(LIBRARY)
    for name in ("condyle_last_error", "condyle_version"):
        getattr(loaded, name).restype = ctypes.c_char_p
    return loaded


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


def test_the_version_is_that_of_the_module(library: Any) -> None:
    assert library.condyle_version().decode() == condyle.__version__


def test_pairs_and_gaps_are_those_of_the_module(library: Any, coarse_bones: condyle.SampleHip) -> None:
    bones = condyle.Joint(*coarse_bones)
    fixed, mobile = mesh(library, bones.fixed), mesh(library, bones.mobile)
    contact, results = made(library, "joint_contact", fixed, mobile), made(library, "contact_results")
    library.condyle_mesh_destroy(fixed)
    library.condyle_mesh_destroy(mobile)
    for flexion, are_in_contact in ((0, False), (140, True)):
        matrix = np.asarray(bones.pose(flexion_deg=flexion))
        pose = Pose.of(matrix)
        check(library, library.condyle_joint_contact_at(contact, byref(pose), results))
        pairs, count, in_contact = POINTER(c_uint32)(), c_size_t(), c_int(-1)
        check(library, library.condyle_contact_results_pairs(results, byref(pairs), byref(count)))
        np.testing.assert_array_equal([[pairs[2 * i], pairs[2 * i + 1]] for i in range(count.value)] or np.empty((0, 2)), bones.pairs(matrix))
        check(library, library.condyle_joint_contact_in_contact(contact, byref(pose), byref(in_contact)))
        assert in_contact.value == are_in_contact
        gaps = np.empty(len(bones.mobile.vertices))
        check(library, library.condyle_joint_contact_radial_gaps(contact, byref(pose), MOBILE, gaps.ctypes.data_as(c_void_p), c_size_t(len(gaps))))
        np.testing.assert_array_equal(gaps, bones.gaps(matrix).mobile.gap_mm)
    library.condyle_contact_results_destroy(results)
    library.condyle_joint_contact_destroy(contact)


def test_errors_are_a_status_and_a_line(library: Any) -> None:
    vertices, triangles = np.zeros((3, 3)), np.array([[0, 1, 3]], dtype=np.uint32)
    refused(lambda: made(library, "mesh", vertices.ctypes.data_as(c_void_p), c_size_t(3), triangles.ctypes.data_as(c_void_p), c_size_t(1)),
            "^triangle 0 uses vertex 3 of 3$", ValueError)
