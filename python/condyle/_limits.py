"""Where motions and paths end, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator, Literal, Mapping, Optional, Sequence, Union, get_args, overload

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._coordinates import position_in
from ._described_joint import DescribedJoint
from ._errors import OutOfRangeError, UsageError, unknown
from ._mesh import TriMesh
from ._motion import Angles, Motion, Motions
from ._records import FeatureRecord, LimitRecord
from ._words import ContactKind, LimitReason, number


#: Values of `reason` in maps, by number.
REASONS: tuple[LimitReason, ...] = get_args(LimitReason)
#: Values of `kind` in maps, by number.
KINDS: tuple[ContactKind, ...] = get_args(ContactKind)


def end_text(limit_deg: float, reason: str) -> str:
    """ "134.8", or ">120" where the range ends without contact."""
    return f">{round(limit_deg, 1):g}" if reason == "end_of_range" else f"{limit_deg:.1f}"


Feature = Union[tuple[Literal["vertex"], int], tuple[Literal["edge"], int, int], tuple[Literal["face"], int]]


@dataclass(frozen=True, eq=False)
class ContactWitness:
    """A pair of features in contact. Each is ("vertex", number), ("edge", vertex, vertex) or ("face", triangle).

    `fixed_point` and `mobile_point` are (3,), each in its own body's frame, mm. `kind` is "bearing", "impingement", "cut"
    (on a face that closes a bone where its image ends), "soft" (of a mesh called soft, before a limit) or "unknown".
    """

    fixed_feature: Feature
    mobile_feature: Feature
    fixed_point: NDArray[np.float64]
    mobile_point: NDArray[np.float64]
    kind: ContactKind


@dataclass(frozen=True, eq=False, repr=False)
class Limit:
    """One end of a free rotation.

    Attributes
    ----------
    limit_deg : float
        From the start, at least 0 in either sense.
    reason : str
        "contact", "end_of_range", "contact_at_start", "ligament" or "strained_at_start".
    contact : ContactWitness or None
        None where nothing meets, or one body is inside the other.
    error_bound_deg : float
        First contact is at `limit_deg` or past it by at most this, never before.
    bearing_contact_deg : float or None
        Where bearing contact does not count: the first one, if it comes before the limit.
    soft_contact_deg : float or None
        The first contact of a mesh called soft, which never counts, if it comes before the limit.
    soft_contact : ContactWitness or None
        The features in contact there.
    """

    limit_deg: float
    reason: LimitReason
    contact: Optional[ContactWitness]
    error_bound_deg: float
    bearing_contact_deg: Optional[float]
    soft_contact_deg: Optional[float]
    soft_contact: Optional[ContactWitness]

    def __repr__(self) -> str:
        return f"Limit({self.limit_deg:.6g} deg, {self.reason})"


def _feature_of(record: FeatureRecord) -> Feature:
    if record.kind == "edge":
        assert record.vertices is not None
        first, last = record.vertices
        return "edge", first, last
    assert record.id is not None
    return ("vertex", record.id) if record.kind == "vertex" else ("face", record.id)


class MotionLimit(LimitRecord):
    __doc__ = (LimitRecord.__doc__ or "").replace("in the words of rom.json.", """by the keys of rom.json.

    And with meshes numbered as they were given: `motion`; `contact`, the features that meet, and `soft_contact`, those of a mesh called
    soft; `fixed_part` and `mobile_part`, names of the meshes that meet, None without contact and of a body of one mesh;
    `soft_fixed_part` and `soft_mobile_part`, of those of `soft_contact`.""")

    motion: Motion
    soft_contact: Optional[ContactWitness] = None

    @property
    def contact(self) -> Optional[ContactWitness]:
        if self.features is None or self.contact_point_mm is None or self.contact_point_mobile_mm is None or self.contact_kind is None:
            return None
        return ContactWitness(_feature_of(self.features.fixed), _feature_of(self.features.mobile), self.contact_point_mm,
                              self.contact_point_mobile_mm, self.contact_kind)

    @property
    def fixed_part(self) -> Optional[str]:
        return self.features.fixed.part if self.features else None

    @property
    def mobile_part(self) -> Optional[str]:
        return self.features.mobile.part if self.features else None

    @property
    def soft_fixed_part(self) -> Optional[str]:
        return self.soft_contact_parts.fixed if self.soft_contact_parts else None

    @property
    def soft_mobile_part(self) -> Optional[str]:
        return self.soft_contact_parts.mobile if self.soft_contact_parts else None

    def __repr__(self) -> str:
        return f"MotionLimit({self.motion.name}: {self.limit_deg:.6g} deg, {self.reason})"


@dataclass(frozen=True)
class FreeAngles:
    """All angles of one joint angle that are free.

    Attributes
    ----------
    intervals_deg : (K, 2) float64
        Low and high of each free interval, ascending: of the varied angle less its start.
    range_deg : (low, high)
        In which was looked.
    negative, positive : Limit
        Both limits from the start.
    at_low, at_high : tuple of Limit
        The limits at each interval's ends.
    """

    intervals_deg: NDArray[np.float64]
    range_deg: tuple[float, float]
    negative: Limit
    positive: Limit
    at_low: tuple[Limit, ...]
    at_high: tuple[Limit, ...]

    @property
    def free_width_deg(self) -> float:
        """Sum over all intervals."""
        return float((self.intervals_deg[:, 1] - self.intervals_deg[:, 0]).sum())

    @property
    def contact_set_deg(self) -> NDArray[np.float64]:
        """(K, 2) the angles in contact: what the free intervals leave of the range."""
        low, high = self.range_deg
        ends: NDArray[np.float64] = np.array([low, *self.intervals_deg.ravel().tolist(), high]).reshape(-1, 2)
        return ends[ends[:, 1] > ends[:, 0]]


@dataclass(frozen=True)
class PathLimit:
    """Where a path ends: on segment `segment`, from its waypoint to the next one, after `fraction` of it.

    `angles_deg` are the joint's angles there, by name; `reason` "contact", "end_of_range" or "contact_at_start";
    `contact` the two faces that are nearest to meeting, `distance_mm` apart.
    """

    segment: int
    fraction: float
    angles_deg: Mapping[str, float]
    reason: LimitReason
    contact: Optional[ContactWitness]
    distance_mm: float


def witness_of(found: Optional[dict[str, Any]], fixed: TriMesh, mobile: TriMesh) -> Optional[ContactWitness]:
    """The compiled part's answer with vertices numbered as in the meshes that were given."""
    if found is None:
        return None
    for body, of in (("fixed", fixed), ("mobile", mobile)):
        kind, *numbers = found[f"{body}_feature"]
        if kind != "face":
            numbers = [of._as_given(vertex) for vertex in numbers]
        found[f"{body}_feature"] = (kind, *numbers)
    return ContactWitness(**found)


