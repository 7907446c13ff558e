"""Records of answers, by the keys of their files. Made by `make describe` from the tables in src/answer/records/."""

from __future__ import annotations

from typing import Literal, Optional

import numpy as np
from numpy.typing import NDArray

from ._motion import Angles
from ._record import Record


class FeatureRecord(Record):
    """A vertex or a face by its number, or an edge by its two vertices, ascending: in numbers of the mesh, from 0."""

    kind: Literal["vertex", "edge", "face"]
    vertices: Optional[list[int]] = None
    id: Optional[int] = None
    part: Optional[str] = None


class FeaturesRecord(Record):
    """What is in contact of either body."""

    fixed: FeatureRecord
    mobile: FeatureRecord


class PartsRecord(Record):
    """Names of the meshes that touch, None of a body of one mesh."""

    fixed: Optional[str] = None
    mobile: Optional[str] = None


class AllowedDepthRecord(Record):
    """Depths of a limit with a depth allowed."""

    at_start_mm: float
    at_limit_mm: float
    ray_to_normal_deg: float
    grows: bool


class ClosedForm(Record):
    """Where liner and neck of an implant end a motion, as bodies of revolution."""

    limit_deg: float
    reason: Literal["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"]
    of_facets_deg: list[float]


class BandWidthRecord(Record):
    """Width of a band if only one source was uncertain."""

    centre_deg: float
    axes_deg: float
    surface_deg: float
    parameters_deg: Optional[float] = None


class BandRecord(Record):
    """The limit over the joints of a band."""

    p5_deg: float
    median_deg: float
    p95_deg: float
    text: str
    width_from: BandWidthRecord
    share_without_contact: float
    share_in_contact_at_start: float


class BoneReference(Record):
    """Means of simulations of bone in other people's hips; their spread is not given."""

    healthy_deg: float
    cam_without_complaints_deg: float
    patients_deg: float
    people_each: int
    is_short: bool
    source: str


class SoftTissueGap(Record):
    """How much earlier soft tissue ended the motion than bone, in hips of cadavers."""

    closeness: Literal["close", "moderate", "weak"]
    mean_deg: float
    sd_deg: float
    hips: int
    source: str


class PeopleRange(Record):
    """How far other people's hips turn, soft tissue included; never of this joint."""

    low_deg: float
    high_deg: float
    who: str
    people: Optional[int] = None
    source: str


class LivingLimit(Record):
    """What studies say of the living beside a limit of bone."""

    expected_deg: Optional[float] = None
    expected_sd_deg: Optional[float] = None
    gap: Optional[SoftTissueGap] = None
    people: Optional[PeopleRange] = None
    text: str


class Caveat(Record):
    """A caveat to read before a limit is compared with a living joint."""

    code: Literal["bone_may_end", "soft_tissue_ends", "soft_tissue_close", "capsule_restrains", "labrum_not_modelled", "end_unknown"]
    text: str
    source: Optional[str] = None


class FixedZoneRecord(Record):
    """The overlap past a limit, on the fixed body."""

    triangles: int
    area_mm2: float
    centroid_mm: Optional[NDArray[np.float64]] = None
    max_radial_depth_mm: Optional[float] = None
    max_tangential_depth_deg: Optional[float] = None
    max_tangential_depth_mm: Optional[float] = None
    clock_hour: Optional[float] = None


class MobileZoneRecord(Record):
    """The overlap past a limit, on the mobile body."""

    triangles: int
    area_mm2: float
    centroid_mm: Optional[NDArray[np.float64]] = None
    max_radial_depth_mm: Optional[float] = None
    max_tangential_depth_deg: Optional[float] = None
    max_tangential_depth_mm: Optional[float] = None
    neck_angle_deg: Optional[float] = None


class ZoneRecord(Record):
    """The overlap past a limit."""

    past_deg: float
    contact_neck_angle_deg: Optional[float] = None
    fixed: FixedZoneRecord
    mobile: MobileZoneRecord


