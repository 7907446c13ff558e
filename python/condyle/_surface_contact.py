"""Faces of surfaces in contact, with depths along their normals."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import Columns, html_of
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._mesh import MeshLike, TriMesh
from ._poses import PoseLike
from ._words import Bodies, FaceRule, Progress, number, progress_of, word


@dataclass(frozen=True, eq=False)
class ContactTotals:
    """Sums over faces in contact, in the frame of the body that casts.

    `triangles`, `area_mm2`, `mean_depth_mm`, `max_depth_mm`; `centre_of_depth` (3,) or None without contact;
    `mean_pressure_mpa`, `max_pressure_mpa`, `centre_of_pressure`; `force_n` and `moment_nmm` (3,) on that body, about
    the origin. Pressures and forces are 0 where no pressure was asked for.
    """

    triangles: int
    area_mm2: float
    mean_depth_mm: float
    max_depth_mm: float
    centre_of_depth: Optional[NDArray[np.float64]]
    mean_pressure_mpa: float
    max_pressure_mpa: float
    centre_of_pressure: Optional[NDArray[np.float64]]
    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class SurfaceContact(Columns):
    """Faces of the casting surface in contact, in its body's frame; all integrals are over the part in contact.

    Attributes
    ----------
    face : (K,) uint32, ascending
    area_mm2, max_depth_mm, overlap_mm3 : (K,) float64
        Area, largest depth and integral of the depth.
    centre_of_depth : (K, 3) float64
        The place weighted by depth.
    max_pressure_mpa, load_n : (K,) float64
        0 where no pressure was asked for.
    totals : ContactTotals
    met_from_front : int
        Rays that met the front of an open target: counted as depths all the same.
    rim_faces : int
        With cut faces: those at the rim of the target, cut where their edges leave it or, of an open one, decided by parts.
    oblique_area_mm2 : float
        Overlapping area whose rays meet the target more than 60 degrees off its normal, as along a rim: their length is no
        depth. With "cut_faces" it counts for nothing else, with "face_centre" it is a part of the faces.
    peak_is_oblique : bool
        With "face_centre": the largest depth or pressure comes from such a ray.
    max_strain : float
        The largest depth over the thickness of both layers; 0 where no pressure was asked for.
    """

    face: NDArray[np.uint32]
    area_mm2: NDArray[np.float64]
    max_depth_mm: NDArray[np.float64]
    overlap_mm3: NDArray[np.float64]
    centre_of_depth: NDArray[np.float64]
    max_pressure_mpa: NDArray[np.float64]
    load_n: NDArray[np.float64]
    totals: ContactTotals
    met_from_front: int
    rim_faces: int
    oblique_area_mm2: float
    peak_is_oblique: bool
    max_strain: float
    _faces: Optional[_native.ContactFaces] = field(repr=False)

    def __len__(self) -> int:
        return len(self.face)

    @property
    def mean_depth_mm(self) -> NDArray[np.float64]:
        """(K,) mean over each face's part in contact."""
        return self.overlap_mm3 / self.area_mm2

    @property
    def mean_pressure_mpa(self) -> NDArray[np.float64]:
        """(K,) mean over each face's part in contact."""
        return self.load_n / self.area_mm2

    def within(self, *region: tuple[ArrayLike, float]) -> SurfaceContact:
        """The faces whose centre is in all half-spaces, and what they add up to: a compartment, say.

        Each is (normal, offset_mm): the points p with normal.p > offset_mm in the casting body's frame. Numbers of
        rays and of rim faces, oblique area and strain stay those of the whole. UsageError for copies, which know no mesh.

        C++: `condyle::faces_within` and `totals_of` in condyle/normal_depth.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip()
        >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
        >>> faces = joint.normal_contact({"flexion_deg": 140}, casting="fixed").fixed
        >>> anterior = faces.within(([1, 0, 0], 0.0))
        >>> 0 < len(anterior) <= len(faces)
        True
        """
        if self._faces is None:
            raise UsageError("within: for faces as the joint gave them, not for a copy of them")
        checked = [_half_space(each) for each in region]
        found = self._faces.within(checked)
        for name in ("met_from_front", "rim_faces", "oblique_area_mm2", "peak_is_oblique", "max_strain"):
            found[name] = getattr(self, name)
        part = surface_of(found)
        assert part is not None
        return part

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_faces": None}  # columns are copied and pickled, the mesh they are of is not

    def __repr__(self) -> str:
        pressure = self.totals.max_pressure_mpa
        loaded = f", up to {pressure:.6g} MPa" if pressure else ""
        return (f"SurfaceContact({len(self)} faces, {self.totals.area_mm2:.6g} mm2, depth up to "
                f"{self.totals.max_depth_mm:.6g} mm{loaded})")

    _dimension = "face_in_contact"


def _half_space(given: tuple[ArrayLike, float]) -> tuple[ArrayLike, float]:
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise UsageError(f"region: a normal and an offset are needed, not {type(given).__name__}")
    return given[0], number(given[1], "region")


@dataclass(frozen=True, eq=False)
class NormalContact:
    """:class:`SurfaceContact` of each body that casts, else None."""

    fixed: Optional[SurfaceContact]
    mobile: Optional[SurfaceContact]

    def _repr_html_(self) -> str:
        return html_of("contact along normals", [("fixed casts", repr(self.fixed)),
                                                 ("mobile casts", repr(self.mobile))])


def surface_of(found: Optional[dict[str, Any]]) -> Optional[SurfaceContact]:
    if found is None:
        return None
    found["totals"] = ContactTotals(**found["totals"])
    return SurfaceContact(**found)


def normal_contact(joint: DescribedJoint, pose: PoseLike, casting: Bodies, rule: FaceRule, reach_mm: float,
                   progress: Progress) -> Union[NormalContact, list[NormalContact]]:
    is_one, found = _native.normal_contact(
        *joint._asked_at(pose), word(casting, "casting", Bodies),
        word(rule, "rule", FaceRule), number(reach_mm, "reach_mm"), progress_of(progress))
    contacts = [NormalContact(surface_of(fixed), surface_of(mobile)) for fixed, mobile in found]
    return contacts[0] if is_one else contacts


def thickness_to(layer: MeshLike, behind: MeshLike, *, reach_mm: float = 20) -> NDArray[np.float64]:
    """(V,) of each vertex of a layer's surface the distance along its negative normal to a surface behind it, mm.

    NaN where nothing lies within the reach: the thickness of a cartilage on its bone.

    C++: `condyle::thickness_to` in condyle/normal_depth.hpp.
    """
    layer, behind = TriMesh.of(layer), TriMesh.of(behind)
    return layer._all(_native.thickness_to(layer._native, behind._native, number(reach_mm, "reach_mm", low=0)))
