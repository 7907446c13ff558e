"""Properties and defects of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, Optional, TypedDict, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._answer import ByName
from ._mesh import MeshLike, TriMesh
from ._words import LengthUnit


class BoundaryLoop(TypedDict):
    """Edges that go round a hole: how many, the first one, and their centre (3,)."""

    edges: int
    first: tuple[int, int]
    centre: NDArray[np.float64]


@dataclass(frozen=True)
class Finding:
    """How many elements have a defect, and the first of them: a number, two numbers of an edge, or a mapping."""

    count: int
    first: Union[int, tuple[int, int], BoundaryLoop, None]

    def __bool__(self) -> bool:
        return self.count > 0


class Findings(ByName[Finding]):
    _what = "finding"


@dataclass(frozen=True)
class MeshComponent:
    """Triangles that hang together over edges. `bounds` is (low, high), each (3,); `inside` the component that most of it lies in."""

    first_triangle: int
    triangles: int
    is_closed: bool
    genus: Optional[int]
    signed_volume: Optional[float]
    bounds: tuple[NDArray[np.float64], NDArray[np.float64]]
    inside: Optional[int]


@dataclass(frozen=True)
class MeshReport:
    """Results of :func:`inspect`. Lengths, areas and volumes are in the mesh's unit; elements are counted from 0.

    `findings` has a :class:`Finding` under each of boundary_edges, boundary_loops, non_manifold_edges,
    non_manifold_vertices, inconsistent_edges, unbalanced_edges, duplicate_triangles, degenerate_triangles,
    unreferenced_vertices, duplicate_vertices, inverted_components, self_crossings. `bounds` is (low, high), each (3,);
    `edge_lengths` are the shortest, the median and the longest. `signed_volume` is None of an open mesh. `two_sided` is None, or a line that
    says that every triangle is there twice, once in each sense.
    """

    vertices: int
    triangles: int
    is_closed: bool
    two_sided: Optional[str]
    findings: Mapping[str, Finding]
    components: tuple[MeshComponent, ...]
    bounds: tuple[NDArray[np.float64], NDArray[np.float64]]
    area: float
    signed_volume: Optional[float]
    edge_lengths: tuple[float, float, float]
    likely_unit: Optional[LengthUnit]
    likely_unit_reason: str

    @property
    def defects(self) -> dict[str, Finding]:
        """The findings that found something."""
        return {name: finding for name, finding in self.findings.items() if finding}

    def __repr__(self) -> str:
        volume = "open" if self.signed_volume is None else f"closed, volume {self.signed_volume:.6g}"
        defects = ", ".join(f"{name}: {finding.count}" for name, finding in self.defects.items())
        return (f"MeshReport({self.vertices} vertices, {self.triangles} triangles, {volume}, "
                f"area {self.area:.6g}, {len(self.components)} component{'' if len(self.components) == 1 else 's'}"
                f"{'; ' + defects if defects else ''})")

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{name}</td><td>{finding.count}</td></tr>" for name, finding in self.findings.items())
        return f"<div>{self!r}</div><table><tr><th>finding</th><th>count</th></tr>{rows}</table>"


def inspect(mesh: MeshLike) -> MeshReport:
    """Looks at everything about a mesh once, as it is given: nothing is merged or repaired. n log n.

    C++: `condyle::inspect` in condyle/inspect.hpp; the command `condyle inspect`.

    >>> import condyle
    >>> condyle.inspect(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    MeshReport(3 vertices, 1 triangles, open, area 0.5, 1 component; boundary_edges: 3, boundary_loops: 1, ...)
    """
    given = TriMesh.of(mesh)
    if given.vertex_map is not None:
        given = TriMesh(given.vertices, given.triangles, merge=False)
    found = _native.inspect(given._native)
    found["findings"] = Findings((name, Finding(*finding)) for name, finding in found["findings"].items())
    found["components"] = tuple(MeshComponent(**part) for part in found["components"])
    return MeshReport(**found)
