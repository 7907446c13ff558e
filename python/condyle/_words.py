"""Arguments as people give them, checked once where they enter."""

from __future__ import annotations

import math
import os
from typing import Any, Callable, Literal, Optional, SupportsFloat, SupportsIndex, Union, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import UsageError

Path = Union[str, os.PathLike[str]]
Progress = Optional[Callable[[int, int], object]]
Ball = tuple[ArrayLike, float]
AboutLike = Union[str, ArrayLike, tuple[ArrayLike, ArrayLike]]

# The words that are taken and given, each list written once: `word` reads it from the type.
Anatomy = Literal["hip", "knee", "ankle", "elbow", "shoulder"]
JointKind = Literal["ball", "hinge", "free"]
Side = Literal["right", "left"]
LengthUnit = Literal["mm", "cm", "in", "m"]
Axes = Literal["LPS", "RAS"]
TranslationFrame = Literal["fixed", "joint_axes"]
ZeroFrom = Literal["as_given", "stated", "landmarks", "anatomy"]
Body = Literal["mobile", "fixed"]
Bodies = Literal["both", "mobile", "fixed"]
DepthMethod = Literal["radial", "tangential", "normal"]
GapMethod = Literal["radial", "tangential"]
FaceRule = Literal["cut_faces", "face_centre"]
ArcRule = Literal["alternating", "nearest_arc"]
CellMap = Literal["cube", "cartesian"]
PressureLaw = Literal["linear", "logarithmic"]
BearingRule = Literal["leave_out", "count"]
BestDesign = Literal["largest_margin", "least_change"]
CutFrom = Literal["mobile", "fixed", "both"]
BrushAction = Literal["lower", "restore"]
KeptBy = Literal["bearing", "depth", "zone", "marked"]
CupDefinition = Literal["radiographic", "anatomic", "operative"]
ImplantCentre = Literal["head", "socket"]
Bones = Literal["sample", "none"]
PartContact = Literal["ends", "bearing", "soft"]
ParameterKind = Literal["frontal", "inclination", "sagittal", "tilt", "version", "translation", "size", "cup_inclination",
                        "cup_anteversion"]
SpherePart = Literal["head", "socket"]
Repair = Literal["weld", "drop_unreferenced", "flip_inverted"]
Colour = Literal["depth", "gap", "nearest", "none"]
BodyStyle = Literal["solid", "transparent", "hidden"]
WrapShape = Literal["sphere", "cylinder", "ellipsoid"]
LimitReason = Literal["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"]
LimitKnownBy = Literal["meshes", "closed_form"]
PolygonRule = Literal["refuse", "split", "guess"]
CoordinateMotion = Literal["rotational", "translational", "coupled"]
LabelTask = Literal["total", "total_v1", "total_mr"]
Affine = Literal["sform", "qform"]
ImageAxes = Literal["LPS", "RAS", "LAS"]
ImageAxis = Literal["i", "j", "k"]
ImageSide = Literal["first", "last"]
Pieces = Literal["largest", "all"]
Cavities = Literal["fill", "keep"]
ClockPlane = Literal["sagittal", "rim"]
LimitSource = Literal["bony", "living"]
StopForce = Literal["limit", "linear"]
AngleUnit = Literal["degree", "radian"]
ContactSide = Literal["superior", "anterior", "inferior", "posterior"]
ContactKind = Literal["unknown", "bearing", "impingement", "cut", "soft"]
DepthKind = Literal["none", "radial", "flexion", "adduction", "internal_rotation", "nearest"]
BalanceOutcome = Literal["balanced", "at_jump", "pulled_apart", "over_the_rim", "too_large", "unstable",
                         "free_direction"]
ContactEndKind = Literal["exact", "bounded", "recording_begins", "recording_ends"]


def path_of(given: Any, name: str = "path") -> str:
    """The path as text; open files and file numbers are none."""
    if not isinstance(given, (str, os.PathLike)):
        raise UsageError(f"{name}: a path is needed, not {type(given).__name__}")
    path = os.fspath(given)
    if not isinstance(path, str):
        raise UsageError(f"{name}: a path of text is needed, not {type(path).__name__}")
    if "\0" in path:
        raise UsageError(f"{name}: a path has no character 0")
    try:
        path.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raise UsageError(f"{name}: a path that cannot be written in UTF-8") from None
    return path


def number(given: SupportsFloat, name: str, low: float = -math.inf, high: float = math.inf) -> float:
    """A finite number from low to high."""
    refuse_masked(given, name)
    try:
        if isinstance(given, (str, bytes)):
            raise TypeError
        value = float(given)
    except (TypeError, ValueError, OverflowError):
        raise UsageError(f"{name}: a number is needed, not {type(given).__name__}") from None
    if not math.isfinite(value):
        raise UsageError(f"{name}: a finite number is needed, not {value}")
    if value < low:
        raise UsageError(f"{name}: {value:g} is below {low:g}")
    if value > high:
        raise UsageError(f"{name}: {value:g} is above {high:g}")
    return value


