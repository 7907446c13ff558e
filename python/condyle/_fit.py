"""Spheres and cylinders fitted to points and found in surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._mesh import MeshLike, TriMesh
from ._words import Ball, SpherePart, ball, count, number, word


@dataclass(frozen=True)
class SphereFit:
    """A sphere and how well it fits; lengths in the unit of the points (mm).

    Attributes
    ----------
    centre : (3,) float64
    radius : float
    rms_residual, largest_residual : float
        Residuals: the distance to the centre less the radius; the second is a magnitude.
    vertices : (K,) uint32
        The vertices used, ascending.
    coverage : float or None
        Coverage by a part of a surface: its area over that of the whole sphere.
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


def fit_sphere(points: ArrayLike) -> SphereFit:
    """The sphere with the smallest sum of squared distances to (N, 3) points. MeshError where they leave it open.

    C++: `condyle::fit_sphere` in condyle/fit.hpp.

    >>> fit = fit_sphere([[3, 2, 1], [-1, 2, 1], [1, 4, 1], [1, 0, 1], [1, 2, 3]])
    >>> fit.centre.round(9).tolist(), round(fit.radius, 9)
    ([1.0, 2.0, 1.0], 2.0)
    """
    return SphereFit(**_native.fit_sphere(points))


def find_sphere(mesh: MeshLike, *, part: SpherePart = "head", smallest_radius_mm: Optional[float] = None,
                largest_radius_mm: Optional[float] = None, within: Optional[Ball] = None, resamples: int = 0) -> SphereFit:
    """The spherical part of a surface that covers most of its sphere: found without a hint, fitted only to that part.

    `part` is "head" (solid inside) or "socket" (outside). Radii are looked for by the size of the surface unless they are given:
    from 0.041 to 0.29 of the root of its area, on a whole adult femur 10 to 72 mm. A piece of the surface inside another is left out.
    `within` is (centre, radius_mm): only vertices in that ball
    are considered. MeshError where no part of the surface is spherical.

    C++: `condyle::find_sphere` in condyle/fit.hpp.
    """
    mesh = TriMesh.of(mesh)
    smallest = None if smallest_radius_mm is None else number(smallest_radius_mm, "smallest_radius_mm", low=0)
    largest = None if largest_radius_mm is None else number(largest_radius_mm, "largest_radius_mm", low=smallest or 0)
    centre, radius = (None, 0.0) if within is None else ball(within, "within")
    found = _native.find_sphere(mesh._native, word(part, "part", SpherePart) == "head", smallest, largest,
                                centre, radius, count(resamples, "resamples", high=100_000))
    if mesh._first is not None:
        found["vertices"] = mesh._first[found["vertices"]]
    return SphereFit(**found)


@dataclass(frozen=True)
class CylinderFit:
    """A cylinder and how well it fits; lengths in the unit of the points (mm).

    Attributes
    ----------
    point : (3,) float64
        On the axis, nearest the centroid of the points used.
    direction : (3,) float64
        Unit; of its two senses the one whose largest component is positive.
    radius : float
    rms_residual, largest_residual : float
        Residuals: the distance to the axis less the radius; the second is a magnitude.
    vertices : (K,) uint32
        The vertices used, ascending.
    coverage : float
        The share of a turn about the axis in which there are points.
    direction_bound_deg, axis_bound : float or None
        95 % of fits to resampled parts have their direction, and their axis beside `point`, within; given by
        :func:`find_cylinder`.
    """

    point: NDArray[np.float64]
    direction: NDArray[np.float64]
    radius: float
    rms_residual: float
    largest_residual: float
    vertices: NDArray[np.uint32]
    coverage: float
    direction_bound_deg: Optional[float]
    axis_bound: Optional[float]

    def __repr__(self) -> str:
        point, direction = (", ".join(f"{value:.6g}" for value in each) for each in (self.point, self.direction))
        return (f"CylinderFit(axis through ({point}) along ({direction}), radius {self.radius:.6g}, "
                f"rms residual {self.rms_residual:.3g}, {len(self.vertices)} points)")


def fit_cylinder(points: ArrayLike, point: ArrayLike, direction: ArrayLike, radius: float) -> CylinderFit:
    """The cylinder near a first one that has the smallest sum of squared distances to (N, 3) points.

    `point` (3,) on the first one's axis, `direction` (3,) of any length but zero, `radius` above 0. MeshError where the
    points leave it open: fewer than five, or all on one line or plane.

    C++: `condyle::fit_cylinder` in condyle/fit.hpp.

    >>> turn = np.linspace(0, 6, 30)
    >>> fit = fit_cylinder(np.column_stack([2 * np.cos(turn), 2 * np.sin(turn), turn]), [0.1, 0, 0], [0, 0.1, 1], 1.8)
    >>> (fit.direction.round(9) + 0.0).tolist(), round(fit.radius, 9)
    ([0.0, 0.0, 1.0], 2.0)
    """
    return CylinderFit(**_native.fit_cylinder(points, point, direction, number(radius, "radius", low=0)))


def find_cylinder(mesh: MeshLike, *, smallest_radius_mm: float = 5, largest_radius_mm: float = 45,
                  within: Optional[Ball] = None) -> CylinderFit:
    """The cylindrical part of a surface with most area for its radius squared, fitted only to that part.

    On a whole long bone that is its shaft: limit the search to the ball `within`, (centre, radius_mm), to get condyles.
    MeshError where no part of the surface is cylindrical, or its parts do not agree on a direction within 15 degrees.

    C++: `condyle::find_cylinder` in condyle/fit.hpp.
    """
    mesh = TriMesh.of(mesh)
    smallest = number(smallest_radius_mm, "smallest_radius_mm", low=0)
    largest = number(largest_radius_mm, "largest_radius_mm", low=smallest)
    centre, radius = (None, 0.0) if within is None else ball(within, "within")
    found = _native.find_cylinder(mesh._native, smallest, largest, centre, radius)
    if mesh._first is not None:
        found["vertices"] = mesh._first[found["vertices"]]
    return CylinderFit(**found)
