"""How far limits move with what is uncertain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ._answer import html_of
from ._motion import Motion
from ._record import columns_of

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True)
class LimitBand:
    """The spread of one motion's limit, degrees: 5, 50 and 95 % of the varied joints.

    `text` quotes it: "88–>120" where 5 % reach the end of the motion's range. `width_from_…_deg` are widths where only one source is uncertain; shares are 0 to 1.
    """

    motion: Motion
    p5_deg: float
    median_deg: float
    p95_deg: float
    text: str
    width_from_centre_deg: float
    width_from_axes_deg: float
    width_from_surface_deg: float
    share_without_contact: float
    share_in_contact_at_start: float
    width_from_parameters_deg: float = 0


class LimitBands(tuple[LimitBand, ...]):
    """The bands of :meth:`RangeOfMotion.bands`, one for each motion."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        return html_of("5 to 95 % of the limits (deg)", [
            (band.motion.name, f"{band.text}, median {band.median_deg:.1f}") for band in self])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row per motion. Needs pandas."""
        import pandas

        return pandas.DataFrame(list(map(columns_of, self)))