def limit_of(found: dict[str, Any], fixed: TriMesh, mobile: TriMesh) -> Limit:
    for key in ("contact", "soft_contact"):
        found[key] = witness_of(found[key], fixed, mobile)
    return Limit(**found)


def _number_as_given(feature: dict[str, Any], mesh: TriMesh) -> None:
    if "vertices" in feature:
        feature["vertices"] = [mesh._as_given(vertex) for vertex in feature["vertices"]]
    elif feature["kind"] == "vertex":
        feature["id"] = mesh._as_given(feature["id"])


class HasLimits:
    """An answer whose `limits` are taken by the names of their motions or by number, and run through."""

    __slots__ = ()
    limits: tuple[MotionLimit, ...]

    @overload
    def __getitem__(self, which: Union[str, int]) -> MotionLimit: ...

    @overload
    def __getitem__(self, which: slice) -> tuple[MotionLimit, ...]: ...

    def __getitem__(self, which: Union[str, int, slice]) -> Union[MotionLimit, tuple[MotionLimit, ...]]:
        if isinstance(which, slice):
            return self.limits[which]
        if hasattr(which, "__index__"):
            try:
                return self.limits[which]
            except IndexError:
                raise OutOfRangeError(f"limit: there are {len(self.limits)}, counted from 0, and no {which}") from None
        for limit in self.limits:
            if limit.motion.name == which:
                return limit
        raise unknown("limit", which, (limit.motion.name for limit in self.limits))

    def __iter__(self) -> Iterator[MotionLimit]:
        return iter(self.limits)

    def __len__(self) -> int:
        return len(self.limits)


def motion_limit_of(found: dict[str, Any], motions: Motions, joint: DescribedJoint) -> MotionLimit:
    """The compiled part's limit, with vertices numbered as in the meshes that were given."""
    said = found["said"]
    for body, of in (("fixed", joint.fixed), ("mobile", joint.mobile)):
        if said["features"] is not None:
            _number_as_given(said["features"][body], of)
    limit = MotionLimit.of(said)
    vary = motions.angle(limit.vary, "vary")[0]
    motion = Motion(limit.name, motions.angles[vary][0 if limit.sense == "positive" else 1], limit.range_deg, limit.start_deg)
    vars(limit).update(motion=motion, soft_contact=witness_of(found["soft_contact"], joint.fixed, joint.mobile))
    return limit


def path_limit(joint: DescribedJoint, waypoints: Sequence[Mapping[str, float]], tolerance_deg: float) -> PathLimit:
    if isinstance(waypoints, str) or not isinstance(waypoints, Sequence):
        raise UsageError(f"waypoints: a list of mappings is needed, not {type(waypoints).__name__}")
    rows = [position_in(each, joint.angle_names, "waypoints", is_free=False)[0] for each in waypoints]
    options = {"count_bearing": False, "bearing_margin_mm": None, "accept_reference_contact": False,
               "leave_out_rings": None}
    found = _native.path_limit(joint._asked, np.array(rows).reshape(-1, 3), number(tolerance_deg, "tolerance_deg"),
                               options)
    found["angles_deg"] = Angles(zip((names[0] for names in joint.angle_names), found["angles_deg"]))
    found["contact"] = witness_of(found["contact"], joint.fixed, joint.mobile)
    return PathLimit(**found)
