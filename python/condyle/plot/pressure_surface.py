"""Pressure on a bearing surface laid flat."""
from __future__ import annotations

from typing import Any, Literal, Optional, Tuple, get_args

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from numpy.typing import ArrayLike, NDArray

from .._errors import UsageError
from . import flatten, style
from .words import spaced

Array = NDArray[np.float64]
Projection = Literal["plane", "sphere"]
PROJECTIONS: Tuple[Projection, ...] = get_args(Projection)
UNITS = {"mpa": "MPa", "mm": "mm", "mm2": "mm²", "deg": "°"}
TOWARDS = (("anterior", "posterior"), ("superior", "inferior"), ("right", "left"))


def _towards(direction: Array, side: Optional[str]) -> str:
    """The anatomical word nearest to a direction of the joint frame."""
    axis = int(np.argmax(np.abs(direction)))
    word = TOWARDS[axis][0 if direction[axis] > 0 else 1]
    if axis == 2 and side in ("right", "left"):
        return "lateral" if word == side else "medial"
    return word


def quantity_label(name: str) -> str:
    """ "pressure (MPa)" of `pressure_mpa`."""
    words, _, unit = name.rpartition("_")
    return f"{spaced(words)} ({UNITS[unit]})" if unit in UNITS else spaced(name)


def laid_flat(projection: Projection, vertices: Array, triangles: NDArray[np.int64], weights: Array,
              centre: ArrayLike = (0, 0, 0), up: Optional[ArrayLike] = None) -> flatten.Flattened:
    """A surface by the name of its projection, `"plane"` or `"sphere"`."""
    if projection == "plane":
        return flatten.on_plane(vertices, triangles, weights, up)
    if projection == "sphere":
        return flatten.about_centre(vertices, triangles, weights, centre, up)
    raise UsageError(f"projection '{projection}': there are {' and '.join(PROJECTIONS)}")


def pressure_map(vertices: ArrayLike, triangles: ArrayLike, values: ArrayLike, *, ax: Optional[Axes] = None,
                 projection: Projection = "plane", centre: ArrayLike = (0, 0, 0), up: Optional[ArrayLike] = None,
                 highest: Optional[float] = None, label: str = "pressure (MPa)", side: Optional[str] = None,
                 colour_bar: bool = True, flattened: Optional[flatten.Flattened] = None) -> Axes:
    """Draws a value per triangle of a curved surface on paper, as its partner sees it; grey where the value is 0.

    Parameters
    ----------
    vertices, triangles, values
        (V, 3) in mm, (T, 3), and (T,) of at least 0: what `files.read_surface` gives of a map of `condyle motion
        --maps`.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    projection
        `"plane"`: orthographic along the mean normal of what is in contact (of all, where nothing is). `"sphere"`:
        azimuthal equidistant about `centre`, for heads and sockets: lengths through the middle are true on the sphere
        of the mean radius.
    centre
        Centre of the sphere, mm; the joint centre is the origin of the joint frame.
    up
        The direction that points up on paper: superior, or anterior for surfaces that face up or down.
    highest
        The end of the scale, for maps that are to be compared; otherwise the largest value.
    label
        Title of the scale, with its unit.
    side
        `"right"` or `"left"`, of a joint whose mesh is in the joint frame: axes then show their directions.
    flattened
        A surface laid flat before, for the same triangles in another pose.

    Returns
    -------
    The axes, in mm; the triangles in contact have the gid `in_contact`, the grey ones `surface`. `Axes.get_title` is
    left to you.
    """
    points = np.asarray(vertices, dtype=np.float64)
    corners = np.asarray(triangles, dtype=np.int64)
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.shape != (len(corners),):
        raise UsageError(f"values: {numbers.shape} numbers for {len(corners)} triangles")
    in_contact = numbers > 0
    weights = np.where(in_contact, 1.0, 0.0) if in_contact.any() else np.ones(len(corners))
    flat = flattened or laid_flat(projection, points, corners, weights, centre, up)
    top = highest if highest is not None else float(numbers.max(initial=0)) or 1.0
    paper = flat.points_mm[corners]
    shown = paper[flat.facing | in_contact].reshape(-1, 2)
    width, height = np.ptp(shown, axis=0)
    room_mm = style.SINGLE_COLUMN_MM - (33 if colour_bar else 15)
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 14 + room_mm * min(height / width, 2.0)) as ax:
        ax.add_collection(PolyCollection(paper[flat.facing & ~in_contact], facecolor="#d9d9d9", edgecolor="#d9d9d9",
                                         linewidth=0.2, rasterized=True, gid="surface"))
        scale = matplotlib.colors.Normalize(0, top)
        drawn = PolyCollection(paper[in_contact], array=numbers[in_contact], cmap=style.SEQUENTIAL, norm=scale,
                               edgecolor="face", linewidth=0.2, rasterized=True, gid="in_contact")
        ax.add_collection(drawn)
        ax.set_aspect("equal")
        ax.update_datalim(shown)
        ax.autoscale_view()
        ax.set_xlabel(_axis(flat.right, side, "right"))
        ax.set_ylabel(_axis(flat.up, side, "up"))
        if colour_bar:
            add_scale(ax, top, label)
    return ax


def _axis(direction: Array, side: Optional[str], otherwise: str) -> str:
    return f"{_towards(direction, side) if side else otherwise} → (mm)"


def add_scale(ax: Any, highest: float, label: str) -> None:
    """A colour bar beside one or several axes with maps up to `highest`."""
    colours = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, highest), style.SEQUENTIAL)
    figure = np.atleast_1d(ax).flat[0].figure
    bar = figure.colorbar(colours, ax=ax, pad=0.02, aspect=26)
    bar.outline.set_linewidth(0.6)
    bar.set_label(label)
