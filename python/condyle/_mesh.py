"""Triangle meshes: taken from arrays, from other packages' objects and from files."""

from __future__ import annotations

from typing import Any, Iterable, Optional, Protocol, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import UsageError
from ._native import Mesh as NativeMesh
from ._words import Path, PolygonRule, Repair, array, path_of, refuse_masked, word


class TriMesh:
    """A triangle mesh, checked once: every index in range, every coordinate finite. It cannot be changed.

    Parameters
    ----------
    vertices : (V, 3) real numbers
        Points, one per row; millimetres wherever lengths are given back. Any float or integer type, any memory
        order, read-only arrays and lists. Copied once, into one array per coordinate.
    triangles : (T, 3) integers
        Numbers of vertices, counted from 0, counter-clockwise seen from outside. Any integer type. Copied once.
    merge : bool, optional
        Whether vertices of exactly the same coordinates (-0 being +0) count as one, as triangle soups need. Not
        given: where the mesh is not closed without. Vertices keep their numbers in all answers either way.

    Attributes
    ----------
    vertices : (V, 3) float64, read-only
        As given. Column by column in memory, which is what tables read without copying.
    triangles : (T, 3) uint32, read-only
        As given. A view where no vertices were merged.
    vertex_map : (V,) uint32, read-only, or None
        The number of each vertex among the merged ones; None where none were merged.
    is_closed : bool
        Every edge is used as often in one direction as in the other: then the surface has an inside.

    Raises
    ------
    MeshError
        For an index out of range or a coordinate that is not finite, naming the first.
    UsageError
        For arrays of another shape or kind.

    C++: `condyle::Mesh` in condyle/mesh.hpp.

    >>> import condyle
    >>> tetrahedron = condyle.TriMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                               [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> tetrahedron
    TriMesh(4 vertices, 4 triangles, closed)
    """

    __slots__ = ("_native", "_map", "_first", "_vertices", "_triangles", "_processing", "__weakref__")
    _native: NativeMesh
    _map: Optional[NDArray[np.uint32]]
    _first: Optional[NDArray[np.uint32]]
    _vertices: Optional[NDArray[np.float64]]
    _triangles: Optional[NDArray[np.uint32]]
    _processing: tuple[str, ...]

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, *, merge: Optional[bool] = None) -> None:
        self._take(_native.Mesh(vertices, triangles), merge)

    def _take(self, given: NativeMesh, merge: Optional[bool]) -> None:
        self._native, self._map, self._first = given, None, None
        self._vertices = self._triangles = None
        self._processing = ()
        if merge or (merge is None and not given.is_closed):
            merged, vertex_map = _native.merged(given)
            if merged.vertex_count < given.vertex_count:
                self._native, self._map = merged, vertex_map
                self._vertices, self._triangles = given.vertices, given.triangles
                first = np.empty(merged.vertex_count, np.uint32)
                first[vertex_map[::-1]] = np.arange(given.vertex_count - 1, -1, -1, dtype=np.uint32)
                self._first = first

    @classmethod
    def _of_native(cls, native: NativeMesh, processing: Iterable[str] = ()) -> TriMesh:
        mesh = cls.__new__(cls)
        mesh._take(native, merge=False)
        mesh._processing = tuple(processing)
        return mesh

    @classmethod
    def _moved(cls, native: NativeMesh, like: TriMesh) -> TriMesh:
        """A mesh whose vertices have moved, numbered like the one it was."""
        return cls._numbered(native, *like._numbering())

    def _numbering(self) -> tuple[Any, ...]:
        """How vertices and triangles were numbered when given, and what was done to them."""
        if self._map is None:
            return None, None, None, self._processing
        return self._map, self._first, self._triangles, self._processing

    @classmethod
    def _numbered(cls, native: NativeMesh, map: Optional[NDArray[np.uint32]], first: Optional[NDArray[np.uint32]],
                  triangles: Optional[NDArray[np.uint32]], processing: tuple[str, ...]) -> TriMesh:
        mesh = cls._of_native(native, processing)
        mesh._map, mesh._first = map, first
        if map is not None:
            mesh._vertices, mesh._triangles = np.asfortranarray(native.vertices[map]), triangles
            mesh._vertices.flags.writeable = False
        return mesh

    @classmethod
    def of(cls, mesh: MeshLike, *, merge: Optional[bool] = None) -> TriMesh:
        """The mesh of another package's object, whose package is not imported for it.

        Taken are a TriMesh itself; a pair (vertices, triangles); trimesh (`.vertices`, `.faces`); PyVista
        (`.points`, `.faces` flat as 3 i j k); meshio (`.points`, `.cells`); vtkPolyData.

        >>> from types import SimpleNamespace
        >>> like_pyvista = SimpleNamespace(points=[[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces=[3, 0, 1, 2])
        >>> TriMesh.of(like_pyvista)
        TriMesh(3 vertices, 1 triangle, open)
        """
        if isinstance(mesh, TriMesh):
            return mesh if merge is None else cls(mesh.vertices, mesh.triangles, merge=merge)
        vertices, triangles = _arrays_of(mesh)
        return cls(vertices, triangles, merge=merge)

    @property
    def vertices(self) -> NDArray[np.float64]:
        if self._vertices is None:
            self._vertices = self._native.vertices
        return self._vertices

    @property
    def triangles(self) -> NDArray[np.uint32]:
        if self._triangles is None:
            self._triangles = self._native.triangles
        return self._triangles

    @property
    def vertex_map(self) -> Optional[NDArray[np.uint32]]:
        return self._map

    @property
    def is_closed(self) -> bool:
        return self._native.is_closed

    @property
    def processing(self) -> tuple[str, ...]:
        """Changes to the mesh of a file by reading it or by repairs, one line each."""
        return self._processing

    def repaired(self, *repairs: Repair) -> TriMesh:
        """A mesh with the same surface, repaired: "weld", "drop_unreferenced", "flip_inverted", in this order.

        Vertices that go take their numbers along: the result is a mesh of its own. `processing` says what was done.
        MeshError where a repair cannot be made.
        """
        for repair in repairs:
            word(repair, "repairs", Repair)
        mesh, done = _native.repaired(self._native, list(repairs))
        return TriMesh._of_native(mesh, done)

    def piece(self, at: Optional[ArrayLike] = None) -> TriMesh:
        """One connected piece with the cavities in it, a mesh of its own: specks, another bone and walls within are left out.

        The piece is the one whose surface is nearest the point `at`, (3,) in the mesh's unit, such as the joint centre; without a point the
        largest by volume, of an open mesh by area.

        C++: `condyle::piece_at` and `condyle::largest_piece` in condyle/inspect.hpp.
        """
        kept = _native.largest_piece(self._native) if at is None else _native.piece_at(self._native, at)
        less = self._native.triangle_count - kept.triangle_count
        return TriMesh._of_native(kept, [f"{less} of {self._native.triangle_count} triangles left out: other pieces"] if less else [])

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TriMesh):
            return NotImplemented
        return np.array_equal(self.vertices, other.vertices) and np.array_equal(self.triangles, other.triangles)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return _remade, (np.array(self.vertices), np.array(self.triangles), self._map is not None, self._processing)

    def __repr__(self) -> str:
        count, triangles = len(self.vertices), self._native.triangle_count
        merged = "" if self._map is None else f", merged into {self._native.vertex_count}"
        return (f"TriMesh({count} {'vertex' if count == 1 else 'vertices'}{merged}, "
                f"{triangles} triangle{'' if triangles == 1 else 's'}, {'closed' if self.is_closed else 'open'})")

    # Numbers of the merged mesh's vertices in the mesh as given.

    def _all(self, values: NDArray[Any]) -> NDArray[Any]:
        """One value for each vertex as given."""
        return values if self._map is None else values[self._map]

    def _as_given(self, vertex: int) -> int:
        return vertex if self._first is None else int(self._first[vertex])


