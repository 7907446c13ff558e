"""Limits of joints whose centre is not held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._answer import Compiled, kept
from ._contact_checks import ContactNote, notes_said
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._limits import HasLimits, MotionLimit, end_text, motion_limit_of
from ._motion import MotionLike, Motions
from ._native import RangeOfMotion as NativeRange
from ._pressure import ElasticContact, used
from ._words import BearingRule, Body, Path, Progress, number, path_of, progress_of, report_labels, text_of, word


@dataclass(frozen=True, eq=False, repr=False)
class FollowedRange(HasLimits, Compiled):
    """Limits of motions on which a free joint's translation follows a recorded motion or a load.

    Attributes
    ----------
    limits : tuple of MotionLimit
        Bounded, not exact: the joint is free up to each, and in contact past it by `error_bound_deg`, or surfaces pass nearer to each
        other than some micrometres. `translation_mm` (3,) is where the mobile body's origin is there.
    notes : what they must be read with, each with a :class:`JointRemark`: where the record or the balance ends; layers and load that
        look wrong have a :class:`JointWarning`
    caveats : list of str

    `found["flexion"]` is one of the limits.
    """

    limits: tuple[MotionLimit, ...]
    notes: tuple[ContactNote, ...]
    caveats: list[str]
    _joint: DescribedJoint
    _native: Optional[NativeRange] = None

    def write_report(self, path: Path, *, title: Optional[str] = None, case: Optional[str] = None, note: Optional[str] = None,
                     date: Optional[str] = None, whole_paths: bool = False, progress: Progress = None) -> None:
        """Writes one HTML file that shows the joint with these limits in any browser, as `condyle report --follow` does.

        `case`, `note`, `date`, `whole_paths` as of :meth:`RangeOfMotion.write_report`. Whole or not at all; FileError where it
        cannot be written, UsageError for limits that were pickled, which leaves out what a report shows.

        C++: `condyle::answer_range` in condyle/answer.hpp.
        """
        _native.write_report(
            kept(self._native, "range of motion", "a report shows"), self._joint._asked, path_of(path),
            None if title is None else text_of(title, "title"), None, None, False, None, None, None, None, False,
            report_labels(case, note, date, whole_paths), progress_of(progress))

    def __repr__(self) -> str:
        def end(limit: MotionLimit) -> str:
            if limit.translation_ends:
                return f"{limit.limit_deg:.1f} translation_ends"
            return end_text(limit.limit_deg, limit.reason) + (" contact_at_start" if limit.reason == "contact_at_start" else "")

        return "FollowedRange(" + ", ".join(f"{limit.motion.name} {end(limit)}" for limit in self.limits) + ")"


def followed_range(joint: DescribedJoint, motions: Optional[Sequence[MotionLike]], poses: Optional[ArrayLike],
                   contact: Optional[ElasticContact], force_n: Optional[ArrayLike], frame: Body,
                   free_directions: ArrayLike, step_deg: float, bearing: BearingRule,
                   bearing_margin_mm: Optional[float], progress: Progress) -> FollowedRange:
    if (poses is None) == (force_n is None):
        raise UsageError("poses of a recorded motion or force_n: one of the two is needed")
    if (contact is None) != (force_n is None):
        raise UsageError("force_n: the contact that carries it is needed too, as ElasticContact.of_file(joint) makes it")
    known = Motions(joint._native)
    asked = known.known if motions is None else known.asked(motions)
    options = {"count_bearing": word(bearing, "bearing", BearingRule) == "count",
               "bearing_margin_mm": None if bearing_margin_mm is None else number(bearing_margin_mm, "bearing_margin_mm"),
               "only_recorded": motions is None, "force_n": np.zeros(3) if force_n is None else force_n,
               "frame": word(frame, "frame", Body), "free_directions": np.reshape(free_directions, (-1, 3)),
               "step_deg": number(step_deg, "step_deg")}
    with used(contact):
        native = _native.followed_range(joint._asked, [known.tuple_of(each) for each in asked], poses,
                                        None if contact is None else contact._native, options, progress_of(progress))
    found = native.answer()
    return FollowedRange(tuple(motion_limit_of(each, known, joint) for each in found["limits"]), notes_said(found["notes"]), found["caveats"],
                         joint, native)
