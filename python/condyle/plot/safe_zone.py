"""The designs of a sweep that leave all targets free: over two parameters, along one, or over more in small multiples."""
from __future__ import annotations

import math
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from .._errors import UsageError
from .._sweep import Sweep
from . import style
from .words import capitalised, cut, number, step_of_ticks

Array = NDArray[np.float64]
ZONE = "#cfe8f7"
#: Ends of safe intervals have these colours and then these lines, target by target.
LINES = ("-", (0, (3, 1)), (0, (1, 1)))
MOST_PANELS = 12
MOST_CONTOURS = 8
#: Designs that miss by more have one colour.
LOWEST_CONTOUR_DEG = -30.0


class Zone(NamedTuple):
    """The drawn part of a sweep: parameters with several values, and the results of their designs."""

    names: Tuple[str, ...]
    units: Tuple[str, ...]
    axes: Tuple[Array, ...]
    targets: Tuple[str, ...]
    over_deg: Array  #: (n1, ..., T): limits less reach
    margin_deg: Array
    probability: Optional[Array]
    #: Values of all parameters but the last one, low, high, and the targets that end it there.
    intervals: List[Tuple[Tuple[float, ...], float, float, Optional[str], Optional[str]]]
    here: Tuple[float, ...]
    best: Optional[Tuple[float, ...]]


SweepLike = Union[Sweep, Mapping[str, object], Zone]


def zone_of(result: SweepLike) -> Zone:
    """From a `condyle.Sweep`, or from the answer of `files.read_sweep` for a folder."""
    if isinstance(result, Zone):
        return result
    if isinstance(result, Sweep):
        reach = [target.reach_deg for target in result.targets]
        return _of_several_values(
            result.axes, result.units, tuple(target.name for target in result.targets), result.limits_deg - np.array(reach),
            result.margin_deg, result.probability,
            [(tuple(each.values.values()), each.low, each.high, each.low_target, each.high_target) for each in result.safe_intervals],
            result.here.values, result.best.values if result.best else None)
    return _of_several_values(**result)  # type: ignore[arg-type]


def _of_several_values(axes: Dict[str, Array], units: Dict[str, str], targets: Sequence[str], over_deg: Array, margin_deg: Array,
                       probability: Optional[Array], intervals: List[Any], here: Dict[str, float],
                       best: Optional[Dict[str, float]]) -> Zone:
    """Without parameters of one value; where the last one has one, intervals along it say nothing."""
    names = list(axes)
    kept = [k for k, name in enumerate(names) if len(axes[name]) > 1]
    if not kept:
        raise UsageError("nothing to draw: the sweep is of one design")
    shape = tuple(len(axes[names[k]]) for k in kept)
    others = [k for k in kept if k < len(names) - 1]
    along_last = kept[-1] == len(names) - 1
    return Zone(
        tuple(names[k] for k in kept), tuple(units.get(names[k], "") for k in kept), tuple(np.asarray(axes[names[k]]) for k in kept),
        tuple(targets), over_deg.reshape(*shape, len(targets)), margin_deg.reshape(shape),
        None if probability is None else probability.reshape(shape),
        [(tuple(values[k] for k in others), low, high, low_target, high_target)
         for values, low, high, low_target, high_target in intervals] if along_last else [],
        tuple(here[names[k]] for k in kept), None if best is None else tuple(best[names[k]] for k in kept))


def _parameter(zone: Zone, k: int) -> str:
    return zone.names[k].replace(".", " ").replace("_", " ")


def _label(zone: Zone, k: int) -> str:
    unit = {"deg": "°"}.get(zone.units[k], zone.units[k])
    return capitalised(_parameter(zone, k)) + (f" ({unit})" if unit not in ("", "1") else "")


