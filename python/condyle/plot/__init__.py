"""Figures for papers: what Condyle finds, drawn with matplotlib.

Every function takes `ax=` and returns the axes; without `ax` it makes a figure as wide as a column of a journal, in 8
pt, with colours that stay apart for all eyes. No heading and no footer is drawn: that is the caption's work. Results
are taken as the module gives them, or as `condyle.plot.files` reads them from the folders that the command writes:

    import condyle.plot as figures
    result = figures.files.read_rom("out/demo/range_of_motion")
    ax = figures.limits(result)
    figures.save(ax, "limits.pdf")

`python3 -m condyle.plot FOLDER` draws all that is in a folder, `python3 -m condyle.plot sheet FOLDER...` a case on paper.
Needs matplotlib 3.6 or newer. What is read of files is drawn without the compiled part of Condyle, which `import condyle`
loads all the same.
"""
from __future__ import annotations

try:
    import matplotlib as _needed  # noqa: F401
except ImportError:
    raise ImportError("figures need matplotlib: install python3-matplotlib (Debian) or matplotlib") from None

from . import files, style
from .agreement import Series, agreement, many_methods
from .both_sides import both_sides
from .case_sheet import sheet
from .cohort import limit_against, limit_distributions
from .contact_sheet import contact_sheet
from .files import ReadError
from .flatten import Flattened, about_centre, on_plane
from .hip_shape import alpha_by_clock, centre_edge_by_clock, hip_shape
from .limit_bars import limits
from .map_contours import map_ends, motion_map
from .motion_curves import curve, cycles, panels, table_of
from .motion_grid import MotionGrid
from .outliers import Outlier, outliers
from .pressure_surface import pressure_map
from .rim_clock import clock_face
from .safe_zone import margins_along, safe_zone, safe_zones
from .style import DOUBLE_COLUMN_MM, SINGLE_COLUMN_MM, print_style, save, size_mm

__all__ = [
    "DOUBLE_COLUMN_MM",
    "SINGLE_COLUMN_MM",
    "Flattened",
    "MotionGrid",
    "Outlier",
    "ReadError",
    "Series",
    "about_centre",
    "agreement",
    "alpha_by_clock",
    "both_sides",
    "centre_edge_by_clock",
    "clock_face",
    "contact_sheet",
    "curve",
    "cycles",
    "files",
    "hip_shape",
    "limit_against",
    "limit_distributions",
    "limits",
    "many_methods",
    "map_ends",
    "margins_along",
    "motion_map",
    "on_plane",
    "outliers",
    "panels",
    "pressure_map",
    "print_style",
    "safe_zone",
    "safe_zones",
    "save",
    "sheet",
    "size_mm",
    "style",
    "table_of",
]
