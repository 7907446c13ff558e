"""A range of motion for figures, whether it comes from rom.json or from `Joint.range_of_motion`."""
from __future__ import annotations

import math
from typing import Any, List, Mapping, NamedTuple, Optional, Protocol, Sequence, Tuple, Union

from .._errors import UsageError
from .._limit_band import LimitBand
from .._range_of_motion import RangeOfMotion
from .words import of


class WithMotions(Protocol):
    """An object with what `rom.json` has."""

    @property
    def motions(self) -> Sequence[object]: ...


RomLike = Union[RangeOfMotion, Mapping[str, object], WithMotions]
Bands = Union[bool, Sequence[Union[LimitBand, Mapping[str, float]]]]


class Band(NamedTuple):
    """Band of a limit, degrees: 5, 50 and 95 % of its joints; `is_open` if over 5 % of them reach the end of the range without contact; `text`
    as the command quotes it, "88–>120"."""

    p5_deg: float
    median_deg: float
    p95_deg: float
    is_open: bool
    text: str


class MotionEnd(NamedTuple):
    """Where a motion ends. `end` is "impingement", "bearing", "cut", "contact" (of an unknown kind), "end_of_range",
    "translation_ends" or "contact_at_start"; `bearing_deg` where bearing surfaces met before; `hour` on the rim's clock, in [0, 12); `caveats`
    the codes of what usually ends such a motion; `living_deg` where a living hip with this bone is expected to end.
    """

    name: str
    turned_deg: float
    end: str
    bearing_deg: Optional[float]
    band: Optional[Band]
    normal_deg: Optional[float]
    hour: Optional[float]
    caveats: Tuple[str, ...]
    range_deg: float
    living_deg: Optional[float]


def _end(limit: Any) -> str:
    reason: str = of(limit, "reason")
    if reason != "contact":
        return "translation_ends" if of(limit, "translation_ends") else reason
    kind: Optional[str] = of(limit, "contact_kind")
    return kind if kind in ("impingement", "bearing", "cut") else "contact"


def _band(found: Any, range_deg: float) -> Optional[Band]:
    if found is None:
        return None
    p5, median, p95 = (float(of(found, name)) for name in Band._fields[:3])
    # Files of earlier versions have no text.
    text = of(found, "text", None) or f"{p5:.0f}–{p95:.0f}"
    return Band(p5, median, p95, of(found, "share_without_contact", 0) > 0.05 and p95 > range_deg - 0.5, text)


def _caveats(limit: Any) -> Tuple[str, ...]:
    return tuple(of(caveat, "code") for caveat in of(limit, "caveats") or ())


def _of_limit(limit: Any) -> MotionEnd:
    range_deg, living = float(of(limit, "range_deg", math.inf)), of(limit, "living")
    return MotionEnd(of(limit, "name"), of(limit, "limit_deg"), _end(limit), of(limit, "bearing_contact_deg"), _band(of(limit, "band"), range_deg),
                     of(limit, "normal_range_deg"), of(limit, "clock_hour"), _caveats(limit), range_deg,
                     None if living is None else of(living, "expected_deg"))


def motion_ends(result: RomLike, bands: Bands = True) -> List[MotionEnd]:
    """The end of each motion of a result. `bands` are those of the result (True), none (False), or one per motion.

    Raises UsageError where there are no motions, or not as many bands.
    """
    limits = of(result, "limits")
    ends = list(map(_of_limit, of(result, "motions") or [] if limits is None else limits))
    if not ends:
        raise UsageError("no motions to draw")
    if bands is True:
        return ends
    if bands is False:
        return [end._replace(band=None) for end in ends]
    if len(bands) != len(ends):
        raise UsageError(f"{len(bands)} bands for {len(ends)} motions")
    return [end._replace(band=_band(band, end.range_deg)) for end, band in zip(ends, bands)]
