"""How far a joint turns before bone meets bone, where, and why."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._answer import html_of
from ._errors import UsageError
from ._mesh import TriMesh
from ._words import count, number, word

if TYPE_CHECKING:
    from ._joint import Joint, Progress

#: Values of `reason` in maps, by number.
REASONS = ("contact", "end_of_range", "contact_at_start")
#: Values of `kind` in maps, by number.
KINDS = ("unknown", "bearing", "impingement")


@dataclass(frozen=True)
class Motion:
    """One joint angle changes from where `start_deg` has it, the other two are held.

    `vary` is the angle's name at the joint; under its negative name ("extension") it turns that way. `start_deg` are
    the three angles by their positive names; those left out are 0. `range_deg` is how far it may turn, above 0.
    """

    name: str
    vary: str
    range_deg: float
    start_deg: Mapping[str, float]

    def __repr__(self) -> str:
        start = ", ".join(f"{name} {value:g}" for name, value in self.start_deg.items() if value)
        return f"Motion({self.name!r}: {self.vary} up to {self.range_deg:g} deg{' from ' + start if start else ''})"


@dataclass(frozen=True, eq=False)
class ContactWitness:
    """A pair of features in contact. Each is ("vertex", number), ("edge", vertex, vertex) or ("face", triangle).

    `fixed_point` and `mobile_point` are (3,), each in its own body's frame, mm. `kind` is "bearing", "impingement" or
    "unknown".
    """

    fixed_feature: tuple[Any, ...]
    mobile_feature: tuple[Any, ...]
    fixed_point: NDArray[np.float64]
    mobile_point: NDArray[np.float64]
    kind: str


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
    """

    turned_deg: float
    reason: str
    contact: Optional[ContactWitness]
    error_bound_deg: float
    bearing_contact_deg: Optional[float]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.turned_deg:.6g} deg, {self.reason})"


