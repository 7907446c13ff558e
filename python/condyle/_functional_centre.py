"""The centre, or the axis, about which one body turned in the other, from recorded poses of both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._poses import Poses


@dataclass(frozen=True)
class FunctionalCentre:
    """Where a ball joint turned. What moves with the joint, as skin over bone does, is in no residual and in no bound.

    Attributes
    ----------
    in_fixed, in_mobile : (3,) float64
        The point, mm, in the frame of each body.
    residual_mm : float
        Root mean square distance of the two.
    centre_bound_mm, sd_mm : float
        95 % of 200 resamples of stretches of the recording have `in_fixed` within; the standard deviation of each of its
        coordinates: root mean square over the three.
    about_axis_deg, off_axis_deg : float
        How much the poses turn about their main axis, and off it: root mean squares.
    poses : int
    """

    in_fixed: NDArray[np.float64]
    in_mobile: NDArray[np.float64]
    residual_mm: float
    centre_bound_mm: float
    sd_mm: float
    about_axis_deg: float
    off_axis_deg: float
    poses: int


@dataclass(frozen=True)
class FunctionalAxis:
    """About which axis a joint turned; bounds as :class:`FunctionalCentre` has them.

    Attributes
    ----------
    point_in_fixed, direction_in_fixed, point_in_mobile, direction_in_mobile : (3,) float64
        A point of it, mm, and its unit vector, in the frame of each body.
    residual_mm : float
        Root mean square distance of the two points.
    direction_bound_deg, axis_bound_mm : float
    about_axis_deg, off_axis_deg : float
        How much the poses turn about it, and off it: root mean squares.
    poses : int
    """

    point_in_fixed: NDArray[np.float64]
    direction_in_fixed: NDArray[np.float64]
    point_in_mobile: NDArray[np.float64]
    direction_in_mobile: NDArray[np.float64]
    residual_mm: float
    direction_bound_deg: float
    axis_bound_mm: float
    about_axis_deg: float
    off_axis_deg: float
    poses: int


def functional_centre(poses: Poses) -> FunctionalCentre:
    """The point that lies best in one place of both bodies (SCoRE, Ehrig et al. 2006): least squares, in closed form.

    `poses` (N, 4, 4) of one body in the other, X_FM, mm; those of NaN are gaps. MeshError for fewer than 20, and where they
    leave their main axis by less than 5 degrees (root mean square): any point of that axis would do.

    >>> import condyle
    >>> joint = condyle.Joint(*condyle.sample_hip())
    >>> turn = np.linspace(0, 6, 50)
    >>> found = functional_centre(joint.pose(flexion_deg=30 * np.sin(turn), adduction_deg=20 * np.sin(2 * turn),
    ...                                      internal_rotation_deg=20 * np.sin(3 * turn)))
    >>> np.abs(found.in_fixed).max() < 1e-9, round(found.off_axis_deg, 1)
    (True, 19.7)
    """
    return FunctionalCentre(**_native.functional_centre(poses))


def functional_axis(poses: Poses) -> FunctionalAxis:
    """The axis about which the poses turn (SARA, Ehrig et al. 2007).

    `poses` as for :func:`functional_centre`. MeshError for fewer than 20, for less than 5 degrees about it (root mean square),
    and where they leave it by more than half as much.

    >>> import condyle
    >>> found = functional_axis(condyle.Joint(*condyle.sample_hip()).pose(flexion_deg=np.linspace(0, 90, 50)))
    >>> (np.abs(found.direction_in_fixed).round(9) + 0.0).tolist(), round(found.about_axis_deg, 1)
    ([0.0, 0.0, 1.0], 25.4)
    """
    return FunctionalAxis(**_native.functional_axis(poses))
