"""Measures of a hip's shape."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Iterable, Iterator, Mapping, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._answer import html_of
from ._described_joint import DescribedJoint
from ._errors import unknown
from ._record import columns_of
from ._records import MeasureRecord
from ._words import Progress, band_of, number, progress_of

if TYPE_CHECKING:
    import pandas


class HipMeasure(MeasureRecord):
    __doc__ = MeasureRecord.__doc__


def _column(of_hours: Iterable[Mapping[str, Optional[float]]], key: str) -> NDArray[np.float64]:
    """A value of each direction, NaN where there is none."""
    return np.array([math.nan if at[key] is None else at[key] for at in of_hours], dtype=np.float64)


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
        said = _native.hip_measures_of(joint._asked, number(pelvic_tilt_deg, "pelvic_tilt_deg"), band_of(band_samples, seed),
                                       progress_of(progress))
        neck, rim = said["around_neck"], said["rim"]
        self._by_key = {each["key"]: HipMeasure.of(each) for each in said["measures"]}
        self.pelvis_frame, self.geometry, self.left_out = said["pelvis_frame"], said["geometry"], tuple(said["left_out"])
        self.neck_hour = _column(neck, "hour")
        self.alpha_deg, self.alpha_at_1mm_deg, self.offset_mm = (
            _column(neck, key) for key in ("alpha_deg", "alpha_at_1mm_deg", "offset_mm"))
        self.is_doubtful = np.array([at["is_doubtful"] for at in neck], dtype=bool)
        self.rim_hour, self.cover_deg, self.centre_edge_deg = (
            _column(rim, key) for key in ("hour", "cover_deg", "centre_edge_deg"))
        none = np.full(3, math.nan)
        self.rim_points = np.array([none if at["point_mm"] is None else at["point_mm"] for at in rim], dtype=np.float64).reshape(-1, 3)
        self.is_in_plane = np.array([at["is_in_plane"] for at in rim], dtype=bool)

    def __getitem__(self, key: str) -> HipMeasure:
        try:
            return self._by_key[key]
        except KeyError:
            raise unknown("measure", key, list(self._by_key)) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_key)

    def __len__(self) -> int:
        return len(self._by_key)

    def _repr_html_(self) -> str:
        return html_of("measures", [(each.key, f"{each.value:.4g} {each.unit}".removesuffix(" 1") if each.value is not None else str(each.why_none))
                                    for each in self.values()])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per measure. Needs pandas."""
        import pandas

        return pandas.DataFrame(list(map(columns_of, self.values())))

    def __repr__(self) -> str:
        measured = sum(each.value is not None for each in self.values())
        return f"HipMeasures({measured} of {len(self)} measures)"