def count(given: Any, name: str, low: int = 0, high: int = 2**31 - 1) -> int:
    """A whole number from low to high."""
    if isinstance(given, bool) or not hasattr(given, "__index__"):
        raise UsageError(f"{name}: a whole number is needed, not {type(given).__name__}")
    try:
        value = given.__index__()
    except TypeError:
        raise UsageError(f"{name}: a whole number is needed, not {type(given).__name__}") from None
    if not low <= value <= high:
        raise UsageError(f"{name}: {value} is not in {low} to {high}")
    return int(value)


#: Of a band: fewer leave nothing below 5 and above 95 % of them.
FEWEST_SAMPLES = 20
#: At some milliseconds each these are an hour, and percentiles have long settled.
MOST_SAMPLES = 100_000
Band = Optional[tuple[int, Optional[int], Optional[float], Optional[float], Optional[float]]]


def band_of(samples: int, seed: Optional[int] = None, sigma_centre_mm: Optional[float] = None, sigma_axes_deg: Optional[float] = None,
            sigma_surface_mm: Optional[float] = None) -> Band:
    """A band as the module is asked for it; None for no samples. What is None is as the joint's file says."""
    samples = count(samples, "band_samples") and count(samples, "band_samples", FEWEST_SAMPLES, MOST_SAMPLES)
    seed = None if seed is None else count(seed, "seed", high=2**64 - 1)
    centre, axes, surface = (None if given is None else number(given, name) for given, name in (
        (sigma_centre_mm, "sigma_centre_mm"), (sigma_axes_deg, "sigma_axes_deg"), (sigma_surface_mm, "sigma_surface_mm")))
    return (samples, seed, centre, axes, surface) if samples else None


def text_of(given: Any, name: str) -> str:
    if not isinstance(given, str):
        raise UsageError(f"{name}: a text is needed, not {type(given).__name__}")
    return given


def report_labels(
        case: Optional[str], note: Optional[str], date: Optional[str], whole_paths: bool,
) -> tuple[Optional[str], Optional[str], Optional[str], bool]:
    """Texts of a report, as given."""
    case, note, date = (None if given is None else text_of(given, name) for given, name in ((case, "case"), (note, "note"), (date, "date")))
    return case, note, date, bool(whole_paths)


def word(given: object, name: str, of: object) -> str:
    """One of the words of a Literal, or of a tuple where the joint or the answer says which there are."""
    known: tuple[str, ...] = of if isinstance(of, tuple) else get_args(of)
    if not isinstance(given, str) or given not in known:
        said = repr(given) if isinstance(given, str) and len(given) < 60 else type(given).__name__
        raise UsageError(f"{name}: there are {', '.join(known[:-1])} and {known[-1]}, not {said}")
    return given


def refuse_masked(given: Any, name: str) -> None:
    """UsageError for a masked array: its masked elements hold numbers that mean nothing."""
    if isinstance(given, np.ma.MaskedArray):
        raise UsageError(f"{name}: a masked array is not read, since what is masked has no value: give its filled() or "
                         "compressed()")


def array(given: ArrayLike, name: str, wanted: str) -> NDArray[Any]:
    """An array of whatever shape; `wanted` is what is asked for: "an array of shape (V, 3)"."""
    refuse_masked(given, name)
    try:
        values: NDArray[Any] = np.asarray(given)
    except (TypeError, ValueError):  # rows of different lengths
        raise UsageError(f"{name}: {wanted} is needed, not {type(given).__name__} of another form") from None
    return values


def number_array(given: Any, name: str, wanted: str) -> NDArray[np.float64]:
    """As doubles, of whatever shape; `wanted` is what is asked for: "three numbers"."""
    refuse_masked(given, name)
    try:
        values = np.asarray(given)
        if values.dtype.kind not in "fiu":  # complex numbers and texts would be cast
            raise TypeError
        return values.astype(float)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: {wanted} are needed, not {type(given).__name__}") from None


def ball(given: Any, name: str) -> tuple[Any, float]:
    """Centre and radius; the centre is looked at where it is used."""
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise UsageError(f"{name}: a centre and a radius are needed, not {type(given).__name__}")
    return given[0], number(given[1], name, low=0)


def progress_of(given: Progress) -> Progress:
    """A callable of (done, total), or None."""
    if given is not None and not callable(given):
        raise UsageError(f"progress: a callable of (done, total) is needed, not {type(given).__name__}")
    return given
