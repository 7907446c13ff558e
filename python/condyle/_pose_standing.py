"""How a pose stands to the limits of its joint."""

from __future__ import annotations

from typing import Optional

from ._record import Record


class NearestLimit(Record):
    """The end of a motion that is nearest to a pose: `movement` is the angle that turns there alone and its sense ("internal_rotation"),
    `to_limit_deg` by how much, `reason` what ends it, "contact" or "ligament"."""

    movement: str
    to_limit_deg: float
    reason: str


class PoseStanding(Record):
    """How a pose stands to the limits of its joint, by the rule of every command and of the page.

    `state` is "free", "at_limit" (one angle is within 0.05 degrees of an end), "bearing" (contact that ends no motion), "impinging", "strained"
    (past the end of a ligament), or "contact" where nothing distinguishes bearing contact, `state_unknown_why`. `nearest_limit` is None beyond an
    end and if none is within half a turn. `clearance_mm` is the smallest distance of surfaces whose contact ends a motion, 0 if they meet.

    C++: `condyle::pose_standing` in condyle/answer/case.hpp.
    """

    state: str
    state_unknown_why: Optional[str]
    nearest_limit: Optional[NearestLimit]
    clearance_mm: Optional[float]

    @property
    def to_limit_deg(self) -> float:
        """Degrees to the nearest limit, 0 beyond one; NaN if none is within half a turn."""
        if self.nearest_limit is not None:
            return self.nearest_limit.to_limit_deg
        return float("nan") if self.state in ("free", "bearing") else 0.0
