"""What is drawn of a study's folder, as `condyle study` or `condyle merge` leaves it."""
from __future__ import annotations

import functools
import math
import re
from pathlib import Path
from typing import Callable, Dict, List, Sequence, get_args

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .._errors import FileError
from .._study import Study, StudyTable, read_study
from .._words import LimitReason
from . import style
from .cohort import MOST_GROUPS, draw_spread, limit_against, limit_distributions, spread_of
from .files import ReadError
from .folder import Drawing
from .motion_curves import axis_label
from .outliers import joint_columns, outliers

_READ = {"hips": {"id": "O"}, "limits": {"id": "O", "motion": "O", "limit_deg": "f", "reason": "O", "contact_kind": "O", "bearing_contact_deg": "f",
                                         "caveats": "O"}}
_REASONS = get_args(LimitReason)


def is_study(folder: Path) -> bool:
    """Whether a folder has a study, or shards of one; a sweep has shards too."""
    return (folder / "study.json").exists() or ((folder / "shards").is_dir() and not (folder / "sweep.json").exists())


def read(folder: Path) -> Study:
    """The study of a folder. ReadError, with file and column, if figures cannot be made of it."""
    try:
        study = read_study(folder)
    except FileError as error:
        raise ReadError(str(error)) from None
    for name, columns in _READ.items():
        _check(folder / f"{name}.csv", getattr(study, name), columns)
    limits, file = study.limits, folder / "limits.csv"
    hips, seen = set(study.hips["id"]), set()
    for joint, motion, limit, reason in zip(*(limits[name].tolist() for name in ("id", "motion", "limit_deg", "reason"))):
        where = f"{file}: joint '{joint}', motion '{motion}'"
        if joint not in hips:
            raise ReadError(f"{where}: column 'id': not in hips.csv")
        if (joint, motion) in seen:
            raise ReadError(f"{where}: column 'motion': twice")
        if not math.isfinite(limit):
            raise ReadError(f"{where}: column 'limit_deg': no number")
        if reason not in _REASONS:
            raise ReadError(f"{where}: column 'reason': '{reason}' is none of {', '.join(_REASONS)}")
        seen.add((joint, motion))
    return study


def _check(path: Path, table: StudyTable, columns: Dict[str, str]) -> None:
    for column, kind in columns.items():
        if column not in table:
            raise ReadError(f"{path}: no column '{column}'")
        if table[column].dtype.kind != kind:
            raise ReadError(f"{path}: column '{column}' is not of {'numbers' if kind == 'f' else 'texts'}")
    if not table.rows:
        raise ReadError(f"{path}: no rows")
    ids = list(table["id"])
    if path.stem == "hips" and len(set(ids)) < len(ids):
        raise ReadError(f"{path}: column 'id': a joint stands there twice")


def figures_of(study: Study) -> List[Drawing]:
    """Limits, by each text of the table with two to seven values and by side, and against each number of the table; measures if there are any."""
    hips = study.hips
    found: List[Drawing] = [("limit_distributions", lambda: limit_distributions(study).figure)]
    for name, values in hips.items():
        if name != "side" and not hips.meanings[name].startswith("from the table"):
            continue
        if values.dtype.kind == "O" and 1 < len(set(values)) <= MOST_GROUPS:
            found.append((_file(found, f"limits_by_{name}"), functools.partial(_by, study, name)))
        elif values.dtype.kind == "f" and len(set(values[np.isfinite(values.astype(float))].tolist())) > 1:
            found.append((_file(found, f"limits_against_{name}"), functools.partial(_against, study, name)))
    measures = [name for name, values in joint_columns(study).items() if name.startswith("measured_") and np.isfinite(values).any()]
    if measures:
        found.append(("measure_distributions", lambda: _measures(study, measures)))
    return [(name, functools.partial(_without_formulas, draw)) for name, draw in found]


def _file(taken: Sequence[Drawing], name: str) -> str:
    """A name that any file system takes and no other figure has."""
    name = re.sub(r"[^\w.-]", "_", name)[:100]
    return f"{name}_{len(taken)}" if name.lower() in (other.lower() for other, _ in taken) else name


def _without_formulas(draw: Callable[[], Figure]) -> Figure:
    with matplotlib.rc_context({"text.parse_math": False}):  # a dollar sign in a name is one
        return draw()


def _by(study: Study, name: str) -> Figure:
    return limit_distributions(study, by=name).figure


def _panels(count: int, across: int, high_mm: float, draw: Callable[[Axes, int], None]) -> Figure:
    down = -(-count // across)
    with style.print_style():
        figure, axes = plt.subplots(down, across, squeeze=False, layout="constrained", figsize=style.size_mm(style.DOUBLE_COLUMN_MM, high_mm * down))
        for i, ax in enumerate(axes.flat):
            if i < count:
                draw(ax, i)
            else:
                ax.remove()
    return figure


def _against(study: Study, name: str) -> Figure:
    known = set(study.hips["id"][np.isfinite(study.hips[name].astype(float))].tolist())
    motions = list(dict.fromkeys(motion for joint, motion in zip(study.limits["id"], study.limits["motion"]) if joint in known))

    def draw(ax: Axes, i: int) -> None:
        limit_against(study, name, motions[i], ax=ax)

    return _panels(len(motions), 3, 42, draw)


def _measures(study: Study, names: Sequence[str]) -> Figure:
    """A panel of each measure, with its outliers as crosses (gid `outlier`)."""
    columns, far = joint_columns(study), outliers(study)

    def draw(ax: Axes, i: int) -> None:
        values = columns[names[i]]
        known = values[np.isfinite(values)]
        draw_spread(ax, 0, spread_of(known, np.full(len(known), "")), 0, 0.8)
        x = [each.value for each in far if each.column == names[i]]
        ax.plot(x, [0.0] * len(x), "x", color=style.VERMILION, markersize=3.5, markeredgewidth=0.9, gid="outlier")
        ax.set_yticks([])
        ax.spines["left"].set_visible(False)
        ax.locator_params(axis="x", nbins=4)
        ax.set_xlabel(axis_label(names[i].replace("measured_", "", 1)), fontsize=6, labelpad=1)
        ax.tick_params(labelsize=6)
        ax.xaxis.get_offset_text().set_fontsize(5)

    return _panels(len(names), 4, 14, draw)
