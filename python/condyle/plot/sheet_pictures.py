"""The pictures of a sheet: the cut, the clock face, the safe zone; each in a place that is given in mm."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Callable, Dict, List, NamedTuple, Optional

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from . import sheet_text, style
from .case_files import Case
from .files import ReadError
from .motion_ends import motion_ends
from .paper import HEIGHT_MM, WIDTH_MM, Block, Paper, stacked
from .rim_clock import HEIGHT_MM as CLOCK_MM
from .rim_clock import clock_face, clock_text, names_fit
from .safe_zone import legend_entries, margins_along, safe_zone, slice_of_best, zone_of

TITLE_MM = 4.0
SMALL = 6.5
"""Points of the type below pictures."""


class Picture(NamedTuple):
    """Something of a height between these, title included; `draw` takes left, top, width and height, mm."""

    title: str
    least: float
    best: float
    draw: Callable[[float, float, float, float], None]


def pictures_of(paper: Paper, case: Case, given: Optional[Path], width: float) -> List[Picture]:
    """What there is to be seen, in the order of the page; each will be of this width.

    Raises ReadError for a picture that cannot be read.
    """
    pictures: List[Picture] = []
    if case.plan and any(cut["volume_mm3"] > 0 for cut in case.plan["cuts"]):
        pictures.append(_cuts(paper, case, given, width))
    elif given:
        pictures.append(Picture(given.name, TITLE_MM + 34, TITLE_MM + 60, _image(paper, given)))
    if case.rom and any(motion.get("clock_hour") is not None for motion in case.rom["motions"]):
        pictures.append(_clock(paper, case.rom))
    if case.sweep:
        pictures.append(_zone(paper, case.sweep))
    return pictures


def _image(paper: Paper, path: Path) -> Callable[[float, float, float, float], None]:
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


def _cuts(paper: Paper, case: Case, given: Optional[Path], width: float) -> Picture:
    """Each cut with its picture, which has a key, side by side, and below them what goes, in figures."""
    assert case.plan is not None
    cuts = [cut for cut in case.plan["cuts"] if cut["volume_mm3"] > 0]
    said = _said(case.plan, cuts)
    drawn = [case.paths["plan"].with_name(f"depth_{cut['body']}.png") for cut in cuts]
    images = [_image(paper, path) for path in ([given] if given else [path for path in drawn if path.exists()])]

    def below(left: float) -> Block:
        return stacked([paper.paragraph(text, left, width, SMALL) for text in said])

    def draw(left: float, top: float, width: float, height: float) -> None:
        text = below(left)
        foot, each = top + height - text.height, width / max(1, len(images))
        for i, image in enumerate(images):
            image(left + i * each, top, each - 1, foot - top)
        text.draw(foot)

    rest = TITLE_MM + below(0).height
    return Picture("Bone that must go" + (", by its depth" if images and not given else ""), rest + (30 if images else 0), rest + (66 if images else 0), draw)


def _said(plan: Dict[str, Any], cuts: List[Dict[str, Any]]) -> List[str]:
    said = []
    for cut in cuts:
        hour = f", at {clock_text(cut['deepest_hour'])} of the neck" if cut["deepest_hour"] is not None else ""
        said.append(f"{sheet_text.volume_text(cut)} over {cut['area_mm2']:.0f} mm²; {cut['deepest_mm']:.2f} mm at the deepest{hour}.")
    depths = enumerate(plan["depth_by_half_hour_mm"] or [])
    deep = [f"{clock_text(i / 2)}–{clock_text((i + 1) / 2)} {depth:.1f}" for i, depth in depths if depth >= 0.05]
    return said + ([f"Largest depth by half hour of the neck, mm: {', '.join(deep)}."] if deep else [])


def _clock(paper: Paper, rom: Dict[str, Any]) -> Picture:
    """The face with names, or where these do not fit with the numbers of the table; the scope stands at the foot of the page."""
    numbers = {} if names_fit(rom) else {end.name: f"({i})" for i, end in enumerate(motion_ends(rom), 1)}
    kinds = {end.end for end in motion_ends(rom) if end.hour is not None}
    legend = style.rows_below(len(kinds)) if len(kinds) > 1 else 0.0

    def draw(left: float, top: float, width: float, height: float) -> None:
        ax = clock_face({**rom, "scope": ""}, ax=paper.axes(left, top, width, CLOCK_MM), names=numbers)
        _lowered(paper, ax, left + width / 2, top + CLOCK_MM)

    title = "Contacts on the rim's clock" + (", with the numbers of the motions" if numbers else "")
    return Picture(title, TITLE_MM + CLOCK_MM + legend, TITLE_MM + CLOCK_MM + legend, draw)


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

    title = "Safe zone: designs that leave all targets free" + (f", at {where}" if where else "")
    return Picture(title, around + 34, around + 60, draw)


def _lowered(paper: Paper, ax: Axes, middle: float, top: float) -> None:
    """The legend of axes, if they have one, hangs below this point."""
    legend = ax.get_legend()
    if legend is not None:
        legend.set_bbox_to_anchor((middle / WIDTH_MM, 1 - top / HEIGHT_MM), paper.figure.transFigure)
