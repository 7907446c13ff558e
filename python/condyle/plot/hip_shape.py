"""The shape of a hip around the clock: alpha angles of the neck, centre-edge angles of the rim."""
from __future__ import annotations

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from .._errors import UsageError
from .._hip_measures import HipMeasures
from . import style
from .rim_clock import clock_text
from .words import of

Array = NDArray[np.float64]
ShapeLike = Union[HipMeasures, Mapping[str, object]]

#: From 6 over 9, 12 and 3 to 6 again: what is in front and above stands together, 12 in the middle.
_HOURS = (6, 9, 12, 3, 6)
_NAMED_ALPHAS = (("alpha_12_deg", 0.0), ("alpha_1_30_deg", 1.5), ("alpha_3_deg", 3.0))
#: Hours from 12 between which the half-plane of each section meets the rim.
_SECTIONS = (("lateral", -1.5, 1.5), ("anterior", 0.0, 6.0), ("posterior", -6.0, 0.0))


class _Named(NamedTuple):
    """A measure of the hip: its value, and the range of other people's, or that of patients."""

    value: Optional[float]
    normal: Optional[Tuple[float, float]]
    patients: Optional[Tuple[float, float]]


def _named(shape: ShapeLike, key: str) -> _Named:
    found: Any = shape[key] if isinstance(shape, HipMeasures) else of(shape, "measures")[key]
    patients = found.get("patients") if isinstance(found, Mapping) else found.patients
    return _Named(of(found, "value"), _ends(of(found, "normal")), _ends(patients))


def _ends(span: Any) -> Optional[Tuple[float, float]]:
    return None if span is None else (float(of(span, "low")), float(of(span, "high")))


def _along_axis(hours: Array) -> Array:
    """Hours from 12, -6 to below 6."""
    return np.asarray((hours + 6) % 12 - 6)


def _curve(ax: Axes, hours: Array, values: Array, **look: Any) -> None:
    """Over the axis from left to right, closed at 6 o'clock, broken where there is no value."""
    x = _along_axis(hours)
    order = np.argsort(x, kind="stable")
    x, y = x[order], values[order]
    if len(x) and x[0] == -6:
        x, y = np.append(x, 6), np.append(y, y[0])
    ax.plot(x, y, **look)


def _clock_axis(ax: Axes) -> None:
    ax.set_xlim(-6, 6)
    ax.set_xticks([-6, -3, 0, 3, 6], [str(hour) for hour in _HOURS])
    ax.set_xticks([hour for hour in range(-6, 7)], minor=True)
    ax.set_xlabel("clock hour (12 superior, 3 anterior)")
    ax.grid(axis="y")


def _range(ax: Axes, left: float, right: float, ends: Optional[Tuple[float, float]], label: str,
           gid: str) -> None:
    if ends is None:
        return
    low, high = ends
    ax.add_patch(Rectangle((left, low), right - left, high - low, facecolor=style.LIGHT_GREY, edgecolor="none",
                           zorder=0, label=label, gid=gid))


def _nearest(x: Array, values: Array, value: float, first: float, last: float) -> float:
    """Where between two places of the axis a curve is nearest to a value."""
    off = np.where((x >= first) & (x <= last) & np.isfinite(values), np.abs(values - value), np.inf)
    return float(x[int(np.argmin(off))])


def _hours(shape: ShapeLike, name: str, what: str) -> Array:
    hours = np.asarray(of(shape, name), dtype=np.float64)
    if hours.size == 0:
        raise UsageError(f"no {what} was found in this hip, so nothing goes around it")
    return hours


