"""The range of motion over two held angles, as a map with contours."""
from __future__ import annotations

import math
from typing import Any, Iterator, List, Literal, Mapping, Optional, Sequence, Tuple, Union, get_args

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import FuncFormatter, MaxNLocator, MultipleLocator
from numpy.typing import NDArray

from .._errors import UsageError
from .._motion_map import MotionMap
from . import style
from .motion_grid import MotionGrid
from .words import OPPOSITE, SYMBOLS, angle_axis, in_two_lines, number, of, scope_clause, spaced, step_of_ticks

Array = NDArray[np.float64]
MapLike = Union[MotionMap, MotionGrid, Mapping[str, object]]
View = Literal["positive", "negative", "free_range"]
VIEWS: Tuple[View, ...] = get_args(View)
"""Drawable quantities of a map: how far it turns in the positive sense, in the negative sense, and both together."""

#           gid              hatch   colour            words
HATCHES = {
    "nowhere": ("////", "#8c8c8c", "free nowhere"),
    "not_at_start": ("\\\\\\\\", style.VERMILION, "not free at the start"),
    "islands": ("....", style.BLACK, "free again beyond contact"),
    "open": ("||||", "white", "no contact in the range"),
}
MOST_LEVELS = 12


def grid_of(result: MapLike) -> MotionGrid:
    """The map of a result: itself, its `grid`, or a `condyle.MotionMap` as a grid."""
    if isinstance(result, MotionGrid):
        return result
    grid = of(result, "grid")
    if isinstance(grid, MotionGrid):
        return grid
    if isinstance(result, MotionMap) or all(hasattr(result, name) for name in ("column_deg", "row_deg", "free_at_start", "positive")):
        return _of_motion_map(result)
    raise UsageError("no map of combined motion in this result")


def _of_motion_map(result: Any) -> MotionGrid:
    """Where the start is not free, ends of the range and contact are not distinguished."""
    column, row, varied = ((name, OPPOSITE.get(name, f"negative_{name}"))
                           for name in (result.column, result.row, result.vary))
    row_unit, column_unit, unit = getattr(result, "units", ("deg", "deg", "deg"))
    columns, rows, start, low, high = (np.asarray(getattr(result, f"{name}_{of}")) for name, of in (
        ("column", column_unit), ("row", row_unit), ("start", unit), ("lower", unit), ("upper", unit)))
    end_of_range = 1  # condyle.REASONS
    free = np.asarray(result.free_at_start)
    count = np.diff(np.asarray(result.offset)).reshape(free.shape)
    names = np.array(("", *result.ligaments))
    lower, upper = (np.where(free, names[np.asarray(end.ligament) + 1], "")
                    for end in (result.negative, result.positive))
    return MotionGrid(column, row, varied, columns, rows, float(start), low, high,
                      (np.asarray(result.negative.reason) == end_of_range) & free,
                      (np.asarray(result.positive.reason) == end_of_range) & free, free, count, lower, upper,
                      (column_unit, row_unit, unit))


def values_of(grid: MotionGrid, view: str) -> Array:
    """Degrees or mm from the start, (rows, columns); below 0 where the interval drawn does not reach the start, NaN where
    none is.
    """
    if view == "positive":
        return grid.upper_deg - grid.start_deg
    if view == "negative":
        return grid.start_deg - grid.lower_deg
    if view == "free_range":
        return grid.upper_deg - grid.lower_deg
    raise UsageError(f"view '{view}': there are positive, negative and free_range")


def quantity_of(grid: MotionGrid, view: str) -> str:
    """ "limit of internal rotation", or "free range of internal and external rotation"."""
    positive, negative = (spaced(name) for name in grid.varied)
    if view != "free_range":
        return f"limit of {positive if view == 'positive' else negative}"
    if grid.units[2] == "mm":
        return f"free range of {positive}"
    first, last = positive.split(" "), negative.split(" ")
    if len(first) > 1 and first[1:] == last[1:]:
        return f"free range of {first[0]} and {negative}"
    return f"free range of {positive} and {negative}"