def _looks(names: Sequence[str]) -> Dict[str, Dict[str, Any]]:
    """Colour and line of each of these targets."""
    return {name: {"color": style.CYCLE[i % len(style.CYCLE)], "linestyle": LINES[i // len(style.CYCLE) % len(LINES)]}
            for i, name in enumerate(names)}


def _ending(zone: Zone) -> List[str]:
    """The targets that end a safe interval, in their order."""
    ending = {each for *_, low, high in zone.intervals for each in (low, high)}
    return [name for name in zone.targets if name in ending]


def _ends(zone: Zone) -> Iterator[Tuple[str, List[Tuple[float, float]]]]:
    """Border of a zone over two parameters: pieces from line to line, each with the target that ends it; half way between two
    lines where these differ, and to where the zone leaves what was swept."""
    x_of = zone.axes[0]
    lines: Dict[int, List[Tuple[float, float, Optional[str], Optional[str]]]] = {}
    for values, low, high, low_target, high_target in zone.intervals:
        lines.setdefault(int(np.argmin(np.abs(x_of - values[0]))), []).append((low, high, low_target, high_target))
    for i in range(len(x_of) - 1):
        for low, high, low_target, high_target in lines.get(i, []):
            for next_low, next_high, next_low_target, next_high_target in lines.get(i + 1, []):
                if next_low > high or low > next_high:
                    continue
                for edge, at, target, next_at, next_target in ((0, low, low_target, next_low, next_low_target),
                                                               (-1, high, high_target, next_high, next_high_target)):
                    middle = ((x_of[i] + x_of[i + 1]) / 2, (at + next_at) / 2)
                    margin, next_margin = zone.margin_deg[i : i + 2, edge]
                    if (target is None) != (next_target is None) and margin * next_margin < 0:
                        margins, places = zip(*sorted([(margin, x_of[i]), (next_margin, x_of[i + 1])]))
                        middle = (np.interp(0, margins, places), zone.axes[1][edge])
                    if target is not None:
                        yield target, [(x_of[i], at), middle]
                    if next_target is not None:
                        yield next_target, [middle, (x_of[i + 1], next_at)]


def _marks(zone: Zone) -> List[Tuple[Tuple[float, ...], str, str, str]]:
    """Designs with a mark, as far as they lie in what is drawn: where, its marker, gid and words."""
    return [(at, marker, gid, words) for at, marker, gid, words in ((zone.here, "+", "here", "as it is"), (zone.best, "*", "best", "best design"))
            if at is not None and all(axis[0] <= value <= axis[-1] for axis, value in zip(zone.axes, at))]


def _contours(ax: Axes, zone: Zone, values: Array, levels: Array, unit: str) -> None:
    x, y = zone.axes[:2]
    drawn = [level for level in levels if np.nanmin(values) < level < np.nanmax(values) and abs(level) > 1e-9]
    if not drawn:
        return
    lines = ax.contour(x, y, values.T, levels=drawn, colors="black", linewidths=0.4, zorder=2)
    style.tidy(ax, ax.clabel(lines, fmt=lambda level: number(round(level, 6)) + unit, fontsize=style.smaller(2), inline=False),
               [at for at, *_ in _marks(zone)])


def _over_two(ax: Axes, zone: Zone, quantity: str, looks: Dict[str, Dict[str, Any]]) -> None:
    x, y = zone.axes
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])
    ax.set_facecolor(style.LIGHT_GREY)  # shows through where a design is in contact in its reference pose
    known = zone.margin_deg.T
    ax.contourf(x, y, known, levels=[-1e9, 0, 1e9], colors=["white", ZONE], zorder=1)
    if np.nanmin(zone.margin_deg) < 0 <= np.nanmax(zone.margin_deg):
        ax.contour(x, y, known, levels=[0], colors=style.GREY, linewidths=0.8, zorder=2)
    if quantity == "probability":
        assert zone.probability is not None
        _contours(ax, zone, 100 * zone.probability, np.array([5, 25, 50, 75, 90, 95]), " %")
    else:
        low, high = max(float(np.nanmin(zone.margin_deg)), LOWEST_CONTOUR_DEG), float(np.nanmax(zone.margin_deg))
        step = step_of_ticks(max(high - low, 1.0), MOST_CONTOURS)
        _contours(ax, zone, zone.margin_deg, np.arange(math.ceil(low / step), math.floor(high / step) + 1, dtype=np.float64) * step, "°")
    for target, look in looks.items():
        pieces = [piece for name, piece in _ends(zone) if name == target]
        if pieces:
            ax.add_collection(LineCollection(pieces, colors=look["color"], linestyles=[look["linestyle"]], linewidths=1.8, zorder=3,
                                             gid=f"ended by {target}"))
    for at, marker, gid, _ in _marks(zone):
        ax.plot(at[0], at[1], marker=marker, markersize=7 if marker == "+" else 8, color="black", markeredgewidth=1.4 if marker == "+" else 0.4,
                markerfacecolor=style.YELLOW, linestyle="none", zorder=4, clip_on=False, gid=gid)
    for side in ("top", "right"):
        ax.spines[side].set_visible(True)
    ax.set_xlabel(_label(zone, 0))
    ax.set_ylabel(_label(zone, 1))