class LimitRecord(Record):
    """Where one motion ends, in the words of rom.json.

    Attributes
    ----------
    name : str
        of the motion
    limit_deg : float
        how far it turned from its start; ≥ 0 whatever the sense
    reason : Literal["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"]
        `"contact"`, `"end_of_range"` (no contact), `"contact_at_start"` (`limit_deg` is 0), `"ligament"`, `"strained_at_start"`
        (likewise)
    ligament : str or None
        the ligament that ends the motion; null if none does
    contact_kind : Literal["unknown", "bearing", "impingement", "cut", "soft"] or None
        `"impingement"`, `"bearing"`, `"cut"` on a face that closes a bone where its image ends or it was cut off, or `"unknown"`
        if no bearing surface is known; null at the end of the range
    bearing_contact_deg : float or None
        where bearing surfaces touch first, if before the limit; else null. A flag, not a measure: centre and segmentation are
        rarely better than it needs
    bearing_contact_point_mm : NDArray[np.float64] or None
        where, in the fixed body's joint frame
    soft_contact_deg : float or None
        where a mesh called soft touches first, if before the limit; else null
    soft_contact_point_mm : NDArray[np.float64] or None
        where, in the fixed body's joint frame
    soft_contact_parts : PartsRecord or None
        `fixed` and `mobile`: names of the meshes that touch there, null of a body of one mesh
    centre_distance_mm : float or None
        between the centres of head and socket at the limit; null without either
    joint_space_mm : float or None
        the smallest distance between bearing surface and fixed body at the limit, 0 where they meet; null if bearing contact
        counts
    error_bound_deg : float
        true contact is at the limit or past it by at most this, and never before
    vary : str
        the angle that varies
    sense : Literal["negative", "positive"]
        `"positive"` or `"negative"`
    range_deg : float
        how far it may change
    start_deg : Angles
        all three angles at the start, digit by digit as given (15 digits and fewer)
    held_deg : Angles
        the two that were held
    zero_from : Literal["as_given", "stated", "landmarks", "anatomy"]
        what zero angles are known by, as in `zero`: `"as_given"`, `"stated"`, `"landmarks"` or `"anatomy"`
    definition : str or None
        of `fadir` and `faber`: `"as defined here; no angles are agreed on"`, their angles are `start_deg` and `vary`; null for
        other motions
    at_limit_deg : Angles
        all three angles at the limit
    translation_mm : NDArray[np.float64] or None
        x, y and z of the mobile body's origin at the limit, if its translation follows a recorded motion or a load; else null
    translation_ends : bool or None
        whether what the translation follows ends at the limit, before the motion does: there is no contact up to it, and nothing
        is known past it. With `translation_mm` null no contact carries the load at the start either, and `limit_deg` is 0; null
        if nothing is followed
    contact_point_mm : NDArray[np.float64] or None
        where the bodies are in contact at the limit, in the fixed body's joint frame; null without contact, and if one body is
        inside the other and their surfaces do not meet
    contact_point_mobile_mm : NDArray[np.float64] or None
        the same point of the mobile body, in the mobile body's frame (the joint frame at zero angles)
    features : FeaturesRecord or None
        `fixed` and `mobile`, each `{"kind": "vertex", "id": n}`, `{"kind": "face", "id": n}` or `{"kind": "edge", "vertices": [a,
        b]}` with a < b, in numbers of the mesh, from 0, and `part` of a body of several meshes; null without a contact point
    contact_side : Literal["superior", "anterior", "inferior", "posterior"] or None
        of a shoulder the side of the joint centre on which contact that is not bearing contact ended the motion: `"superior"`,
        where the acromion is, `"anterior"` (coracoid process), `"inferior"` (lower rim and neck of the scapula) or `"posterior"`;
        null for other joints, without contact, and within 30 degrees of the joint's Z
    clock_hour : float or None
        direction of the contact on the socket's clock face, in [0, 12): 0 superior, 3 anterior on either side of the body, in the
        plane that `clock_plane` says; null for joints other than hips, without contact, and for contacts farther than 1.6 head
        radii from the joint centre, which are not at the rim
    normal_range_deg : float or None
        how far a healthy hip turns from neutral in this motion by the source, below; null if the source has no value, if zero
        angles are not known to be neutral (`zero`), and for other joints
    bone_reference : BoneReference or None
        only of internal rotation at 90° flexion of a hip without implant, with zero known to be neutral and no end but
        impingement: means of simulations of bone, `healthy_deg`, `cam_without_complaints_deg`, `patients_deg`, `people_each`,
        `source`; `is_short` if the limit is not above that of hips with a cam
    living : LivingLimit or None
        what studies say of living hips, without an implant and with zero known to be neutral: `gap`, how much earlier soft tissue
        ended the motion than bone in cadavers (`closeness`: `"close"`, `"moderate"` or `"weak"`), or null; `expected_deg` and
        `expected_sd_deg` of the close ones that impingement ends, else null; `people`, how far others turn, or null; `text`, such
        as `"some 131 (SD 5)"`
    caveats : list[Caveat]
        list of `code`, `text` and `source` each: what usually ends such a motion; empty for joints other than hips
    guarantee : str
        what is guaranteed of the limit, in words
    depth : AllowedDepthRecord or None
        only with `--allow-depth`, below
    closed_form : ClosedForm or None
        only of an implant whose liner and neck are bodies of revolution: where these two end the motion, `limit_deg` and
        `reason`, and `of_facets_deg`, between which their meshes do
    zone : ZoneRecord or None
        only with `--past`, below; null for motions that did not end by contact
    band : BandRecord or None
        `p5_deg`, `median_deg`, `p95_deg` of the limit over the joints of the band; `text`, such as `"88–>120"` where 5 % of
        them end with the range; `width_from`: what the width, 5 to 95 %, would be if only the centre (`centre_deg`), the axes
        (`axes_deg`), the surfaces (`surface_deg`) or parameters of parts (`parameters_deg`, if they have standard deviations)
        were uncertain; `share_without_contact`, `share_in_contact_at_start` of the joints, 0 to 1. Null without `--band`
    """

    name: str
    limit_deg: float
    reason: Literal["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"]
    ligament: Optional[str] = None
    contact_kind: Optional[Literal["unknown", "bearing", "impingement", "cut", "soft"]] = None
    bearing_contact_deg: Optional[float] = None
    bearing_contact_point_mm: Optional[NDArray[np.float64]] = None
    soft_contact_deg: Optional[float] = None
    soft_contact_point_mm: Optional[NDArray[np.float64]] = None
    soft_contact_parts: Optional[PartsRecord] = None
    centre_distance_mm: Optional[float] = None
    joint_space_mm: Optional[float] = None
    error_bound_deg: float
    vary: str
    sense: Literal["negative", "positive"]
    range_deg: float
    start_deg: Angles
    held_deg: Angles
    zero_from: Literal["as_given", "stated", "landmarks", "anatomy"]
    definition: Optional[str] = None
    at_limit_deg: Angles
    translation_mm: Optional[NDArray[np.float64]] = None
    translation_ends: Optional[bool] = None
    contact_point_mm: Optional[NDArray[np.float64]] = None
    contact_point_mobile_mm: Optional[NDArray[np.float64]] = None
    features: Optional[FeaturesRecord] = None
    contact_side: Optional[Literal["superior", "anterior", "inferior", "posterior"]] = None
    clock_hour: Optional[float] = None
    normal_range_deg: Optional[float] = None
    bone_reference: Optional[BoneReference] = None
    living: Optional[LivingLimit] = None
    caveats: list[Caveat]
    guarantee: str
    depth: Optional[AllowedDepthRecord] = None
    closed_form: Optional[ClosedForm] = None
    zone: Optional[ZoneRecord] = None
    band: Optional[BandRecord] = None


