"""What the colours mean of the pictures that `condyle resect --out` leaves of its cuts."""
from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from . import style
from .words import number

# The bands of src/io/picture/depth_bands.cpp, which drew the picture; a test holds both.
DEPTH_COLOURS = ("#ffeda0", "#fed976", "#feb24c", "#fd8d3c", "#fc4e2a", "#d5141c", "#800026")
"""From little to much."""
BAND_WIDTHS_MM = (0.25, 0.5, 1.0, 2.0)


def depth_band_mm(deepest_mm: float) -> float:
    """How deep each band is: the first width with which all colours hold the cut, else the last."""
    return next((width for width in BAND_WIDTHS_MM if deepest_mm <= width * len(DEPTH_COLOURS)), BAND_WIDTHS_MM[-1])


def depth_key(deepest_mm: float, ax: Axes) -> Axes:
    """Draws the bands of a cut this deep, with the depths at their borders; beside the last band that of the deepest place."""
    width = depth_band_mm(deepest_mm)
    bands = min(max(1, math.ceil(deepest_mm / width - 1e-9)), len(DEPTH_COLOURS))
    for i, colour in enumerate(DEPTH_COLOURS[:bands]):
        ax.add_patch(Rectangle((i, 0), 1, 1, facecolor=colour, linewidth=0, gid="band"))
    ax.set_xlim(0, bands)
    ax.set_ylim(0, 1)
    ax.set_xticks(range(bands), [number(i * width) for i in range(bands)])
    ax.text(bands + 0.1, 0.5, f"{deepest_mm:.2f}", va="center", fontsize=style.smaller(2), gid="deepest")
    ax.set_yticks([])
    ax.tick_params(axis="x", length=1.5, pad=1, labelsize=style.smaller(2))
    for spine in ax.spines.values():
        spine.set_visible(False)
    return ax