def _handles(zone: Zone, looks: Dict[str, Dict[str, Any]]) -> List[Any]:
    """Meaning of lines and marks, for the legend."""
    handles: List[Any] = [Patch(facecolor=ZONE, edgecolor=style.GREY, linewidth=0.5, label="all targets free")]
    handles += [Line2D([], [], linewidth=1.8, label=f"ended by {cut(name, 26)}", **look) for name, look in looks.items()]
    if np.isnan(zone.margin_deg).any():
        handles.append(Patch(facecolor=style.LIGHT_GREY, label="in contact at the start"))
    return handles + [Line2D([], [], marker=marker, markersize=6, color="black", markerfacecolor=style.YELLOW,
                             markeredgewidth=1.2 if marker == "+" else 0.4, linestyle="none", label=words) for _, marker, _, words in _marks(zone)]


def legend_entries(zone: Zone) -> int:
    """As many as `margins_along` or `safe_zone` explain."""
    return 2 + len(zone.targets) if len(zone.names) == 1 else len(_handles(zone, _looks(_ending(zone))))


def _slices(zone: Zone) -> List[Tuple[str, Zone]]:
    """The last two of more than two parameters, at values of the others: all of them, or some at equal distances; existing designs of the
    best design, and of the joint as it is, where it lies in the slice."""
    others = len(zone.names) - 2
    counts = [len(axis) for axis in zone.axes[:others]]
    each = counts if math.prod(counts) <= MOST_PANELS else [min(count, 4 if others == 1 else 3) for count in counts]
    picked = [np.unique(np.linspace(0, count - 1, few).round().astype(int)) for count, few in zip(counts, each)]
    return [_slice(zone, tuple(at)) for at in np.stack(np.meshgrid(*picked, indexing="ij"), axis=-1).reshape(-1, others)]


def _slice(zone: Zone, at: Tuple[int, ...]) -> Tuple[str, Zone]:
    """The last two parameters where the others have the values of these numbers, and what the others are."""
    others = len(at)
    values = [float(zone.axes[k][i]) for k, i in enumerate(at)]

    def inside(point: Optional[Tuple[float, ...]]) -> Optional[Tuple[float, ...]]:
        return point[others:] if point is not None and np.allclose(point[:others], values) else None

    title = ", ".join(f"{_parameter(zone, k)} {number(value)}" for k, value in enumerate(values))
    here = inside(zone.here)
    return title, zone._replace(
        names=zone.names[others:], units=zone.units[others:], axes=zone.axes[others:], over_deg=zone.over_deg[at],
        margin_deg=zone.margin_deg[at], probability=None if zone.probability is None else zone.probability[at],
        intervals=[(rest[others:], low, high, low_target, high_target)
                   for rest, low, high, low_target, high_target in zone.intervals if np.allclose(rest[:others], values)],
        here=here if here is not None else (math.nan, math.nan), best=inside(zone.best))


def slice_of_best(zone: Zone) -> Tuple[str, Zone]:
    """Of more than two parameters the slice nearest to the best design, or if there is none to the joint as it is; what the others are."""
    at = zone.best or zone.here
    return _slice(zone, tuple(int(np.argmin(np.abs(axis - value))) for axis, value in zip(zone.axes[:-2], at)))


