"""Where on the socket's rim, and where around the neck: clock faces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._mesh import MeshLike, TriMesh
from ._words import Ball, array, ball, number

OneDirection = Union[np.ndarray[tuple[int], np.dtype[np.generic]], Sequence[float]]
ManyDirections = Union[np.ndarray[tuple[int, int], np.dtype[np.generic]], Sequence[Sequence[float]]]
HoursOf = Callable[[NDArray[np.float64], NDArray[np.float64], ArrayLike], NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class ClockFace:
    """A clock face in a body's frame, seen with 12 up and 3 anterior whichever side of the body it is on.

    `twelve` and `three` are (3,) unit vectors at a right angle.

    C++: `condyle::ClockFace` in condyle/impingement_zone.hpp.

    >>> import condyle
    >>> face = condyle.sagittal_clock()
    >>> face.hour_of([1, 0, 0]), face.angle_deg_of([[0, -1, 0], [-1, 0, 0]]).tolist()
    (3.0, [180.0, 270.0])
    """

    twelve: NDArray[np.float64]
    three: NDArray[np.float64]

    @overload
    def hour_of(self, direction: OneDirection) -> float: ...

    @overload
    def hour_of(self, direction: ManyDirections) -> NDArray[np.float64]: ...

    def hour_of(self, direction: ArrayLike) -> Union[float, NDArray[np.float64]]:
        """The hour of a direction (3,) from the centre, in [0, 12), 1.5 being half past one; of (N, 3) an array (N,).

        Along the face's normal there is no hour: 0.
        """
        return self._each(_native.clock_hours, direction)

    @overload
    def angle_deg_of(self, direction: OneDirection) -> float: ...

    @overload
    def angle_deg_of(self, direction: ManyDirections) -> NDArray[np.float64]: ...

    def angle_deg_of(self, direction: ArrayLike) -> Union[float, NDArray[np.float64]]:
        """The same as an angle from 12 towards 3, in [0, 360)."""
        return self._each(_native.clock_angles_deg, direction)

    def _each(self, ask: HoursOf, direction: ArrayLike) -> Union[float, NDArray[np.float64]]:
        given = array(direction, "direction", "an array of shape (3,) or (N, 3)")
        found = ask(self.twelve, self.three, given[None] if given.ndim == 1 else given)
        return float(found[0]) if given.ndim == 1 else found


def clock_face(normal: ArrayLike) -> ClockFace:
    """The face whose plane has this normal (3,), of either sense and any length but zero.

    12 is Y of the joint frame and 3 is X, each as it falls on the plane. UsageError where the normal is within a degree
    of Y, or 12 and X leave no 3.

    C++: `condyle::clock_face` in condyle/impingement_zone.hpp.
    """
    return ClockFace(*_native.clock_face(normal))


def sagittal_clock() -> ClockFace:
    """The acetabular clock where the plane of the rim is not given: the sagittal plane, normal Z.

    C++: `condyle::sagittal_clock` in condyle/impingement_zone.hpp.
    """
    return ClockFace(*_native.sagittal_clock())


def find_rim_clock(fixed: MeshLike, head: Ball) -> Optional[ClockFace]:
    """The acetabular clock in the plane of the rim, 6 o'clock at the acetabular notch; head (centre, radius_mm) in F.

    None where no rim or no notch is found, or the plane leaves no 3 o'clock.

    C++: `condyle::find_rim_clock` in condyle/impingement_zone.hpp.
    """
    centre, radius = ball(head, "head")
    found = _native.find_rim_clock(TriMesh.of(fixed)._native, centre, radius)
    return None if found is None else ClockFace(*found)


def find_neck_axis(mobile: MeshLike, head_radius_mm: float) -> Optional[NDArray[np.float64]]:
    """(3,) the direction of the femoral neck from the head's centre outwards, in M; None where there is none.

    C++: `condyle::find_neck_axis` in condyle/impingement_zone.hpp.
    """
    return _native.find_neck_axis(TriMesh.of(mobile)._native, number(head_radius_mm, "head_radius_mm", low=0))


def neck_clock(direction: ArrayLike) -> ClockFace:
    """The clock around the neck, across its axis: see :func:`find_neck_axis`.

    C++: `condyle::neck_clock` in condyle/impingement_zone.hpp.
    """
    return ClockFace(*_native.neck_clock(direction))
