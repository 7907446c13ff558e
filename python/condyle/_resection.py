"""The bone that must go so that motions reach their targets."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Callable, Generic, Mapping, NamedTuple, Optional, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import Compiled, kept
from ._contact_checks import ContactNote, remarked
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._limits import MotionLimit, motion_limit_of
from ._mesh import TriMesh
from ._motion import Motions
from ._native import Joint as NativeJoint
from ._native import Plan
from ._words import BearingRule, Body, CutFrom, KeptBy, Progress, band_of, count, number, progress_of, text_of, word

OfJoint = TypeVar("OfJoint", bound=DescribedJoint)


@dataclass(frozen=True, eq=False)
class CutBone:
    """A bone that was cut.

    Attributes
    ----------
    mesh, before : TriMesh
        The bone without what must go, and the same triangles where its surface was: smaller around the cut than those of the
        joint's mesh.
    depth_mm : (V,) float64
        How far each vertex now lies below the surface before.
    needed_by : (V,) int32
        The number of the target that needs it, -1 where nothing goes.
    needed_from_deg : (V,) float64
        The angle of that motion from which on it is in the way; 0 where nothing goes.
    volume_mm3, least_volume_mm3 : float
        Volume that goes, and the part of it that the other bone sweeps over.
    burr_volume_mm3, burr_in_kept_mm : float
        The part of it that goes only because a burr is no smaller, and by how much the burr would have to enter bone that stays.
    area_mm2, deepest_mm : float
    deepest_at : (3,) float64
        On the surface before, in the bone's frame.
    """

    mesh: TriMesh
    before: TriMesh
    depth_mm: NDArray[np.float64]
    needed_by: NDArray[np.int32]
    needed_from_deg: NDArray[np.float64]
    volume_mm3: float
    least_volume_mm3: float
    burr_volume_mm3: float
    burr_in_kept_mm: float
    area_mm2: float
    deepest_mm: float
    deepest_at: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"CutBone({self.volume_mm3:.1f} mm3, {self.deepest_mm:.2f} mm deep)"


class Blocked(NamedTuple):
    """Kept bone that stops a motion short of its target: why it is kept, of which body, and where (3,)."""

    by: KeptBy
    body: Body
    point_mm: NDArray[np.float64]


class OtherCentre(NamedTuple):
    """A motion before and after a cut about the centre of the "socket" or "head"; decided if its target is reached about both centres or neither."""

    centre: str
    before_deg: float
    after_deg: float
    is_decided: bool


@dataclass(frozen=True, eq=False)
class ReachedTarget:
    """A motion, how far it should go, and how far it goes.

    Attributes
    ----------
    confidence_reached : float, optional
        Share of the varied joints in which this cut reaches the target.
    before_band, band : tuple of float, optional
        5 %, median and 95 % of where they end before the cut and after it.
    other_centre : OtherCentre, optional
        The same about the other one of head's and socket's centres, if these are known over 1 mm apart.
    is_plan : bool
        False if it ends before where it ends now about the other centre.
    text : str
        All that in a sentence.
    """

    motion: str
    reach_deg: float
    planned_deg: float
    before: MotionLimit
    after: MotionLimit
    blocked: Optional[Blocked]
    confidence_reached: Optional[float]
    before_band: Optional[tuple[float, float, float]]
    band: Optional[tuple[float, float, float]]
    other_centre: Optional[OtherCentre]
    is_plan: bool
    text: str


class ResectionAlternative(NamedTuple):
    """The margin with which a share of the varied joints reaches the targets, and what it costs."""

    confidence: float
    margin_mm: float
    volume_mm3: float


class CurvePoint(NamedTuple):
    """Cost of a target by itself, at nearer angles."""

    motion: str
    reached_deg: float
    volume_mm3: float
    deepest_mm: float


@dataclass(frozen=True, eq=False)
class Resection(Compiled, Generic[OfJoint]):
    """A plan made by :meth:`Joint.resection`.

    Attributes
    ----------
    joint : Joint
        Without the bone: ask it as any other.
    mobile, fixed : CutBone or None
    targets : tuple of ReachedTarget
    before, after : tuple of MotionLimit
        Exact limits of all motions of the joint, before and without the bone.
    gain_deg : tuple of float
        What the cut adds to each of them; to a target in the share `confidence` of varied joints, or half. Smaller triangles of the same
        surface add a little by themselves, which is no gain.
    measures : dict of (before, after)
        Measures of a hip by the keys of :class:`HipMeasures`; None for a measure that the meshes do not show. Empty for other joints.
    curve : tuple of CurvePoint
        Degrees against mm3.
    margin_mm : float
        As planned.
    confidence : float, optional
        The share of varied joints that it was chosen for; None for a margin that was given.
    displaced : int
        Joints by which the plan is judged.
    alternatives : tuple of ResectionAlternative
        This plan, and the one for 80 % of varied joints.
    notes : what the plan must be read with, each with a :class:`JointRemark`
    caveats : list of str
    """

    joint: OfJoint
    mobile: Optional[CutBone]
    fixed: Optional[CutBone]
    targets: tuple[ReachedTarget, ...]
    before: tuple[MotionLimit, ...]
    after: tuple[MotionLimit, ...]
    gain_deg: tuple[float, ...]
    measures: dict[str, tuple[Optional[float], Optional[float]]]
    curve: tuple[CurvePoint, ...]
    margin_mm: float
    confidence: Optional[float]
    displaced: int
    alternatives: tuple[ResectionAlternative, ...]
    notes: tuple[ContactNote, ...]
    caveats: list[str]
    _native: Optional[Plan] = None

    def _shown_by(self, joint: DescribedJoint) -> Plan:
        """Its data in a report, beside the limits of this joint."""
        if joint is not self.joint:
            raise UsageError("plan: the limits are not those of plan.joint")
        return kept(self._native, "plan", "a report shows")

    @property
    def volume_mm3(self) -> float:
        """Sum over both bones."""
        return sum(bone.volume_mm3 for bone in (self.mobile, self.fixed) if bone)

    def __repr__(self) -> str:
        reached = "; ".join(f"{each.motion} {each.text}" for each in self.targets)
        return f"Resection({reached}; {self.volume_mm3:.1f} mm3)"


def _cut_of(found: Optional[dict[str, Any]]) -> Optional[CutBone]:
    if found is None:
        return None
    before, after = (TriMesh._of_native(found.pop(name)) for name in ("before", "after"))
    return CutBone(after, before, **found)


#: Motions and how far each shall go from its start in degrees, or with a plus from where it ends now: {"flexion": 115, "fadir": "+10"}.
Reach = Mapping[str, Union[float, str]]


def reach_of(given: Reach) -> list[tuple[str, float, bool]]:
    """Motions, degrees, and whether these are a gain, checked."""
    if not isinstance(given, Mapping) or not given:
        raise UsageError('reach: motions and their degrees are needed: {"flexion": 115}, or what they shall gain: {"flexion": "+10"}')

    def degrees_of(name: str, value: Union[float, str]) -> tuple[float, bool]:
        if not isinstance(value, str):
            return number(value, f"reach of {name}"), False
        try:
            gain = float(value) if value.strip().startswith("+") else math.nan
        except ValueError:
            gain = math.nan
        if math.isnan(gain):
            raise UsageError(f'reach of {name}: must be degrees, or a gain as "+10"')
        return number(gain, f"reach of {name}"), True

    return [(text_of(name, "reach"), *degrees_of(name, value)) for name, value in given.items()]


def kept_vertices(marks: Optional[ArrayLike], mesh: TriMesh, what: str) -> NDArray[np.uint8]:
    """Marks of the vertices that stay, as the compiled part numbers them; none for none."""
    if marks is None:
        return np.empty(0, np.uint8)
    kept = np.asarray(marks)
    if kept.dtype == bool:
        kept = kept.astype(np.uint8)
    if kept.shape != (len(mesh.vertices),) or not np.isin(kept, (0, 1)).all():
        raise UsageError(f"{what}: must be True or False for each of {len(mesh.vertices)} vertices")
    # Vertices that count as one are kept if one of them is.
    if mesh.vertex_map is None:
        return kept.astype(np.uint8)
    merged = np.zeros(int(mesh.vertex_map.max()) + 1, np.uint8)
    np.maximum.at(merged, mesh.vertex_map, kept.astype(np.uint8))
    return merged


def cut_options(cut: CutFrom, share: Optional[float], margin_mm: Optional[float], deepest_mm: Optional[float],
                within_mm: Optional[float], burr_mm: Optional[float], edge_mm: float) -> dict[str, Any]:
    """How bone is cut, checked."""
    if share is not None and cut != "both":
        raise UsageError('share: only with cut="both"')
    shares = {"mobile": 0.0, "fixed": 1.0, "both": 0.5 if share is None else number(share, "share")}

    def optional(value: Optional[float], name: str) -> Optional[float]:
        return None if value is None else number(value, name)

    return {"fixed_share": shares[word(cut, "cut", CutFrom)], "margin_mm": optional(margin_mm, "margin_mm"),
            "deepest_mm": optional(deepest_mm, "deepest_mm"), "within_mm": optional(within_mm, "within_mm"),
            "burr_mm": optional(burr_mm, "burr_mm"), "edge_mm": number(edge_mm, "edge_mm")}


def resection(joint: OfJoint, of_native: Callable[[NativeJoint], OfJoint], reach: Reach, cut: CutFrom, share: Optional[float],
              margin_mm: Optional[float], confidence: Optional[float], deepest_mm: Optional[float], within_mm: Optional[float], burr_mm: Optional[float], keep: Optional[ArrayLike],
              keep_fixed: Optional[ArrayLike], edge_mm: float, curve_points: int, band_samples: int, seed: Optional[int],
              bearing: BearingRule, bearing_margin_mm: Optional[float], progress: Progress) -> Resection[OfJoint]:
    if confidence is not None and (margin_mm is not None or band_samples == 0):
        raise UsageError("confidence: chooses the margin for a share of varied joints, and " + (
            "margin_mm is given" if margin_mm is not None else "band_samples is 0"))
    chosen = None if margin_mm is not None else 0.5 if confidence is None else number(confidence, "confidence")
    known = Motions(joint._native)
    options = {
        **cut_options(cut, share, margin_mm, deepest_mm, within_mm, burr_mm, edge_mm),
        "keep_mobile": kept_vertices(keep, joint.mobile, "keep"), "keep_fixed": kept_vertices(keep_fixed, joint.fixed, "keep_fixed"),
        "curve_points": count(curve_points, "curve_points", 0, 1000),
        "band": band_of(band_samples, seed), "confidence": chosen,
        "count_bearing": word(bearing, "bearing", BearingRule) == "count",
        "bearing_margin_mm": None if bearing_margin_mm is None else number(bearing_margin_mm, "bearing_margin_mm")}
    found = _native.resection(
        joint._asked, [known.tuple_of(each) for each in known.known],
        [(known.tuple_of(known[name]), degrees, is_gain) for name, degrees, is_gain in reach_of(reach)], options,
        progress_of(progress))
    without = of_native(found["joint"])

    def limit_of(each: dict[str, Any], of: DescribedJoint) -> MotionLimit:
        return motion_limit_of(each, known, of)

    targets = []
    for motion, asked, planned, before, after, blocked, share, band_before, band, other, *promised in found["targets"]:
        targets.append(ReachedTarget(motion, asked, planned, limit_of(before, joint), limit_of(after, without),
                                     blocked and Blocked(*blocked), share, band_before, band, other and OtherCentre(*other), *promised))
    return Resection(
        without, _cut_of(found["mobile"]), _cut_of(found["fixed"]), tuple(targets),
        tuple(limit_of(each, joint) for each in found["before"]), tuple(limit_of(each, without) for each in found["after"]),
        tuple(found["gain_deg"]), found["shapes"] or {},
        tuple(CurvePoint(targets[target].motion, *rest) for target, *rest in found["curve"]), found["margin_mm"],
        found["confidence"], found["displaced"], tuple(ResectionAlternative(*each) for each in found["alternatives"]), remarked(found["notes"]),
        found["caveats"], found["plan"])
