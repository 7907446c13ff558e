"""Vertices of one body inside the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, Optional, Union, overload

import numpy as np
from numpy.typing import NDArray

from ._answer import Columns, html_of
from ._errors import OutOfRangeError
from ._mesh import TriMesh
from ._words import GapMethod

if TYPE_CHECKING:
    import pandas

#: Values of `state`.
OUTSIDE, ON_SURFACE, INSIDE = 0, 1, 2
#: "None" among numbers of triangles.
NO_INDEX = 2**32 - 1


@dataclass(frozen=True, eq=False, repr=False)
class VerticesInside(Columns):
    """The vertices of one body that are not outside the other one.

    Attributes
    ----------
    vertex : (K,) uint32
        Numbers of the vertices in the mesh as it was given. Neighbours in space follow each other; no order is
        promised.
    state : (K,) int8
        1 on the surface, 2 inside.
    winding : (K,) int32
        Winding number of the other surface around the vertex.
    triangle : (K,) uint32
        Triangle of the other mesh through which the vertex leaves; NO_INDEX if there is none.
    depth_mm : (K,) float64
        At least 0: along the ray from the joint centre ("radial"), or along the arc about the axis ("tangential"),
        where it is infinite if the whole circle is solid. The two are not comparable.
    direction : (K,) int8
        1 away from the joint centre, -1 towards it; of arcs, 1 for a positive rotation of the vertex's body.
    depth_deg : (K,) float64 or None
        For arcs, the angle.
    offset : (N + 1,) int64 or None
        For several poses: pose n owns the entries from offset[n] to offset[n + 1].
    """

    vertex: NDArray[np.uint32]
    state: NDArray[np.int8]
    winding: NDArray[np.int32]
    triangle: NDArray[np.uint32]
    depth_mm: NDArray[np.float64]
    direction: NDArray[np.int8]
    depth_deg: Optional[NDArray[np.float64]] = None
    offset: Optional[NDArray[np.int64]] = None

    def __len__(self) -> int:
        return len(self.vertex)

    @property
    def max_depth_mm(self) -> float:
        """The largest depth; 0 where nothing is inside."""
        return float(self.depth_mm.max()) if len(self.depth_mm) else 0.0

    @property
    def deepest(self) -> Optional[int]:
        """The vertex of the largest depth; None where nothing is inside."""
        return int(self.vertex[self.depth_mm.argmax()]) if len(self.depth_mm) else None

    def __repr__(self) -> str:
        return f"VerticesInside({len(self)} vertices, up to {self.max_depth_mm:.6g} mm)"

    def _part(self, part: Union[slice, NDArray[np.int64]], offset: Optional[NDArray[np.int64]] = None
              ) -> VerticesInside:
        return VerticesInside(self.vertex[part], self.state[part], self.winding[part], self.triangle[part],
                              self.depth_mm[part], self.direction[part],
                              None if self.depth_deg is None else self.depth_deg[part], offset)

    _dimension = "vertex_inside"


def vertices_inside(found: Optional[dict[str, Any]], of: TriMesh, is_one: bool) -> Optional[VerticesInside]:
    """The compiled part's answer, its vertices numbered as in the mesh that was given."""
    if found is None:
        return None
    if of._map is not None:
        _expand(found, of._map)
    if is_one:
        del found["offset"]
    return VerticesInside(**found)


def _expand(found: dict[str, Any], vertex_map: NDArray[np.uint32]) -> None:
    """Each entry once for every given vertex that was merged into the one it is of."""
    given = np.argsort(vertex_map, kind="stable").astype(np.uint32)
    begin = np.searchsorted(vertex_map[given], np.arange(int(vertex_map.max()) + 2))
    counts = np.diff(begin)[found["vertex"]]
    ends = np.cumsum(counts)
    entry = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(entry)) - np.repeat(ends - counts, counts)
    vertices = given[begin[found["vertex"]][entry] + within]
    found["offset"] = np.concatenate(([0], ends))[found["offset"]]
    for name in found:
        if name == "vertex":
            found[name] = vertices
        elif name != "offset":
            found[name] = found[name][entry]
        found[name].flags.writeable = False


