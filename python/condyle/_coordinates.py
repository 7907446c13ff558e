"""A joint's coordinates by their names."""

from __future__ import annotations

from typing import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import UsageError, unknown
from ._words import refuse_masked

AngleNames = Sequence[tuple[str, str]]


def position_in(given: Mapping[str, ArrayLike], names: AngleNames, what: str, *, is_free: bool
                ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(3,) degrees and (3,) translation of one number for each of the angle names, of a free joint x, y and z too."""
    angles, translations = _table(given, names, what, "", "", is_free, "a number", 0)
    return angles[0], translations[0]


def positions_in(given: Mapping[str, ArrayLike], names: AngleNames, what: str, *, is_free: bool
                 ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(N, 3) degrees and (N, 3) mm of coordinates by their names with `_deg` and `_mm`; scalars stand for all N."""
    return _table(given, names, what, "_deg", "_mm", is_free, "a number or an array of shape (N,)", 1)


def _table(given: Mapping[str, ArrayLike], names: AngleNames, what: str, of_angles: str, of_lengths: str, is_free: bool,
           wanted: str, most_dimensions: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    known = {word + of_angles: (i, sign) for i, pair in enumerate(names) for word, sign in zip(pair, (1.0, -1.0))}
    if is_free:
        known.update({axis + of_lengths: (3 + i, 1.0) for i, axis in enumerate("xyz")})
    if not isinstance(given, Mapping):
        raise UsageError(f"{what}: coordinates by their names are needed, not {type(given).__name__}")
    columns: dict[int, NDArray[np.float64]] = {}
    for name, value in given.items():
        if name not in known:
            raise unknown(what, name, known)
        column, sign = known[name]
        refuse_masked(value, f"{what}: {name}")
        try:
            values = np.asarray(value)
            if values.dtype.kind not in "fiu" or values.ndim > most_dimensions:
                raise TypeError
        except (TypeError, ValueError):
            raise UsageError(f"{what}: {name} is {wanted}") from None
        if column in columns:
            raise UsageError(f"{what}: {names[column][0]} is given twice" if column < 3 else f"{what}: twice")
        if not np.isfinite(values).all():
            raise UsageError(f"{what}: {name} must be finite")
        columns[column] = sign * values.astype(float) + 0.0
    sizes = {column.shape for column in columns.values()} - {()}
    if len(sizes) > 1:
        lengths = ", ".join(str(size[0]) for size in sorted(sizes))
        raise UsageError(f"{what}: coordinates of different lengths: {lengths}")
    table = np.zeros((6, sizes.pop()[0] if sizes else 1))
    for i, values in columns.items():
        table[i] = values
    return table[:3].T, table[3:].T
