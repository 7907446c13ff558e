"""How far a joint turns before bone meets bone, where, and why."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, TypedDict, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import Unchanging, html_of
from ._contact_checks import notes_said, reported
from ._described_joint import DescribedJoint
from ._errors import JointRemark, UsageError, warn
from ._impingement_zone import ImpingementZone, body_zone_of
from ._limit_band import LimitBand, LimitBands
from ._limits import FreeAngles, HasLimits, Limit, MotionLimit, end_text, limit_of, motion_limit_of
from ._motion import Motion, MotionLike, Motions
from ._motion_map import TRANSLATIONS, MotionMap, map_of
from ._native import RangeOfMotion as NativeRange
from ._resection import OfJoint, Resection
from ._sweep import Sweep
from ._words import FEWEST_SAMPLES, MOST_SAMPLES, AngleUnit, BearingRule, ClockPlane, LimitSource, Path, Progress, StopForce, band_of, count
from ._words import number, path_of, progress_of, report_labels, text_of, word

if TYPE_CHECKING:
    import pandas


class FittedSphere(TypedDict):
    """The sphere of a socket: see :attr:`RangeOfMotion.bearing`."""

    centre_mm: list[float]
    radius_mm: float


class MotionArc(TypedDict):
    """From one limit to the other of two motions: see :attr:`RangeOfMotion.arcs`."""

    motions: list[str]
    arc_deg: float


class ImplantPair(TypedDict, total=False):
    """Liner and neck of an implant: see :attr:`RangeOfMotion.implant`."""

    fixed_part: str
    mobile_part: str
    half_angle_deg: Optional[float]
    between_axes_deg: Optional[float]
    why_no_closed_form: str


class Bearing(TypedDict):
    """The surface on which head and socket slide: see :attr:`RangeOfMotion.bearing`."""

    head_centre: NDArray[np.float64]
    head_radius_mm: float
    margin_mm: Optional[float]
    parts: Sequence[str]
    rim_gap_mm: Optional[float]
    beside_gap_mm: Optional[float]
    head_coverage: float
    socket: Optional[FittedSphere]
    triangles: NDArray[np.uint8]


def _native_before(before: object, plan: Optional[Resection[OfJoint]]) -> Optional[_native.Joint]:
    """The joint with which a report compares its own."""
    if before is None:
        return None
    if plan is not None:
        raise UsageError("before: a plan has its own before and after: one of the two")
    if not isinstance(before, DescribedJoint):
        raise UsageError(f"before: a joint is needed, not {type(before).__name__}")
    return before._native


def _native_sweep(sweep: object, plan: Optional[Resection[OfJoint]]) -> Optional[_native.Sweep]:
    """The sweep whose safe zone a report shows."""
    if sweep is None:
        return None
    if plan is not None:
        raise UsageError("sweep: not with a plan, whose bone is cut where its parts are")
    if not isinstance(sweep, Sweep):
        raise UsageError(f"sweep: a condyle.Sweep is needed, not {type(sweep).__name__}")
    return sweep._shown()


class RangeOfMotion(HasLimits, Unchanging):
    """A joint made ready for motions, and the limits of those asked for. Made by :meth:`Joint.range_of_motion`.

    `limits` is a tuple of :class:`MotionLimit`; `rom["flexion"]` and `rom[0]` are one of them, `rom[-2:]` some. Limits are exact: never past a
    contact, short of one by at most `error_bound_deg`. `notes` is what they must be read with because of the joint's shape, each
    with a :class:`JointRemark`. What `condyle rom --json` says beside them has its keys: :attr:`caveats`, :attr:`implant` and so on.
    Any number of threads may ask. It can be pickled: the tables for further questions are built anew when the first one needs them.

    C++: `condyle::answer_range` in condyle/answer.hpp; `condyle rom`.
    """

    __slots__ = ("_made", "_asked", "_joint", "_motions", "_said", "limits", "notes", "__weakref__")
    _made: Optional[NativeRange]
    _asked: tuple[Any, ...]

    def __init__(self, joint: DescribedJoint, motions: Motions, asked: list[tuple[object, ...]], translation_mm: Optional[ArrayLike],
                 *how: object) -> None:
        self._asked = asked, translation_mm, *how
        self._made = _native.range_of_motion(joint._asked, *self._asked)
        self._joint, self._motions, self._said = joint, motions, self._made.answer()
        if translation_mm is not None:  # an array, which may change
            self._asked = asked, self.held_translation_mm, *how
        self.limits = tuple(map(self._motion_limit_of, self._said.pop("limits")))
        self.notes = notes_said(self._said["notes"])

    def __reduce__(self) -> tuple[Any, ...]:
        return RangeOfMotion._remade, (self._joint, self._asked, self._said, self.limits, self.notes)

    @classmethod
    def _remade(cls, joint: DescribedJoint, *kept: Any) -> RangeOfMotion:
        rom = cls.__new__(cls)
        rom._made, rom._joint, rom._motions = None, joint, Motions(joint._native)
        rom._asked, rom._said, rom.limits, rom.notes = kept
        return rom

    @property
    def _native(self) -> NativeRange:
        if self._made is None:
            self._made = _native.range_of_motion(self._joint._native, *self._asked)
        return self._made

    def _limit_of(self, found: dict[str, Any]) -> Limit:
        return limit_of(found, self._joint.fixed, self._joint.mobile)

    def _motion_limit_of(self, found: dict[str, Any]) -> MotionLimit:
        return motion_limit_of(found, self._motions, self._joint)

    @property
    def known_motions(self) -> tuple[Motion, ...]:
        """Built-in ones of the joint and those of its file."""
        return self._motions.known

    def motion(self, named: MotionLike) -> Motion:
        """The motion of that name, or the one given."""
        return self._motions[named]

    # Its answers.

    def limit(self, motion: MotionLike) -> MotionLimit:
        """Where one motion ends: one of the known ones by its name, or a :class:`Motion` of one's own."""
        found, = self._native.limits([self._motions.tuple_of(self.motion(motion))])
        return self._motion_limit_of(found)

    def free_angles(self, vary: str, start_deg: Mapping[str, float] = {}, *, negative_deg: float = -180,
                    positive_deg: float = 180) -> FreeAngles:
        """All values of one angle that are free, the others held: intervals, and with them the exact contact set.

        From `negative_deg` to `positive_deg` of the start, at most half a turn either way.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> rom = condyle.Joint(bones.hip_bone, bones.femur).range_of_motion(["flexion"])
        >>> free = rom.free_angles("flexion")
        >>> free.contact_set_deg.shape[1], bool(free.positive.limit_deg == rom["flexion"].limit_deg)
        (2, True)
        """
        which = self._motions.positive_angle(vary, "vary")
        if which != 0:
            self._motions.refuse_of_hinge("vary")
        low, high = number(negative_deg, "negative_deg", -180, 0), number(positive_deg, "positive_deg", 0, 180)
        found = self._native.free_angles(which, self._motions.start(start_deg), low, high)
        intervals = np.array([interval[:2] for interval in found["intervals"]]).reshape(-1, 2)
        return FreeAngles(intervals, (low, high), self._limit_of(found["negative"]), self._limit_of(found["positive"]),
                          tuple(self._limit_of(interval[2]) for interval in found["intervals"]),
                          tuple(self._limit_of(interval[3]) for interval in found["intervals"]))

    def contact_set(self, vary: str, start_deg: Mapping[str, float] = {}) -> NDArray[np.float64]:
        """(K, 2) all values of one angle, less its start, at which the bodies are in contact; within half a turn."""
        return self.free_angles(vary, start_deg).contact_set_deg

    def map(self, column: Mapping[str, Sequence[float]], row: Mapping[str, Sequence[float]], *,
            vary: Optional[str] = None, start_deg: float = 0, held_deg: Mapping[str, float] = {},
            progress: Progress = None) -> MotionMap:
        """Free values of a third coordinate over a grid of two others, on all threads.

        `column` and `row` are each one angle with first, last and step in degrees: `{"flexion": (0, 120, 10)}`, or of a free joint
        one translation in mm: `{"x": (-1, 1, 0.5)}`; `vary` is the third angle by default, and may be a translation, which goes up to
        50 mm from where the joint is held. `held_deg` has angles that the map neither holds on an axis nor varies. Exact
        at every point; a :class:`JointRemark` names an axis that ends before its last value. Ctrl-C ends it within points
        begun; `progress` is called with (done, total).

        C++: `condyle::further_answer` with `RangeRequest::map` in condyle/answer.hpp.

        >>> import condyle
        >>> bones = condyle.sample_hip(scenario=1)
        >>> rom = condyle.Joint(bones.hip_bone, bones.femur).range_of_motion([])
        >>> rom.map({"flexion": (0, 100, 50)}, {"adduction": (-20, 20, 20)})
        MotionMap(internal_rotation over 3 values of adduction and 3 of flexion; 9 of 9 points free somewhere)
        """
        axes, which = self._grid(column, row, vary)
        start = number(start_deg, "start_deg")
        if which > 2 and start != 0:
            raise UsageError("start_deg: is of an angle that varies")
        found = _native.motion_map(self._native, *axes, which, start, self._motions.start(held_deg), progress_of(progress))
        reported(found.pop("notes"))
        names = (*(pair[0] for pair in self._motions.angles), *TRANSLATIONS)
        places = (axes[0][0], axes[1][0], which)
        ligaments = tuple(each.name for each in self._joint.ligaments)
        return map_of(found, tuple(names[i] for i in places), tuple("deg" if i < 3 else "mm" for i in places), start if which < 3 else
                      found["held_translation_mm"][which - 3], ligaments)

    def write_limits(self, path: Path, *, limits: LimitSource = "bony", column: Optional[Mapping[str, Sequence[float]]] = None,
                     row: Optional[Mapping[str, Sequence[float]]] = None, vary: Optional[str] = None, stop: StopForce = "limit",
                     model: Optional[Path] = None, angle_unit: AngleUnit = "degree", progress: Progress = None) -> dict[str, object]:
        """Writes limits that hold each coordinate by itself, for another program, and returns them as `written_limits` of rom.json.

        The ending of `path` decides: .osim of the model that the joint was read from, a copy of `model` if that is given, with `stop` "limit"
        (CoordinateLimitForce) or "linear" (CoordinateLinearStopForce); .xml of MuJoCo, with angles in `angle_unit`; .csv of coupled limits.
        `limits` "living": where a living hip is expected to end, if studies say so. `column`, `row` and `vary` are of the map that the limits are held against, as
        :meth:`map`; without them a grid of 10 degrees. UsageError for another ending or a joint without coordinates of a model.

        C++: `condyle rom --write-limits`.

        >>> import condyle, os, tempfile
        >>> bones = condyle.sample_hip()
        >>> rom = condyle.Joint(bones.hip_bone, bones.femur).range_of_motion([])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     said = rom.write_limits(os.path.join(folder, "hip.xml"), column={"flexion": (0, 100, 50)}, row={"adduction": (-20, 20, 20)})
        >>> [side["coordinate"] for side in said["coordinates"]], said["error"]["points"]
        (['hip_r_flexion', 'hip_r_adduction', 'hip_r_internal_rotation'], 9)
        """
        if (column is None) != (row is None) or (column is None and vary is not None):
            raise UsageError("column: column and row are given together, and vary with them")
        grid = None if column is None or row is None else self._grid(column, row, vary)
        return _native.write_limits(self._native, self._joint._native, path_of(path), word(limits, "limits", LimitSource) == "living",
                                    word(stop, "stop", StopForce) == "linear", word(angle_unit, "angle_unit", AngleUnit) == "radian",
                                    None if model is None else path_of(model, "model"), grid, progress_of(progress))

    def _grid(self, column: Mapping[str, Sequence[float]], row: Mapping[str, Sequence[float]], vary: Optional[str]
              ) -> tuple[tuple[tuple[int, float, float, float], tuple[int, float, float, float]], int]:
        """Rows, columns, and the coordinate that varies: angles from 0, translations from 3."""
        axes = self._grid_axis(row, "row"), self._grid_axis(column, "column")
        rest = [i for i in range(3) if i not in (axes[0][0], axes[1][0])]
        if vary is None and max(axes[0][0], axes[1][0]) > 2:
            raise UsageError("vary: a map over a translation needs the angle or the translation that varies")
        return axes, rest[-1] if vary is None else self._coordinate(vary, "vary")

    def _coordinate(self, name: str, what: str) -> int:
        return 3 + TRANSLATIONS.index(name) if name in TRANSLATIONS else self._motions.positive_angle(name, what)

    def _grid_axis(self, given: Mapping[str, Sequence[float]], what: str) -> tuple[int, float, float, float]:
        if not isinstance(given, Mapping) or len(given) != 1:
            raise UsageError(f'{what}: one angle with first, last and step is needed: {{"flexion": (0, 120, 10)}}')
        (name, values), = given.items()
        which = self._coordinate(name, what)
        if not isinstance(values, (tuple, list)) or len(values) not in (2, 3):
            raise UsageError(f"{what}: first, last and step are needed")
        first, last, step = (number(value, what) for value in (*values, 1)[:3])
        return which, first, last, step

    def bands(self, motions: Optional[Sequence[MotionLike]] = None, *, samples: int = 200,
              seed: Optional[int] = None, sigma_centre_mm: Optional[float] = None,
              sigma_axes_deg: Optional[float] = None, sigma_surface_mm: Optional[float] = None,
              progress: Progress = None) -> LimitBands:
        """How far each limit moves with what is uncertain: 5 to 95 % of `samples` varied joints, 20 to 100,000.

        Standard deviations and a seed not given are those of the joint file, else 0.5 mm, 1 degree, 0.25 mm and 1; a surface from
        a label map has 0.25 voxels along its normal, which is the grid's part and not the segmentation's. The same seed gives the
        same bands. Without `motions` those of `limits`.

        C++: `condyle::further_answer` with `RangeRequest::bands` in condyle/answer.hpp.
        """
        asked = [limit.motion for limit in self.limits] if motions is None else self._motions.asked(motions)
        band = band_of(count(samples, "samples", FEWEST_SAMPLES, MOST_SAMPLES), seed, sigma_centre_mm, sigma_axes_deg, sigma_surface_mm)
        found = _native.limit_bands(self._native, [self._motions.tuple_of(each) for each in asked], band, progress_of(progress))
        return LimitBands(LimitBand(motion, **band) for motion, band in zip(asked, found))

    def zones(self, motions: Optional[Sequence[MotionLike]] = None, *, past_deg: float = 5,
              progress: Progress = None) -> tuple[Optional[ImpingementZone], ...]:
        """The overlap `past_deg` past each limit; None for motions that did not end by contact.

        C++: `condyle::further_answer` with `RangeRequest::zones_past` in condyle/answer.hpp.
        """
        asked = [limit.motion for limit in self.limits] if motions is None else self._motions.asked(motions)
        found = _native.impingement_zones(self._native, [self._motions.tuple_of(each) for each in asked],
                                          number(past_deg, "past_deg"), progress_of(progress))
        return tuple(self._zone_of(zone) for zone in found)

    def write_report(self, path: Path, *, title: Optional[str] = None, band_samples: int = 0,
                     seed: Optional[int] = None, past_deg: Optional[float] = None, measures: bool = False,
                     plan: Optional[Resection[OfJoint]] = None, before: Optional[DescribedJoint] = None,
                     sweep: Optional[Sweep] = None, motion: Optional[Path] = None, load: bool = False,
                     case: Optional[str] = None, note: Optional[str] = None, date: Optional[str] = None,
                     whole_paths: bool = False, progress: Progress = None) -> None:
        """Writes one HTML file that shows the joint with these limits in any browser and computes with it there.

        `band_samples` above 0: with the bands of the limits, as :meth:`bands`; `past_deg`: with the impingement zones, as
        :meth:`zones`; `measures`: with the shape of a hip, as :meth:`Joint.measures`, with bands if the limits have them. `plan`
        shows the bone that must go: write it by the range of motion of `plan.joint`, whose limits the page has. `before`: another
        joint of the same kind, anatomy and side, with which the page compares this one: its bodies are seen through in the same
        scene, and its limits of the same motions, with bands of the same seed and standard deviations, stand beside these. `sweep`, of
        the same joint over one parameter or two, shows its safe zone with a point that turns the parts. `motion` is the file of a recorded
        motion, which the page plays with its curves; `load`: with pressure, by the layers of the joint file. What looks wrong with
        them is warned of, :class:`JointWarning`, and remarks are made of how they were read. `case`
        and `date` stand in the heading and `note` under the result, as given: nothing is taken from the clock. Files are named
        without their folders unless `whole_paths`. Whole or not at all; FileError where it cannot be written, UsageError if its
        name does not end in .html or .htm.

        C++: `condyle::answer_range` in condyle/answer.hpp; `condyle report`.

        >>> import condyle, os, tempfile
        >>> bones = condyle.sample_hip()
        >>> rom = condyle.Joint(bones.hip_bone, bones.femur, name="right hip").range_of_motion(["flexion", "fadir"])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     rom.write_report(os.path.join(folder, "hip.html"), past_deg=5)
        ...     os.listdir(folder)
        ['hip.html']
        """
        if plan is not None and load:
            raise UsageError("load: not with a plan, whose layers are of the joint with the bone")
        notes, remarks = _native.write_report(
            self._native, self._joint._native, path_of(path), None if title is None else text_of(title, "title"),
            band_of(band_samples, seed),
            None if past_deg is None else number(past_deg, "past_deg"), bool(measures),
            None if plan is None else plan._shown_by(self._joint), _native_before(before, plan),
            _native_sweep(sweep, plan), None if motion is None else path_of(motion, "motion"), bool(load),
            report_labels(case, note, date, whole_paths), progress_of(progress))
        reported(notes)
        for remark in remarks:
            warn(remark, JointRemark)

    def _zone_of(self, found: Optional[dict[str, Any]]) -> Optional[ImpingementZone]:
        if found is None:
            return None
        found["limit"] = self._motion_limit_of(found["limit"])
        for body, of in (("fixed", self._joint.fixed), ("mobile", self._joint.mobile)):
            found[body] = body_zone_of(found[body], of)
        return ImpingementZone(**found)

    @property
    def bearing(self) -> Optional[Bearing]:
        """The bearing surface: `head_centre` (3,) in M, `head_radius_mm`, `head_coverage` of its sphere, `socket` with `centre_mm` and
        `radius_mm`, `rim_gap_mm`, of a shoulder `beside_gap_mm` (what an acromion leaves of the head's way), `triangles` (T,) uint8.

        It lies within `margin_mm` of the head; or it is `parts`, names of meshes that are called bearing, and then the margin
        is None.
        """
        said = self._said["bearing"]
        if "head" not in said:
            return None
        return {"head_centre": np.array(said["head"]["centre_mm"]), "head_radius_mm": said["head"]["radius_mm"],
                "margin_mm": said["margin_mm"], "parts": said["parts"], "rim_gap_mm": said["rim_gap_mm"],
                "beside_gap_mm": said.get("beside_gap_mm"), "head_coverage": said["head_coverage"], "socket": said["socket"],
                "triangles": self._native.bearing_triangles}

    @property
    def bearing_rule(self) -> BearingRule:
        """Whether bearing contact ends a motion: "count", as it does where no bearing surface is known, or "leave_out"."""
        return cast("BearingRule", self._said["bearing"]["rule"])

    @property
    def caveats(self) -> list[str]:
        """What was left out, accepted or held, a sentence each."""
        return cast("list[str]", self._said["caveats"])

    @property
    def clock_plane(self) -> Optional[ClockPlane]:
        """The plane of the clock of :attr:`MotionLimit.clock_hour`; None for joints other than hips."""
        return cast("Optional[ClockPlane]", self._said["clock_plane"])

    @property
    def held_translation_mm(self) -> Optional[list[float]]:
        """The translation that all motions of a free joint keep, x, y and z."""
        return cast("Optional[list[float]]", self._said["held_translation_mm"])

    @property
    def implant(self) -> Optional[ImplantPair]:
        """Of an implant `fixed_part`, `mobile_part`, `half_angle_deg`, `between_axes_deg`, and `why_no_closed_form` where
        :attr:`MotionLimit.closed_form` is None."""
        return cast("Optional[ImplantPair]", self._said.get("implant"))

    @property
    def arcs(self) -> list[MotionArc]:
        """Pairs of `motions` that turn one angle to either side, both ending in contact, and the `arc_deg` between their limits."""
        return cast("list[MotionArc]", self._said["arcs"])

    @property
    def normal_range_source(self) -> Optional[str]:
        """Where :attr:`MotionLimit.normal_range_deg` is from; None for joints other than hips."""
        return cast("Optional[str]", self._said["normal_range_source"])

    @property
    def scope(self) -> str:
        """The tissues whose contact the limits cover, and those they do not, in one line."""
        return self._joint.scope

    @property
    def why_no_bearing(self) -> str:
        """Why no bearing surface was found and every contact counts that no mesh's word leaves out; empty where there is one."""
        return cast("str", self._said["bearing"].get("why_none", ""))

    @property
    def left_out(self) -> tuple[int, int]:
        """Triangles of the fixed and of the mobile body that were left out as in contact in the reference pose."""
        return self._native.left_out

    def __repr__(self) -> str:
        return "RangeOfMotion(" + ", ".join(
            f"{limit.motion.name} {end_text(limit.limit_deg, limit.reason)}{' ' + limit.reason if limit.reason == 'contact_at_start' else ''}"
            for limit in self.limits) + ")"

    def _repr_html_(self) -> str:
        return html_of(self._joint.name, [(limit.motion.name, f"{end_text(limit.limit_deg, limit.reason)} deg, {limit.reason}")
                                          for limit in self.limits])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per motion. Needs pandas."""
        import pandas

        return pandas.DataFrame([
            {"motion": limit.motion.name, "limit_deg": limit.limit_deg, "reason": limit.reason,
             "kind": limit.contact.kind if limit.contact else "unknown", "error_bound_deg": limit.error_bound_deg,
             "bearing_contact_deg": math.nan if limit.bearing_contact_deg is None else limit.bearing_contact_deg,
             "soft_contact_deg": math.nan if limit.soft_contact_deg is None else limit.soft_contact_deg,
             "fixed_part": limit.fixed_part, "mobile_part": limit.mobile_part,
             "soft_fixed_part": limit.soft_fixed_part, "soft_mobile_part": limit.soft_mobile_part}
            for limit in self.limits])