class NormalRange(Record):
    """Between these values lie the measures of other people.

    Attributes
    ----------
    people : str
        whose measures they are
    count : int or None
        of these; null if the source does not say
    meaning : str
        which measures lie between
    source : str
        where they are from
    """

    low: float
    high: float
    people: str
    count: Optional[int] = None
    meaning: str
    source: str


class MeasureBand(Record):
    """A measure over varied joints.

    Attributes
    ----------
    p5 : float or None
        5 % of them are below; null if none shows the measure
    samples_without_value : int
        joints that do not show it
    """

    p5: Optional[float] = None
    median: Optional[float] = None
    p95: Optional[float] = None
    samples_without_value: int


class MeasureRecord(Record):
    """One measure of a hip.

    Attributes
    ----------
    key : str
        its name
    part : Literal["femur", "acetabulum", "both"]
        `"femur"`, `"acetabulum"` or `"both"`
    unit : str
        `"mm"`, `"deg"`, `"h"` or `"1"`
    value : float or None
        null if it cannot be computed
    why_none : str or None
        the reason then, else null
    note : str or None
        its caveat, usually null
    definition : str
        in a line
    measured_by : list[str]
        the planes, axes and points that it is measured by: names in `geometry`, or of a list here
    source : str
        where the definition is from
    frame : str or None
        the pelvis frame of an angle that turns with it, else null
    normal : NormalRange or None
        a range of people with usual hips: `low`, `high`, `people`, `count`, `meaning` and `source`; null if none is known
    patients : NormalRange or None
        likewise of patients, which is not called normal
    band : MeasureBand or None
        `p5`, `median`, `p95` over the varied joints, and `samples_without_value`; null without `--band`
    """

    key: str
    part: Literal["femur", "acetabulum", "both"]
    unit: str
    value: Optional[float] = None
    why_none: Optional[str] = None
    note: Optional[str] = None
    definition: str
    measured_by: list[str]
    source: str
    frame: Optional[str] = None
    normal: Optional[NormalRange] = None
    patients: Optional[NormalRange] = None
    band: Optional[MeasureBand] = None


