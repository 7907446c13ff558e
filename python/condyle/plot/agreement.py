"""How well two methods agree, and what many of them cost."""
from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from .._errors import UsageError
from . import style
from .rim_clock import spread_apart

Array = NDArray[np.float64]


def _pairs(ours: ArrayLike, theirs: ArrayLike) -> "tuple[Array, Array]":
    a, b = np.asarray(ours, dtype=np.float64).ravel(), np.asarray(theirs, dtype=np.float64).ravel()
    if a.shape != b.shape:
        raise UsageError(f"{len(a)} values of one method and {len(b)} of the other")
    known = np.isfinite(a) & np.isfinite(b)
    if known.sum() < 2:
        raise UsageError(f"{int(known.sum())} pairs of values: agreement needs two or more")
    return a[known], b[known]


def agreement(ours: ArrayLike, theirs: ArrayLike, *, unit: str, ax: Optional[Axes] = None,
              names: Sequence[str] = ("ours", "theirs"), quantity: str = "") -> Axes:
    """Draws differences of two methods against their means, with bias and limits of agreement.

    After J. M. Bland and D. G. Altman, Lancet 327 (1986): bias is the mean difference, ours less theirs, and the limits
    are 1.96 standard deviations (n - 1) to either side.

    Parameters
    ----------
    ours, theirs
        As many values each, in the same unit; pairs with NaN are left out.
    unit, quantity, names
        For the axes: "mm²", "contact area", ("Condyle", "JAM").
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.

    Returns
    -------
    The axes; lines have the gids `bias`, `lower`, `upper`, the points `pairs`.
    """
    a, b = _pairs(ours, theirs)
    difference = a - b
    bias, spread = float(difference.mean()), 1.96 * float(difference.std(ddof=1))
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 58) as ax:
        ax.plot((a + b) / 2, difference, "o", color=style.BLUE, markersize=3, markeredgewidth=0, alpha=0.7, gid="pairs")
        for value, name, words, line in ((bias, "bias", "bias", "-"), (bias - spread, "lower", f"{-1.96:.2f} SD", "--"),
                                         (bias + spread, "upper", "+1.96 SD", "--")):
            ax.axhline(value, color=style.VERMILION, linestyle=line, linewidth=0.9, gid=name)
            ax.annotate(f"{words.replace('-', '−')}\n{value:.3g}".replace("-", "−"), (1.01, value),
                        xycoords=("axes fraction", "data"), va="center", fontsize=style.smaller(1.5))
        what = f"{quantity}, " if quantity else ""
        ax.set_xlabel(f"{what}mean of both ({unit})")
        ax.set_ylabel(f"{names[0]} less {names[1]} ({unit})")
        ax.margins(y=0.15)
    return ax


class Series(NamedTuple):
    """One method: `label` beside its last point, `family` for its colour, `x` and `y` as many, above 0 (`y` at least
    0).
    """

    label: str
    family: str
    x: Sequence[float]
    y: Sequence[float]


MARKERS = "osD^vP*X"
LINE_MM = 3.0


def many_methods(series: Sequence[Series], *, x_label: str, y_label: str, ax: Optional[Axes] = None,
                 zero_label: Optional[str] = None) -> Axes:
    """Draws what many methods take or how wrong they are, both axes logarithmic, each named at the right.

    Parameters
    ----------
    series
        A line each; colours and marks distinguish families.
    x_label, y_label
        With units.
    ax
        Where to draw; without it new axes as wide as a page, high enough for all labels, under `print_style`.
    zero_label
        Where values of 0 are possible: the name of the row below all others that holds them, such as "none".

    Returns
    -------
    The axes; lines have the gid `series:LABEL`.
    """
    if not series:
        raise UsageError("no methods to draw")
    families: Dict[str, str] = {}
    for one in series:
        families.setdefault(one.family, style.CYCLE[len(families) % len(style.CYCLE)])
    marks = {family: MARKERS[i % len(MARKERS)] for i, family in enumerate(families)}
    positive = [y for one in series for y in one.y if y > 0]
    if not positive:
        raise UsageError("no value above 0: nothing to draw on a logarithmic axis")
    low = 10.0 ** np.floor(np.log10(min(positive)))
    zero = low / 10 ** 0.5
    is_ours = ax is None
    height = max(70.0, 16 + LINE_MM * len(series))
    with style.drawing(ax, style.DOUBLE_COLUMN_MM, height + style.rows_below(len(families), 4)) as ax:
        ax.set_xscale("log")
        ax.set_yscale("log")
        for one in series:
            ax.plot(one.x, [y if y > 0 else zero for y in one.y], marker=marks[one.family], color=families[one.family],
                    linewidth=0.8, markersize=3.2, clip_on=False, gid=f"series:{one.label}")
        ax.set_ylim((zero if zero_label else low), 10.0 ** np.ceil(np.log10(max(positive))))
        if zero_label and any(y == 0 for one in series for y in one.y):
            ax.axhline(low / 10**0.25, color=style.GREY, linewidth=0.5, linestyle=":")
            ax.text(-0.01, zero, zero_label, transform=ax.get_yaxis_transform(), ha="right", va="center",
                    fontsize=style.smaller(1))
        ax.grid(which="major")
        ax.set_xlabel(x_label)
        ax.set_ylabel(y_label)
        _name(ax, series, families, zero, height)
        handles = [Line2D([], [], marker=marks[f], color=colour, linewidth=0.8, markersize=3.5, label=f)
                   for f, colour in families.items()]
        style.legend_below(ax, is_ours, handles, 4)
    return ax


def _name(ax: Axes, series: Sequence[Series], colours: Dict[str, str], zero: float, height_mm: float) -> None:
    """Names in one column at the right, moved apart, with a thin line from the last point of each."""
    low, high = np.log10(ax.get_ylim())

    def part(one: Series) -> float:
        last = one.y[-1] if one.y[-1] > 0 else zero
        return float((np.log10(last) - low) / (high - low))

    ordered: List[Series] = sorted(series, key=part)
    gap = LINE_MM / (height_mm - 12)
    at = spread_apart([part(one) for one in ordered], [gap] * (len(ordered) - 1), 0.0, 1.0)
    for one, y in zip(ordered, at):
        x = one.x[-1], one.y[-1] if one.y[-1] > 0 else zero
        ax.annotate(one.label, x, xytext=(1.03, y), textcoords="axes fraction", va="center", fontsize=style.smaller(2),
                    color="black", annotation_clip=False,
                    arrowprops=dict(arrowstyle="-", color=colours[one.family], linewidth=0.4, shrinkA=0, shrinkB=1,
                                    relpos=(0, 0.5)))
