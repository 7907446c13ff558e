"""A map of combined motion as arrays."""
from __future__ import annotations

from typing import NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class MotionGrid(NamedTuple):
    """Which values of one angle, or of one translation, are free over a grid of two other coordinates.

    Arrays over the grid are (rows, columns). An angle is named by its two movements, the positive one first.
    `lower_deg` and `upper_deg` are the ends of the free interval that holds the start, else of the one nearest to it;
    NaN where nothing is free.
    """

    column: Tuple[str, str]
    """Movements of the held angle along columns: ("flexion", "extension")."""
    row: Tuple[str, str]
    """Movements of the held angle along rows."""
    varied: Tuple[str, str]
    """Movements of the angle that varies."""
    columns_deg: Array
    """Values of the columns, ascending, (columns,)."""
    rows_deg: Array
    """Values of the rows, ascending, (rows,)."""
    start_deg: float
    """Value of the varied angle from which limits are counted."""
    lower_deg: Array
    upper_deg: Array
    lower_open: Mask
    """Where the lower end is that of the range: no contact."""
    upper_open: Mask
    free_at_start: Mask
    """Whether the start is free."""
    intervals: NDArray[np.int64]
    """How many free intervals there are; 0 where nothing is free."""
    lower_ligament: Optional[NDArray[np.str_]] = None
    """The ligament that makes the lower end, "" where none does; None of a joint without ligaments."""
    upper_ligament: Optional[NDArray[np.str_]] = None
    units: Tuple[str, str, str] = ("deg", "deg", "deg")
    """Of columns, rows and the varied coordinate; "mm" of a translation, whatever the names above say."""
