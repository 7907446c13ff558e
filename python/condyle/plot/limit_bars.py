"""How far each motion turns, as bars."""
from __future__ import annotations

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MultipleLocator

from .._limits import end_text
from . import style
from .motion_ends import Band, Bands, MotionEnd, RomLike, motion_ends
from .words import AS_DEFINED_HERE, SOFT_TISSUE_ENDS, SOFT_TISSUE_MARK, in_two_lines, is_as_defined_here
from .words import motion_name, of, scope_clause, step_of_ticks


class End(NamedTuple):
    """How one way of ending is drawn: each has a shape of its own, so that the figure reads without colour."""

    colour: str
    marker: str
    words: str


ENDS: Dict[str, End] = {
    "impingement": End(style.BLUE, "o", "impingement"),
    "contact": End(style.BLUE, "o", "contact"),
    "cut": End(style.VERMILION, "s", "cut of the image: no limit"),
    "bearing": End(style.ORANGE, "D", "bearing contact"),
    "end_of_range": End(style.GREY, ">", "no contact in the range"),
    "translation_ends": End(style.GREY, "P", "no contact, translation ends"),
    "contact_at_start": End(style.VERMILION, "X", "in contact at the start"),
    "ligament": End(style.GREEN, "v", "ligament"),
    "strained_at_start": End(style.GREEN, "X", "ligament strained at the start"),
}


# Where a living hip with this bone is expected to end.
LIVING: Dict[str, Any] = {"marker": "o", "markersize": 4, "markerfacecolor": "white", "markeredgecolor": style.BLACK, "markeredgewidth": 0.8,
                          "linestyle": "none", "clip_on": False}


def turned_text(end: MotionEnd) -> str:
    """ "131.9°"; ">120°" where the range ended before."""
    return f"{end_text(end.turned_deg, end.end)}°"


def value_text(end: MotionEnd) -> str:
    """ "131.9° (126–135)", ">120° (88–>120)": a limit with its band, as the command quotes it."""
    text, band = turned_text(end), end.band
    return text if band is None else f"{text} ({band.text})"


def ends_of(result: RomLike, bands: Bands = True) -> List[MotionEnd]:
    """The ends as they are drawn: without a band that lies at the end of the range as a whole."""
    return list(map(_with_its_band, motion_ends(result, bands)))


def _with_its_band(end: MotionEnd) -> MotionEnd:
    is_beyond = end.end == "end_of_range" and end.band is not None and round(end.band.p5_deg) == round(end.band.p95_deg)
    return end._replace(band=None) if is_beyond else end


def bar(ax: Axes, y: float, end: MotionEnd, fill: bool = True) -> None:
    """The bar of a motion, filled or hollow, with its marks, and below it the whisker of its band."""
    look = ENDS[end.end]
    ax.barh(y, end.turned_deg, height=0.3, facecolor=look.colour if fill else "white", edgecolor=look.colour, linewidth=0 if fill else 0.9,
            gid="limit", zorder=2)
    if end.bearing_deg is not None:
        _mark(ax, end.bearing_deg, y, ENDS["bearing"], "bearing_contact")
    _mark(ax, end.turned_deg, y, look, "end")
    if end.living_deg is not None:
        ax.plot([end.living_deg], [y], **LIVING, gid="living", zorder=5)
    if end.band is not None:
        _whisker(ax, y, end.band)


def _mark(ax: Axes, x: float, y: float, end: End, gid: str) -> None:
    ax.plot([x], [y], marker=end.marker, color=end.colour, markeredgecolor="white", markeredgewidth=0.6, markersize=5.5,
            linestyle="none", clip_on=False, zorder=4, gid=gid)


def _whisker(ax: Axes, y: float, band: Band) -> None:
    below = y + 0.29  # of the bar: the mark at its end would hide a narrow band
    ax.errorbar([band.median_deg], [below], xerr=[[band.median_deg - band.p5_deg], [band.p95_deg - band.median_deg]],
                fmt="|", color=style.BLACK, markersize=3, markeredgewidth=0.7, elinewidth=0.7, capsize=1.6,
                capthick=0.7, zorder=3, label="_band")
    if band.is_open:
        ax.plot([band.p95_deg], [below], marker=">", color=style.BLACK, markersize=3, linestyle="none", clip_on=False, zorder=3, gid="open_band")


def normal_range(ax: Axes, y: float, degrees: float, height: float = 0.74) -> None:
    """Stands behind bars about a height."""
    ax.barh(y, degrees, height=height, color=style.LIGHT_GREY, gid="normal_range", zorder=1)
    ax.vlines(degrees, y - height / 2, y + height / 2, color=style.GREY, linewidth=0.9, zorder=1)


def _is_ended_by_soft_tissue(end: MotionEnd) -> bool:
    return "soft_tissue_ends" in end.caveats


def marked_name(end: MotionEnd) -> str:
    """The name of a motion, with a dagger where soft tissue usually ends it."""
    name = motion_name(end.name)
    return f"{name} {SOFT_TISSUE_MARK}" if _is_ended_by_soft_tissue(end) else name


