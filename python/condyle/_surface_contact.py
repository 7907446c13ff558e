"""Depth along normals, pressure and loads of surfaces in contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import Columns, html_of
from ._errors import UsageError
from ._mesh import MeshLike, TriMesh
from ._words import Progress, array, number, progress_of, word

if TYPE_CHECKING:
    from ._joint import Joint, PoseLike


@dataclass(frozen=True, eq=False)
class ContactTotals:
    """What faces in contact add up to, in the frame of the body that casts.

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
        Faces at the rim of an open target.
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

    def __repr__(self) -> str:
        pressure = self.totals.max_pressure_mpa
        loaded = f", up to {pressure:.6g} MPa" if pressure else ""
        return (f"SurfaceContact({len(self)} faces, {self.totals.area_mm2:.6g} mm2, depth up to "
                f"{self.totals.max_depth_mm:.6g} mm{loaded})")

    _dimension = "face_in_contact"


@dataclass(frozen=True, eq=False)
class NormalContact:
    """Of each body that casts its :class:`SurfaceContact`, else None."""

    fixed: Optional[SurfaceContact]
    mobile: Optional[SurfaceContact]

    def _repr_html_(self) -> str:
        return html_of("contact along normals", [("fixed casts", repr(self.fixed)),
                                                 ("mobile casts", repr(self.mobile))])


@dataclass(frozen=True)
class ElasticLayer:
    """A layer on a body: Young's modulus above 0, Poisson's ratio above -1 and below 0.5, thickness above 0.

    `thickness_mm` is one number, or one for each vertex of the layer's mesh, (V,).
    """

    youngs_modulus_mpa: float
    poisson_ratio: float
    thickness_mm: Union[float, NDArray[np.float64]]

    def _checked(self, mesh: TriMesh) -> dict[str, Any]:
        thickness: Any = self.thickness_mm
        if not isinstance(thickness, (list, tuple)) and getattr(thickness, "ndim", 0) == 0:
            thickness = number(thickness, "thickness_mm")
        elif mesh._first is not None:
            thickness = array(thickness, "thickness_mm", "a number for each vertex")
            if thickness.shape != mesh.vertices.shape[:1]:
                raise UsageError(f"thickness_mm: an array of shape ({len(mesh.vertices)},) is needed")
            thickness = thickness[mesh._first]
        return {"youngs_modulus_mpa": number(self.youngs_modulus_mpa, "youngs_modulus_mpa"),
                "poisson_ratio": number(self.poisson_ratio, "poisson_ratio"), "thickness_mm": thickness}


@dataclass(frozen=True, eq=False, repr=False)
class ElasticContactResults:
    """What one pose shows.

    `fixed` and `mobile` are the :class:`SurfaceContact` of those that cast; `force_n` and `moment_nmm` (3,) what the
    fixed body exerts on the mobile one, in F, about the origin of M; `energy_nmm` stored in the layers.
    """

    fixed: Optional[SurfaceContact]
    mobile: Optional[SurfaceContact]
    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]
    energy_nmm: float

    def __repr__(self) -> str:
        return (f"ElasticContactResults(force {np.linalg.norm(self.force_n):.6g} N, energy {self.energy_nmm:.6g} N mm; "
                f"fixed={self.fixed!r}, mobile={self.mobile!r})")


@dataclass(frozen=True, eq=False)
class BalancedPose:
    """The pose in which the contact carries a load, or why there is none.

    `outcome` is "balanced", "at_jump" (all but a little of the load is carried, and next to `X_FM` the force jumps over
    what is left), "pulled_apart", "over_the_rim", "unstable" or "free_direction"; `reason` one line where
    there is no balance; `X_FM` (4, 4) the pose found, or the last one looked at; `residual_force_n` and
    `residual_moment_nmm` (3,) what contact and load add up to along what is free; `contact` at that pose.
    """

    outcome: str
    reason: str
    X_FM: NDArray[np.float64]
    residual_force_n: NDArray[np.float64]
    residual_moment_nmm: NDArray[np.float64]
    steps: int
    contact: ElasticContactResults

    @property
    def carries_load(self) -> bool:
        """Whether the contact carries the load at `X_FM`: balanced, unstable, or at a jump up to the residual."""
        return self.outcome in ("balanced", "unstable", "at_jump")