@dataclass(frozen=True, eq=False, repr=False)
class MotionLimit(Limit):
    """Where one motion ends.

    Besides what a :class:`Limit` has: `motion`; `angles_deg`, the joint's angles there by name; `centre_distance_mm`
    between head and socket and `joint_space_mm` of the bearing surface, None where not known.
    """

    motion: Motion
    angles_deg: Mapping[str, float]
    centre_distance_mm: Optional[float]
    joint_space_mm: Optional[float]

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
        What ends each interval.
    """

    intervals_deg: NDArray[np.float64]
    range_deg: tuple[float, float]
    negative: Limit
    positive: Limit
    at_low: tuple[Limit, ...]
    at_high: tuple[Limit, ...]

    @property
    def free_width_deg(self) -> float:
        """Of all intervals together."""
        return float((self.intervals_deg[:, 1] - self.intervals_deg[:, 0]).sum())

    @property
    def contact_set_deg(self) -> NDArray[np.float64]:
        """(K, 2) the angles in contact: what the free intervals leave of the range."""
        low, high = self.range_deg
        ends: NDArray[np.float64] = np.array([low, *self.intervals_deg.ravel().tolist(), high]).reshape(-1, 2)
        return ends[ends[:, 1] > ends[:, 0]]


@dataclass(frozen=True)
class MapEnds:
    """One end of the rotation that holds the start, at every grid point, (R, C) each and `fixed_point` (R, C, 3).

    `turned_deg` from the start; `reason` and `kind` are positions in :data:`REASONS` and :data:`KINDS`;
    `bearing_contact_deg` and `fixed_point` (F, mm) are NaN where there is none.
    """

    turned_deg: NDArray[np.float64]
    reason: NDArray[np.int8]
    kind: NDArray[np.int8]
    error_bound_deg: NDArray[np.float64]
    bearing_contact_deg: NDArray[np.float64]
    fixed_point: NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class MotionMap:
    """Free values of one angle for every pair of values of the two others.

    Attributes
    ----------
    row, column, vary : str
        Names of the angles.
    row_deg : (R,), column_deg : (C,) float64
    lower_deg, upper_deg : (R, C) float64
        Ends of the free interval of the varied angle that holds the start, else of the nearest one; NaN where nothing
        is free.
    free_width_deg : (R, C) float64
        Of all intervals together.
    free_at_start : (R, C) bool
    offset : (R C + 1,) int64; intervals_deg : (K, 2) float64
        Point n, row by row, has the free intervals from offset[n] to offset[n + 1], of the varied angle less its start.
    negative, positive : MapEnds
        Both limits from the start.
    free_volume_deg3, weighted_free_volume_deg3 : float
        How much of the space of angles is free; the second by the measure that does not depend on how rotations are
        written down.
    """

    row: str
    column: str
    vary: str
    start_deg: float
    row_deg: NDArray[np.float64]
    column_deg: NDArray[np.float64]
    lower_deg: NDArray[np.float64]
    upper_deg: NDArray[np.float64]
    free_width_deg: NDArray[np.float64]
    free_at_start: NDArray[np.bool_]
    offset: NDArray[np.int64]
    intervals_deg: NDArray[np.float64]
    negative: MapEnds
    positive: MapEnds
    free_volume_deg3: float
    weighted_free_volume_deg3: float

    def __repr__(self) -> str:
        free = int((self.free_width_deg > 0).sum())
        return (f"MotionMap({self.vary} over {len(self.row_deg)} values of {self.row} and {len(self.column_deg)} of "
                f"{self.column}; {free} of {self.free_width_deg.size} points free somewhere)")

    def _repr_html_(self) -> str:
        return html_of(f"map of {self.vary}", [(self.row, f"{self.row_deg[0]:g} to {self.row_deg[-1]:g} deg"),
                                               (self.column, f"{self.column_deg[0]:g} to {self.column_deg[-1]:g} deg"),
                                               ("free volume", f"{self.free_volume_deg3:.6g} deg3")])

    def to_dataframe(self) -> Any:
        """A row per grid point, columns as in map.csv. Needs pandas."""
        import pandas

        columns, rows = np.meshgrid(self.column_deg, self.row_deg)
        return pandas.DataFrame({
            f"{self.column}_deg": columns.ravel(), f"{self.row}_deg": rows.ravel(),
            f"{self.vary}_lower_deg": self.lower_deg.ravel(), f"{self.vary}_upper_deg": self.upper_deg.ravel(),
            "free_width_deg": self.free_width_deg.ravel(), "free_at_start": self.free_at_start.ravel()})

    def to_xarray(self) -> Any:
        """A dataset over the two held angles. Needs xarray."""
        import xarray

        dims = (f"{self.row}_deg", f"{self.column}_deg")
        return xarray.Dataset(
            {name: (dims, getattr(self, name)) for name in ("lower_deg", "upper_deg", "free_width_deg",
                                                            "free_at_start")},
            coords={dims[0]: self.row_deg, dims[1]: self.column_deg}, attrs={"vary": self.vary})


@dataclass(frozen=True)
class LimitBand:
    """The spread of one motion's limit, degrees: 5, 50 and 95 % of the displaced joints.

    `width_from_…_deg` are widths where only one source is uncertain; shares are 0 to 1.
    """

    motion: Motion
    p5_deg: float
    median_deg: float
    p95_deg: float
    width_from_centre_deg: float
    width_from_axes_deg: float
    width_from_surface_deg: float
    share_without_contact: float
    share_in_contact_at_start: float


@dataclass(frozen=True)
class BodyZone:
    """One body's part of an impingement zone, in that body's own frame.

    (V,) `radial_depth_mm`, `ray_to_normal_deg`, `tangential_depth_deg`, `tangential_depth_mm`, 0 for vertices not
    inside, all empty where the other body is open; `triangles` (K,) that meet the other body; `area_mm2` and `centroid`
    (3,) of these.
    """

    radial_depth_mm: NDArray[np.float64]
    ray_to_normal_deg: NDArray[np.float64]
    tangential_depth_deg: NDArray[np.float64]
    tangential_depth_mm: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    area_mm2: float
    centroid: Optional[NDArray[np.float64]]


@dataclass(frozen=True)
class ImpingementZone:
    """What overlaps `past_deg` past a limit. Hours are on the socket's sagittal clock, angles around the neck."""

    limit: MotionLimit
    past_deg: float
    fixed: BodyZone
    mobile: BodyZone
    contact_hour: Optional[float]
    zone_hour: Optional[float]
    contact_neck_angle_deg: Optional[float]
    zone_neck_angle_deg: Optional[float]


