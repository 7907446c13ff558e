"""Contact along a recorded motion or over a cycle, as curves."""
from __future__ import annotations

from typing import Dict, List, Literal, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from .._errors import UsageError
from .._pressure import ElasticContactResults
from . import style
from .words import spaced

Array = NDArray[np.float64]
Table = Mapping[str, ArrayLike]


class Quantity(NamedTuple):
    """The columns that can be drawn: their axis, and the words that distinguish them."""

    axis: str
    columns: Tuple[Tuple[str, str], ...]


QuantityName = Literal["area", "depth", "pressure", "force", "limit", "clearance", "gap"]
QUANTITIES: Dict[QuantityName, Quantity] = {
    "area": Quantity("contact area (mm²)", (("area_mm2", ""),)),
    "depth": Quantity("depth (mm)", (("max_depth_mm", "largest"), ("mean_depth_mm", "mean"))),
    "pressure": Quantity("pressure (MPa)", (("max_pressure_mpa", "largest"), ("mean_pressure_mpa", "mean"))),
    "force": Quantity("contact force (N)", (("force_n", ""),)),
    "limit": Quantity("to the nearest limit (°)", (("to_limit_deg", ""),)),
    "clearance": Quantity("clearance (mm)", (("clearance_mm", ""),)),
    "gap": Quantity("smallest gap (mm)", (("smallest_gap_mm", ""),)),
}
STYLES = ("-", "--", ":")
UNITS = {"s": "s", "deg": "°", "mm": "mm", "percent": "%", "mm2": "mm²", "mpa": "MPa", "n": "N", "nmm": "N mm"}


def force_columns(table: Table) -> List[str]:
    """The three components of the contact's force, whose names say in which body's frame they are; none if there is none."""
    for stem in ("force", "force_in_mobile", "force_in_fixed"):
        if f"{stem}_x_n" in table:
            return [f"{stem}_{axis}_n" for axis in "xyz"]
    return []


def column(table: Table, name: str) -> Array:
    """A column by its name; `force_n` is the length of the contact's force."""
    if name == "force_n" and name not in table:
        parts = [np.asarray(table[part], dtype=np.float64) for part in force_columns(table)]
        return np.asarray(np.sqrt(sum(part**2 for part in parts)))
    return np.asarray(table[name], dtype=np.float64)


def has(table: Table, quantity: QuantityName) -> bool:
    """Whether a table has the columns of a quantity."""
    return all(name in table or (name == "force_n" and bool(force_columns(table)))
               for name, _ in QUANTITIES[quantity].columns)


def table_of(time_s: ArrayLike, answers: Sequence[Optional[ElasticContactResults]]) -> Dict[str, Array]:
    """Curves of what `condyle.ElasticContact.at` answers of the poses of a motion, by the names of `curves.csv`.

    `time_s` (N,), and N answers; of bodies that both cast the mobile one's surface. None is a gap.
    """
    surfaces = [None if answer is None else answer.mobile or answer.fixed for answer in answers]
    found = [None if surface is None else surface.totals for surface in surfaces]
    table = {"time_s": np.asarray(time_s, dtype=np.float64)}
    if len(table["time_s"]) != len(found):
        raise UsageError(f"{len(table['time_s'])} times for {len(found)} answers")
    for name in ("area_mm2", "mean_depth_mm", "max_depth_mm", "mean_pressure_mpa", "max_pressure_mpa"):
        table[name] = np.array([np.nan if totals is None else getattr(totals, name) for totals in found])
    for k, axis in enumerate("xyz"):
        table[f"force_{axis}_n"] = np.array([np.nan if totals is None else totals.force_n[k] for totals in found])
    return table


def axis_label(name: str) -> str:
    """ "flexion (°)" of `flexion_deg`; "time (s)", "cycle (%)"."""
    words, _, unit = name.rpartition("_")
    return f"{spaced(words)} ({UNITS[unit]})" if words and unit in UNITS else spaced(name)


def _quantity(tables: Sequence[Table], quantity: QuantityName) -> Quantity:
    if quantity not in QUANTITIES:
        raise UsageError(f"quantity '{quantity}': there are {', '.join(QUANTITIES)}")
    if not all(has(table, quantity) for table in tables):
        raise UsageError(f"no {quantity} in this table: it has {', '.join(tables[0])}")
    return QUANTITIES[quantity]


def _label(label: Optional[str], words: str) -> str:
    return ", ".join(part for part in (label, words) if part) or "_curve"


def _finish(ax: Axes, along: str, quantity: Quantity) -> None:
    ax.set_xlabel(axis_label(along))
    ax.set_ylabel(quantity.axis)
    ax.set_ylim(bottom=0)
    ax.grid(axis="y")
    ax.margins(x=0)
    if ax.get_legend_handles_labels()[1]:
        ax.legend(fontsize=style.smaller(1.5))


