"""Overlap past a limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._limits import MotionLimit
from ._mesh import TriMesh


@dataclass(frozen=True)
class BodyZone:
    """One body's part of an impingement zone, in that body's own frame.

    (V,) `radial_depth_mm`, `ray_to_normal_deg`, `tangential_depth_deg`, `tangential_depth_mm`, 0 for vertices not
    inside, all empty where the other body is open; `triangles` (K,) that meet the other body; `area_mm2` and `centroid`
    (3,) of these.
    """

    radial_depth_mm: NDArray[np.float64]
    ray_to_normal_deg: NDArray[np.float64]
    tangential_depth_deg: NDArray[np.float64]
    tangential_depth_mm: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    area_mm2: float
    centroid: Optional[NDArray[np.float64]]


@dataclass(frozen=True)
class ImpingementZone:
    """The triangles that overlap `past_deg` past a limit. Hours are on the socket's sagittal clock, angles around the neck.

    An hour is None for joints other than hips, and farther than 1.6 head radii from the joint centre, beyond the rim.
    """

    limit: MotionLimit
    past_deg: float
    fixed: BodyZone
    mobile: BodyZone
    contact_hour: Optional[float]
    zone_hour: Optional[float]
    contact_neck_angle_deg: Optional[float]
    zone_neck_angle_deg: Optional[float]


def body_zone_of(found: dict[str, Any], of: TriMesh) -> BodyZone:
    for name, values in found.items():
        if isinstance(values, np.ndarray) and name not in ("triangles", "centroid") and len(values):
            found[name] = of._all(values)
    return BodyZone(**found)
