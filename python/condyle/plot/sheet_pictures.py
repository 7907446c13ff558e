"""The pictures of a sheet: the cut, limits now and planned, the clock face, the safe zone; each in a place that is given in mm."""
from __future__ import annotations

import functools
from pathlib import Path
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from . import sheet_text, style
from .case_files import Case
from .files import ReadError
from .limit_bars import LIVING, marked_name, value_text
from .motion_ends import MotionEnd, motion_ends
from .paper import HEIGHT_MM, LINE, MM_PER_POINT, WIDTH_MM, Paper
from .rim_clock import HEIGHT_MM as CLOCK_MM
from .rim_clock import clock_face, clock_text, names_fit
from .safe_zone import legend_entries, margins_along, safe_zone, slice_of_best, zone_of
from .sheet_text import Row
from .words import capitalised, spaced

Draw = Callable[[float, float, float, float], None]

TITLE_MM = 4.5
SMALL = 7.0
"""Points of the type below pictures."""
PICTURE_MM = 110.0
"""Usual width: letters in the pictures of the command are then 7 points high."""
EDGE_MM, INNER_MM, BAR_MM = 12.0, WIDTH_MM - 24.0, 5.2
EXAMINED = ("flexion", "internal_rotation_at_90_flexion", "fadir")


class Picture(NamedTuple):
    """Something of a height between these, title included; `draw` takes left, top, width and height, mm."""

    title: str
    least: float
    best: float
    draw: Draw
    width: float = PICTURE_MM


def pictures_of(paper: Paper, case: Case, given: Optional[Path]) -> List[Picture]:
    """What there is to be seen, the first of which is for the first page.

    Raises ReadError for a picture that cannot be read.
    """
    pictures: List[Picture] = []
    if case.plan and any(cut["volume_mm3"] > 0 for cut in case.plan["cuts"]):
        pictures += _cuts(paper, case, given)
    elif given:
        pictures.append(Picture(given.name, TITLE_MM + 34, TITLE_MM + 84, _image(paper, given)))
    if case.sweep:
        pictures.append(_zone(paper, case.sweep))
    if case.rom and any(motion.get("clock_hour") is not None for motion in case.rom["motions"]):
        pictures.append(_clock(paper, case.rom))
    return pictures


def _image(paper: Paper, path: Path) -> Draw:
    """As large as it can be, in the middle of its place."""
    try:
        with path.open("rb") as file:
            pixels = plt.imread(file, format="png")
    except OSError as error:
        raise ReadError(f"{path}: {error.strerror or 'not a PNG picture'}") from None
    except (SyntaxError, ValueError):
        raise ReadError(f"{path}: not a PNG picture") from None

    def draw(left: float, top: float, width: float, height: float) -> None:
        ax = paper.axes(left, top, width, height)
        ax.imshow(pixels, cmap="gray", gid="picture")
        ax.set_axis_off()

    return draw


def _cuts(paper: Paper, case: Case, given: Optional[Path]) -> List[Picture]:
    """Each cut with its picture, which has a key, and below it what goes, in figures; the largest first."""
    assert case.plan is not None
    found: List[Picture] = []
    for cut in sorted(case.plan["cuts"], key=lambda cut: -float(cut["volume_mm3"])):
        if cut["volume_mm3"] <= 0:
            continue
        path = given if given and not found else case.paths["plan"].with_name(f"depth_{cut['body']}.png")
        image = _image(paper, path) if path == given or path.exists() else None
        title = f"Cut of {spaced(cut['name'])}" + (", depth in mm" if image and path != given else "")
        title += "".join(f"; {spaced(other['name'])} overleaf" for other in case.plan["cuts"] if not found and other is not cut and other["volume_mm3"] > 0)
        height = TITLE_MM + 4 * SMALL * MM_PER_POINT * LINE + (82.5 if image else 0)
        found.append(Picture(title, height, height, functools.partial(_cut, paper, case.plan, cut, image)))
    return found


def _cut(paper: Paper, plan: Dict[str, Any], cut: Dict[str, Any], image: Optional[Draw], left: float, top: float, width: float, height: float) -> None:
    clock = "neck's clock" if cut["body"] == "mobile" else "socket's clock"
    hour = f", at {clock_text(cut['deepest_hour'])} of the {clock}" if cut["deepest_hour"] is not None else ""
    said = f"{sheet_text.volume_text(cut)} over {cut['area_mm2']:.0f} mm²; {cut['deepest_mm']:.1f} mm at the deepest{hour}."
    # Files of earlier versions have hours of the neck only.
    hours = cut.get("depth_by_half_hour_mm", plan["depth_by_half_hour_mm"] if cut["body"] == "mobile" else None)
    deep = [f"{clock_text(i / 2)}–{clock_text((i + 1) / 2)} {depth:.1f}" for i, depth in enumerate(hours or []) if depth >= 0.05]
    if deep and cut["deepest_hour"] is not None:
        said += f" Largest depth by the {clock} (12 superior, 3 anterior), mm: {', '.join(deep)}."
    text = paper.paragraph(said, left, width, SMALL)
    if image:
        image(left, top, width, height - text.height - 1)
    text.draw(top + height - text.height if image else top)


