"""Free angles over a grid of two others."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._answer import html_of
from ._limits import REASONS

if TYPE_CHECKING:
    import pandas
    import xarray


@dataclass(frozen=True)
class MapEnds:
    """One end of the rotation that holds the start, at every grid point, (R, C) each and `fixed_point` (R, C, 3).

    `turned_deg` from the start; `reason` and `kind` are positions in :data:`REASONS` and :data:`KINDS`;
    `bearing_contact_deg` and `fixed_point` (F, mm) are NaN where there is none. `ligament` is the position of the one
    that ends it in the map's `ligaments`, -1 where none does.
    """

    turned_deg: NDArray[np.float64]
    reason: NDArray[np.int8]
    kind: NDArray[np.int8]
    error_bound_deg: NDArray[np.float64]
    bearing_contact_deg: NDArray[np.float64]
    fixed_point: NDArray[np.float64]
    ligament: NDArray[np.int32]


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
        Sum over all intervals.
    free_at_start : (R, C) bool
    offset : (R C + 1,) int64; intervals_deg : (K, 2) float64
        Point n, row by row, has the free intervals from offset[n] to offset[n + 1], of the varied angle less its start.
    negative, positive : MapEnds
        Both limits from the start.
    row_area_deg2 : (R,) float64
        Free width over the columns of each row; 0 of a single column.
    free_volume_deg3, weighted_free_volume_deg3 : float
        How much of the space of angles is free; the second by the measure that does not depend on how rotations are
        written down.
    ligaments : tuple of str
        Names of the joint's ligaments.
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
    row_area_deg2: NDArray[np.float64]
    free_volume_deg3: float
    weighted_free_volume_deg3: float
    ligaments: tuple[str, ...] = ()

    def __repr__(self) -> str:
        free = int((self.free_width_deg > 0).sum())
        return (f"MotionMap({self.vary} over {len(self.row_deg)} values of {self.row} and {len(self.column_deg)} of "
                f"{self.column}; {free} of {self.free_width_deg.size} points free somewhere)")

    def _repr_html_(self) -> str:
        return html_of(f"map of {self.vary}", [(self.row, f"{self.row_deg[0]:g} to {self.row_deg[-1]:g} deg"),
                                               (self.column, f"{self.column_deg[0]:g} to {self.column_deg[-1]:g} deg"),
                                               ("free volume", f"{self.free_volume_deg3:.6g} deg3")])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per grid point, columns as in map.csv. Needs pandas."""
        import pandas

        columns, rows = np.meshgrid(self.column_deg, self.row_deg)
        return pandas.DataFrame({
            f"{self.column}_deg": columns.ravel(), f"{self.row}_deg": rows.ravel(),
            f"{self.vary}_lower_deg": self.lower_deg.ravel(), f"{self.vary}_upper_deg": self.upper_deg.ravel(),
            "free_width_deg": self.free_width_deg.ravel(), "free_at_start": self.free_at_start.ravel()})

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over the two held angles. Needs xarray."""
        import xarray

        dims = (f"{self.row}_deg", f"{self.column}_deg")
        return xarray.Dataset(
            {name: (dims, getattr(self, name)) for name in ("lower_deg", "upper_deg", "free_width_deg",
                                                            "free_at_start")},
            coords={dims[0]: self.row_deg, dims[1]: self.column_deg}, attrs={"vary": self.vary})


def map_of(found: dict[str, Any], row: str, column: str, vary: str, start: float,
           ligaments: tuple[str, ...]) -> MotionMap:
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
    free = ~np.isin(ends["positive"].reason, [REASONS.index("contact_at_start"), REASONS.index("strained_at_start")])
    return MotionMap(row, column, vary, start, found["row_deg"], found["column_deg"], lower.reshape(shape),
                     upper.reshape(shape), width.reshape(shape), free, offset, np.column_stack([low, high]),
                     ends["negative"], ends["positive"], found["row_area_deg2"],
                     found["free_volume_deg3"], found["weighted_free_volume_deg3"], ligaments)