class NeckHour(Record):
    """What is measured in one direction around the neck, 12 superior and 3 anterior."""

    hour: float
    alpha_deg: Optional[float] = None
    alpha_at_1mm_deg: Optional[float] = None
    is_doubtful: bool
    alpha_point_mm: Optional[NDArray[np.float64]] = None
    offset_mm: Optional[float] = None
    offset_point_mm: Optional[NDArray[np.float64]] = None


class RimHour(Record):
    """The rim in one direction around the socket, 12 superior and 3 anterior."""

    hour: float
    point_mm: Optional[NDArray[np.float64]] = None
    cover_deg: Optional[float] = None
    centre_edge_deg: Optional[float] = None
    is_in_plane: bool


class ShapeRecord(Record):
    """The shape of a hip, in the words of measures.json.

    Attributes
    ----------
    pelvis_frame : str
        the frame of acetabular angles, with the tilt that was given
    pelvic_tilt_deg : float
        that tilt
    left_out : list[str]
        sentences on pieces of a mesh near the head that are not measured, such as the wall of its marrow or another bone
    measures : list[MeasureRecord]
        list of measures in the order of the text, below
    around_neck : list[NeckHour]
        list of `hour`, `alpha_deg`, `alpha_at_1mm_deg`, `is_doubtful`, `alpha_point_mm`, `offset_mm`, `offset_point_mm`; points
        in the mobile body's frame
    rim : list[RimHour]
        list of `hour`, `point_mm` in the fixed body's frame, `cover_deg`, `centre_edge_deg`, `is_in_plane`
    """

    pelvis_frame: str
    pelvic_tilt_deg: float
    left_out: list[str]
    measures: list[MeasureRecord]
    around_neck: list[NeckHour]
    rim: list[RimHour]


