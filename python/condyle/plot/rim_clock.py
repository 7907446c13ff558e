"""Where on the rim of the socket motions end, as a clock face."""
from __future__ import annotations

import math
import textwrap
from typing import List, Mapping, NamedTuple, Optional, Sequence

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from . import style
from .limit_bars import ENDS
from .motion_ends import RomLike, motion_ends
from .words import in_two_lines, motion_name, of, scope_clause


def clock_text(hour: float) -> str:
    """ "1:30" of 1.5: hours and minutes, 12 for the first hour."""
    minutes = math.floor(hour * 60 + 0.5) % 720
    return f"{minutes // 60 or 12}:{minutes % 60:02d}"


def spread_apart(wanted: Sequence[float], gaps: Sequence[float], low: float, high: float) -> List[float]:
    """Heights as near as possible (least squares) to those wanted, in the same order and between low and high.

    `wanted` ascends; `gaps[i]` is the least distance from the i-th to the next, one less than heights. Where there is
    no room, all gaps are made smaller alike.
    """
    if not wanted:
        return []
    total = sum(gaps)
    scale = min(1.0, (high - low) / total) if total > 0 else 1.0
    offsets = [0.0]
    for gap in gaps:
        offsets.append(offsets[-1] + gap * scale)
    # With the offsets taken off, "at least a gap apart" becomes "not descending": pooled means.
    pools: List[List[float]] = []
    for value, offset in zip(wanted, offsets):
        pools.append([value - offset, 1])
        while len(pools) > 1 and pools[-2][0] / pools[-2][1] > pools[-1][0] / pools[-1][1]:
            total_, size = pools.pop()
            pools[-1][0] += total_
            pools[-1][1] += size
    highest = max(low, high - offsets[-1])
    level = [min(max(total_ / size, low), highest) for total_, size in pools for _ in range(int(size))]
    return [base + offset for base, offset in zip(level, offsets)]


def _face(ax: Axes, plane: str) -> None:
    ax.add_patch(Circle((0, 0), 1, facecolor="#f7f7f7", edgecolor="#444444", linewidth=1))
    for hour in range(1, 13):
        x, y = _on_face(1, hour)
        ax.plot([0.94 * x, x], [0.94 * y, y], color="#444444", linewidth=0.8)
        ax.text(0.8 * x, 0.8 * y, str(hour), ha="center", va="center", fontsize=style.smaller(1.5))
    # In the plane of the rim 6 is at the notch, and 12 opposite of it.
    for hour, word in ((6, "notch"),) if plane == "rim" else ((12, "superior"), (6, "inferior")):
        ax.text(0, 0.5 * _on_face(1, hour)[1], word, ha="center", va="center", fontsize=style.smaller(2.5),
                color="#555555")
    for hour, word in ((3, "anterior"), (9, "posterior")):
        ax.text(0.42 * _on_face(1, hour)[0], 0, word, ha="center", va="center", fontsize=style.smaller(2.5),
                color="#555555", rotation=90)


def _on_face(distance: float, hour: float) -> "tuple[float, float]":
    angle = hour * math.pi / 6
    return distance * math.sin(angle), distance * math.cos(angle)


RADIUS_MM = 14.5
HEIGHT_MM = 44.0
LINE = 2.75 / RADIUS_MM
"""Height of a line of a label in radii of the face."""
HALF_HEIGHT, HALF_WIDTH = HEIGHT_MM / 2 / RADIUS_MM, style.SINGLE_COLUMN_MM / 2 / RADIUS_MM
LETTERS = 16
"""As many fit beside the face."""


class Place(NamedTuple):
    """Where a motion ends: `hour` in [0, 12), `end` a key of `ENDS`."""

    hour: float
    motion: str
    end: str


def _in_lines(place: Place, name: str) -> str:
    return "\n".join(textwrap.wrap(f"{clock_text(place.hour)} {name}", LETTERS, max_lines=3, placeholder="…"))


def _places(result: RomLike) -> List[Place]:
    return [Place(end.hour, end.name, end.end) for end in motion_ends(result) if end.hour is not None]


def _halves(places: List[Place]) -> "tuple[List[Place], List[Place]]":
    """Those of the right half of the face and those of the left one."""
    return [place for place in places if place.hour < 6], [place for place in places if place.hour >= 6]


