"""Figures over a cohort: how limits are spread, by group and against a measure."""
from __future__ import annotations

from typing import Any, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.transforms import offset_copy
from numpy.typing import ArrayLike, NDArray

from .._errors import UsageError
from .._study import Study
from . import style
from .motion_curves import axis_label
from .words import in_two_lines, motion_name

StudyLike = Union[Study, Mapping[str, ArrayLike]]
MOST_GROUPS = len(style.CYCLE)
MARKERS = "osD^vPX"
"""Markers of groups, in the order of the colours: the figure reads without colour."""
WITHOUT_CONTACT: Any = {"marker": ">", "linestyle": "none"}


class Spread(NamedTuple):
    """Summary of the limits of one motion in one group, degrees."""

    p5: float
    quartile: float
    median: float
    third_quartile: float
    p95: float
    share_without_contact: float


def _column(table: Mapping[str, Any], name: str) -> NDArray[Any]:
    try:
        return np.asarray(table[name])
    except KeyError:
        raise UsageError(f"the table has no column '{name}'") from None


def _groups(table: Mapping[str, Any], by: Optional[str], rows: NDArray[np.bool_]) -> List[Tuple[str, NDArray[np.bool_]]]:
    """Names and rows of the groups, in the order of their values."""
    if by is None:
        return [("", rows)]
    values = _column(table, by)
    found = [value for value in np.unique(values[rows]) if value == value]
    if len(found) > MOST_GROUPS:
        raise UsageError(f"column '{by}' has {len(found)} values: at most {MOST_GROUPS} groups are drawn")
    return [(f"{value:g}" if isinstance(value, (float, np.floating)) else str(value), rows & (values == value))
            for value in found]


def _limits_of(study: StudyLike) -> Mapping[str, ArrayLike]:
    """`limits` of a `condyle.Study` with the columns of `hips` beside, as `Study.to_dataframe` has them; else the table."""
    if not isinstance(study, Study):
        return study
    row = {name: i for i, name in enumerate(study.hips["id"])}
    of_hip = np.array([row[name] for name in study.limits["id"]], dtype=int)
    beside = {name: values[of_hip] for name, values in study.hips.items() if name not in study.limits}
    return {**study.limits, **beside}


def spread_of(limits_deg: NDArray[np.float64], reasons: NDArray[Any]) -> Spread:
    """Percentiles 5, 25, 50, 75 and 95, and the share that ended without contact."""
    p5, quartile, median, third_quartile, p95 = map(float, np.percentile(limits_deg, [5, 25, 50, 75, 95]))
    return Spread(p5, quartile, median, third_quartile, p95, float(np.mean(reasons == "end_of_range")))


def limit_distributions(study: StudyLike, *, by: Optional[str] = None, motions: Optional[Sequence[str]] = None,
                        ax: Optional[Axes] = None, legend: bool = True) -> Axes:
    """Draws how the limits of each motion are spread over a cohort, in degrees.

    Parameters
    ----------
    study
        A `condyle.Study`, or a table of its limits: any mapping of columns, a pandas DataFrame too.
    by
        A column that parts the joints into groups, seven at most; one row per group then.
    motions
        Their names, from the top; all of the table if not given.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.

    Returns
    -------
    The axes: per motion and group a line from 5 to 95 % (gid `band`), a bar between the quartiles (gid `quartiles`) and a
    mark at the median (gid `median`). A grey arrow at the right (gid `without_contact`) where some joints
    reached the end of the range without contact: their limits are at least that.
    """
    table = _limits_of(study)
    names, limits, reasons = (_column(table, name) for name in ("motion", "limit_deg", "reason"))
    shown = list(dict.fromkeys(names)) if motions is None else list(motions)
    for name in shown:
        if not (names == name).any():
            raise UsageError(f"the table has no motion '{name}'")
    groups = _groups(table, by, np.ones(len(names), bool))
    is_ours, between = ax is None, 0.8 / len(groups)
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 20 + (4 + 2.5 * len(groups)) * len(shown)) as ax:
        for row, name in enumerate(shown):
            for i, (_, rows) in enumerate(groups):
                of = rows & (names == name)
                if of.any():
                    draw_spread(ax, row + (i - (len(groups) - 1) / 2) * between, spread_of(limits[of], reasons[of]), i,
                            between)
        ax.set_ylim(len(shown) - 0.5, -0.5)
        ax.set_yticks(range(len(shown)), [in_two_lines(motion_name(name)) for name in shown])
        ax.tick_params(axis="y", length=0)
        ax.grid(axis="x")
        ax.set_xlim(left=0)
        ax.set_xlabel("limit: median, quartiles, 5 to 95 % (°)")
        if legend:
            handles = [] if by is None else _handles(by, groups)
            if (reasons[np.isin(names, shown)] == "end_of_range").any():
                handles.append(Line2D([], [], color=style.GREY, label="some: no contact in the range", **WITHOUT_CONTACT))
            style.legend_below(ax, is_ours, handles)
    return ax


