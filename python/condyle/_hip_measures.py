"""Measures of a hip's shape."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Iterator, Mapping, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._described_joint import DescribedJoint
from ._errors import unknown
from ._words import Progress, band_of, number, progress_of


@dataclass(frozen=True)
class NormalRange:
    """Between `low` and `high` lie the measures of `people`, `count` of them if it is known: `meaning` says which measures, `source` where from."""

    low: float
    high: float
    people: str
    count: Optional[int]
    meaning: str
    source: str


class MeasureBand(NamedTuple):
    """5 %, median and 95 % of a measure over displaced joints, None where none shows it; and how many do not."""

    p5: Optional[float]
    median: Optional[float]
    p95: Optional[float]
    samples_without_value: int


@dataclass(frozen=True)
class HipMeasure:
    """One measure: `value` in `unit` ("mm", "deg", "h" or "1"), None where the meshes do not show it, and then `why_none`.

    `note` is to be read with the value; `measured_by` names the planes, axes and points in :attr:`HipMeasures.geometry` that it is
    measured by; `in_pelvis_frame`: the value turns with the frame of the pelvis, and with its tilt. `normal` is a range of people with
    usual hips, `patients` one of patients, which is not called normal.
    """

    key: str
    part: str
    unit: str
    value: Optional[float]
    why_none: str
    note: str
    definition: str
    measured_by: tuple[str, ...]
    source: str
    in_pelvis_frame: bool
    normal: Optional[NormalRange]
    band: Optional[MeasureBand] = None
    patients: Optional[NormalRange] = None


class HipMeasures(Mapping[str, HipMeasure]):
    """Measures of a hip by their keys, made by :meth:`Joint.measures`.

    Attributes
    ----------
    neck_hour, alpha_deg, alpha_at_1mm_deg, offset_mm : (144,) float64
        Around the neck, 12 superior and 3 anterior: alpha angles at tolerances of 0.5 and 1 mm, head-neck offset; NaN where there
        is none. Empty without a neck.
    is_doubtful : (144,) bool
        Where the two alpha angles differ by more than 5 degrees.
    rim_hour, cover_deg, centre_edge_deg : (72,) float64
        Around the socket. `rim_points` (72, 3) in the fixed body's frame, mm; `is_in_plane` (72,) bool: what the rim's plane was
        fitted to. Empty without a socket.
    pelvis_frame : str
        Orientation of the pelvis for every measure that depends on it: "as scanned", "anterior pelvic plane", with the tilt that was given.
    geometry : dict
        Planes, axes and points that measures were made with, as `geometry` of measures.json has them; None where not found.
    left_out : tuple of str
        Pieces of the meshes near the head that are not measured, a sentence for each bone.
    """

    __slots__ = ("_by_key", "pelvis_frame", "geometry", "left_out", "neck_hour", "alpha_deg", "alpha_at_1mm_deg", "is_doubtful",
                 "offset_mm", "rim_hour", "rim_points", "is_in_plane", "cover_deg", "centre_edge_deg")

    pelvis_frame: str
    geometry: dict[str, object]
    left_out: tuple[str, ...]
    neck_hour: NDArray[np.float64]
    alpha_deg: NDArray[np.float64]
    alpha_at_1mm_deg: NDArray[np.float64]
    is_doubtful: NDArray[np.bool_]
    offset_mm: NDArray[np.float64]
    rim_hour: NDArray[np.float64]
    rim_points: NDArray[np.float64]
    is_in_plane: NDArray[np.bool_]
    cover_deg: NDArray[np.float64]
    centre_edge_deg: NDArray[np.float64]

    def __init__(self, joint: DescribedJoint, pelvic_tilt_deg: float, band_samples: int, seed: Optional[int],
                 progress: Progress) -> None:
        found = _native.hip_measures_of(joint._asked, number(pelvic_tilt_deg, "pelvic_tilt_deg"), band_of(band_samples, seed),
                                        progress_of(progress))
        self._by_key: dict[str, HipMeasure] = {}
        for each in found.pop("measures"):
            (key, part, unit, value, why_none, note, definition, by, source, in_pelvis_frame, others, are_patients), band = each
            of_others = others and NormalRange(*others)
            self._by_key[key] = HipMeasure(key, part, unit, value, why_none, note, definition, tuple(by.split(", ")), source,
                                           in_pelvis_frame, None if are_patients else of_others, band and MeasureBand(*band),
                                           of_others if are_patients else None)
        found["geometry"] = json.loads(found["geometry"])
        for name, values in found.items():
            setattr(self, name, values)

    def __getitem__(self, key: str) -> HipMeasure:
        try:
            return self._by_key[key]
        except KeyError:
            raise unknown("measure", key, list(self._by_key)) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_key)

    def __len__(self) -> int:
        return len(self._by_key)

    def __repr__(self) -> str:
        measured = sum(each.value is not None for each in self.values())
        return f"HipMeasures({measured} of {len(self)} measures)"