class Note(Record):
    """What an answer about two meshes must be read with."""

    code: str
    text: str


class TouchDepth(Record):
    """The place of either surface that is deepest in the other body.

    Attributes
    ----------
    body : Literal["fixed", "mobile"]
        whose surface it is on: `"fixed"` or `"mobile"`
    depth_mm : float
        its distance from the other body's surface, along that surface's normal where a face is nearest
    error_mm : float
        no place of either surface is deeper by more
    place_mm : NDArray[np.float64]
        the place
    exit_mm : NDArray[np.float64]
        the nearest point of the other surface
    normal : NDArray[np.float64]
        of length 1 from the place to the exit
    triangle : int
        of that body that has the place, counted from 0
    other_triangle : int
        of the other body that has the exit
    """

    body: Literal["fixed", "mobile"]
    depth_mm: float
    error_mm: float
    place_mm: NDArray[np.float64]
    exit_mm: NDArray[np.float64]
    normal: NDArray[np.float64]
    triangle: int
    other_triangle: int


class FreeTranslation(Record):
    """How far the mobile body moves along a direction until it is free.

    Attributes
    ----------
    along : NDArray[np.float64]
        the direction, of length 1
    distance_mm : float
        just beyond it is free; 0 if it is free as it is
    error_bound_mm : float
        so far before it is in contact for certain
    """

    along: NDArray[np.float64]
    distance_mm: float
    error_bound_mm: float


class TouchRecord(Record):
    """Two meshes in one pose; points and directions are in the frame of the fixed one.

    Attributes
    ----------
    in_contact : bool
        the surfaces meet, or one body is inside the other
    intersecting_pairs : int
        pairs of triangles that meet; touching counts
    inside : Literal["fixed", "mobile"] or None
        the body that is wholly inside the other, without their surfaces meeting: `"fixed"`, `"mobile"` or null
    nearest_distance_mm : float or None
        between the surfaces; null where they meet, and a distance too if one body is inside the other
    nearest_fixed_mm : NDArray[np.float64] or None
        where, on the fixed body
    nearest_mobile_mm : NDArray[np.float64] or None
        and on the mobile body
    deepest : TouchDepth or None
        the deepest place, below; null without contact, if no point of a surface is inside the other body (they touch, or
        coincide), and if no body has an inside
    depth_bound_mm : float or None
        no place of either surface is deeper than this; null without contact, and if no body has an inside
    ray_depth_mm : float or None
        along rays from `--centre`, as `condyle depth --method radial` has it: of the deepest vertex whose ray is a depth; null
        without a centre or contact, and if a body has no inside
    volume_mm3 : float or None
        of the space inside both; null without contact, without `--measures`, and if a body has no inside or is inside out there,
        as one that crosses itself may be
    volume_error_mm3 : float or None
        it is off by no more
    fixed_area_mm2 : float or None
        of the fixed body's surface inside the mobile body
    mobile_area_mm2 : float or None
        of the mobile body's surface inside the fixed body
    centroid_mm : NDArray[np.float64] or None
        of both areas
    fixed_covered_again_mm3 : float or None
        how much of that volume is counted again because the fixed body covers it more than once: it crosses itself or has
        triangles twice
    mobile_covered_again_mm3 : float or None
        likewise because of the mobile body
    free : list[FreeTranslation]
        for each direction of `--along` how far the mobile body moves until it is free, below
    notes : list[Note]
        `code` and `text` of what the answer must be read with
    """

    in_contact: bool
    intersecting_pairs: int
    inside: Optional[Literal["fixed", "mobile"]] = None
    nearest_distance_mm: Optional[float] = None
    nearest_fixed_mm: Optional[NDArray[np.float64]] = None
    nearest_mobile_mm: Optional[NDArray[np.float64]] = None
    deepest: Optional[TouchDepth] = None
    depth_bound_mm: Optional[float] = None
    ray_depth_mm: Optional[float] = None
    volume_mm3: Optional[float] = None
    volume_error_mm3: Optional[float] = None
    fixed_area_mm2: Optional[float] = None
    mobile_area_mm2: Optional[float] = None
    centroid_mm: Optional[NDArray[np.float64]] = None
    fixed_covered_again_mm3: Optional[float] = None
    mobile_covered_again_mm3: Optional[float] = None
    free: list[FreeTranslation]
    notes: list[Note]