def bars(paper: Paper, rows: Sequence[Row], spoken_of: Row, width: float) -> Picture:
    """How far motions turn, now and planned: those with a target or a gain, without a plan those examined first and the one of the verdict."""
    planned = sorted((row for row in rows if row.target or (row.after and row.is_changed)), key=lambda row: not row.target)
    shown = planned[:6] or sorted(rows, key=lambda row: not (row is spoken_of or row.now.name in EXAMINED))[:4]
    targets = [row.target or {} for row in shown]
    key = {"line: 5 to 95 % of varied joints": any(end.band for row in shown for end in row.ends), "dashes: target": any(targets),
           "diamond: about the other centre": any(target.get("other_centre") for target in targets),
           "ring: expected of living hips": any(row.now.living_deg is not None for row in shown)}
    text = paper.paragraph(capitalised("; ".join(words for words, is_shown in key.items() if is_shown)), EDGE_MM + INNER_MM - width, width, SMALL)
    drawn = sum(BAR_MM * (len(row.ends) + 1.3) for row in shown)

    def draw(left: float, top: float, width: float, height: float) -> None:
        ax = paper.axes(left + 38, top, width - 39, drawn)
        ax.set_axis_off()
        ax.set_ylim(drawn, 0)
        reached = [target.get("reach_deg", 0.0) for target in targets] + [degrees for row in shown for end in row.ends for degrees in (end.turned_deg, *(end.band or ())[2:3])]
        ax.set_xlim(0, max(10.0, *reached))
        y = 0.0
        for row, target in zip(shown, targets):
            paper.first_line(left, top + y, marked_name(row.now), width, SMALL + 0.5)
            other = target.get("other_centre") or {}
            if target:
                ax.vlines(target["reach_deg"], y + BAR_MM, y + BAR_MM * (1 + len(row.ends)), color=style.BLACK, linestyle="--", linewidth=0.9, clip_on=False)
            for when, end, colour, about in zip(("now", "planned"), row.ends, (style.GREY, style.BLUE), (other.get("before_deg"), other.get("after_deg"))):
                y += BAR_MM
                middle = y + BAR_MM / 2
                paper.line(left, top + y + 0.6, f"{when} {value_text(end)}", SMALL)
                ax.barh(middle, end.turned_deg, height=0.55 * BAR_MM, color=colour, gid="limit")
                if end.band:
                    ax.plot(end.band[:3:2], [middle] * 2, "|-", color=style.BLACK, linewidth=0.9, markersize=6, clip_on=False)
                if end.living_deg is not None:
                    ax.plot([end.living_deg], [middle], **LIVING)
                if about is not None:
                    ax.plot(about, middle, "D", color=style.VERMILION, markeredgecolor="white", markersize=5.5, clip_on=False)
            y += 1.3 * BAR_MM
        text.draw(top + drawn + 1)

    height = TITLE_MM + drawn + text.height + 1
    return Picture("Limits now and planned" if planned else "Limits now", height, height, draw)


def _clock(paper: Paper, rom: Dict[str, Any]) -> Picture:
    """The face with names, or where these do not fit with the numbers of the table."""
    numbers = {} if names_fit(rom) else {end.name: f"({i})" for i, end in enumerate(motion_ends(rom), 1)}
    kinds = {end.end for end in motion_ends(rom) if end.hour is not None}
    legend = style.rows_below(len(kinds)) if len(kinds) > 1 else 0.0
    # Where more than sixteen stand on one side the face makes type smaller: it is larger then, with larger type.
    beside = [end.hour < 6 for end in motion_ends(rom) if end.hour is not None]
    points = max(9.5, 1.5 + SMALL * max(beside.count(True), beside.count(False)) / 16)
    face, width = CLOCK_MM * points / 7.6, style.SINGLE_COLUMN_MM * points / 7.6

    def draw(left: float, top: float, wide: float, height: float) -> None:
        with matplotlib.rc_context({"font.size": points}):
            ax = clock_face({**rom, "scope": ""}, ax=paper.axes(left, top, width, face), names=numbers)
        _lowered(paper, ax, left + width / 2, top + face)

    title = "Contacts on the socket's clock" + (" (numbers of motions)" if numbers else "")
    return Picture(title, TITLE_MM + face + legend, TITLE_MM + face + legend, draw, width)


def _zone(paper: Paper, sweep: Dict[str, Any]) -> Picture:
    """The margin over two parameters, along one, or of more in the slice of the best design."""
    zone, where = zone_of(sweep["zone"]), ""
    if len(zone.names) > 2:
        where, zone = slice_of_best(zone)
    legend = style.rows_below(legend_entries(zone))
    around = TITLE_MM + 10 + legend  # title, labels of the axes and legend

    def draw(left: float, top: float, width: float, height: float) -> None:
        ax = paper.axes(left + 12, top + 1, width - 16, height - 10 - legend)
        margins_along(zone, ax=ax) if len(zone.names) == 1 else safe_zone(zone, ax=ax)
        _lowered(paper, ax, left + width / 2, top + height - legend)

    title = f"Safe zone{f' at {where}' if where else ''}: all targets free"
    return Picture(title, around + 34, around + 60, draw)


def _lowered(paper: Paper, ax: Axes, middle: float, top: float) -> None:
    """The legend of axes, if they have one, hangs below this point."""
    legend = ax.get_legend()
    if legend is not None:
        legend.set_bbox_to_anchor((middle / WIDTH_MM, 1 - top / HEIGHT_MM), paper.figure.transFigure)
