"""Spheres fitted to points and found in surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._mesh import MeshLike, TriMesh
from ._words import ball, count, number, word


@dataclass(frozen=True)
class SphereFit:
    """A sphere and how well it fits; lengths in the unit of the points (mm).

    Attributes
    ----------
    centre : (3,) float64
    radius : float
    rms_residual, largest_residual : float
        Of the distance to the centre less the radius; the second is a magnitude.
    vertices : (K,) uint32
        Those used, ascending.
    coverage : float or None
        Of a part of a surface: its area over that of the whole sphere.
    centre_bound : float or None
        95 % of fits to resampled parts have their centre within. Where resamples were asked for.
    """

    centre: NDArray[np.float64]
    radius: float
    rms_residual: float
    largest_residual: float
    vertices: NDArray[np.uint32]
    coverage: Optional[float] = None
    centre_bound: Optional[float] = None

    def __repr__(self) -> str:
        centre = ", ".join(f"{value:.6g}" for value in self.centre)
        covered = "" if self.coverage is None else f", covers {self.coverage:.0%}"
        return (f"SphereFit(centre ({centre}), radius {self.radius:.6g}, rms residual {self.rms_residual:.3g}, "
                f"{len(self.vertices)} points{covered})")


def fit_sphere(points: Any) -> SphereFit:
    """The sphere with the smallest sum of squared distances to (N, 3) points. MeshError where they leave it open.

    C++: `condyle::fit_sphere` in condyle/fit.hpp.

    >>> fit = fit_sphere([[3, 2, 1], [-1, 2, 1], [1, 4, 1], [1, 0, 1], [1, 2, 3]])
    >>> fit.centre.round(9).tolist(), round(fit.radius, 9)
    ([1.0, 2.0, 1.0], 2.0)
    """
    return SphereFit(**_native.fit_sphere(points))


def find_sphere(mesh: MeshLike, *, part: str = "head", smallest_radius_mm: float = 10, largest_radius_mm: float = 45,
                within: Optional[tuple[Any, float]] = None, resamples: int = 0) -> SphereFit:
    """The spherical part of a surface that covers most of its sphere: found without a hint, fitted only to that part.

    `part` is "head" (solid inside) or "socket" (outside). `within` is (centre, radius_mm): only vertices in that ball
    are considered. MeshError where no part of the surface is spherical.

    C++: `condyle::find_sphere` in condyle/fit.hpp.
    """
    mesh = TriMesh.of(mesh)
    smallest = number(smallest_radius_mm, "smallest_radius_mm", low=0)
    largest = number(largest_radius_mm, "largest_radius_mm", low=smallest)
    centre, radius = (None, 0.0) if within is None else ball(within, "within")
    found = _native.find_sphere(mesh._native, word(part, "part", ("head", "socket")) == "head", smallest, largest,
                                centre, radius, count(resamples, "resamples", high=100_000))
    if mesh._first is not None:
        found["vertices"] = mesh._first[found["vertices"]]
    return SphereFit(**found)