def draw_spread(ax: Axes, y: float, spread: Spread, group: int, height: float) -> None:
    """The line, bar and mark of `limit_distributions` at a height."""
    colour = style.CYCLE[group]
    ax.plot([spread.p5, spread.p95], [y, y], color=colour, linewidth=0.9, solid_capstyle="butt", gid="band")
    ax.barh(y, spread.third_quartile - spread.quartile, left=spread.quartile, height=0.55 * height, color=colour,
            alpha=0.35, gid="quartiles")
    ax.plot([spread.median], [y], marker=MARKERS[group], color=colour, markeredgecolor="white", markeredgewidth=0.5,
            markersize=4.5, clip_on=False, gid="median")
    if spread.share_without_contact > 0:  # beside the mark of a median that is there too
        ax.plot([spread.p95], [y], color=style.GREY, markersize=3.5, clip_on=False, gid="without_contact", **WITHOUT_CONTACT,
                transform=offset_copy(ax.transData, ax.figure, x=4.5, units="points"))


def _handles(by: str, groups: Sequence[Tuple[str, Any]]) -> List[Any]:
    return [Line2D([], [], color=style.CYCLE[i], marker=MARKERS[i], markeredgecolor="white", markeredgewidth=0.5,
                   label=f"{by} {name}") for i, (name, _) in enumerate(groups)]


def running_band(x: NDArray[np.float64], y: NDArray[np.float64], parts: int) -> NDArray[np.float64]:
    """Mean x, and percentiles 5, 50 and 95 of y, of `parts` parts with equally many points, by x; (parts, 4)."""
    order = np.argsort(x, kind="stable")
    return np.array([[x[part].mean(), *np.percentile(y[part], [5, 50, 95])] for part in np.array_split(order, parts)])


def limit_against(study: StudyLike, measure: str, motion: str, *, by: Optional[str] = None, ax: Optional[Axes] = None,
                  label: Optional[str] = None, legend: bool = True) -> Axes:
    """Draws the limit of one motion against a measure, a point per joint, in degrees.

    Parameters
    ----------
    study
        A `condyle.Study`, or a table of its limits: any mapping of columns.
    measure
        A column of numbers, such as `bone_alpha_angle_deg` of a cohort of samples or, of a study with measures,
        `measured_alpha_1_30_deg`; joints without a value are left out.
    motion
        Its name.
    by
        A column that parts the joints into groups, seven at most.
    label
        Label of the axis of the measure; default: its name and unit.

    Returns
    -------
    The axes: points (gid `limits`), hollow where the range ended without contact (gid `without_contact`), and for each
    group of 50 joints or more the median (gid `median`) within a band from 5 to 95 % (gid `band`) of parts of equally
    many joints, 20 or more.
    """
    table = _limits_of(study)
    names, limits, reasons = (_column(table, name) for name in ("motion", "limit_deg", "reason"))
    values = _column(table, measure)
    if values.dtype.kind not in "fiu":
        raise UsageError(f"column '{measure}' has no numbers")
    rows = (names == motion) & np.isfinite(values.astype(float))
    if not rows.any():
        raise UsageError(f"the table has no motion '{motion}' with a {measure}")
    groups = _groups(table, by, rows)
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 62) as ax:
        for i, (_, of) in enumerate(groups):
            _points(ax, values[of].astype(float), limits[of], reasons[of] == "end_of_range", i)
        ax.grid(axis="y")
        ax.set_ylim(bottom=0)
        ax.set_xlabel(label or axis_label(measure))
        ax.set_ylabel(in_two_lines(motion_name(motion)) + " (°)")
        if legend and by is not None:
            style.legend_below(ax, is_ours, _handles(by, groups))
    return ax


def _points(ax: Axes, x: NDArray[np.float64], y: NDArray[np.float64], is_free: NDArray[np.bool_], group: int) -> None:
    colour, fewest, in_part = style.CYCLE[group], 50, 20
    look: Any = {"marker": MARKERS[group], "linestyle": "none", "markersize": 2.2}
    ax.plot(x[~is_free], y[~is_free], color=colour, alpha=0.35, markeredgewidth=0, gid="limits", **look)
    if is_free.any():
        ax.plot(x[is_free], y[is_free], color=colour, markerfacecolor="none", markeredgewidth=0.4, alpha=0.6,
                gid="without_contact", **look)
    if len(x) >= fewest:
        centre, p5, median, p95 = running_band(x, y, min(12, len(x) // in_part)).T
        ax.fill_between(centre, p5, p95, color=colour, alpha=0.18, linewidth=0, gid="band")
        ax.plot(centre, median, color=colour, gid="median")
