"""Poses as people give them: one or many."""

from __future__ import annotations

from typing import Mapping, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

#: One pose X_FM, (4, 4), and many, (N, 4, 4). A type checker does not know the shape of most arrays, and takes them for one
#: pose: annotate those of many with `Poses`.
Pose = np.ndarray[tuple[int, int], np.dtype[np.float64]]
Poses = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]

ManyNumbers = Union[np.ndarray[tuple[int], np.dtype[np.generic]], Sequence[float]]

#: What is taken for one pose, a matrix or a mapping of what :meth:`Joint.pose` takes; and for many.
OnePoseLike = Union[np.ndarray[tuple[int, int], np.dtype[np.generic]], Sequence[Sequence[float]], Mapping[str, float]]
ManyPosesLike = Union[np.ndarray[tuple[int, int, int], np.dtype[np.generic]], Sequence[Pose],
                      Sequence[Sequence[Sequence[float]]], Mapping[str, ManyNumbers]]
PoseLike = Union[ArrayLike, Mapping[str, float], Mapping[str, ArrayLike]]
