"""All joints of a study on sheets of paper: the limits of each as small bars, outliers marked."""
from __future__ import annotations

import math
from typing import Any, Dict, List, Mapping, Optional

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .._errors import UsageError
from .._study import Study, StudyTable
from . import style
from .limit_bars import ENDS, degrees_axis, handles_of, marked_name
from .motion_curves import axis_label
from .motion_ends import MotionEnd, motion_ends
from .outliers import Outlier, limit_column, not_searched, outliers
from .paper import HEIGHT_MM, WIDTH_MM, Paper, width_mm, wrapped
from .words import MINUS, motion_name

ACROSS, DOWN = 4, 6
MOST_JOINTS = 2000
"""Nobody looks through more, and they take minutes."""
EDGE_MM, TOP_MM, BOTTOM_MM, NAMES_MM, GAP_MM, LOW_MM, TITLE_MM = 10.0, 17.0, 31.0, 32.0, 8.0, 2.5, 6.5
WIDE_MM, HIGH_MM = (WIDTH_MM - 2 * EDGE_MM - NAMES_MM) / ACROSS, (HEIGHT_MM - TOP_MM - BOTTOM_MM) / DOWN
SMALL = 5.0
"""Points, of what stands in and below the bars: of 24 joints, each of 12 motions has 2.8 mm."""


def contact_sheet(study: Study, *, name: str = "") -> List[Figure]:
    """Draws all joints of a study on A4 pages, 24 on each, in the order of the study; `save(pages, "contact_sheet.pdf")` writes them.

    `name` begins the heading. UsageError for more than 2,000 joints.

    Returns
    -------
    The pages: axes per joint (its name as gid) with a bar (gid `limit`) per motion, the marks of `limits` at its end (gid `end`), and a tick at the
    median of all joints (gid `median`). The name of a joint with `outliers` has an asterisk. Outliers among limits have another one at the right
    of their bar (gid `outlier`) with their robust standard deviations; the others stand below the name.
    """
    joints = list(study.hips["id"])
    if len(joints) > MOST_JOINTS:
        raise UsageError(f"{len(joints)} joints: at most {MOST_JOINTS} stand on contact sheets")
    ends: Dict[str, Dict[str, MotionEnd]] = {joint: {} for joint in joints}
    for i, (joint, motion) in enumerate(zip(study.limits["id"], study.limits["motion"])):
        ends[joint][motion] = _end_of(study.limits, i)
    every = [end for of in ends.values() for end in of.values()]
    names: Dict[str, str] = {}
    for end in every:
        names[end.name] = max(names.get(end.name, ""), marked_name(end), key=len)  # with its dagger if one joint has it
    medians = [float(np.median(study.limits["limit_deg"][study.limits["motion"] == motion])) for motion in names]
    far: Dict[str, Dict[str, Outlier]] = {joint: {} for joint in joints}
    for each in outliers(study):
        far[each.joint][each.column] = each
    left_out = not_searched(study)
    same = [motion_name(motion) for motion in names if limit_column(study, motion) in left_out]
    counts = f"{len(joints)} joints, {study.failures.rows} without an answer, {sum(map(bool, far.values()))} with outliers"
    pages: List[Figure] = []
    with style.print_style(), matplotlib.rc_context({"text.parse_math": False}):
        for first in range(0, len(joints), ACROSS * DOWN):
            shown = joints[first:first + ACROSS * DOWN]
            paper = Paper()
            plt.close(paper.figure)  # pyplot warns of many open figures
            page = f"page {len(pages) + 1} of {math.ceil(len(joints) / (ACROSS * DOWN))}"
            _around(paper, " · ".join(filter(None, (name, counts, page))), len(shown), every, same)
            for place, joint in enumerate(shown):
                left, top = EDGE_MM + NAMES_MM + place % ACROSS * WIDE_MM, TOP_MM + place // ACROSS * HIGH_MM
                ax = paper.axes(left, top + TITLE_MM, WIDE_MM - GAP_MM, HIGH_MM - TITLE_MM - LOW_MM)
                ax.set_gid(joint)
                _bars(ax, [ends[joint].get(motion) for motion in names], medians)
                _scales(ax, every, list(names.values()) if place % ACROSS == 0 else [], place + ACROSS >= len(shown))
                for row, motion in enumerate(names):
                    _mark(ax, row, far[joint].pop(limit_column(study, motion), None))
                _title(paper, left, top, joint, any(text.get_gid() == "outlier" for text in ax.texts), far[joint])
            pages.append(paper.figure)
    return pages


def _end_of(limits: StudyTable, i: int) -> MotionEnd:
    limit: Dict[str, Any] = {key: limits[key][i] for key in ("limit_deg", "reason", "contact_kind", "bearing_contact_deg")}
    if math.isnan(limit["bearing_contact_deg"]):
        limit["bearing_contact_deg"] = None
    caveats = [{"code": code} for code in str(limits["caveats"][i]).split()]
    return motion_ends({"motions": [{**limit, "name": limits["motion"][i], "caveats": caveats}]})[0]