@dataclass(frozen=True, eq=False, repr=False)
class Penetration:
    """Results of one pose, vertices of each body against the other one.

    `mobile` are vertices of the mobile body inside the fixed one; None where the fixed mesh is open and has no inside.
    `fixed` likewise, or not asked for. `method` says along what depths are: a ray may run along a bone and be no depth.
    How deep the bodies penetrate :meth:`Joint.depths` says, as `condyle depth` does.
    """

    mobile: Optional[VerticesInside]
    fixed: Optional[VerticesInside]
    method: GapMethod

    @property
    def max_depth_mm(self) -> float:
        """The largest depth of either body; 0 where nothing is inside."""
        return max((body.max_depth_mm for body in (self.mobile, self.fixed) if body is not None), default=0.0)

    def _said(self, body: Optional[VerticesInside]) -> str:
        if body is None:
            return "not asked"
        if not len(body):
            return "none inside"
        along = "rays" if self.method == "radial" else "arcs"
        return f"{len(body)} vertices, {along} up to {body.max_depth_mm:.3f} mm"

    def __repr__(self) -> str:
        # The longest ray may run along a bone.
        hint = "; how deep: joint.depths" if self.method == "radial" else ""
        return (f"{type(self).__name__}({self.method}; mobile {self._said(self.mobile)}; "
                f"fixed {self._said(self.fixed)}{hint})")

    def _repr_html_(self) -> str:
        return html_of(f"{self.method} penetration", [("mobile in fixed", self._said(self.mobile)),
                                                      ("fixed in mobile", self._said(self.fixed))])


@dataclass(frozen=True, eq=False, repr=False)
class Penetrations(Penetration):
    """Results of many poses. `penetrations[n]` is that of one of them, `penetrations[k:n]` of some: without a copy."""

    count: int = 0

    def __len__(self) -> int:
        return self.count

    @overload
    def __getitem__(self, n: int) -> Penetration: ...

    @overload
    def __getitem__(self, n: slice) -> Penetrations: ...

    def __getitem__(self, n: Union[int, slice]) -> Penetration:
        if isinstance(n, slice):
            poses = range(self.count)[n]
            return Penetrations(_of_poses(self.mobile, poses), _of_poses(self.fixed, poses), self.method, len(poses))
        if not -self.count <= n < self.count:
            raise OutOfRangeError(f"pose: there are {self.count}, counted from 0, and no {n}")
        n = range(self.count)[n]
        return Penetration(_of_pose(self.mobile, n), _of_pose(self.fixed, n), self.method)

    def __iter__(self) -> Iterator[Penetration]:
        return (self[n] for n in range(self.count))

    @property
    def depths_mm(self) -> NDArray[np.float64]:
        """(N,) the largest depth of either body at each pose; 0 where nothing is inside."""
        depths = np.zeros(self.count)
        for body in (self.mobile, self.fixed):
            if body is not None and body.offset is not None:
                counts = np.diff(body.offset)
                np.maximum.at(depths, np.repeat(np.arange(self.count), counts), body.depth_mm)
        return depths

    def __repr__(self) -> str:
        depths = self.depths_mm
        inside = int((depths > 0).sum())
        along = "rays" if self.method == "radial" else "arcs"
        return (f"Penetrations({self.method}; {self.count} poses, {inside} with vertices inside, "
                f"{along} up to {self.max_depth_mm:.6g} mm)")

    def _repr_html_(self) -> str:
        return html_of(f"{self.method} penetration of {self.count} poses",
                       [("mobile in fixed", self._said(self.mobile)), ("fixed in mobile", self._said(self.fixed))])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per vertex inside, with columns `pose` and `body`. Needs pandas."""
        import pandas

        tables = []
        for name, body in (("mobile", self.mobile), ("fixed", self.fixed)):
            if body is not None and body.offset is not None:
                table = body.to_dataframe()
                table.insert(0, "body", name)
                table.insert(0, "pose", np.repeat(np.arange(self.count), np.diff(body.offset)))
                tables.append(table)
        return pandas.concat(tables, ignore_index=True) if tables else pandas.DataFrame()


def _of_pose(body: Optional[VerticesInside], n: int) -> Optional[VerticesInside]:
    if body is None or body.offset is None:
        return None
    return body._part(slice(int(body.offset[n]), int(body.offset[n + 1])))


def _of_poses(body: Optional[VerticesInside], poses: range) -> Optional[VerticesInside]:
    if body is None or body.offset is None:
        return None
    chosen: NDArray[np.int64] = np.arange(poses.start, poses.stop, poses.step)
    begin, end = body.offset[:-1][chosen], body.offset[1:][chosen]
    offset: NDArray[np.int64] = np.append(0, np.cumsum(end - begin))
    if poses.step == 1 and len(poses):
        return body._part(slice(int(begin[0]), int(end[-1])), offset)
    parts = [np.arange(first, last) for first, last in zip(begin, end)]
    return body._part(np.concatenate([np.empty(0, np.int64), *parts]), offset)