@dataclass(frozen=True)
class PathLimit:
    """Where a path ends: on the way from waypoint `segment` to the next one, after `fraction` of it.

    `angles_deg` are the joint's angles there, by name; `reason` "contact", "end_of_range" or "contact_at_start";
    `contact` the two faces that are nearest to meeting, `distance_mm` apart.
    """

    segment: int
    fraction: float
    angles_deg: Mapping[str, float]
    reason: str
    contact: Optional[ContactWitness]
    distance_mm: float


MotionLike = Union[str, Motion]


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


class RangeOfMotion:
    """A joint made ready for motions, and the limits of those asked for. Made by :meth:`Joint.range_of_motion`.

    `limits` is a tuple of :class:`MotionLimit`; `rom["flexion"]` is one of them. Limits are exact: never past a
    contact, short of one by at most `error_bound_deg`. Any number of threads may ask.

    C++: `condyle::RangeOfMotion` in condyle/range_of_motion.hpp; `condyle rom`.
    """

    __slots__ = ("_native", "_joint", "_angles", "known_motions", "limits", "__weakref__")

    def __init__(self, joint: Joint, native: _native.RangeOfMotion, asked: Optional[Sequence[MotionLike]]
                 ) -> None:
        self._native, self._joint = native, joint
        self._angles = tuple(joint._native.angle_names)
        self.known_motions = tuple(self._motion_of(found) for found in _native.motions(joint._native))
        self.limits = self._limits(self.known_motions if asked is None else self._asked(asked))

    # Motions and angles between words and the compiled part.

    def _motion_of(self, found: tuple[Any, ...]) -> Motion:
        name, vary, sense, start, range_deg = found
        return Motion(name, self._angles[vary][0 if sense > 0 else 1], range_deg, self._named(start))

    def _named(self, degrees: Sequence[float]) -> dict[str, float]:
        return {positive: value for (positive, _), value in zip(self._angles, degrees)}

    def _angle(self, name: str, what: str) -> tuple[int, int]:
        known = tuple(word for pair in self._angles for word in pair)
        place = known.index(word(name, what, known))
        return place // 2, 1 - 2 * (place % 2)

    def _start(self, start_deg: Mapping[str, float]) -> list[float]:
        if not isinstance(start_deg, Mapping):
            raise UsageError(f"start_deg: angles by their names are needed, not {type(start_deg).__name__}")
        angles = [0.0, 0.0, 0.0]
        for name, value in start_deg.items():
            which, sense = self._angle(name, "start_deg")
            angles[which] = sense * number(value, f"start_deg: {name}") + 0.0
        return angles

    def _tuple_of(self, motion: Motion) -> tuple[Any, ...]:
        vary, sense = self._angle(motion.vary, "vary")
        if not isinstance(motion.name, str):
            raise UsageError(f"motion: a name is needed, not {type(motion.name).__name__}")
        return motion.name, vary, sense, self._start(motion.start_deg), number(motion.range_deg, "range_deg")

    def motion(self, named: MotionLike) -> Motion:
        """The motion of that name, or the one given."""
        if isinstance(named, Motion):
            return named
        if isinstance(named, str):
            wanted = named.lower().replace(" ", "_").replace("-", "_")
            for motion in self.known_motions:
                if motion.name == named or motion.name.lower() == wanted:
                    return motion
        raise UsageError(f"motion: no {named!r:.60}; there are {', '.join(each.name for each in self.known_motions)}")

    def _asked(self, motions: Sequence[MotionLike]) -> tuple[Motion, ...]:
        if isinstance(motions, str) or not isinstance(motions, Sequence):
            raise UsageError(f"motions: a list of names is needed, not {type(motions).__name__}")
        return tuple(self.motion(each) for each in motions)

    def _contact_of(self, found: Optional[dict[str, Any]]) -> Optional[ContactWitness]:
        return witness_of(found, self._joint.fixed, self._joint.mobile)

    def _limit_of(self, found: dict[str, Any]) -> Limit:
        found["contact"] = self._contact_of(found["contact"])
        return Limit(**found)

    def _motion_limit_of(self, found: dict[str, Any]) -> MotionLimit:
        found["contact"] = self._contact_of(found["contact"])
        found["motion"] = self._motion_of(found["motion"])
        found["angles_deg"] = self._named(found["angles_deg"])
        return MotionLimit(**found)

    def _limits(self, motions: Sequence[Motion]) -> tuple[MotionLimit, ...]:
        return tuple(map(self._motion_limit_of, self._native.limits([self._tuple_of(each) for each in motions])))

    # What is asked of it.

    def limit(self, motion: MotionLike) -> MotionLimit:
        """Where one motion ends: one of the known ones by its name, or a :class:`Motion` of one's own."""
        return self._limits([self.motion(motion)])[0]

    def __getitem__(self, name: str) -> MotionLimit:
        for limit in self.limits:
            if limit.motion.name == name:
                return limit
        raise KeyError(name)

    def __iter__(self) -> Iterator[MotionLimit]:
        return iter(self.limits)

    def __len__(self) -> int:
        return len(self.limits)

    def free_angles(self, vary: str, start_deg: Mapping[str, float] = {}, *, negative_deg: float = -180,
                    positive_deg: float = 180) -> FreeAngles:
        """All values of one angle that are free, the others held: intervals, and with them the exact contact set.

        From `negative_deg` to `positive_deg` of the start, at most half a turn either way.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> rom = condyle.Joint(bones.hip_bone, bones.femur).range_of_motion(["flexion"])
        >>> free = rom.free_angles("flexion")
        >>> free.contact_set_deg.shape[1], bool(free.positive.turned_deg == rom["flexion"].turned_deg)
        (2, True)
        """
        which, sense = self._angle(vary, "vary")
        if sense < 0:
            raise UsageError(f"vary: {vary} is {self._angles[which][0]} with the opposite sign")
        low, high = number(negative_deg, "negative_deg", -180, 0), number(positive_deg, "positive_deg", 0, 180)
        found = self._native.free_angles(which, self._start(start_deg), low, high)
        intervals = np.array([interval[:2] for interval in found["intervals"]]).reshape(-1, 2)
        return FreeAngles(intervals, (low, high), self._limit_of(found["negative"]), self._limit_of(found["positive"]),
                          tuple(self._limit_of(interval[2]) for interval in found["intervals"]),
                          tuple(self._limit_of(interval[3]) for interval in found["intervals"]))

    def contact_set(self, vary: str, start_deg: Mapping[str, float] = {}) -> NDArray[np.float64]:
        """(K, 2) all values of one angle, less its start, at which the bodies are in contact; within half a turn."""
        return self.free_angles(vary, start_deg).contact_set_deg

    def map(self, column: Mapping[str, Sequence[float]], row: Mapping[str, Sequence[float]], *,
            vary: Optional[str] = None, start_deg: float = 0, progress: Progress = None) -> MotionMap:
        """Free values of the third angle over a grid of the two others, on all threads.

        `column` and `row` are each one angle with first, last and step in degrees: `{"flexion": (0, 120, 10)}`. Exact
        at every point. Ctrl-C ends it within points begun; `progress` is called with (done, total).

        C++: `condyle::motion_map` in condyle/motion_map.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> rom = condyle.Joint(bones.hip_bone, bones.femur).range_of_motion([])
        >>> rom.map({"flexion": (0, 100, 50)}, {"adduction": (-20, 20, 20)})
        MotionMap(internal_rotation over 3 values of adduction and 3 of flexion; 9 of 9 points free somewhere)
        """
        axes = [self._grid_axis(column, "column"), self._grid_axis(row, "row")]
        if vary is None:
            rest = [i for i in range(3) if i not in (axes[0][0], axes[1][0])]
            which = rest[0]
        else:
            which, sense = self._angle(vary, "vary")
            if sense < 0:
                raise UsageError(f"vary: {vary} is {self._angles[which][0]} with the opposite sign")
        from ._joint import _callable

        start = number(start_deg, "start_deg")
        found = _native.motion_map(self._native, axes[1], axes[0], which, start, -180.0, 180.0, _callable(progress))
        return _map_of(found, self._angles[axes[1][0]][0], self._angles[axes[0][0]][0], self._angles[which][0], start)

    def _grid_axis(self, given: Mapping[str, Sequence[float]], what: str) -> tuple[int, float, float, float]:
        if not isinstance(given, Mapping) or len(given) != 1:
            raise UsageError(f'{what}: one angle with first, last and step is needed: {{"flexion": (0, 120, 10)}}')
        (name, values), = given.items()
        which, sense = self._angle(name, what)
        if sense < 0:
            raise UsageError(f"{what}: {name} is {self._angles[which][0]} with the opposite sign")
        if not isinstance(values, (tuple, list)) or len(values) not in (2, 3):
            raise UsageError(f"{what}: first, last and step are needed")
        first, last, step = (number(value, what) for value in (*values, 1)[:3])
        return which, first, last, step

    def bands(self, motions: Optional[Sequence[MotionLike]] = None, *, samples: int = 200, seed: int = 1,
              sigma_centre_mm: Optional[float] = None, sigma_axes_deg: Optional[float] = None,
              sigma_surface_mm: Optional[float] = None, progress: Progress = None) -> tuple[LimitBand, ...]:
        """How far each limit moves with what is uncertain: 5 to 95 % of `samples` displaced joints.

        Standard deviations not given are those of the joint file, else 0.5 mm, 1 degree and 0.25 mm. The same seed
        gives the same bands. Of the motions of `limits` where none are named.

        C++: `condyle::limit_bands` in condyle/limit_band.hpp.
        """
        from ._joint import _callable

        asked = [limit.motion for limit in self.limits] if motions is None else self._asked(motions)
        usual = _native.uncertainty(self._joint._native)
        sigma = [number(value if given is None else given, what) for given, value, what in (
            (sigma_centre_mm, usual[0], "sigma_centre_mm"), (sigma_axes_deg, usual[1], "sigma_axes_deg"),
            (sigma_surface_mm, usual[2], "sigma_surface_mm"))]
        found = _native.limit_bands(self._native, [self._tuple_of(each) for each in asked], count(samples, "samples"),
                                    count(seed, "seed", high=2**64 - 1), sigma[0], sigma[1], sigma[2],
                                    _callable(progress))
        return tuple(LimitBand(motion, **band) for motion, band in zip(asked, found))

    def zones(self, motions: Optional[Sequence[MotionLike]] = None, *, past_deg: float = 5,
              progress: Progress = None) -> tuple[Optional[ImpingementZone], ...]:
        """What overlaps `past_deg` past each limit; None for motions that did not end by contact on their way.

        C++: `condyle::ZoneFinder` in condyle/impingement_zone.hpp.
        """
        from ._joint import _callable

        asked = [limit.motion for limit in self.limits] if motions is None else self._asked(motions)
        found = _native.impingement_zones(self._native, [self._tuple_of(each) for each in asked],
                                          number(past_deg, "past_deg"), _callable(progress))
        return tuple(self._zone_of(zone) for zone in found)

    def _zone_of(self, found: Optional[dict[str, Any]]) -> Optional[ImpingementZone]:
        if found is None:
            return None
        found["limit"] = self._motion_limit_of(found["limit"])
        for body, of in (("fixed", self._joint.fixed), ("mobile", self._joint.mobile)):
            found[body] = _body_zone_of(found[body], of)
        return ImpingementZone(**found)

    @property
    def bearing(self) -> Optional[Mapping[str, Any]]:
        """The bearing surface: `head_centre` (3,) in M, `head_radius_mm`, `margin_mm`, `rim_gap_mm`, `triangles`
        (T,)."""
        found: Optional[Mapping[str, Any]] = self._native.bearing
        return found

    @property
    def why_no_bearing(self) -> str:
        """Why no bearing surface can be told and every contact counts; empty where there is one."""
        return self._native.why_no_bearing

    def __repr__(self) -> str:
        return "RangeOfMotion(" + ", ".join(
            f"{limit.motion.name} {limit.turned_deg:.1f}{'' if limit.reason == 'contact' else ' ' + limit.reason}"
            for limit in self.limits) + ")"

    def _repr_html_(self) -> str:
        return html_of(self._joint.name, [(limit.motion.name, f"{limit.turned_deg:.1f} deg, {limit.reason}")
                                          for limit in self.limits])

    def to_dataframe(self) -> Any:
        """A row per motion. Needs pandas."""
        import pandas

        return pandas.DataFrame([
            {"motion": limit.motion.name, "limit_deg": limit.turned_deg, "reason": limit.reason,
             "kind": limit.contact.kind if limit.contact else "unknown", "error_bound_deg": limit.error_bound_deg,
             "bearing_contact_deg": math.nan if limit.bearing_contact_deg is None else limit.bearing_contact_deg}
            for limit in self.limits])


