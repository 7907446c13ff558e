"""Joints of a study with a limit or a measure far from that of the others."""
from __future__ import annotations

from typing import Dict, List, NamedTuple, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from .._csv_text import csv_field
from .._study import Study

FARTHEST = 3.5
"""In robust standard deviations: Iglewicz and Hoaglin, How to detect and handle outliers, 1993, for their modified z score, which is the same."""
FEWEST_JOINTS = 10
NORMAL = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation."""
ROUNDING = 1e-9
"""A median absolute deviation up to this, mm or degrees, is rounding: what is 0 of a perfect sphere has one of 1e-13."""
FEW, SAME = "fewer than 10 joints have a value", "the values of more than half of the joints are the same"


class Outlier(NamedTuple):
    """A value and the median of its column; `deviations` are robust standard deviations from it, negative below it."""

    joint: str
    column: str
    value: float
    median: float
    deviations: float


def limit_column(study: Study, motion: str) -> str:
    """The name of its limits beside the columns of `hips`: `flexion_limit_deg`."""
    name = f"{motion}_limit_deg"
    return f"study_{name}" if name in study.hips else name


def joint_columns(study: Study) -> Dict[str, NDArray[np.float64]]:
    """All numbers that say something of a joint, one for each row of `hips`: its columns, then the limits of each motion.

    Left out are `table_row`, hours, which begin again at 12, and ends of bands.
    """
    hips, limits = study.hips, study.limits
    found = {name: values.astype(float) for name, values in hips.items()
             if values.dtype.kind == "f" and name != "table_row" and hips.units[name] != "h"
             and not (name.endswith(("_p5", "_p95")) and name.rpartition("_")[0] in hips)}
    row = {joint: i for i, joint in enumerate(hips["id"])}
    for motion in dict.fromkeys(limits["motion"]):
        of = limits["motion"] == motion
        found[limit_column(study, motion)] = column = np.full(len(row), np.nan)
        column[[row[joint] for joint in limits["id"][of].tolist()]] = limits["limit_deg"][of]
    return found


def _reference(values: NDArray[np.float64]) -> Union[Tuple[float, float], str]:
    """The median and the robust standard deviation; why there is none."""
    known = values[np.isfinite(values)]
    if len(known) < FEWEST_JOINTS:
        return FEW
    median = float(np.median(known))
    deviation = float(np.median(np.abs(known - median)))
    return SAME if deviation <= ROUNDING else (median, NORMAL * deviation)


def not_searched(study: Study) -> Dict[str, str]:
    """Columns that `outliers` finds none in, with the reason."""
    references = {name: _reference(values) for name, values in joint_columns(study).items()}
    return {name: reference for name, reference in references.items() if isinstance(reference, str)}


def outliers(study: Study) -> List[Outlier]:
    """Values more than 3.5 robust standard deviations from the median of their column, by joints in the order of the study.

    The robust standard deviation is 1.4826 times the median absolute deviation. Searched are the numeric columns of `hips`, those of the table too,
    and the limits of each motion, as `flexion_limit_deg`. A limit at the end of the range counts with its value. There are no outliers in a column
    with fewer than 10 values, and none where more than half are the same: their median absolute deviation is 0.
    """
    joints = list(study.hips["id"])
    found: List[Tuple[int, Outlier]] = []
    for name, values in joint_columns(study).items():
        reference = _reference(values)
        if isinstance(reference, str):
            continue
        median, deviation = reference
        far = map(int, np.flatnonzero(np.abs(values - median) > FARTHEST * deviation))
        found += [(i, Outlier(joints[i], name, float(values[i]), median, float((values[i] - median) / deviation))) for i in far]
    return [each for _, each in sorted(found, key=lambda one: one[0])]


def outliers_csv(study: Study) -> str:
    """`outliers` as a table; comments before it name the columns that were not searched."""
    by_reason = {why: [name for name, each in not_searched(study).items() if each == why] for why in (FEW, SAME)}
    lines = [f"# not searched, {why}: {', '.join(map(csv_field, names))}" for why, names in by_reason.items() if names]
    rows = [[csv_field(each.joint), csv_field(each.column), *map(repr, each[2:])] for each in outliers(study)]
    return "".join(f"{line}\n" for line in [*lines, ",".join(Outlier._fields), *map(",".join, rows)])
