"""Lays a curved bearing surface flat on paper."""
from __future__ import annotations

from typing import NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._errors import UsageError

Array = NDArray[np.float64]


class Flattened(NamedTuple):
    """A surface laid flat: `points_mm` (V, 2) to the right and up; `facing` (T,) triangles whose front is seen; `right`
    and `up`, unit vectors (3,) on the paper's axes at its middle; `projection`, in words.
    """

    points_mm: Array
    facing: NDArray[np.bool_]
    right: Array
    up: Array
    projection: str


def area_normals(vertices: Array, triangles: NDArray[np.int64]) -> Array:
    """(T, 3): outwards, their lengths the areas."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return np.asarray(np.cross(b - a, c - a) / 2, dtype=np.float64)


def _unit(vector: Array) -> Array:
    length = float(np.linalg.norm(vector))
    if not length > 0:
        raise UsageError("the surface has no mean direction: it is closed, or has no area")
    return np.asarray(vector / length, dtype=np.float64)


def axes_seen_along(normal: Array, up: Optional[ArrayLike]) -> Tuple[Array, Array]:
    """To the right and up on paper when looking against `normal`. Without `up`: superior (+Y), or anterior (+X) where
    the surface faces up or down by more than 45 degrees.
    """
    if up is None:
        up = (1.0, 0.0, 0.0) if abs(normal[1]) > np.sqrt(0.5) else (0.0, 1.0, 0.0)
    wanted = np.asarray(up, dtype=np.float64)
    upwards = _unit(wanted - (wanted @ normal) * normal)
    return np.asarray(np.cross(upwards, normal), dtype=np.float64), upwards


def on_plane(vertices: Array, triangles: NDArray[np.int64], weights: Array,
             up: Optional[ArrayLike] = None) -> Flattened:
    """Orthographic: seen from far away along the mean normal of the triangles, weighted; the origin at their centroid.

    Lengths are true along the paper only where the surface is parallel to it.
    """
    normals = area_normals(vertices, triangles)
    normal = _unit((weights[:, None] * normals).sum(axis=0))
    right, upwards = axes_seen_along(normal, up)
    shares = weights * np.linalg.norm(normals, axis=1)
    middle = (shares[:, None] * vertices[triangles].mean(axis=1)).sum(axis=0) / shares.sum()
    points = (vertices - middle) @ np.stack((right, upwards)).T
    return Flattened(points, normals @ normal > 0, right, upwards, "orthographic along the mean normal")


def about_centre(vertices: Array, triangles: NDArray[np.int64], weights: Array, centre: ArrayLike = (0, 0, 0),
                 up: Optional[ArrayLike] = None) -> Flattened:
    """Azimuthal equidistant about a centre: the pole is the mean direction of the triangles, weighted; along every line
    through it lengths are true on the sphere of the triangles' mean distance from the centre. Heads are seen from
    outside, sockets from inside.
    """
    from_centre = vertices - np.asarray(centre, dtype=np.float64)
    normals = area_normals(vertices, triangles)
    middles = from_centre[triangles].mean(axis=1)
    distances = np.linalg.norm(middles, axis=1)
    if not (np.linalg.norm(from_centre, axis=1) > 0).all():
        raise UsageError("a vertex is at the centre: it has no direction")
    shares = weights * np.linalg.norm(normals, axis=1)
    pole = _unit((shares[:, None] * middles / distances[:, None]).sum(axis=0))
    radius = float((shares * distances).sum() / shares.sum())
    outward = np.einsum("ij,ij->i", normals, middles)
    faces_centre = float(np.sum(weights * outward)) < 0  # a socket is seen from its centre, a head from outside
    right, upwards = axes_seen_along(-pole if faces_centre else pole, up)
    directions = from_centre / np.linalg.norm(from_centre, axis=1)[:, None]
    on_paper = directions @ np.stack((right, upwards)).T
    sine = np.linalg.norm(on_paper, axis=1)
    angle = np.arctan2(sine, directions @ pole)
    scale = np.divide(angle, sine, out=np.ones_like(angle), where=sine > 0)
    near = np.abs(distances - radius) < 0.25 * radius  # what is farther in or out is not the bearing surface
    # A triangle around the point opposite of the pole would be torn over the whole paper.
    whole = angle[triangles].max(axis=1) < np.radians(170)
    facing = (outward < 0 if faces_centre else outward > 0) & near & whole
    return Flattened(radius * scale[:, None] * on_paper, facing, right, upwards,
                     f"azimuthal equidistant about the joint centre, radius {radius:.1f} mm")