def _remade(vertices: Any, triangles: Any, merge: bool, processing: tuple[str, ...] = ()) -> TriMesh:
    mesh = TriMesh(vertices, triangles, merge=merge)
    mesh._processing = processing
    return mesh


class WithFaces(Protocol):
    """A mesh of trimesh."""

    @property
    def vertices(self) -> object: ...

    @property
    def faces(self) -> object: ...


class WithPoints(Protocol):
    """A mesh of PyVista, whose `faces` are flat: 3 i j k for each."""

    @property
    def points(self) -> object: ...

    @property
    def faces(self) -> object: ...


class WithCells(Protocol):
    """A mesh of meshio."""

    @property
    def points(self) -> object: ...

    @property
    def cells(self) -> object: ...


class OfVtk(Protocol):
    """A vtkPolyData."""

    def GetPoints(self) -> object: ...

    def GetPolys(self) -> object: ...


MeshLike = Union[TriMesh, tuple[ArrayLike, ArrayLike], WithFaces, WithPoints, WithCells, OfVtk]


def _triangles_of_flat(faces: Any, what: str) -> NDArray[Any]:
    """3 i j k 3 l m n ..., as VTK and PyVista store triangles."""
    refuse_masked(faces, what)
    flat = np.asarray(faces)
    if flat.ndim != 1:
        return flat
    if flat.size % 4 or (flat.size and (flat[::4] != 3).any()):
        raise UsageError(f"{what}: only triangles are taken: 3 i j k for each")
    return flat.reshape(-1, 4)[:, 1:]


