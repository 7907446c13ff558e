"""How far limits move with what is uncertain."""

from __future__ import annotations

from dataclasses import dataclass

from ._motion import Motion


@dataclass(frozen=True)
class LimitBand:
    """The spread of one motion's limit, degrees: 5, 50 and 95 % of the displaced joints.

    `width_from_…_deg` are widths where only one source is uncertain; shares are 0 to 1.
    """

    motion: Motion
    p5_deg: float
    median_deg: float
    p95_deg: float
    width_from_centre_deg: float
    width_from_axes_deg: float
    width_from_surface_deg: float
    share_without_contact: float
    share_in_contact_at_start: float
    width_from_parameters_deg: float = 0