def _body_zone_of(found: dict[str, Any], of: TriMesh) -> BodyZone:
    for name, values in found.items():
        if isinstance(values, np.ndarray) and name not in ("triangles", "centroid") and len(values):
            found[name] = of._all(values)
    return BodyZone(**found)


def _map_of(found: dict[str, Any], row: str, column: str, vary: str, start: float) -> MotionMap:
    shape = len(found["row_deg"]), len(found["column_deg"])
    ends = {}
    for name in ("negative", "positive"):
        end = found[name]
        ends[name] = MapEnds(**{key: values.reshape(*shape, *values.shape[1:]) for key, values in end.items()})
    offset, low, high = found["offset"], found["low_deg"], found["high_deg"]
    points = np.repeat(np.arange(shape[0] * shape[1]), np.diff(offset))
    width: NDArray[np.float64] = np.zeros(shape[0] * shape[1])
    np.add.at(width, points, high - low)
    lower, upper = np.full(width.shape, math.nan), np.full(width.shape, math.nan)
    # The interval nearest to the start, the lower of two as near.
    distance = np.maximum(0, np.maximum(low, -high))
    order = np.lexsort((np.arange(len(low)), distance, points))
    first = order[np.flatnonzero(np.diff(points[order], prepend=-1))]
    lower[points[first]], upper[points[first]] = start + low[first], start + high[first]
    free = ends["positive"].reason != REASONS.index("contact_at_start")
    return MotionMap(row, column, vary, start, found["row_deg"], found["column_deg"], lower.reshape(shape),
                     upper.reshape(shape), width.reshape(shape), free, offset, np.column_stack([low, high]),
                     ends["negative"], ends["positive"], found["free_volume_deg3"],
                     found["weighted_free_volume_deg3"])