class TurnEnd(Record):
    """First contact of a turn in one sense.

    Attributes
    ----------
    turned_deg : float
        from the start, at least 0; 360 if nothing meets
    reason : Literal["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"]
        `"contact"`, `"contact_at_start"` or `"end_of_range"`
    error_bound_deg : float
        contact is not before it, and past it by no more
    contact_point_mm : NDArray[np.float64] or None
        where; null without contact, and if one body is inside the other
    features : FeaturesRecord or None
        which features meet, `fixed` and `mobile`
    """

    turned_deg: float
    reason: Literal["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"]
    error_bound_deg: float
    contact_point_mm: Optional[NDArray[np.float64]] = None
    features: Optional[FeaturesRecord] = None


class TurnInterval(Record):
    """Angles between which nothing meets."""

    low_deg: float
    high_deg: float
    low_error_bound_deg: float
    high_error_bound_deg: float


class TurnRecord(Record):
    """A whole turn of the mobile mesh about an axis; points are in the frame of the fixed one.

    Attributes
    ----------
    axis : NDArray[np.float64]
        its direction as it was given
    centre_mm : NDArray[np.float64]
        a point on it
    free_at_start : bool
        whether the bodies are apart where they are given
    negative : TurnEnd
        first contact against the right hand about the axis
    positive : TurnEnd
        and with it
    free : list[TurnInterval]
        all free intervals, ascending: `low_deg` and `high_deg` from the start, with their error bounds: free between, and contact
        outside by no more. One that holds the start goes from below 0 to above, others lie between 0 and 360
    notes : list[Note]
        `code` and `text` of what the answer must be read with
    """

    axis: NDArray[np.float64]
    centre_mm: NDArray[np.float64]
    free_at_start: bool
    negative: TurnEnd
    positive: TurnEnd
    free: list[TurnInterval]
    notes: list[Note]


class SlideEnd(Record):
    """First contact of a slide in one sense.

    Attributes
    ----------
    moved_mm : float or None
        along the direction, signed; null if nothing meets
    error_bound_mm : float
        contact is not before it, and past it by no more
    contact_point_mm : NDArray[np.float64] or None
        where
    features : FeaturesRecord or None
        which faces meet, `fixed` and `mobile`
    """

    moved_mm: Optional[float] = None
    error_bound_mm: float
    contact_point_mm: Optional[NDArray[np.float64]] = None
    features: Optional[FeaturesRecord] = None


class SlideInterval(Record):
    """Positions between which nothing meets."""

    low_mm: Optional[float] = None
    high_mm: Optional[float] = None
    low_error_bound_mm: float
    high_error_bound_mm: float


class SlideRecord(Record):
    """A slide of the mobile mesh along a direction; points are in the frame of the fixed one.

    Attributes
    ----------
    along : NDArray[np.float64]
        the direction, of length 1
    free_at_start : bool
        whether the bodies are apart where they are given
    negative : SlideEnd
        first contact against the direction; 0 in contact at the start
    positive : SlideEnd
        and along it
    free : list[SlideInterval]
        all free intervals, ascending: `low_mm` and `high_mm` from the start, null for the ends of the line, with their error
        bounds
    notes : list[Note]
        `code` and `text` of what the answer must be read with
    """

    along: NDArray[np.float64]
    free_at_start: bool
    negative: SlideEnd
    positive: SlideEnd
    free: list[SlideInterval]
    notes: list[Note]