def _bars(ax: Axes, ends: List[Optional[MotionEnd]], medians: List[float]) -> None:
    rows = {row: end for row, end in enumerate(ends) if end is not None}
    ax.barh(list(rows), [end.turned_deg for end in rows.values()], height=0.4, color=[ENDS[end.end].colour for end in rows.values()], gid="limit")
    met = {row: end.bearing_deg for row, end in rows.items() if end.bearing_deg is not None}
    _marks(ax, met, "bearing", "bearing_contact")
    for kind in dict.fromkeys(end.end for end in rows.values()):
        _marks(ax, {row: end.turned_deg for row, end in rows.items() if end.end == kind}, kind, "end")
    ax.vlines(medians, np.arange(len(medians)) - 0.42, np.arange(len(medians)) + 0.42, color=style.BLACK, linewidth=0.7, gid="median")
    ax.set_ylim(len(medians) - 0.4, -0.6)


def _marks(ax: Axes, at: Dict[int, float], kind: str, gid: str) -> None:
    ax.plot(list(at.values()), list(at), marker=ENDS[kind].marker, color=ENDS[kind].colour, linestyle="none", markersize=3.2,
            markeredgecolor="white", markeredgewidth=0.3, clip_on=False, gid=gid)


def _scales(ax: Axes, every: List[MotionEnd], names: List[str], is_lowest: bool) -> None:
    degrees_axis(ax, every, "")
    ax.set_xlabel("")
    ax.tick_params(axis="x", labelsize=SMALL, labelbottom=is_lowest, pad=1.5)
    size = min(SMALL, *((NAMES_MM - 2) / width_mm(name, 1) for name in names)) if names else SMALL
    ax.set_yticks(range(len(names)), names, fontsize=size)


def _deviations(outlier: Outlier) -> str:
    return f"{outlier.deviations:+.{int(abs(outlier.deviations) < 10)}f}".replace("-", MINUS)


def _mark(ax: Axes, row: int, outlier: Optional[Outlier]) -> None:
    if outlier is not None:
        ax.text(1.02, row, f"* {_deviations(outlier)}", transform=ax.get_yaxis_transform(), va="center", fontsize=SMALL, fontweight="bold",
                color=style.VERMILION, gid="outlier")


def _title(paper: Paper, left: float, top: float, joint: str, has_outlier: bool, others: Mapping[str, Outlier]) -> None:
    """The name in one line, and what fits of its other outliers, the farthest first."""
    wide, is_far = WIDE_MM - 1.5, has_outlier or bool(others)
    text = wrapped(joint, 1e6, 1)[:1] or [""]
    name = text[0] + " *" * is_far
    paper.line(left, top, name, min(7.0, wide / width_mm(name or " ", 1, True)), bold=True, colour=style.VERMILION if is_far else style.BLACK)
    names = {column: axis_label(column.replace("measured_", "", 1)).partition(" (")[0] for column in others}
    said = [f"{names[each.column]} {_deviations(each)}" for each in sorted(others.values(), key=lambda each: -abs(each.deviations))]
    fitting = [said[:n] + [f"{len(said) - n} more"] * (n < len(said)) for n in range(len(said), 0, -1)]
    line = next((", ".join(each) for each in fitting if width_mm(", ".join(each), SMALL) <= wide), ", ".join(fitting[-1]) if said else "")
    if line:
        paper.line(left, top + 3.1, line, min(SMALL, wide / width_mm(line, 1)), colour=style.VERMILION)


def _around(paper: Paper, heading: str, shown: int, every: List[MotionEnd], same: List[str]) -> None:
    """What stands above and below the joints."""
    inner = WIDTH_MM - 2 * EDGE_MM
    paper.line(EDGE_MM, EDGE_MM, heading, min(9.0, inner / width_mm(heading, 1, True)), bold=True)
    paper.line(EDGE_MM + NAMES_MM, TOP_MM + math.ceil(shown / ACROSS) * HIGH_MM - LOW_MM + 3.5, "turned from the start of the motion (°)", 7)
    handles = handles_of(every, None)
    handles.append(Line2D([], [], marker="|", color=style.BLACK, linestyle="none", markersize=6, label="median of all joints"))
    says = "outlier: robust standard deviations from the median"
    handles.append(Line2D([], [], marker=(5, 2, 0), color=style.VERMILION, linestyle="none", label=says))
    paper.figure.legend(handles=handles, loc="upper center", ncol=4, fontsize=6, bbox_to_anchor=(0.5, (BOTTOM_MM - 6) / HEIGHT_MM), borderaxespad=0,
                        columnspacing=1.4)
    if same:
        text = f"Not searched for outliers, see outliers.csv: {', '.join(same)}."
        paper.paragraph(text, EDGE_MM, inner, 6, colour="#555555").draw(HEIGHT_MM - EDGE_MM - 2)