def footnotes(ends: Sequence[MotionEnd]) -> List[str]:
    """Of the names of these motions."""
    found = [AS_DEFINED_HERE] if any(is_as_defined_here(end.name) for end in ends) else []
    return found + [SOFT_TISSUE_ENDS] * any(map(_is_ended_by_soft_tissue, ends))


def handles_of(ends: Sequence[MotionEnd], source: Optional[str]) -> List[Any]:
    """The elements shown, for the legend."""
    shown = {end.end for end in ends}
    if any(end.bearing_deg is not None for end in ends):
        shown.add("bearing")
    handles: List[Any] = [
        Line2D([], [], marker=end.marker, color=end.colour, markeredgecolor="white", markeredgewidth=0.6,
               label=end.words, linewidth=3)
        for name, end in ENDS.items()
        if name in shown
    ]
    if any(end.band is not None for end in ends):
        handles.append(Line2D([], [], marker="|", color=style.BLACK, linewidth=0.7, markersize=4,
                              label="band, 5 to 95 %"))
    if any(end.band is not None and end.band.is_open for end in ends):
        handles.append(Line2D([], [], marker=">", color=style.BLACK, linewidth=0.7, markersize=3, label="band beyond the range"))
    if any(end.living_deg is not None for end in ends):
        handles.append(Line2D([], [], label="living hips, expected", **LIVING))
    if any(end.normal_deg is not None for end in ends):
        handles.append(Patch(color=style.LIGHT_GREY, label="clinical range" + (f" ({source})" if source else "")))
    return handles + [Line2D([], [], linestyle="none", label=footnote) for footnote in footnotes(ends)]


def degrees_axis(ax: Axes, ends: Sequence[MotionEnd], below: str) -> None:
    """From 0 to beyond all bars, bands and clinical ranges; of some length if nothing turns at all. A text stands below its label."""
    reached = ((end.turned_deg, end.normal_deg, end.band and end.band.p95_deg) for end in ends)
    longest = max(10.0, *(degrees for each in reached for degrees in each if degrees is not None))
    step = step_of_ticks(longest, 5)
    ax.set_xlim(0, step * -(-longest // step))
    ax.xaxis.set_major_locator(MultipleLocator(step))
    ax.tick_params(axis="y", which="both", length=0)
    ax.grid(axis="x")
    ax.set_xlabel("\n".join(filter(None, ("turned from the start of the motion (°)", below))))


def limits(result: RomLike, *, ax: Optional[Axes] = None, bands: Bands = True,
           normal_ranges: Union[bool, Mapping[str, float]] = True, values: bool = True, legend: bool = True) -> Axes:
    """Draws how far each motion turns from its start, as horizontal bars in degrees.

    Parameters
    ----------
    result
        A `condyle.RangeOfMotion`, what `files.read_rom` gives, or a mapping or object with `motions`, each with what
        `rom.json` has of it: `name`, `limit_deg`, `reason`, `contact_kind`, and where there is one
        `bearing_contact_deg`, `band` (with `p5_deg`, `median_deg`, `p95_deg`), `normal_range_deg`, `living` and `caveats`; and its
        `scope`, whose first clause stands below the axis.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    bands
        A whisker from 5 to 95 % of each limit, with a tick at the median, and an arrow (gid `open_band`) for its end where over 5 % of
        the joints turn to the end of the range without contact: those of the result, or one per motion as
        `RangeOfMotion.bands` gives them. False: none.
    normal_ranges
        A grey bar behind, where a source has a value: of the living, in whom soft tissue stops most motions before bone
        does. Those of the result, or degrees by the names of motions. False: none.
    values
        The limit in figures at the right, with its band in brackets.
    legend
        Whether to explain marks and bars, below the axes.

    Returns
    -------
    The axes: one bar (gid `limit`) per motion, from the top; its mark (gid `end`) shows the reason of its end, a diamond on the
    bar (gid `bearing_contact`) where bearing surfaces met before, a ring (gid `living`) where a living hip is expected to end. A dagger marks the names of motions that soft
    tissue usually ends before bone does.
    """
    ends = ends_of(result, bands)
    if normal_ranges is not True:
        given = normal_ranges or {}
        ends = [end._replace(normal_deg=given.get(end.name)) for end in ends]
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 22 + 6.2 * len(ends)) as ax:
        for y, end in enumerate(ends):
            bar(ax, y, end)
            if end.normal_deg is not None:
                normal_range(ax, y, end.normal_deg)
            if values:
                ax.text(1.04, y, value_text(end), transform=ax.get_yaxis_transform(), va="center",
                        fontsize=style.smaller(1.5), gid="value")
        ax.set_ylim(len(ends) - 0.5, -0.5)
        ax.set_yticks(range(len(ends)), [in_two_lines(marked_name(end)) for end in ends])
        degrees_axis(ax, ends, scope_clause(result))
        if legend:
            source = of(result, "normal_range_source") if normal_ranges is True else None
            style.legend_below(ax, is_ours, handles_of(ends, source))
    return ax
