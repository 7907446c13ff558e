"""How far each motion of both sides turns, as pairs of bars."""
from __future__ import annotations

from typing import Dict, List, Optional

from matplotlib.axes import Axes

from . import style
from .limit_bars import bar, degrees_axis, ends_of, handles_of, marked_name, normal_range, value_text
from .motion_ends import MotionEnd, RomLike
from .words import MINUS, in_two_lines, of, scope_clause

APART, PITCH = 0.85, 2.0
"""From a left bar to the right one below it, and from one motion to the next, in heights of a row of `limits`."""
_TOP = -0.7
_VALUES, _DIFFERENCES = 1.0, 11.0
"""Where the columns of figures begin, right of the axes, in heights of their type."""
_HAS_NO_LIMIT = ("end_of_range", "translation_ends")


def difference_text(left: Optional[MotionEnd], right: Optional[MotionEnd]) -> str:
    """How much further the left side turns, "+5.3°"; ">+5.3°" or "<−5.3°" if one of the sides ends without contact. A dash if that has no bound:
    one side lacks the motion, both end without contact, or the cut of an image ends one."""
    if left is None or right is None or "cut" in (left.end, right.end):
        return "–"
    left_is_open, right_is_open = left.end in _HAS_NO_LIMIT, right.end in _HAS_NO_LIMIT
    if left_is_open and right_is_open:
        return "–"
    turned = round(left.turned_deg - right.turned_deg, 1)
    text = f"{turned:+.1f}°".replace("-", MINUS) if turned else "0.0°"
    return ">" * left_is_open + "<" * right_is_open + text


def _scope(left: RomLike, right: RomLike) -> str:
    """Once if both sides have the same."""
    clauses = {"left": scope_clause(left), "right": scope_clause(right)}
    if clauses["left"] == clauses["right"]:
        return clauses["left"]
    return "\n".join(f"{side}: {clause}" for side, clause in clauses.items() if clause)


def both_sides(left: RomLike, right: RomLike, *, ax: Optional[Axes] = None) -> Axes:
    """Draws the limits of both sides of a patient below each other, motion by motion, as `limits` draws those of one.

    Parameters
    ----------
    left, right
        The ranges of motion of both sides, each as `limits` takes it. Motions are matched by their names: those of the left side come first, in
        their order, then those that only the right side has. A motion that one side lacks has one bar.
    ax
        Where to draw; without it new axes as wide as a page, under `print_style`.

    Returns
    -------
    The axes: bars (gid `limit`), filled for the left side and hollow for the right one, with the marks and bands of `limits`. A clinical range
    that both have stands behind both. At the right are the limits (gid `value`), and how much further the left side turns (gid `difference`): a
    bound, with ">" or "<", if one side ends without contact in its range; a dash if both do, if the cut of an image ends one, or if one side
    lacks the motion.
    """
    sides: List[Dict[str, MotionEnd]] = [{end.name: end for end in ends_of(result)} for result in (left, right)]
    names = list(dict.fromkeys([*sides[0], *sides[1]]))
    every = [end for ends in sides for end in ends.values()]
    is_ours = ax is None
    with style.drawing(ax, style.DOUBLE_COLUMN_MM, 26 + 9.6 * len(names)) as ax:
        sides_at: Dict[float, str] = {}
        labels: List[str] = []
        for row, name in enumerate(names):
            pair = {PITCH * row + APART * k: ends[name] for k, ends in enumerate(sides) if name in ends}
            for y, end in pair.items():
                sides_at[y] = "left" if y == PITCH * row else "right"
                bar(ax, y, end, fill=sides_at[y] == "left")
                _beside(ax, _VALUES, y, value_text(end), "value")
            _normal_ranges(ax, pair)
            labels.append(in_two_lines(max(map(marked_name, pair.values()), key=len)))  # with its dagger if one side has it
            _beside(ax, _DIFFERENCES, PITCH * row + APART / 2, difference_text(*(ends.get(name) for ends in sides)), "difference")
        _beside(ax, _DIFFERENCES, _TOP, f"left {MINUS} right", "heading")
        ax.set_ylim(PITCH * len(names) - 0.5, _TOP)
        ax.set_yticks([PITCH * row + APART / 2 for row in range(len(names))], labels)
        ax.set_yticks(list(sides_at), list(sides_at.values()), minor=True, fontsize=style.smaller(1.5))
        ax.tick_params(axis="y", which="major", pad=4 * style.smaller(1.5))  # the names stand beside those of the sides
        degrees_axis(ax, every, _scope(left, right))
        source = of(left, "normal_range_source") or of(right, "normal_range_source")
        style.legend_below(ax, is_ours, handles_of(every, source), 3 if is_ours else 2)
    return ax


def _normal_ranges(ax: Axes, pair: Dict[float, MotionEnd]) -> None:
    """One behind both bars if they have the same. A side has none if its neutral pose is not known, and then it has none here."""
    for degrees in dict.fromkeys(end.normal_deg for end in pair.values() if end.normal_deg is not None):
        ys = [y for y, end in pair.items() if end.normal_deg == degrees]
        normal_range(ax, (ys[0] + ys[-1]) / 2, degrees, ys[-1] - ys[0] + 0.74)


def _beside(ax: Axes, ems: float, y: float, text: str, gid: str) -> None:
    """At so many heights of the type right of the axes, whose width may be any."""
    size = style.smaller(1.5)
    ax.annotate(text, (1, y), (ems * size, 0), xycoords=ax.get_yaxis_transform(), textcoords="offset points", va="center", fontsize=size, gid=gid)
