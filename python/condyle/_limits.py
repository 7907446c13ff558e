"""Where motions and paths end, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, Mapping, Optional, Sequence, TypedDict, Union, get_args

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._coordinates import position_in
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._mesh import TriMesh
from ._motion import Angles, Motion, Motions
from ._words import ContactKind, ContactSide, LimitReason, number


#: Values of `reason` in maps, by number.
REASONS: tuple[LimitReason, ...] = get_args(LimitReason)
#: Values of `kind` in maps, by number.
KINDS: tuple[ContactKind, ...] = get_args(ContactKind)


def end_text(turned_deg: float, reason: LimitReason) -> str:
    """ "134.8", or ">120" where the range ends without contact."""
    return f">{round(turned_deg, 1):g}" if reason == "end_of_range" else f"{turned_deg:.1f}"


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
    turned_deg : float
        From the start, at least 0 in either sense.
    reason : str
        "contact", "end_of_range" or "contact_at_start".
    contact : ContactWitness or None
        None where nothing meets, or one body is inside the other.
    error_bound_deg : float
        First contact is at `turned_deg` or past it by at most this, never before.
    bearing_contact_deg : float or None
        Where bearing contact does not count: the first one, if it comes before the limit.
    soft_contact_deg : float or None
        The first contact of a mesh called soft, which never counts, if it comes before the limit.
    soft_contact : ContactWitness or None
        The features in contact there.
    """

    turned_deg: float
    reason: LimitReason
    contact: Optional[ContactWitness]
    error_bound_deg: float
    bearing_contact_deg: Optional[float]
    soft_contact_deg: Optional[float]
    soft_contact: Optional[ContactWitness]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.turned_deg:.6g} deg, {self.reason})"


@dataclass(frozen=True)
class Caveat:
    """A caveat to read before a limit is compared with a living joint.

    `code` as in rom.json ("soft_tissue_ends"), `text` one sentence, `source` where it is from, None for "end_unknown".
    """

    code: str
    text: str
    source: Optional[str]


class ClosedForm(TypedDict):
    """Where liner and neck of an implant end a motion, as bodies of revolution: see :attr:`MotionLimit.closed_form`."""

    limit_deg: float
    reason: LimitReason
    of_facets_deg: list[float]


@dataclass(frozen=True, eq=False, repr=False)
class MotionLimit(Limit):
    """Where one motion ends.

    Besides what a :class:`Limit` has: `motion`; `angles_deg`, the joint's angles there by name; `centre_distance_mm`
    between head and socket and `joint_space_mm` of the bearing surface, None where not known; `fixed_part` and
    `mobile_part`, names of the meshes that meet, None without contact and of a body of one mesh; `soft_fixed_part` and
    `soft_mobile_part`, of those of `soft_contact`; `translation_mm` (3,) at the limit of :meth:`Joint.range_following`, else None;
    `translation_ends`, True if what it follows ends there, so that nothing is known past the limit; `contact_side`, of a shoulder the side of its centre on which the scapula is met:
    "superior" (acromion), "anterior" (coracoid process), "inferior" or "posterior", else None; `caveats`, a list of
    :class:`Caveat`: whether bone usually ends such a motion of a hip, and what is not modelled; empty for other joints.

    By the keys of rom.json (docs/formats-limits.md): `clock_hour` of the contact on the socket, in [0, 12); `closed_form` of an implant
    whose liner and neck are bodies of revolution, `limit_deg`, `reason` and `of_facets_deg`, between which their meshes end the motion;
    `normal_range_deg` of a healthy hip; `definition` of motions without agreed angles; each None where there is none. `guarantee`
    is what is guaranteed of the limit, in words.
    """

    motion: Motion
    angles_deg: Mapping[str, float]
    centre_distance_mm: Optional[float]
    joint_space_mm: Optional[float]
    fixed_part: Optional[str]
    mobile_part: Optional[str]
    soft_fixed_part: Optional[str]
    soft_mobile_part: Optional[str]
    translation_mm: Optional[NDArray[np.float64]]
    translation_ends: bool
    contact_side: Optional[ContactSide]
    caveats: list[Caveat]
    # Limits that were pickled before there were these have none of them.
    clock_hour: Optional[float] = None
    closed_form: Optional[ClosedForm] = None
    normal_range_deg: Optional[float] = None
    definition: Optional[str] = None
    guarantee: str = ""

    def __repr__(self) -> str:
        return f"MotionLimit({self.motion.name}: {self.turned_deg:.6g} deg, {self.reason})"


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


def motion_limit_of(found: dict[str, Any], motions: Motions, joint: DescribedJoint) -> MotionLimit:
    """The compiled part's limit, with what rom.json says of it."""
    said = found.pop("said")
    features, soft_parts = said["features"] or {}, said["soft_contact_parts"] or {}
    for body in ("fixed", "mobile"):
        found[f"{body}_part"] = features.get(body, {}).get("part")
        found[f"soft_{body}_part"] = soft_parts.get(body)
    for key in ("contact", "soft_contact"):
        found[key] = witness_of(found[key], joint.fixed, joint.mobile)
    for key in ("contact_side", "clock_hour", "normal_range_deg", "definition", "guarantee"):
        found[key] = said[key]
    found["closed_form"] = said.get("closed_form")
    found["caveats"] = [Caveat(**each) for each in said["caveats"]]
    found["motion"] = motions.motion_of(found["motion"])
    found["angles_deg"] = motions.named(found["angles_deg"])
    return MotionLimit(**found)


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
