"""Every vertex at one pose: gaps, depths to read, and measures of contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Generic, Optional, TypeVar, get_args

import numpy as np
from numpy.typing import NDArray

from ._answer import Columns, at_most, html_of
from ._mesh import TriMesh
from ._pose_standing import PoseStanding
from ._words import DepthKind

if TYPE_CHECKING:
    import pandas

#: Values of `VertexDepths.kind`, by number.
DEPTH_KINDS: tuple[DepthKind, ...] = get_args(DepthKind)


@dataclass(frozen=True, eq=False, repr=False)
class VertexGaps(Columns):
    """Every vertex of one body against the other one.

    Attributes
    ----------
    state : (V,) int8
        0 outside, 1 on the surface, 2 inside.
    winding : (V,) int32
    gap_mm : (V,) float64
        > 0 apart, < 0 inside, 0 on the surface; along the ray from the joint centre, or along the arc about the axis.
        +inf where nothing is met, -inf where the whole circle is solid.
    triangle : (V,) uint32
        Triangle of the other mesh to which the gap is measured; NO_INDEX if there is none.
    ray_to_normal_deg : (V,) float64 or None
        For rays: angle between the ray and that triangle's normal, 0 to 90. Above 60 the value along the ray is not a depth.
    gap_deg : (V,) float64 or None
        For arcs: the gap as an angle.
    rotation_sense : (V,) int8 or None
        For arcs: the sense of rotation that reaches that triangle, 1 or -1.
    """

    state: NDArray[np.int8]
    winding: NDArray[np.int32]
    gap_mm: NDArray[np.float64]
    triangle: NDArray[np.uint32]
    ray_to_normal_deg: Optional[NDArray[np.float64]] = None
    gap_deg: Optional[NDArray[np.float64]] = None
    rotation_sense: Optional[NDArray[np.int8]] = None

    def __len__(self) -> int:
        return len(self.state)

    @property
    def depth_mm(self) -> NDArray[np.float64]:
        """(V,) how deep each vertex is inside, 0 for the others."""
        return np.where(self.state == 2, -self.gap_mm, 0.0)

    def __repr__(self) -> str:
        inside = int((self.state == 2).sum())
        outside = self.gap_mm[self.state == 0]
        gap = f", smallest gap {outside.min():.6g} mm" if len(outside) else ""
        return f"VertexGaps({len(self)} vertices, {inside} inside{gap})"

    _dimension = "vertex"


@dataclass(frozen=True, eq=False, repr=False)
class VertexDepths(Columns):
    """The depth to read of every vertex of one body: of several exits the one that is a depth there.

    Attributes
    ----------
    depth_mm : (V,) float64
        Finite, at least 0; 0 for vertices that are not inside.
    kind : (V,) int8
        The kind of depth, a position in :data:`DEPTH_KINDS`: the ray where it faces the surface, else the shortest arc about one
        of the joint's axes, else to the nearest point.
    without : int
        Vertices inside of which neither ray nor arc is a depth.
    deepest : int or None
        The deepest vertex whose kind is other than nearest.
    """

    depth_mm: NDArray[np.float64]
    kind: NDArray[np.int8]
    without: int
    deepest: Optional[int]

    def __len__(self) -> int:
        return len(self.depth_mm)

    def __repr__(self) -> str:
        inside = int((self.kind != 0).sum())
        deepest = "" if self.deepest is None else f", up to {self.depth_mm[self.deepest]:.6g} mm"
        return f"VertexDepths({len(self)} vertices, {inside} inside{deepest})"

    _dimension = "vertex"


Of = TypeVar("Of", VertexGaps, VertexDepths)


@dataclass(frozen=True, eq=False, repr=False)
class BothBodies(Generic[Of]):
    """One answer for each body; None where the other mesh is open and has no inside."""

    mobile: Optional[Of]
    fixed: Optional[Of]

    def __repr__(self) -> str:
        return f"{type(self).__name__}(mobile={self.mobile!r}, fixed={self.fixed!r})"

    def _repr_html_(self) -> str:
        return html_of(type(self).__name__, [("mobile", repr(self.mobile)), ("fixed", repr(self.fixed))])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per vertex, with columns `body` and `vertex`. Needs pandas."""
        import pandas

        bodies = {name: body.to_dataframe() for name, body in (("mobile", self.mobile), ("fixed", self.fixed)) if body is not None}
        return pandas.concat(bodies, names=["body", "vertex"]).reset_index() if bodies else pandas.DataFrame()


class Gaps(BothBodies[VertexGaps]):
    """Gaps of every vertex: `mobile` and `fixed` are :class:`VertexGaps`."""