def curve(table: Table, quantity: QuantityName, *, ax: Optional[Axes] = None, along: Optional[str] = None,
          label: Optional[str] = None, reference: Optional[Table] = None, reference_label: str = "reference",
          colour: str = style.BLUE) -> Axes:
    """Draws one quantity along a motion.

    Parameters
    ----------
    table
        Columns by name: what `files.read_curves` gives of `curves.csv` or `cycle.csv`, what `table_of` gives of
        answers, a pandas DataFrame, or arrays in a dict. NaN is a gap, and the line is broken there.
    quantity
        `"area"`, `"depth"` (largest and mean), `"pressure"` (largest and mean), `"force"` (length of the vector), `"limit"` (degrees to
        the nearest), `"clearance"` (of surfaces whose contact ends a motion) or `"gap"` (of any).
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`. Given again, a second motion is
        drawn over the first.
    along
        The column to the right: the first one (`time_s`, `frame`, `cycle_percent`), or an angle such as
        `"flexion_deg"`.
    label, colour
        The name and colour of this motion.
    reference, reference_label
        Columns of the same names by another method, drawn as black dots: at most 40, evenly spaced.

    Returns
    -------
    The axes; lines have the gid `curve` and the name of the column, such as `curve:area_mm2`, those of the reference
    `reference:…`.
    """
    drawn = _quantity([table] if reference is None else [table, reference], quantity)
    along = along or next(iter(table))
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 52) as ax:
        for (name, words), line in zip(drawn.columns, STYLES):
            ax.plot(column(table, along), column(table, name), linestyle=line, color=colour, label=_label(label, words),
                    gid=f"curve:{name}")
        if reference is not None:
            marked = max(1, -(-len(column(reference, along)) // 40))
            for i, (name, _) in enumerate(drawn.columns):
                ax.plot(column(reference, along), column(reference, name), linestyle="none", marker=".", markersize=3.5,
                        markevery=marked, color=style.BLACK, zorder=3, label="_more" if i else reference_label,
                        gid=f"reference:{name}")
        _finish(ax, along, drawn)
    return ax


def cycles(tables: Sequence[Table], quantity: QuantityName, *, ax: Optional[Axes] = None, label: Optional[str] = None,
           colour: str = style.BLUE) -> Axes:
    """Draws the mean of a quantity over several cycles, and one standard deviation to either side.

    Parameters
    ----------
    tables
        Two or more of `cycle.csv`, as `files.read_curves` gives them, with the same `cycle_percent`. A gap in one is
        left out of the mean there.
    quantity, ax, label, colour
        As for `curve`; of a quantity with two columns the first one, the largest value.

    Returns
    -------
    The axes; the mean has the gid `mean`, the band `deviation` (of a sample: divided by n - 1).
    """
    if len(tables) < 2:
        raise UsageError(f"{len(tables)} cycle: a mean needs two or more")
    drawn = _quantity(tables, quantity)
    percent = column(tables[0], "cycle_percent")
    if any(not np.array_equal(column(table, "cycle_percent"), percent) for table in tables[1:]):
        raise UsageError("the cycles are not sampled at the same cycle_percent")
    name, words = drawn.columns[0]
    values = np.array([column(table, name) for table in tables])
    known = np.isfinite(values)
    count = known.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):  # NaN where too few are known
        mean = np.where(known, values, 0).sum(axis=0) / count
        deviation = np.sqrt(np.square(np.where(known, values - mean, 0)).sum(axis=0) / (count - 1))
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 52) as ax:
        ax.fill_between(percent, mean - deviation, mean + deviation, color=colour, alpha=0.25, linewidth=0,
                        gid="deviation")
        ax.plot(percent, mean, color=colour, label=_label(label, f"{words} mean ± 1 SD, n = {len(tables)}".strip()),
                gid="mean")
        _finish(ax, "cycle_percent", drawn)
    return ax


def panels(table: Table, *, along: Optional[str] = None, label: Optional[str] = None, reference: Optional[Table] = None,
           reference_label: str = "reference") -> Figure:
    """Area, depth, pressure and force of one motion, as far as there are, or clearance or gap if nothing touches, and the degrees
    left to the nearest limit: a figure, which it returns.

    Arguments are those of `curve`. It is as wide as a page, with one quantity as a column.
    """
    import matplotlib.pyplot as plt

    free: List[QuantityName] = ["limit", "clearance", "gap"]
    shown: List[QuantityName] = [name for name in QUANTITIES if name not in free and has(table, name)]
    if not any((column(table, name) > 0).any() for each in shown for name, _ in QUANTITIES[each].columns):
        shown = [name for name in (free[:2] if has(table, "clearance") else free[2:]) if has(table, name)] or shown
    elif has(table, "limit") and (column(table, "to_limit_deg") > 0).any():
        shown.append("limit")
    if not shown:
        raise UsageError(f"no contact in this table: it has {', '.join(table)}")
    columns = min(2, len(shown))
    rows = -(-len(shown) // columns)
    width_mm = style.SINGLE_COLUMN_MM if columns == 1 else style.DOUBLE_COLUMN_MM
    with style.print_style():
        figure, all_axes = plt.subplots(rows, columns, figsize=style.size_mm(width_mm, 50 * rows), layout="constrained", squeeze=False)
        for i, ax in enumerate(all_axes.flat):
            if i >= len(shown):
                ax.set_axis_off()
                continue
            known = None if reference is None or not has(reference, shown[i]) else reference
            curve(table, shown[i], ax=ax, along=along, label=label, reference=known, reference_label=reference_label)
            if columns > 1:
                ax.text(-0.01, 1.03, "abcde"[i], transform=ax.transAxes, fontweight="bold", ha="right")
    return figure