class ElasticContact:
    """Two surfaces with their layers, ready to be asked at any pose. Any number of threads may ask.

    Parameters
    ----------
    fixed, mobile : mesh
        Surfaces in their bodies' frames, mm; open ones too.
    fixed_layer, mobile_layer : ElasticLayer, optional
        At least one; a body without one is rigid.
    casting : "both", "fixed" or "mobile"
        Whose surface is cast along its normals; with "both" the load is the mean of the two.
    rule : "cut_faces" or "face_centre"
    reach_mm : float
        How far rays go.
    law : "linear" or "logarithmic"

    C++: `condyle::ElasticContact` in condyle/pressure.hpp; `condyle load`.

    >>> import condyle
    >>> layers = condyle.sample_cartilages(clearance_mm=0)
    >>> contact = condyle.ElasticContact(layers.acetabular, layers.femoral,
    ...                                  mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
    >>> pressed = contact.balance([0, 800, 0])
    >>> pressed.outcome, (pressed.contact.force_n.round(3) + 0.0).tolist()
    ('balanced', [0.0, -800.0, 0.0])
    """

    __slots__ = ("_native", "_fixed", "_mobile", "__weakref__")

    def __init__(self, fixed: MeshLike, mobile: MeshLike, *, fixed_layer: Optional[ElasticLayer] = None,
                 mobile_layer: Optional[ElasticLayer] = None, casting: str = "both", rule: str = "cut_faces",
                 reach_mm: float = 20, law: str = "linear") -> None:
        self._fixed, self._mobile = TriMesh.of(fixed), TriMesh.of(mobile)
        for layer, what in ((fixed_layer, "fixed_layer"), (mobile_layer, "mobile_layer")):
            if layer is not None and not isinstance(layer, ElasticLayer):
                raise UsageError(f"{what}: an ElasticLayer is needed, not {type(layer).__name__}")
        self._native = _native.ElasticContact(
            self._fixed._native, self._mobile._native,
            None if fixed_layer is None else fixed_layer._checked(self._fixed),
            None if mobile_layer is None else mobile_layer._checked(self._mobile),
            word(casting, "casting", ("both", "fixed", "mobile")), word(rule, "rule", ("cut_faces", "face_centre")),
            number(reach_mm, "reach_mm"), word(law, "law", ("linear", "logarithmic")) == "logarithmic")

    @classmethod
    def of_file(cls, joint: Joint) -> ElasticContact:
        """With the surfaces, layers and rays that the table [contact] of the joint's file says."""
        native = _native.elastic_of_file(joint._native)
        if native is None:
            raise UsageError("joint: its file has no table [contact]")
        contact = cls.__new__(cls)
        contact._native = native
        contact._fixed, contact._mobile = TriMesh._of_native(native.fixed), TriMesh._of_native(native.mobile)
        return contact

    def at(self, pose: ArrayLike, *, progress: Progress = None) -> Any:
        """:class:`ElasticContactResults` of X_FM, (4, 4); of (N, 4, 4) a list of N.

        MeshError with the logarithmic law where the overlap reaches the thickness.
        """
        is_one, found = self._native.at(pose, progress_of(progress))
        results = [results_of(each) for each in found]
        return results[0] if is_one else results

    def balance(self, force_n: ArrayLike, *, moment_nmm: ArrayLike = (0, 0, 0), start: Optional[ArrayLike] = None,
                frame: str = "fixed", free_directions: ArrayLike = (), free_rotations: bool = False) -> BalancedPose:
        """The pose near `start` (the identity if not given) in which the contact carries a load on the mobile body.

        `force_n` and `moment_nmm` about the origin of M are held in F, or with `frame="mobile"` go along with M.
        Directions (K, 3) in F along which the body may be translated, all if none are given; with `free_rotations` its
        rotations are unknowns too. UsageError where the load is zero along what is free.

        C++: `condyle::balance` in condyle/load_balance.hpp.
        """
        return _balanced(self._native.balance(
            np.eye(4) if start is None else start, force_n, moment_nmm,
            word(frame, "frame", ("fixed", "mobile")) == "mobile", _directions(free_directions),
            bool(free_rotations)))

    def balance_along(self, poses: ArrayLike, force_n: ArrayLike, *, moment_nmm: Optional[ArrayLike] = None,
                      frame: str = "fixed", free_directions: ArrayLike = (), free_rotations: bool = False,
                      progress: Progress = None) -> list[BalancedPose]:
        """The poses that balance a load, frame after frame of a motion, (N, 4, 4).

        Rotations are the given ones; each frame starts from its translation as the last frame that carries its load has
        moved its own. `force_n` and `moment_nmm` (3,) for all frames, or (N, 3) one for each; the rest as
        :meth:`balance` takes it. UsageError where there are neither one nor N loads.

        C++: `condyle::balance_along` in condyle/motion_contact.hpp.
        """
        forces = _rows(force_n, "force_n")
        moments = np.zeros_like(forces, dtype=np.float64) if moment_nmm is None else _rows(moment_nmm, "moment_nmm")
        return [_balanced(found) for found in self._native.balance_along(
            poses, forces, moments, word(frame, "frame", ("fixed", "mobile")) == "mobile",
            _directions(free_directions), bool(free_rotations), progress_of(progress))]

    def __repr__(self) -> str:
        return f"ElasticContact(fixed={self._fixed!r}, mobile={self._mobile!r})"


