"""The tables that everything else is made of, for those who build on the core."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import Columns
from ._errors import OutOfRangeError
from ._gaps import VertexGaps
from ._mesh import MeshLike, TriMesh, merged_positions, refuse_merged
from ._words import ArcRule, CellMap, count, number, word


class RadialTable:
    """Which triangles of a mesh can be met in each direction from the origin of its frame, the joint centre.

    Parameters
    ----------
    mesh : mesh
        A :class:`TriMesh` or what :meth:`TriMesh.of` takes; closed, for queries. MeshError where the origin lies on it.
    map : "cube" or "cartesian"
        The map from directions to cells; "cartesian" is the founding paper's.
    cells_per_side : int, optional
        1 to 2048; chosen for the number of triangles if not given.

    Any number of threads may ask; an update waits for those before it.

    C++: `condyle::RadialTable` in condyle/radial.hpp.

    >>> import numpy as np
    >>> import condyle
    >>> octahedron = condyle.TriMesh(np.vstack([np.eye(3), -np.eye(3)]),
    ...     [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]])
    >>> table = condyle.RadialTable(octahedron)
    >>> table.query([[0.25, 0, 0], [2, 0, 0]]).gap_mm
    array([-0.75,  1.  ])
    >>> table.update(2 * octahedron.vertices)
    >>> table.query([[0.25, 0, 0], [2, 0, 0]]).gap_mm
    array([-1.75,  0.  ])
    """

    __slots__ = ("_native", "_mesh", "__weakref__")

    def __init__(self, mesh: MeshLike, *, map: CellMap = "cube", cells_per_side: Optional[int] = None) -> None:
        self._mesh = TriMesh.of(mesh)
        cells = None if cells_per_side is None else count(cells_per_side, "cells_per_side", 1, 2048)
        self._native = _native.RadialTable(
            self._mesh._native, word(map, "map", CellMap) == "cube", cells)

    def query(self, points: ArrayLike) -> VertexGaps:
        """State, winding number and gap along its ray of each of (N, 3) points in the mesh's frame, mm.

        float64 points that lie column by column in memory, as `TriMesh.vertices` do, are read in place and must not be
        written to meanwhile; others are copied. MeshError of an open mesh.
        """
        return VertexGaps(**self._native.query(points))

    def radial_gaps(self, points: ArrayLike) -> NDArray[np.float64]:
        """(N,) `gap_mm` of :meth:`query` alone, sooner: for colours and curves. The same points and errors.

        >>> import condyle
        >>> hip = condyle.sample_hip(scenario=1)
        >>> table = condyle.RadialTable(hip.hip_bone)
        >>> bool((table.radial_gaps(hip.femur.vertices) == table.query(hip.femur.vertices).gap_mm).all())
        True
        """
        return self._native.radial_gaps(points)

    def update(self, vertices: ArrayLike, *, moved: Optional[ArrayLike] = None) -> None:
        """The surface has deformed: (V, 3) new positions of all vertices, or those of the K vertices `moved` (K,).

        Answers are then those of a table made anew. UsageError where numbers do not fit, MeshError where the surface
        now holds the origin; the table is then what it was. A third to nearly half the cost of making one.
        """
        if moved is None:
            self._native.update(merged_positions(self._mesh, vertices))
        else:
            refuse_merged(self._mesh)
            self._native.update_some(moved, vertices)

    @property
    def mesh(self) -> TriMesh:
        """The mesh as it is now."""
        return TriMesh._moved(self._native.mesh, self._mesh)

    @property
    def winding_at_centre(self) -> Optional[int]:
        """Winding number of the origin; None for an open mesh."""
        return self._native.winding_at_centre

    @property
    def table_size(self) -> dict[str, int]:
        """Cells, entries, bytes and the longest list."""
        return self._native.size

    def __repr__(self) -> str:
        return f"RadialTable({self._mesh!r}, {self.table_size['cells']} cells)"


@dataclass(frozen=True, eq=False, repr=False)
class OccupiedArcs(Columns):
    """Rotation angles at which each of many points lies in the solid: point i owns [offset[i], offset[i + 1]).

    `begin_deg` in [0, 360) and `end_deg`, up to 360 more; `enters` and `leaves` are the triangles at both ends.
    """

    offset: NDArray[np.int64]
    begin_deg: NDArray[np.float64]
    end_deg: NDArray[np.float64]
    enters: NDArray[np.uint32]
    leaves: NDArray[np.uint32]

    def __len__(self) -> int:
        return len(self.offset) - 1

    def of(self, point: int) -> NDArray[np.float64]:
        """(K, 2) begin and end of the arcs of one point, degrees."""
        if not -len(self) <= point < len(self):
            raise OutOfRangeError(f"point: there are {len(self)}, counted from 0, and no {point}")
        point = range(len(self))[point]
        part = slice(int(self.offset[point]), int(self.offset[point + 1]))
        return np.column_stack([self.begin_deg[part], self.end_deg[part]])

    def __repr__(self) -> str:
        return f"OccupiedArcs({len(self)} points, {len(self.begin_deg)} arcs)"

    _dimension = "arc"


class RingTable:
    """Which triangles of a closed mesh a point can meet that rotates about an axis.

    `point` and `direction` of the axis are in the mesh's frame, the direction of any length but zero. Any number of
    threads may ask. MeshError where the mesh is open, UsageError for options out of range.

    C++: `condyle::RingTable` in condyle/tangential.hpp.

    >>> import condyle
    >>> tetrahedron = condyle.TriMesh([[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1]],
    ...                               [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> table = condyle.RingTable(tetrahedron, [0, 0, 0], [0, 0, 1])
    >>> table.query([[0, -1.5, 0.25]]).gap_deg.round(3)
    array([90.])
    """

    __slots__ = ("_native", "_mesh", "__weakref__")

    def __init__(self, mesh: MeshLike, point: ArrayLike, direction: ArrayLike, *,
                 cells_per_triangle: float = 0.0625) -> None:
        self._mesh = TriMesh.of(mesh)
        self._native = _native.RingTable(self._mesh._native, point, direction,
                                         number(cells_per_triangle, "cells_per_triangle"))

    def query(self, points: ArrayLike, *, rule: ArcRule = "alternating") -> VertexGaps:
        """State and gap along its circle of each of (N, 3) points; `rule` "nearest_arc" is the founding paper's."""
        is_nearest = word(rule, "rule", ArcRule) == "nearest_arc"
        return VertexGaps(**self._native.query(points, is_nearest))

    def occupied_arcs(self, points: ArrayLike) -> OccupiedArcs:
        """All rotation angles at which each of (N, 3) points lies in the solid."""
        return OccupiedArcs(**self._native.occupied_arcs(points))

    def __repr__(self) -> str:
        return f"RingTable({self._mesh!r})"