def names_fit(result: RomLike) -> bool:
    """Whether the names of all motions stand beside the face whole and in their size."""
    halves = [[_in_lines(place, motion_name(place.motion)) for place in half] for half in _halves(_places(result))]
    return not any("…" in text for half in halves for text in half) and all(
        sum(1 + text.count("\n") for text in half) * (LINE + 0.1) <= 2 * HALF_HEIGHT for half in halves)


def _labels(ax: Axes, half: List[Place], side: int, names: Mapping[str, str]) -> None:
    """Labels of one half of the face; side 1 is the right one. Type is smaller where it would not fit."""
    half = sorted(half, key=lambda place: _on_face(1, place.hour)[1])
    texts = [_in_lines(place, names.get(place.motion) or motion_name(place.motion)) for place in half]
    lines = [1 + text.count("\n") for text in texts]
    shrunk = min(1.0, 2 * HALF_HEIGHT / (LINE * max(1, sum(lines))))
    heights = [LINE * shrunk * count for count in lines]
    gap = min(0.1, (2 * HALF_HEIGHT - sum(heights)) / max(1, len(heights) - 1))
    gaps = [(a + b) / 2 + gap for a, b in zip(heights, heights[1:])]
    outer = max(heights, default=0.0) / 2
    at = spread_apart([_on_face(1.14, place.hour)[1] for place in half], gaps, outer - HALF_HEIGHT, HALF_HEIGHT - outer)
    for place, text, y in zip(half, texts, at):
        on_rim, bend = _on_face(1, place.hour), _on_face(1.12, place.hour)
        x = 1.28 * side
        ax.plot([on_rim[0], bend[0], x], [on_rim[1], bend[1], y], color=style.GREY, linewidth=0.5, zorder=1,
                gid="leader")
        ax.text(x + 0.04 * side, y, text, ha="left" if side > 0 else "right", va="center",
                fontsize=shrunk * style.smaller(1.5), linespacing=1.05, gid="place")


def clock_face(result: RomLike, *, ax: Optional[Axes] = None, legend: bool = True, names: Optional[Mapping[str, str]] = None) -> Axes:
    """Draws where on the rim of a hip's socket its motions end.

    12 is superior and on top, 3 anterior and to the right, for right and left hips alike, so that sides compare. In the
    plane of the rim (`clock_plane` "rim") 6 is at the acetabular notch.

    Parameters
    ----------
    result
        A range of motion, as `limits` takes it; motions with a `clock_hour` in [0, 12) are drawn.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    legend
        Whether to explain the marks, if there is more than one kind.
    names
        What motions are called beside the face, by their names; without it their names in words.

    Returns
    -------
    The axes, the face at the origin with radius 1; one mark (gid `end`) per motion on its edge.
    """
    found = _places(result)
    kinds = [name for name in ENDS if any(place.end == name for place in found)]
    handles = [Line2D([], [], marker=ENDS[kind].marker, color=ENDS[kind].colour, linestyle="none",
                      label=ENDS[kind].words)
               for kind in kinds]
    if not legend or len(kinds) < 2:
        handles = []
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, HEIGHT_MM + style.rows_below(len(handles))) as ax:
        ax.set_axis_off()
        ax.set_aspect("equal")
        ax.set_ylim(-HALF_HEIGHT, HALF_HEIGHT)
        ax.set_xlim(-HALF_WIDTH, HALF_WIDTH)
        _face(ax, of(result, "clock_plane", "sagittal"))
        for half, side in zip(_halves(found), (1, -1)):
            _labels(ax, half, side, names or {})
        for place in found:
            end = ENDS[place.end]
            ax.plot(*([v] for v in _on_face(1, place.hour)), marker=end.marker, color=end.colour,
                    markeredgecolor="white", markeredgewidth=0.6, markersize=5.5, linestyle="none", zorder=3, gid="end")
        ax.text(0, -HALF_HEIGHT, in_two_lines(scope_clause(result), 30), ha="center", va="bottom",
                fontsize=style.smaller(2.5), color="#555555", linespacing=1.05, gid="scope")
        if not found:
            ax.text(0, 0, "no contact", ha="center", va="center", gid="none")
        style.legend_below(ax, is_ours, handles)
    return ax