@dataclass(frozen=True, eq=False, repr=False)
class Depths(BothBodies[VertexDepths]):
    """The depths to read of every vertex: `mobile` and `fixed` are :class:`VertexDepths`.

    `caveats` are sentences that they must be read with, as for a pose that translates. `surface_depth_mm` is how deep the deepest place of
    either surface is, to the nearest point of the other one, as :func:`condyle.touch` has it; 0 if none is inside. `standing` says what the pose
    is to the limits of the joint: None if no contact of its meshes ends a motion.
    """

    caveats: tuple[str, ...] = ()
    surface_depth_mm: float = 0.0
    standing: Optional[PoseStanding] = None

    @property
    def max_depth_mm(self) -> float:
        """The depth along a ray or an arc that `condyle depth` reports, of either body's deepest vertex; 0 if no vertex is inside.

        NaN if vertices are inside and neither ray nor arc is a depth of any.
        """
        bodies = [body for body in (self.mobile, self.fixed) if body is not None]
        return max((float(body.depth_mm[body.deepest]) for body in bodies if body.deepest is not None),
                   default=float("nan") if any(body.without for body in bodies) else 0.0)

    def __repr__(self) -> str:
        state = "" if self.standing is None else f"{self.standing.state}; "
        return f"Depths({state}{self.surface_depth_mm:.3f} mm to the surface, {self.max_depth_mm:.3f} mm by ray or arc; mobile={self.mobile!r}, fixed={self.fixed!r})"


@dataclass(frozen=True)
class ContactPatch:
    """The part of a body's surface inside the other body.

    `area_mm2`; `mean_depth_mm`, the mean distance to the other surface, None where there is no patch; `centroid` (3,)
    in F.
    """

    area_mm2: float
    mean_depth_mm: Optional[float]
    centroid: Optional[NDArray[np.float64]]


@dataclass(frozen=True, eq=False, repr=False)
class ContactMeasures:
    """Overlap of two bodies at one pose, and their distance.

    Attributes
    ----------
    in_contact : bool
        The bodies share a point: surfaces that meet, or one body inside the other.
    intersecting_pairs : int
        Pairs of triangles that meet.
    smallest_gap_mm : float
        Between the surfaces; 0 where they meet.
    nearest_on_fixed, nearest_on_mobile : (3,) float64
        Where they are nearest, in F.
    mobile_distance_mm, fixed_distance_mm : (V,) float64
        From every vertex to the nearest point of the other surface, at least 0 inside and outside.
    mobile, fixed : ContactPatch or None
        None where the other mesh is open.
    volume_mm3 : float or None
        Volume of the space inside both, each point as often as the bodies cover it; None if either mesh is open, or inside out there.
    volume_error_mm3 : float
        A bound on what the volume is off by rounding.
    mobile_covered_again_mm3, fixed_covered_again_mm3 : float
        How much of that volume is counted again because the body covers it more than once: it crosses itself, has triangles
        twice or a component in another.
    centroid : (3,) float64 or None
        Centroid of the patches of both, in F.
    """

    in_contact: bool
    intersecting_pairs: int
    smallest_gap_mm: float
    nearest_on_fixed: NDArray[np.float64]
    nearest_on_mobile: NDArray[np.float64]
    mobile_distance_mm: NDArray[np.float64]
    fixed_distance_mm: NDArray[np.float64]
    mobile: Optional[ContactPatch]
    fixed: Optional[ContactPatch]
    volume_mm3: Optional[float]
    volume_error_mm3: float
    mobile_covered_again_mm3: float
    fixed_covered_again_mm3: float
    centroid: Optional[NDArray[np.float64]]

    def _rows(self) -> list[tuple[str, str]]:
        rows = [("in contact", "yes" if self.in_contact else "no"), ("triangle pairs", str(self.intersecting_pairs))]
        if not self.in_contact:
            rows.append(("smallest gap", f"{self.smallest_gap_mm:.6g} mm"))
        for name, patch in (("mobile", self.mobile), ("fixed", self.fixed)):
            if patch is not None and patch.mean_depth_mm is not None:
                rows.append((f"{name} patch", f"{patch.area_mm2:.6g} mm2, mean depth {patch.mean_depth_mm:.6g} mm"))
        if self.volume_mm3 is not None:
            rows.append(("overlap", f"{self.volume_mm3:.6g} mm3, to within {at_most(self.volume_error_mm3)}"))
        for name, again in (("mobile", self.mobile_covered_again_mm3), ("fixed", self.fixed_covered_again_mm3)):
            if again > 0:
                rows.append((f"{name} counted again", f"{again:.6g} mm3 of it"))
        return rows

    def __repr__(self) -> str:
        return f"ContactMeasures({'; '.join(f'{name}: {value}' for name, value in self._rows())})"

    def _repr_html_(self) -> str:
        return html_of("contact", self._rows())


def of_vertices(kind: Callable[..., Of], found: Optional[dict[str, Any]], of: TriMesh) -> Optional[Of]:
    """The compiled part's answer with one value for each vertex of the mesh as it was given."""
    if found is None:
        return None
    for name, values in found.items():
        if isinstance(values, np.ndarray):
            found[name] = of._all(values)
            found[name].flags.writeable = False
    if found.get("deepest") is not None:
        found["deepest"] = of._as_given(found["deepest"])
    return kind(**found)


def measures_of(found: dict[str, Any], fixed: TriMesh, mobile: TriMesh) -> ContactMeasures:
    for name, of in (("fixed", fixed), ("mobile", mobile)):
        found[f"{name}_distance_mm"] = of._all(found[f"{name}_distance_mm"])
        if found[name] is not None:
            found[name] = ContactPatch(**found[name])
    return ContactMeasures(**found)