def _rows(given: ArrayLike, name: str) -> NDArray[Any]:
    try:
        rows: NDArray[Any] = np.atleast_2d(np.asarray(given))
        return rows
    except ValueError:
        raise UsageError(f"{name}: numbers of shape (3,) or (N, 3) are needed") from None


def _directions(given: ArrayLike) -> ArrayLike:
    return np.empty((0, 3)) if isinstance(given, (tuple, list)) and not given else given


def _balanced(found: dict[str, Any]) -> BalancedPose:
    found["residual_force_n"], found["residual_moment_nmm"] = found.pop("residual")
    found["contact"] = results_of(found["contact"])
    return BalancedPose(**found)


def surface_of(found: Optional[dict[str, Any]]) -> Optional[SurfaceContact]:
    if found is None:
        return None
    found["totals"] = ContactTotals(**found["totals"])
    return SurfaceContact(**found)


def results_of(found: dict[str, Any]) -> ElasticContactResults:
    found["fixed"], found["mobile"] = surface_of(found["fixed"]), surface_of(found["mobile"])
    return ElasticContactResults(**found)


def normal_contact(joint: Joint, pose: PoseLike, casting: str, rule: str, reach_mm: float, progress: Progress) -> Any:
    is_one, found = _native.normal_contact(
        joint._native, joint._matrices(pose), word(casting, "casting", ("both", "fixed", "mobile")),
        word(rule, "rule", ("cut_faces", "face_centre")), number(reach_mm, "reach_mm"), progress_of(progress))
    contacts = [NormalContact(surface_of(fixed), surface_of(mobile)) for fixed, mobile in found]
    return contacts[0] if is_one else contacts


def thickness_to(layer: MeshLike, behind: MeshLike, *, reach_mm: float = 20) -> NDArray[np.float64]:
    """(V,) of each vertex of a layer's surface the distance along its negative normal to a surface behind it, mm.

    NaN where nothing lies within the reach: the thickness of a cartilage on its bone.

    C++: `condyle::thickness_to` in condyle/normal_depth.hpp.
    """
    layer, behind = TriMesh.of(layer), TriMesh.of(behind)
    return layer._all(_native.thickness_to(layer._native, behind._native, number(reach_mm, "reach_mm", low=0)))