def margins_along(result: SweepLike, *, ax: Optional[Axes] = None) -> Axes:
    """Draws limits of a sweep over one parameter, less the reach of their targets: free above 0, and the safe values shaded.

    Parameters
    ----------
    result
        A `condyle.Sweep` over one parameter, or what `files.read_sweep` reads.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    """
    zone = zone_of(result)
    if len(zone.names) != 1:
        raise UsageError(f"the sweep is over {len(zone.names)} parameters: safe_zone draws it")
    x, looks = zone.axes[0], _looks(zone.targets)
    handles = [Patch(facecolor=ZONE, label="all targets free"), Line2D([], [], color=style.BLACK, linewidth=0.8, label="as it is")]
    handles += [Line2D([], [], label=cut(name, 28), **look) for name, look in looks.items()]
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 60 + style.rows_below(len(handles))) as ax:
        for _, low, high, *_ in zone.intervals:
            ax.axvspan(low, high, color=ZONE, zorder=0, gid="safe")
        ax.axhline(0, color=style.GREY, linewidth=0.8, zorder=1)
        for t, (name, look) in enumerate(looks.items()):
            ax.plot(x, zone.over_deg[:, t], zorder=2, gid=name, **look)
        if x[0] <= zone.here[0] <= x[-1]:
            ax.axvline(zone.here[0], color=style.BLACK, linewidth=0.8, zorder=1, gid="here")
        ax.set_xlim(x[0], x[-1])
        ax.set_xlabel(_label(zone, 0))
        ax.set_ylabel("limit less what is needed (°)")
        style.legend_below(ax, is_ours, handles)
    return ax


def safe_zone(result: SweepLike, *, quantity: str = "margin", ax: Optional[Axes] = None, legend: bool = True) -> Axes:
    """Draws where in a plane of two parameters all targets of a sweep are free, with contours, and which target ends the zone where.

    Parameters
    ----------
    result
        A `condyle.Sweep` over two parameters, or what `files.read_sweep` reads.
    quantity
        Quantity of the contours: "margin", degrees beyond the nearest target (below 0: misses it), or "probability".
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    legend
        Whether to explain lines and marks, below.

    Returns
    -------
    The axes. By gid: the border, "ended by NAME", ends of the safe intervals along the last parameter; "here" and "best".
    """
    zone = zone_of(result)
    if len(zone.names) != 2:
        raise UsageError(f"the sweep is over {len(zone.names)} parameters: " +
                         ("margins_along draws it" if len(zone.names) == 1 else "safe_zones draws it"))
    if quantity not in ("margin", "probability"):
        raise UsageError("quantity: there are margin and probability")
    if quantity == "probability" and zone.probability is None:
        raise UsageError("the sweep has no probability: it was made without a band")
    if np.isnan(zone.margin_deg).all():
        raise UsageError("nothing to draw: every design is in contact in its reference pose")
    looks = _looks(_ending(zone))
    handles = _handles(zone, looks)
    is_ours = ax is None
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 68 + (style.rows_below(len(handles)) if legend else 0)) as ax:
        _over_two(ax, zone, quantity, looks)
        if legend:
            style.legend_below(ax, is_ours, handles)
    return ax


def safe_zones(result: SweepLike, *, quantity: str = "margin") -> Figure:
    """Draws a sweep over three or four parameters as planes of the last two, at up to twelve values of the others."""
    zone = zone_of(result)
    if len(zone.names) < 3:
        raise UsageError(f"the sweep is over {len(zone.names)} parameters: safe_zones draws three and four")
    slices = _slices(zone)
    columns = min(4, len(slices))
    rows = -(-len(slices) // columns)
    looks = _looks(_ending(zone))
    is_here_shown = any(not math.isnan(each.here[0]) for _, each in slices)
    handles = _handles(zone if is_here_shown else zone._replace(here=tuple(math.nan for _ in zone.here)), looks)
    with style.print_style():
        figure, all_axes = plt.subplots(rows, columns, sharex=True, sharey=True, squeeze=False, layout="constrained",
                                        figsize=style.size_mm(style.DOUBLE_COLUMN_MM, 8 + 46 * rows + style.rows_below(len(handles), 4)))
        for ax, (title, each) in zip(all_axes.flat, slices):
            ax.set_title(title, fontsize=style.smaller(1))
            if np.isnan(each.margin_deg).all():
                ax.set_facecolor(style.LIGHT_GREY)
                continue
            _over_two(ax, each, quantity, looks)
            ax.label_outer()
        for ax in all_axes.flat[len(slices):]:
            ax.set_visible(False)
        style.legend_below(all_axes[0][0], True, handles, 4)
    return figure