def _triangles_of_cells(cells: Any) -> NDArray[Any]:
    """The triangles of meshio's blocks; vertices and lines beside them are passed over."""
    pairs = cells.items() if isinstance(cells, dict) else [
        (block.type, block.data) if hasattr(block, "type") else tuple(block) for block in cells]
    triangles = []
    for kind, data in pairs:
        refuse_masked(data, "cells")
        if kind == "triangle":
            triangles.append(np.asarray(data))
        elif kind not in ("vertex", "line"):
            raise UsageError(f"cells: only triangles are taken, not {kind}")
    return np.concatenate(triangles) if triangles else np.empty((0, 3), np.int64)


def _arrays_of_vtk(mesh: Any) -> tuple[NDArray[Any], NDArray[Any]]:
    vertices = np.asarray(mesh.GetPoints().GetData()).reshape(-1, 3)
    cells = mesh.GetPolys()
    if hasattr(cells, "GetOffsetsArray"):
        offsets = np.asarray(cells.GetOffsetsArray()).reshape(-1)
        if (np.diff(offsets) != 3).any():
            raise UsageError("polys: only triangles are taken")
        return vertices, np.asarray(cells.GetConnectivityArray()).reshape(-1, 3)
    return vertices, _triangles_of_flat(np.asarray(cells.GetData()).reshape(-1), "polys")


def _arrays_of(mesh: Any) -> tuple[Any, Any]:
    try:
        if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
            return mesh[0], mesh[1]
        if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            return mesh.vertices, _triangles_of_flat(mesh.faces, "faces")
        if hasattr(mesh, "points") and hasattr(mesh, "cells") and not hasattr(mesh, "faces"):
            return mesh.points, _triangles_of_cells(mesh.cells)
        if hasattr(mesh, "points") and hasattr(mesh, "faces"):
            return mesh.points, _triangles_of_flat(mesh.faces, "faces")
        if hasattr(mesh, "GetPoints") and hasattr(mesh, "GetPolys"):
            return _arrays_of_vtk(mesh)
    except UsageError:
        raise
    except Exception as error:  # an object that is no mesh after all may raise anything
        raise UsageError(f"mesh: {type(mesh).__name__} cannot be read as a mesh: "
                         f"{str(error).splitlines()[0] if str(error) else type(error).__name__}") from error
    raise UsageError(f"mesh: {type(mesh).__name__} is none: a TriMesh, a pair (vertices, triangles), or an object of "
                     "trimesh, PyVista, meshio or VTK is needed")


def read_mesh(path: Path, *, polygons: PolygonRule = "refuse") -> TriMesh:
    """Reads .stl, .obj, .ply, .vtp or .vtk (legacy PolyData), in the file's own unit.

    Vertices keep the file's order and every bit. STL has corners and no vertices: those of the same coordinates are
    one, numbered by their first, and corner k of triangle t is vertex `triangles[t, k]`. Polygons of more than three
    corners are refused, for a file does not say what surface is inside; "split" takes the triangles round the first
    corner from which all turn one way, cuts any other flat one, and refuses twisted ones; "guess" splits these too.
    The mesh says how many in its `processing`. Raises FileError.

    C++: `condyle::read_mesh` in condyle/io/mesh_file.hpp.

    >>> read_mesh("nowhere.stl")
    Traceback (most recent call last):
        ...
    condyle.FileError: nowhere.stl: no such file
    """
    mesh, merged, split = _native.read_mesh(path_of(path), word(polygons, "polygons", PolygonRule))
    processing = [f"merged {merged} corners of the same coordinates"] if merged else []
    return TriMesh._of_native(mesh, processing + ([split] if split else []))


def write_mesh(path: Path, mesh: MeshLike) -> None:
    """Writes .vtp or .ply, binary, so that reading gives the same bits. The whole file or nothing; FileError."""
    mesh = TriMesh.of(mesh)
    whole = mesh if mesh.vertex_map is None else TriMesh(mesh.vertices, mesh.triangles, merge=False)
    _native.write_mesh(path_of(path), whole._native)


def merged_positions(mesh: TriMesh, vertices: ArrayLike) -> ArrayLike:
    """New positions of the vertices of a mesh: of those that merged vertices became."""
    if mesh.vertex_map is None:
        return vertices
    positions = array(vertices, "vertices", f"an array of shape {mesh.vertices.shape}")
    if positions.shape != mesh.vertices.shape:
        raise UsageError(f"vertices: an array of shape {mesh.vertices.shape} is needed, not {positions.shape}")
    merged: NDArray[Any] = positions[mesh._first]
    if not np.array_equal(merged[mesh.vertex_map], positions):
        raise UsageError("vertices: some that were merged are no longer in one place")
    return merged


def refuse_merged(mesh: TriMesh) -> None:
    """Numbers of vertices are those of the mesh as it was given only where none were merged."""
    if mesh.vertex_map is not None:
        raise UsageError("moved: the mesh has merged vertices: give the positions of all")
