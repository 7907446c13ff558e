"""Ligaments as strings: what a joint has of them, and their length, strain, tension and load in poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._contact_checks import ContactNote, reported
from ._errors import UsageError
from ._native import Joint as NativeJoint
from ._words import Body, WrapShape


@dataclass(frozen=True, eq=False)
class LigamentWrap:
    """The surface that a ligament lies on where the straight line would go through it.

    Attributes
    ----------
    shape : str
        "sphere", "cylinder" (without ends) or "ellipsoid" (where lengths are not known).
    body : str
        That it is fixed to, "fixed" or "mobile"; the rest is in that body's joint frame, mm.
    centre : (3,) float64
        Of a cylinder any point of its axis.
    radius_mm : float or None
        Of a sphere or a cylinder.
    axis : (3,) float64 or None
        Of a cylinder, unit.
    axes, radii_mm : (2, 3) and (3,) float64 or None
        Of an ellipsoid: its first two axes, unit, and half its size along all three.
    """

    shape: WrapShape
    body: Body
    centre: NDArray[np.float64]
    radius_mm: Optional[float] = None
    axis: Optional[NDArray[np.float64]] = None
    axes: Optional[NDArray[np.float64]] = None
    radii_mm: Optional[NDArray[np.float64]] = None


@dataclass(frozen=True, eq=False, repr=False)
class Ligament:
    """A string from one body to the other (docs/ligaments.md).

    Attributes
    ----------
    name : str
    fixed, mobile : (N, 3) float64
        Its points on either body, from the insertion on, in that body's joint frame, mm.
    slack_length_mm : float
        Longer than this it is taut.
    slack_sigma_mm : float
        Its standard deviation, for bands.
    point_sigma_mm : float
        And that of each of its points along each axis of its body.
    stiffness_n : float
        N per unit of strain; 0 if it has no tension.
    transition_strain : float
        Above which its tension grows linearly.
    damping_n_s : float
        Force over the rate of strain while it becomes longer; 0 if it has no damping.
    ends_at_strain : float or None
        The strain that ends a motion.
    wrap : LigamentWrap or None
    """

    name: str
    fixed: NDArray[np.float64]
    mobile: NDArray[np.float64]
    slack_length_mm: float
    slack_sigma_mm: float
    point_sigma_mm: float
    stiffness_n: float
    transition_strain: float
    damping_n_s: float
    ends_at_strain: Optional[float]
    wrap: Optional[LigamentWrap]

    def __repr__(self) -> str:
        return f"Ligament({self.name!r}, slack {self.slack_length_mm:.6g} mm)"


@dataclass(frozen=True, eq=False, repr=False)
class LigamentStates:
    """Ligaments of a joint in poses: the first axis of each array is the ligament, the others are those of the poses.

    NaN where a length is not known: an end lies inside what it wraps, or the straight line meets an ellipsoid.

    Attributes
    ----------
    names : tuple of str
    length_mm, strain, tension_n : (L, ...) float64
        Strain is (length - slack length) / slack length, negative while it is slack.
    force_n, moment_nmm : (L, ..., 3) float64
        Of the tension on the mobile body, in F; the moment about the joint centre. The fixed body has the opposite.
    lengthening_mm_s, damping_n, total_n : (L, ...) float64 or None
        How fast it becomes longer, the force of its damping, and tension and damping; None if neither velocities nor
        times were given.
    notes : tuple of ContactNote
        Lengths that are not known in some of the poses, and strains that no ligament bears: each is a :class:`JointWarning` too.
    """

    names: tuple[str, ...]
    length_mm: NDArray[np.float64]
    strain: NDArray[np.float64]
    tension_n: NDArray[np.float64]
    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]
    lengthening_mm_s: Optional[NDArray[np.float64]] = None
    damping_n: Optional[NDArray[np.float64]] = None
    total_n: Optional[NDArray[np.float64]] = None
    notes: tuple[ContactNote, ...] = ()

    def __repr__(self) -> str:
        return f"LigamentStates({len(self.names)} ligaments, {self.length_mm.shape[1:]} poses)"


def _ligament_of(given: dict[str, Any]) -> Ligament:
    wrap = given.pop("wrap")
    return Ligament(wrap=None if wrap is None else LigamentWrap(**wrap), **given)


def ligaments_of(native: NativeJoint) -> tuple[Ligament, ...]:
    return tuple(_ligament_of(each) for each in _native.ligaments_of(native))


def ligament_states(native: NativeJoint, poses: ArrayLike, time_s: Optional[ArrayLike],
                    velocity_mm_s: Optional[ArrayLike], angular_velocity_rad_s: Optional[ArrayLike]) -> LigamentStates:
    if (velocity_mm_s is None) != (angular_velocity_rad_s is None):
        raise UsageError("velocity_mm_s: velocity_mm_s and angular_velocity_rad_s are given together")
    if time_s is not None and velocity_mm_s is not None:
        raise UsageError("time_s: give times or velocities, not both")
    of_poses = np.shape(poses)[:-2]
    for name, velocity in (("velocity_mm_s", velocity_mm_s), ("angular_velocity_rad_s", angular_velocity_rad_s)):
        if velocity is not None and np.shape(velocity) != (*of_poses, 3):
            raise UsageError(f"{name}: must have the shape {(*of_poses, 3)}, not {np.shape(velocity)}")
    if velocity_mm_s is not None and angular_velocity_rad_s is not None:
        velocity_mm_s = np.reshape(velocity_mm_s, (-1, 3))
        angular_velocity_rad_s = np.reshape(angular_velocity_rad_s, (-1, 3))
    names = tuple(each["name"] for each in _native.ligaments_of(native))
    shape = (len(names), *of_poses)
    arrays = _native.ligament_states(native, poses, time_s, velocity_mm_s, angular_velocity_rad_s)
    notes = reported(_native.ligament_checks(native, poses))
    return LigamentStates(names, notes=notes, **{key: array.reshape((*shape, 3) if key in ("force_n", "moment_nmm") else shape)
                                                 for key, array in arrays.items()})


def ligament_stiffness(native: NativeJoint, poses: ArrayLike) -> NDArray[np.float64]:
    reported(_native.ligament_checks(native, poses))
    return _native.ligament_stiffness(native, poses).reshape((-1, *np.shape(poses)[:-2], 6, 6))
