"""How far one mesh turns about an axis before it meets another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._limits import Limit, limit_of
from ._mesh import MeshLike, TriMesh
from ._words import number


@dataclass(frozen=True)
class RotationLimits:
    """Both ends of a free rotation; where the bodies are in contact at the start, both say so."""

    negative: Limit
    positive: Limit

    @property
    def free_at_start(self) -> bool:
        return self.positive.reason != "contact_at_start"


class FirstContact:
    """Two bodies made ready for rotations of the mobile one about one axis that stays in the fixed one.

    `point` (3,), mm, and `direction` (3,), of any length but zero, are in the frame of the fixed body. Limits are
    exact: never past a contact, short of one by at most `error_bound_deg`. Any number of threads may ask. UsageError
    for an axis without direction.

    C++: `condyle::FirstContact` in condyle/first_contact.hpp.

    >>> import condyle
    >>> tetrahedron = condyle.TriMesh([[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1]],
    ...                               [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> opposite = condyle.TriMesh(tetrahedron.vertices * [-1, -1, 1], tetrahedron.triangles)
    >>> limits = condyle.FirstContact(tetrahedron, opposite, [0, 0, 0], [0, 0, 1]).limits()
    >>> limits.negative, limits.positive
    (Limit(135 deg, contact), Limit(135 deg, contact))
    """

    __slots__ = ("_native", "_fixed", "_mobile", "__weakref__")

    def __init__(self, fixed: MeshLike, mobile: MeshLike, point: ArrayLike, direction: ArrayLike) -> None:
        self._fixed, self._mobile = TriMesh.of(fixed), TriMesh.of(mobile)
        self._native = _native.FirstContact(self._fixed._native, self._mobile._native, point, direction)

    def limits(self, pose: ArrayLike = np.eye(4), *, negative_deg: float = -360, positive_deg: float = 360
               ) -> RotationLimits:
        """Both limits from the pose X_FM (4, 4), the identity if not given, at most a full turn either way."""
        found = self._native.limits(pose, number(negative_deg, "negative_deg", -360, 0),
                                    number(positive_deg, "positive_deg", 0, 360))
        return RotationLimits(*map(self._limit_of, found))

    def _limit_of(self, found: dict[str, Any]) -> Limit:
        return limit_of(found, self._fixed, self._mobile)

    def __repr__(self) -> str:
        return f"FirstContact(fixed={self._fixed!r}, mobile={self._mobile!r})"
