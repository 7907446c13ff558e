"""Forces of an elastic contact as a simulator integrates them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._contact_checks import ContactNote, contact_notes
from ._mesh import TriMesh
from ._words import Body


@dataclass(frozen=True, eq=False)
class VertexForces:
    """Forces on the vertices of one body that have a share in the contact, in the frame of that body.

    `vertex` (K,) are numbers of vertices of the mesh as it was given, `force_n` (K, 3) the forces on them.
    """

    vertex: NDArray[np.uint32]
    force_n: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.vertex)


@dataclass(frozen=True, eq=False)
class VertexStiffness:
    """How forces on vertices fall when vertices are moved: 3 x 3 blocks of a sparse matrix.

    `row` and `column` (B,) are places in `on_fixed`, and after these in `on_mobile`; `block` (B, 3, 3) is in N / mm, its rows in
    the frame of the row's body and its columns in that of the column's. As a matrix of scipy:
    `scipy.sparse.bsr_array` takes blocks sorted by row, as these are.
    """

    row: NDArray[np.uint32]
    column: NDArray[np.uint32]
    block: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.row)


@dataclass(frozen=True, eq=False)
class ForcePatch:
    """Faces in contact that hang together by common vertices.

    `face` (K,) are faces of the body that is `casting`; `area_mm2`, `load_n` (the integral of the pressure) and
    `max_pressure_mpa` (elastic, times the factor) are of that surface; `force_n` and `moment_nmm` (3,) are what the patch adds to
    those of the contact; `centre_of_pressure` and `centre_of_area` (3,) are in F.
    """

    casting: Body
    face: NDArray[np.uint32]
    area_mm2: float
    max_pressure_mpa: float
    load_n: float
    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]
    centre_of_pressure: NDArray[np.float64]
    centre_of_area: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ContactForces:
    """Forces at one pose and motion (docs/contact.md). What was not asked for is None.

    Attributes
    ----------
    force_n, moment_nmm : (3,) float64
        On the mobile body, in F, about the origin of M.
    energy_nmm : float
        Stored in the layers.
    friction_power, damping_power : float
        Taken out of the motion, N mm / s; 0 or more.
    max_strain : float
        The largest depth over the thickness of both layers there. Above 1 no layer is compressed so far, and the forces are none.
    factor : float
        The factor asked for: below 1 a ramp is in force.
    stiffness : (6, 6) float64
        Minus the derivative of force and moment with a translation (mm) and a rotation (rad) of the mobile body about the origin
        of M, in F, of the elastic part.
    on_fixed, on_mobile : VertexForces
    vertex_stiffness : VertexStiffness
    patches : tuple of ForcePatch
    notes : tuple of ContactNote
        What looks wrong: layers compressed too far, a force that no joint carries.
    """

    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]
    energy_nmm: float
    friction_power: float
    damping_power: float
    max_strain: float
    factor: float
    stiffness: Optional[NDArray[np.float64]]
    on_fixed: Optional[VertexForces]
    on_mobile: Optional[VertexForces]
    vertex_stiffness: Optional[VertexStiffness]
    patches: Optional[tuple[ForcePatch, ...]]
    notes: tuple[ContactNote, ...]


def forces_of(found: dict[str, Any], fixed: TriMesh, mobile: TriMesh) -> ContactForces:
    for name, mesh in (("on_fixed", fixed), ("on_mobile", mobile)):
        if found[name] is not None:
            vertex, force = found[name]
            found[name] = VertexForces(vertex if mesh._first is None else mesh._first[vertex], force)
    if found["vertex_stiffness"] is not None:
        found["vertex_stiffness"] = VertexStiffness(*found["vertex_stiffness"])
    if found["patches"] is not None:
        found["patches"] = tuple(ForcePatch(**each) for each in found["patches"])
    found["notes"] = contact_notes(found["notes"])
    return ContactForces(**found)
