"""Free values of one coordinate over a grid of two others."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ._answer import html_of
from ._limits import REASONS

if TYPE_CHECKING:
    import pandas
    import xarray

TRANSLATIONS = ("x", "y", "z")
Array = NDArray[np.float64]


class _InUnits:
    """What is in the unit of a coordinate has a second name with that unit: `lower` is `lower_deg`, or `lower_mm`."""

    _second_names: ClassVar[dict[str, tuple[str, int]]]  # attribute and place in `units`

    def __getattr__(self, name: str) -> Any:
        first, _, unit = name.rpartition("_")
        attribute, place = self._second_names.get(first, ("", 0))
        if attribute and self.__dict__["units"][place] == unit:
            return self.__dict__[attribute]
        raise AttributeError(f"{type(self).__name__} has no {name}")


@dataclass(frozen=True)
class MapEnds(_InUnits):
    """One end of the rotation or slide that holds the start, at every grid point, (R, C) each and `fixed_point` (R, C, 3).

    `moved` from the start, in the unit of the coordinate that varies, as `error_bound` and `bearing_contact` are: the same are `turned_deg`,
    `error_bound_deg` and `bearing_contact_deg` of an angle, `moved_mm` and so on of a translation. `reason` and `kind` are positions
    in :data:`REASONS` and :data:`KINDS`; `bearing_contact` and `fixed_point` (F, mm) are NaN where there is none.
    `ligament` is the position of the one that ends it in the map's `ligaments`, -1 where none does.
    """

    moved: Array
    reason: NDArray[np.int8]
    kind: NDArray[np.int8]
    error_bound: Array
    bearing_contact: Array
    fixed_point: Array
    ligament: NDArray[np.int32]
    units: tuple[str, ...]

    _second_names = {name: (name.replace("turned", "moved"), 0) for name in ("turned", "moved", "error_bound", "bearing_contact")}


@dataclass(frozen=True, eq=False, repr=False)
class MotionMap(_InUnits):
    """Free values of one coordinate for every pair of values of two others.

    Attributes
    ----------
    row, column, vary : str
        Names of the coordinates: angles, or the translations x, y and z.
    units : tuple of str
        Of row, column and vary: "deg" or "mm". Each attribute below that is in one of them has that in a second name too: `row_deg`
        or `row_mm`, `lower_deg` or `lower_mm`.
    start : float
        Of the varied coordinate.
    row_values : (R,), column_values : (C,) float64
    lower, upper : (R, C) float64
        Ends of the free interval of the varied coordinate that holds the start, else of the nearest one; NaN where nothing
        is free.
    free_width : (R, C) float64
        Sum over all intervals.
    free_at_start : (R, C) bool
    offset : (R C + 1,) int64; intervals : (K, 2) float64
        Point n, row by row, has the free intervals from offset[n] to offset[n + 1], of the varied coordinate less its start.
    negative, positive : MapEnds
        Both limits from the start.
    row_area_deg2 : (R,) float64
        Free width over the columns of each row; 0 of a single column, and of a map with a translation.
    free_volume_deg3, weighted_free_volume_deg3 : float
        How much of the space of angles is free; the second by the measure that does not depend on how rotations are
        written down. 0 with a translation.
    ligaments : tuple of str
        Names of the joint's ligaments.
    """

    row: str
    column: str
    vary: str
    units: tuple[str, ...]
    start: float
    row_values: Array
    column_values: Array
    lower: Array
    upper: Array
    free_width: Array
    free_at_start: NDArray[np.bool_]
    offset: NDArray[np.int64]
    intervals: Array
    negative: MapEnds
    positive: MapEnds
    row_area_deg2: Array
    free_volume_deg3: float
    weighted_free_volume_deg3: float
    ligaments: tuple[str, ...] = ()

    _second_names = {"row": ("row_values", 0), "column": ("column_values", 1),
                     **{name: (name, 2) for name in ("start", "lower", "upper", "free_width", "intervals")}}

    def __repr__(self) -> str:
        free = int((self.free_width > 0).sum())
        return (f"MotionMap({self.vary} over {len(self.row_values)} values of {self.row} and {len(self.column_values)} of "
                f"{self.column}; {free} of {self.free_width.size} points free somewhere)")

    def _repr_html_(self) -> str:
        axes = zip((self.row, self.column), (self.row_values, self.column_values), self.units)
        said = [(name, f"{values[0]:g} to {values[-1]:g} {unit}") for name, values, unit in axes]
        return html_of(f"map of {self.vary}", [*said, ("free volume", f"{self.free_volume_deg3:.6g} deg3")] if "mm" not in self.units
                       else said)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per grid point, columns as in map.csv. Needs pandas."""
        import pandas

        row, column, vary = self.units
        columns, rows = np.meshgrid(self.column_values, self.row_values)
        return pandas.DataFrame({
            f"{self.column}_{column}": columns.ravel(), f"{self.row}_{row}": rows.ravel(),
            f"{self.vary}_lower_{vary}": self.lower.ravel(), f"{self.vary}_upper_{vary}": self.upper.ravel(),
            f"free_width_{vary}": self.free_width.ravel(), "free_at_start": self.free_at_start.ravel()})

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over the two held coordinates. Needs xarray."""
        import xarray

        dims = (f"{self.row}_{self.units[0]}", f"{self.column}_{self.units[1]}")
        return xarray.Dataset(
            {"free_at_start": (dims, self.free_at_start),
             **{f"{name}_{self.units[2]}": (dims, getattr(self, name)) for name in ("lower", "upper", "free_width")}},
            coords={dims[0]: self.row_values, dims[1]: self.column_values}, attrs={"vary": self.vary})


def map_of(found: dict[str, Any], names: tuple[str, ...], units: tuple[str, ...], start: float,
           ligaments: tuple[str, ...]) -> MotionMap:
    shape = len(found["row_values"]), len(found["column_values"])
    ends = {}
    for name in ("negative", "positive"):
        end = found[name]
        ends[name] = MapEnds(**{key: values.reshape(*shape, *values.shape[1:]) for key, values in end.items()}, units=units[2:])
    offset, low, high = found["offset"], found["low"], found["high"]
    points = np.repeat(np.arange(shape[0] * shape[1]), np.diff(offset))
    width: Array = np.zeros(shape[0] * shape[1])
    np.add.at(width, points, high - low)
    lower, upper = np.full(width.shape, math.nan), np.full(width.shape, math.nan)
    # The interval nearest to the start, the lower of two as near.
    distance = np.maximum(0, np.maximum(low, -high))
    order = np.lexsort((np.arange(len(low)), distance, points))
    first = order[np.flatnonzero(np.diff(points[order], prepend=-1))]
    lower[points[first]], upper[points[first]] = start + low[first], start + high[first]
    free = ~np.isin(ends["positive"].reason, [REASONS.index("contact_at_start"), REASONS.index("strained_at_start")])
    row, column, vary = names
    return MotionMap(row, column, vary, units, start, found["row_values"], found["column_values"], lower.reshape(shape),
                     upper.reshape(shape), width.reshape(shape), free, offset, np.column_stack([low, high]),
                     ends["negative"], ends["positive"], found["row_area_deg2"], found["free_volume_deg3"],
                     found["weighted_free_volume_deg3"], ligaments)