def _levels(values: Array, unit: str) -> Array:
    """Multiples of a round step, from below the lowest value to above the highest; no step below a degree."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if unit == "mm":
        return np.asarray(MaxNLocator(MOST_LEVELS, steps=[1, 2, 5, 10]).tick_values(low, high))
    step = step_of_ticks(max(high - low, 1.0), MOST_LEVELS)
    first = math.floor(low / step)
    last = max(math.ceil(high / step), first + 1)
    return np.arange(first, last + 1, dtype=np.float64) * step


def _borders(values: Array) -> Array:
    """Half way between neighbours, and the outer values themselves."""
    return np.concatenate((values[:1], (values[1:] + values[:-1]) / 2, values[-1:]))


def _cells(grid: MotionGrid, marked: NDArray[np.bool_]) -> Iterator[Rectangle]:
    """Around the marked points, neighbours in a row at once."""
    across, up = _borders(grid.columns_deg), _borders(grid.rows_deg)
    for row in range(len(grid.rows_deg)):
        edges = np.flatnonzero(np.diff(np.concatenate(([0], marked[row].astype(np.int8), [0]))))
        for first, last in edges.reshape(-1, 2):
            yield Rectangle((across[first], up[row]), across[last] - across[first], up[row + 1] - up[row])


def _hatch(ax: Axes, grid: MotionGrid, marked: NDArray[np.bool_], name: str) -> None:
    pattern, colour, _ = HATCHES[name]
    cells = PatchCollection(list(_cells(grid, marked)), facecolor="none", edgecolor=colour, linewidth=0, hatch=pattern,
                            zorder=1.5, gid=name)
    ax.add_collection(cells)


def _marks(grid: MotionGrid, view: str) -> List[Tuple[str, NDArray[np.bool_]]]:
    """Hatched regions and their cells; only those that exist."""
    is_open = {"positive": grid.upper_open, "negative": grid.lower_open,
               "free_range": grid.upper_open | grid.lower_open}[view]
    somewhere = grid.intervals > 0
    marks = [
        ("nowhere", ~somewhere),
        ("not_at_start", somewhere & ~grid.free_at_start),
        ("islands", grid.intervals > 1),
        ("open", somewhere & is_open),
    ]
    return [(name, marked) for name, marked in marks if marked.any()]


def _handles(grid: MotionGrid, names: Sequence[str], ground: Optional[str] = None) -> List[Patch]:
    """Meaning of the hatchings, for the legend; on this ground where it is not that of a contour."""
    has_ligaments = bool(ligaments_of(grid))
    handles = []
    for name in names:
        pattern, colour, words = HATCHES[name]
        if name == "islands" and has_ligaments:
            words = "free again beyond that end"
        colours = matplotlib.colormaps[style.SEQUENTIAL]
        below = style.LIGHT_GREY if name == "nowhere" else ground or colours(0.45 if name == "open" else 0.75)
        handles.append(Patch(facecolor=below, edgecolor=colour, hatch=pattern, linewidth=0, label=words))
    return handles


MOST_TICKS = 7


def _angle_ticks(axis: Any, values: Array) -> None:
    """Ticks at values of the grid, true minus signs."""
    step = (values[-1] - values[0]) / max(len(values) - 1, 1) or 1.0
    steps = next(n for n in (1, 2, 3, 4, 5, 6, 9, 10, 18, 20, 45, 50, 90, 100, 10**9)
                 if n * MOST_TICKS >= len(values) - 1)
    axis.set_major_locator(MultipleLocator(step * steps))
    axis.set_major_formatter(FuncFormatter(lambda value, _: number(round(value, 6))))


def motion_map(result: MapLike, view: View = "positive", *, ax: Optional[Axes] = None,
               levels: Optional[Sequence[float]] = None, colour_bar: bool = True, legend: bool = True) -> Axes:
    """Draws how far one angle turns, or one translation goes, over two held coordinates, as filled contours with labels.

    Points between those of the grid are interpolated linearly. Drawn is the free interval that holds the start, else
    the one nearest to it: its end is then on the other side of the start, and the limit below zero.

    Parameters
    ----------
    result
        A `condyle.MotionMap`, what `files.read_rom` gives of a folder with a map, or a `MotionGrid`.
    view
        `"positive"` or `"negative"`: how far from the start it turns in that sense; `"free_range"`: both together.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    levels
        Contours in degrees or mm, ascending, for maps that are to be compared; otherwise round ones that hold all values.
    colour_bar, legend
        The scale at the right; what the hatchings mean, below.

    Returns
    -------
    The axes. Cells around points are hatched, by gid: `nowhere` free, free but `not_at_start`, with other free
    intervals (`islands`), free up to the end of the range (`open`). A map of one row or one column has no area and is
    drawn as a curve.
    """
    grid = grid_of(result)
    values = values_of(grid, view)
    if np.isnan(values).all():
        raise UsageError("nothing to draw: no point of the map is free")
    if min(values.shape) < 2:
        return _curve(grid, values, view, ax)
    chosen = _levels(values, grid.units[2]) if levels is None else np.asarray(levels, dtype=np.float64)
    marks = _marks(grid, view)
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 68 + style.rows_below(len(marks))) as ax:
        ax.set_facecolor(style.LIGHT_GREY)
        ax.set_xlim(grid.columns_deg[0], grid.columns_deg[-1])
        ax.set_ylim(grid.rows_deg[0], grid.rows_deg[-1])
        filled = ax.contourf(grid.columns_deg, grid.rows_deg, values, levels=chosen, cmap=style.SEQUENTIAL, zorder=1,
                             extend="neither" if levels is None else "both")
        lines = ax.contour(grid.columns_deg, grid.rows_deg, values, levels=chosen, colors="black", linewidths=0.5,
                           zorder=2)
        for name, marked in marks:
            _hatch(ax, grid, marked, name)
        labels = ax.clabel(lines, fmt=lambda level: number(level), fontsize=style.smaller(1), inline=False)
        style.tidy(ax, labels)
        for side in ("top", "right"):
            ax.spines[side].set_visible(True)
        _angle_ticks(ax.xaxis, grid.columns_deg)
        _angle_ticks(ax.yaxis, grid.rows_deg)
        ax.set_xlabel("\n".join(filter(None, (angle_axis(*grid.column, *ax.get_xlim(), symbol=SYMBOLS[grid.units[0]]), scope_clause(result)))))
        ax.set_ylabel(angle_axis(*grid.row, *ax.get_ylim(), symbol=SYMBOLS[grid.units[1]]))
        if colour_bar:
            bar = ax.figure.colorbar(filled, ax=ax, pad=0.02, aspect=28)
            bar.outline.set_linewidth(0.6)
            bar.formatter = FuncFormatter(lambda value, _: number(value))
            bar.update_ticks()
            bar.set_label(in_two_lines(f"{quantity_of(grid, view)} ({SYMBOLS[grid.units[2]]})", 40))
        if legend:
            style.legend_below(ax, is_ours, _handles(grid, [name for name, _ in marks]))
    return ax


END_COLOURS = tuple(style.tinted(colour) for colour in (style.BLUE, style.VERMILION, style.GREEN, style.ORANGE,
                                                       style.PURPLE, style.SKY_BLUE, style.YELLOW))
"""Of ligaments, by how many points they end; more of them have these again, hatched."""
END_HATCHES = ("", "....", "xxxx", "oooo", "----")


def ligaments_of(grid: MotionGrid, side: Optional[str] = None) -> List[str]:
    """Ligaments that end the motion somewhere on the map, to one side or to either: first who ends most points."""
    if side not in ("positive", "negative", None):
        raise UsageError(f"side '{side}': there are positive and negative")
    sides = [names for name, names in (("positive", grid.upper_ligament), ("negative", grid.lower_ligament))
             if side in (name, None) and names is not None]
    all_names = np.concatenate([np.empty(0, dtype="<U1"), *(names[names != ""] for names in sides)])
    found, count = np.unique(all_names, return_counts=True)
    return [str(name) for _, name in sorted(zip(-count, found))]


def _look_of(place: int) -> Tuple[str, str]:
    """Colour and hatch of a ligament by its place among all of the map, so that both sides have the same."""
    return END_COLOURS[place % len(END_COLOURS)], END_HATCHES[place // len(END_COLOURS) % len(END_HATCHES)]


def map_ends(result: MapLike, side: Literal["positive", "negative"] = "positive", *, ax: Optional[Axes] = None,
             legend: bool = True) -> Axes:
    """Draws what ends the motion in one sense over two held angles: ligaments in a colour each, contact in grey.

    Parameters
    ----------
    result
        As :func:`motion_map` takes it; two columns and two rows at least.
    side
        `"positive"` or `"negative"`: the sense of the varied angle.
    ax, legend
        As of :func:`motion_map`.

    Returns
    -------
    The axes. Cells lie around the points of the map, by gid `ligament NAME`, `contact` and `end_of_range`; hatched ones
    have the gids of :func:`motion_map`. Lines are contours of the limit, from the start.
    """
    grid = grid_of(result)
    values = values_of(grid, side)
    if np.isnan(values).all():
        raise UsageError("nothing to draw: no point of the map is free")
    if min(values.shape) < 2:
        raise UsageError("a map of one row or one column has no area: motion_map draws it")
    ligaments = ligaments_of(grid, side)
    places = {name: i for i, name in enumerate(ligaments_of(grid))}
    found, is_open = ((grid.upper_ligament, grid.upper_open) if side == "positive" else
                      (grid.lower_ligament, grid.lower_open))
    names = np.full(values.shape, "") if found is None else found
    by_ligament = np.not_equal(names, "")
    somewhere = grid.intervals > 0
    #        gid, words, colour, hatch, cells
    ends = [(f"ligament {name}", name, *_look_of(places[name]), np.equal(names, name)) for name in ligaments]
    ends += [("contact", "contact", style.tinted(style.GREY), "", somewhere & ~by_ligament & ~is_open),
             ("end_of_range", "end of the range", "white", "", somewhere & is_open)]
    ends = [end for end in ends if end[-1].any()]
    marks = [(name, marked) for name, marked in _marks(grid, side) if name != "open"]
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 68 + style.rows_below(len(ends) + len(marks))) as ax:
        ax.set_facecolor(style.LIGHT_GREY)
        ax.set_xlim(grid.columns_deg[0], grid.columns_deg[-1])
        ax.set_ylim(grid.rows_deg[0], grid.rows_deg[-1])
        for gid, _, colour, hatch, cells in ends:
            ax.add_collection(PatchCollection(list(_cells(grid, cells)), facecolor=colour, linewidth=0,
                                              edgecolor="black" if hatch else "none", hatch=hatch or None, zorder=1,
                                              gid=gid))
        for name, marked in marks:
            _hatch(ax, grid, marked, name)
        lines = ax.contour(grid.columns_deg, grid.rows_deg, values, levels=_levels(values, grid.units[2]), colors="black",
                           linewidths=0.5, zorder=2)
        style.tidy(ax, ax.clabel(lines, fmt=lambda level: number(level), fontsize=style.smaller(1), inline=False))
        for edge in ("top", "right"):
            ax.spines[edge].set_visible(True)
        _angle_ticks(ax.xaxis, grid.columns_deg)
        _angle_ticks(ax.yaxis, grid.rows_deg)
        ax.set_xlabel("\n".join(filter(None, (angle_axis(*grid.column, *ax.get_xlim(), symbol=SYMBOLS[grid.units[0]]), scope_clause(result)))))
        ax.set_ylabel(angle_axis(*grid.row, *ax.get_ylim(), symbol=SYMBOLS[grid.units[1]]))
        movement = spaced(grid.varied[side == "negative"])
        ax.text(1.02, 0.5, in_two_lines(f"what ends {movement}; lines: after how far ({SYMBOLS[grid.units[2]]})", 40), transform=ax.transAxes,
                rotation=90, va="center", ha="left", multialignment="center")
        if legend:
            style.legend_below(ax, is_ours, [
                Patch(facecolor=colour, edgecolor="black", hatch=hatch or None, linewidth=0.4, label=words)
                for _, words, colour, hatch, _ in ends] + _handles(grid, [name for name, _ in marks], "white"))
    return ax


def _curve(grid: MotionGrid, values: Array, view: str, ax: Optional[Axes]) -> Axes:
    """Along one held angle: broken where nothing is free, hollow where the range ends without contact."""
    along_columns = len(grid.rows_deg) == 1
    held = grid.columns_deg if along_columns else grid.rows_deg
    flat = values.ravel()
    marks = dict(_marks(grid, view))
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 60) as ax:
        ax.plot(held, flat, marker="o", color=style.BLUE, gid="limit")
        if "open" in marks:
            at = marks["open"].ravel()
            ax.plot(held[at], flat[at], marker="o", linestyle="none", markerfacecolor="white",
                    markeredgecolor=style.BLUE, label=HATCHES["open"][2], gid="open")
        if "not_at_start" in marks:
            at = marks["not_at_start"].ravel()
            ax.plot(held[at], flat[at], marker="s", linestyle="none", color=style.VERMILION,
                    label=HATCHES["not_at_start"][2], gid="not_at_start")
        if "nowhere" in marks:
            at = marks["nowhere"].ravel()
            ax.plot(held[at], np.zeros(at.sum()), marker="X", linestyle="none", color=style.VERMILION, clip_on=False,
                    transform=ax.get_xaxis_transform(), label=HATCHES["nowhere"][2], gid="nowhere")
        _angle_ticks(ax.xaxis, held)
        ax.grid(axis="y")
        ax.set_xlabel(angle_axis(*(grid.column if along_columns else grid.row), float(held[0]), float(held[-1]),
                                 symbol=SYMBOLS[grid.units[0 if along_columns else 1]]))
        ax.set_ylabel(f"{quantity_of(grid, view)} ({SYMBOLS[grid.units[2]]})")
        if set(marks) - {"islands"}:
            ax.legend()
    return ax