def alpha_by_clock(shape: ShapeLike, *, ax: Optional[Axes] = None, legend: bool = True) -> Axes:
    """Draws the alpha angle at every hour around the neck, at tolerances of 0.5 and 1 mm.

    12, 1:30 and 3 o'clock have dots, the largest from 11 to 4 a diamond. Between the two lines is shaded where they
    differ by more than 5 degrees: there the contour leaves its circle slowly, and the angle depends on how closely one
    looks.

    Parameters
    ----------
    shape
        The answer of `condyle.Joint.measures`, or of `files.read_measures` for the folder of `condyle measure`.
    ax
        Where to draw; without it new axes as wide as a column, under `print_style`.
    legend
        Whether to explain lines and marks.

    Returns
    -------
    The axes; lines have the gids `alpha` and `alpha_at_1mm`, dots `named`, the diamond `largest`, the shading
    `doubtful`.
    """
    hours = _hours(shape, "neck_hour", "neck")
    at_half, at_one = (np.asarray(of(shape, name), dtype=np.float64) for name in ("alpha_deg", "alpha_at_1mm_deg"))
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 62) as ax:
        normal = _named(shape, "alpha_1_30_deg").normal
        _range(ax, _NAMED_ALPHAS[0][1], _NAMED_ALPHAS[-1][1], normal, "range of others", "normal_range")
        doubtful = np.abs(at_half - at_one) > 5
        if doubtful.any():
            ax.bar(_along_axis(hours)[doubtful], (at_half - at_one)[doubtful], width=12 / len(hours),
                   bottom=at_one[doubtful], color=style.ORANGE, alpha=0.4, linewidth=0, label="differ by over 5°",
                   gid="doubtful")
        _curve(ax, hours, at_half, color=style.BLUE, label="at 0.5 mm", gid="alpha")
        _curve(ax, hours, at_one, color=style.BLUE, linestyle="--", linewidth=0.8, label="at 1 mm", gid="alpha_at_1mm")
        named = [(hour, value) for key, hour in _NAMED_ALPHAS if (value := _named(shape, key).value) is not None]
        for hour, value in named:
            ax.plot(hour, value, marker="o", color=style.BLUE, linestyle="none", gid="named")
            ax.annotate(f"{value:.0f}°", (hour, value), xytext=(0, 4), textcoords="offset points", ha="center",
                        fontsize=style.smaller(1.5), path_effects=style.white_border())
        largest, at = (_named(shape, key).value for key in ("alpha_largest_deg", "alpha_largest_hour"))
        if largest is not None and at is not None:
            ax.plot(_along_axis(np.array([at])), [largest], marker="D", color=style.VERMILION, linestyle="none",
                    label=f"largest, {largest:.0f}° at {clock_text(at)}", gid="largest")
        _clock_axis(ax)
        ax.set_ylabel("alpha angle (°)")
        if legend:
            ax.legend(fontsize=style.smaller(2), loc="upper left")
    return ax


def centre_edge_by_clock(shape: ShapeLike, *, ax: Optional[Axes] = None, legend: bool = True) -> Axes:
    """Draws how far from superior the rim is seen from the head's centre, at every hour around the socket.

    Dots are the angles of the lateral, anterior and posterior section, where the rim has them: not at 12, 3 and 9
    o'clock where a socket is turned. Arguments are those of `alpha_by_clock`.

    Returns
    -------
    The axes; the line has the gid `centre_edge`, the dots of the sections `section`.
    """
    hours = _hours(shape, "rim_hour", "rim")
    with style.drawing(ax, style.SINGLE_COLUMN_MM, 62) as ax:
        angles = np.asarray(of(shape, "centre_edge_deg"), dtype=np.float64)
        _range(ax, *_SECTIONS[0][1:], _named(shape, "centre_edge_lateral_section_deg").patients, "patients, lateral", "patients_range")
        _curve(ax, hours, angles, color=style.BLUE, label="rim", gid="centre_edge")
        for name, first, last in _SECTIONS:
            value = _named(shape, f"centre_edge_{name}_section_deg").value
            if value is None:
                continue
            at = _nearest(_along_axis(hours), angles, value, first, last)
            ax.plot(at, value, marker="o", linestyle="none", color=style.BLUE, gid="section")
            ax.annotate(f"{name} section {value:.0f}°", (at, value), xytext=(4, 4 if name == "posterior" else -4),
                        textcoords="offset points", va="bottom" if name == "posterior" else "top",
                        fontsize=style.smaller(1.5))
        _clock_axis(ax)
        ax.set_ylabel("from superior to the rim (°)")
        ax.set_ylim(bottom=0)
        frame = str(of(shape, "pelvis_frame") or "")
        ax.text(0.99, 0.01, frame, transform=ax.transAxes, ha="right", va="bottom", fontsize=style.smaller(2),
                color="#555555", gid="frame")
        if legend:
            ax.legend(fontsize=style.smaller(2), loc="upper center")
    return ax


def hip_shape(shape: ShapeLike) -> Figure:
    """Alpha angles and centre-edge angles by the clock, side by side: a figure as wide as a page, which it returns.

    For a hip in which only one of neck and rim was found, only that one.
    """
    import matplotlib.pyplot as plt

    drawn: Dict[str, Any] = {"neck_hour": alpha_by_clock, "rim_hour": centre_edge_by_clock}
    there: List[Any] = [draw for name, draw in drawn.items() if np.size(of(shape, name))]
    if not there:
        raise UsageError("neither neck nor rim was found in this hip")
    with style.print_style():
        width = style.DOUBLE_COLUMN_MM if len(there) == 2 else style.SINGLE_COLUMN_MM
        figure, all_axes = plt.subplots(1, len(there), figsize=style.size_mm(width, 62), layout="constrained",
                                        squeeze=False)
        for i, (ax, draw) in enumerate(zip(all_axes.flat, there)):
            draw(shape, ax=ax)
            if len(there) == 2:
                ax.text(-0.01, 1.03, "ab"[i], transform=ax.transAxes, fontweight="bold", ha="right")
    return figure
