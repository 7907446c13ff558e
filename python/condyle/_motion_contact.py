"""Contact in every frame of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._contact_checks import ContactNote, reported
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._pose_standing import PoseStanding
from ._poses import Pose
from ._pressure import ElasticContact, used
from ._surface_contact import SurfaceContact, surface_of
from ._words import Body, FaceRule, Progress, number, progress_of, word


@dataclass(frozen=True, eq=False)
class ScrewStep:
    """The step into a frame as one screw motion, and how deep the bodies are along arcs about its axis.

    A slide turns by less than 1e-4 degrees and has none of what may be None, nor has a step past 179. `axis` is in F, of unit length in
    the sense of the rotation, `point_mm` its point nearest to the origin of M. Depths are the largest angle and the largest arc by
    which a rotation frees a vertex of either body: 0 if none is inside, None also if it frees none of those inside.
    """

    rotation_deg: float
    is_slide: bool
    axis: Optional[NDArray[np.float64]]
    point_mm: Optional[NDArray[np.float64]]
    depth_deg: Optional[float]
    depth_mm: Optional[float]


@dataclass(frozen=True, eq=False, repr=False)
class FrameContact:
    """Contact of one frame.

    Attributes
    ----------
    X_FM : (4, 4) float64
    in_contact : bool
        The surfaces meet, or one body is inside the other.
    intersecting_pairs : int
        Pairs of triangles that meet.
    smallest_gap_mm : float
        Between the surfaces; 0 where they meet.
    surface : SurfaceContact
        The surface that casts, in its body's frame: the mobile one's where both are cast.
    force_n, moment_nmm : (3,) float64
        By the fixed body on the mobile one, in F, about the origin of M; 0 where no pressure was asked for.
    cut_off_by_reach : int
        Rays that a longer reach would find in contact; looked for where the largest depth is beyond half of the reach, or no
        ray ends in contact though the bodies meet or one is open.
    standing : PoseStanding or None
        What the pose is to the limits of the joint; None if no contact of its meshes ends a motion. Its `nearest_limit` is known of a
        frame that is at one; of any pose by `joint.depths(pose).standing`.
    screw : ScrewStep or None
        If asked for, of a frame that has a frame before it.
    """

    X_FM: Pose
    in_contact: bool
    intersecting_pairs: int
    smallest_gap_mm: float
    surface: SurfaceContact
    force_n: NDArray[np.float64]
    moment_nmm: NDArray[np.float64]
    cut_off_by_reach: int
    standing: Optional[PoseStanding]
    screw: Optional[ScrewStep]

    def __repr__(self) -> str:
        return f"FrameContact({self.standing.state if self.standing else 'in contact' if self.in_contact else 'apart'}; {self.surface!r})"


class ContactFrames(list[Optional[FrameContact]]):
    """A :class:`FrameContact` for each frame, None for gaps; `notes` is what looks wrong with layers and motion."""

    notes: tuple[ContactNote, ...] = ()

    @property
    def nearest(self) -> Optional[int]:
        """Number of the frame with the smallest gap, the first of equals; None if all are gaps of the motion."""
        answered = [(frame.smallest_gap_mm, i) for i, frame in enumerate(self) if frame is not None]
        return min(answered)[1] if answered else None


def contact_along(joint: DescribedJoint, poses: ArrayLike, surfaces: Optional[ElasticContact], casting: Body,
                  rule: FaceRule, reach_mm: float, screws: bool, progress: Progress) -> ContactFrames:
    if surfaces is not None and not isinstance(surfaces, ElasticContact):
        raise UsageError(f"surfaces: an ElasticContact is needed, not {type(surfaces).__name__}")
    with used(surfaces):
        found, notes = _native.contact_along(
            joint._asked, poses, None if surfaces is None else surfaces._native,
            word(casting, "casting", Body), word(rule, "rule", FaceRule),
            number(reach_mm, "reach_mm"), bool(screws), progress_of(progress))
    for frame in found:
        if frame is not None:
            frame["surface"] = surface_of(frame["surface"])
            frame["standing"] = None if frame["standing"] is None else PoseStanding.of(frame["standing"])
            frame["screw"] = None if frame["screw"] is None else ScrewStep(**frame["screw"])
    frames = ContactFrames(None if frame is None else FrameContact(**frame) for frame in found)
    frames.notes = reported(notes)
    return frames
