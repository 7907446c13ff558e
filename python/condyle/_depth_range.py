"""Limits of joints whose meshes overlap a little wherever they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence

from . import _native
from ._joint import Joint
from ._limits import ContactWitness, MotionLimit, motion_limit_of, witness_of
from ._motion import MotionLike, Motions
from ._words import Progress, number, progress_of


@dataclass(frozen=True, eq=False)
class DeepestPlace:
    """The deepest vertex of two bodies at one pose, along its ray.

    `depth_mm` is 0 where no vertex is inside; `contact` that vertex and the face that its ray leaves through, or None;
    `ray_to_normal_deg` at that face: beyond 60 the depth grazes.
    """

    depth_mm: float
    contact: Optional[ContactWitness]
    ray_to_normal_deg: float


@dataclass(frozen=True, eq=False)
class DepthLimit:
    """Where a motion ends because the depth exceeds the allowed one.

    `limit`, whose error bound is the tolerance of the search; `at_limit`, where the depth is still allowed;
    `start_depth_mm`; `depth_grows`, False where the surfaces are rough at this scale and a limit a little further on
    would be as good.
    """

    limit: MotionLimit
    at_limit: DeepestPlace
    start_depth_mm: float
    depth_grows: bool


class DepthRange:
    """A joint whose motions end where the deepest radial depth exceeds an allowed one.

    For meshes that overlap wherever they are; where they are clean, :meth:`Joint.range_of_motion` is exact. Not exact:
    depth is computed at poses `step_deg` apart, of vertices only, and the limit to `tolerance_deg`. UsageError for a
    depth below 0, and for a tolerance that is not above 0 and at most the step; MeshError where a mesh is open.

    C++: `condyle::DepthRange` in condyle/range_of_motion.hpp; `condyle rom --allow-depth`.

    >>> import condyle
    >>> bones = condyle.sample_hip(scenario=1)
    >>> joint = condyle.Joint(bones.hip_bone, bones.femur)
    >>> exact = joint.range_of_motion(["flexion"])["flexion"].limit_deg
    >>> deep, = condyle.DepthRange(joint, 1.0).limits(["flexion"])
    >>> exact < deep.limit.limit_deg < exact + 5
    True
    """

    __slots__ = ("_native", "_joint", "_motions", "__weakref__")

    def __init__(self, joint: Joint, allowed_depth_mm: float, *, step_deg: float = 1, tolerance_deg: float = 1e-3
                 ) -> None:
        self._joint = joint
        self._motions = Motions(joint._native)
        self._native = _native.DepthRange(joint._asked, number(allowed_depth_mm, "allowed_depth_mm"),
                                          number(step_deg, "step_deg"), number(tolerance_deg, "tolerance_deg"))

    def deepest(self, angles_deg: Mapping[str, float] = {}) -> DeepestPlace:
        """The deepest place at these angles, by their names; those left out are 0."""
        return self._place_of(self._native.deepest(self._motions.start(angles_deg)))

    def limits(self, motions: Optional[Sequence[MotionLike]] = None, *, progress: Progress = None
               ) -> tuple[DepthLimit, ...]:
        """Where these motions end, all known ones if not given. Ctrl-C ends it after the motion begun."""
        asked = self._motions.known if motions is None else self._motions.asked(motions)
        found = self._native.limits(self._joint._native, [self._motions.tuple_of(each) for each in asked],
                                    progress_of(progress))
        return tuple(self._limit_of(each) for each in found)

    def _limit_of(self, found: dict[str, Any]) -> DepthLimit:
        found["limit"] = motion_limit_of(found["limit"], self._motions, self._joint)
        found["at_limit"] = self._place_of(found["at_limit"])
        return DepthLimit(**found)

    def _place_of(self, found: dict[str, Any]) -> DeepestPlace:
        found["contact"] = witness_of(found["contact"], self._joint.fixed, self._joint.mobile)
        return DeepestPlace(**found)

    def __repr__(self) -> str:
        return f"DepthRange({self._joint!r})"
