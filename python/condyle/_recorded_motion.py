"""Recorded motions, and contact in them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Mapping, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._contact_checks import ContactNote
from ._described_joint import DescribedJoint
from ._errors import unknown
from ._limits import ContactWitness, witness_of
from ._poses import Poses
from ._words import ContactEndKind, Path, Progress, number, path_of, progress_of

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False, repr=False)
class MotionTable:
    """A motion file as it is: `columns` by name, (N,) float64 each, NaN for gaps; nothing is converted.

    `in_degrees` is what an OpenSim header says of angles, None where it says nothing.
    """

    columns: Mapping[str, NDArray[np.float64]]
    in_degrees: Optional[bool]
    processing: tuple[str, ...]

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        if column not in self.columns:
            raise unknown("column", column, self.columns)
        return self.columns[column]

    def __repr__(self) -> str:
        rows = len(next(iter(self.columns.values())))
        return f"MotionTable({rows} rows; {', '.join(self.columns)})"

    def to_dataframe(self) -> pandas.DataFrame:
        """A column per column. Needs pandas."""
        import pandas

        return pandas.DataFrame(dict(self.columns))


@dataclass(frozen=True, eq=False, repr=False)
class JointMotion:
    """A recorded motion of a joint: `time` (N,), in seconds where `in_seconds`, else numbers of frames.

    `X_FM` (N, 4, 4) poses in the joint frame, mm, NaN for gaps; `is_gap` (N,) bool; `notes` what looks wrong with its
    numbers: their unit. `velocity_mm_s` and `angular_velocity_rad_s` (N, 3) of the mobile body's origin and of its
    turn, in the fixed body's frame, if the file has columns of speeds beside those of values, as states of OpenSim;
    NaN where they are not known; else None.
    """

    time: NDArray[np.float64]
    X_FM: Poses
    in_seconds: bool
    processing: tuple[str, ...]
    notes: tuple[ContactNote, ...] = ()
    velocity_mm_s: Optional[NDArray[np.float64]] = None
    angular_velocity_rad_s: Optional[NDArray[np.float64]] = None

    @property
    def is_gap(self) -> NDArray[np.bool_]:
        gaps: NDArray[np.bool_] = np.isnan(self.X_FM[:, 0, 0])
        return gaps

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        unit = " s" if self.in_seconds else ""
        return (f"JointMotion({len(self)} frames from {self.time[0]:g} to {self.time[-1]:g}{unit}, "
                f"{int(self.is_gap.sum())} gaps)")


@dataclass(frozen=True, eq=False)
class ContactEnd:
    """Where a contact begins or ends.

    `kind` "exact", "bounded", or "recording_begins" of an entry and "recording_ends" of an exit: in contact before the first,
    or after the last sample. Contact begins at `time_s` or later by at most `uncertainty_s`, and ends at `time_s` or earlier
    by at most that; None where the recording begins or ends. `sample`: on the way from it to
    the next, `turned_deg` after it. `contact`: the features that meet, or None.
    """

    kind: ContactEndKind
    time_s: float
    uncertainty_s: Optional[float]
    sample: int
    turned_deg: float
    contact: Optional[ContactWitness]


@dataclass(frozen=True, eq=False, repr=False)
class ContactInterval:
    """From `entry` to `exit` the bodies are in contact, but for `undecided_s`; before and after they are free.

    `is_certain`: whether they are in contact for certain at some moment.
    """

    entry: ContactEnd
    exit: ContactEnd
    is_certain: bool
    undecided_s: float

    def __repr__(self) -> str:
        return f"ContactInterval({self.entry.time_s:.6g} s to {self.exit.time_s:.6g} s, {self.entry.kind})"


@dataclass(frozen=True, eq=False)
class RecordedContact:
    """Contact in a whole recording, between the samples too: free outside `contacts`.

    `is_bounded` (N - 1,) bool: where the way from a sample to the next was decided by bounds and not in closed form;
    `poses` looked at for these.
    """

    contacts: tuple[ContactInterval, ...]
    is_bounded: NDArray[np.bool_]
    poses: int


def recorded_contact(joint: DescribedJoint, time_s: ArrayLike, poses: ArrayLike, resolution_s: float, progress: Progress
                     ) -> RecordedContact:
    found = _native.contact_between(joint._asked, time_s, poses, number(resolution_s, "resolution_s"),
                                    progress_of(progress))
    for interval in found["contacts"]:
        for name in ("entry", "exit"):
            end = interval[name]
            end["contact"] = witness_of(end["contact"], joint.fixed, joint.mobile)
            interval[name] = ContactEnd(**end)
    return RecordedContact(tuple(ContactInterval(**each) for each in found["contacts"]), found["searched"] == 1,
                           found["poses"])


def read_motion_table(path: Path) -> MotionTable:
    """Reads .mot and .sto (OpenSim) or .csv (docs/motion-files.md). FileError naming file, line and column.

    C++: `condyle::read_motion_table` in condyle/io/recorded_motion.hpp.
    """
    found = _native.read_motion_table(path_of(path))
    return MotionTable(found["columns"], found["in_degrees"], tuple(found["processing"]))
