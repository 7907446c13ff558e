"""All figures that a folder of results has data for."""
from __future__ import annotations

import functools
from pathlib import Path
from typing import Any, Callable, Dict, List, Literal, Optional, Sequence, Tuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from . import files, style
from .hip_shape import hip_shape
from .limit_bars import limits
from .map_contours import VIEWS, View, ligaments_of, map_ends, motion_map
from .motion_curves import QUANTITIES, has, panels
from .pressure_surface import Projection, add_scale, laid_flat, pressure_map, quantity_label
from .rim_clock import clock_face
from .safe_zone import Zone, margins_along, safe_zone, safe_zones, zone_of

Drawing = Tuple[str, Callable[[], Figure]]
"""Name of a figure without its ending, and what draws it."""


def drawings(folder: Path, frames: Optional[Sequence[int]] = None, projection: Projection = "plane") -> List[Drawing]:
    """The contents of a folder that can be drawn; files are read here, so that a bad one is reported before anything is written.

    Raises ReadError where there is nothing, or a file is bad.
    """
    if not folder.is_dir():
        raise files.ReadError(f"{folder}: not a folder")
    found = found_in(folder, frames, projection)
    if not found:
        raise files.ReadError(f"{folder}: neither rom.json nor curves.csv nor sweep.json nor measures.json of a hip in it, "
                              "nor left/limits/rom.json nor right/limits/rom.json nor study.json")
    return found


def found_in(folder: Path, frames: Optional[Sequence[int]] = None, projection: Projection = "plane") -> List[Drawing]:
    """The same; nothing if there is nothing to draw."""
    found: List[Drawing] = []
    if (folder / "rom.json").exists():
        found += _of_rom(files.read_rom(folder))
    if (folder / "measures.json").exists():
        shape = files.read_measures(folder)
        if shape["neck_hour"].size or shape["rim_hour"].size:
            found.append(("hip_shape", lambda: hip_shape(shape)))
    if (folder / "sweep.json").exists():
        found += _of_sweep(files.read_sweep(folder))
    if (folder / "curves.csv").exists():
        found += _of_motion(folder, frames, projection)
    elif frames:
        raise files.ReadError(f"{folder}: no curves.csv in it, so no frames to draw")
    return found


def _of_sweep(result: Dict[str, Any]) -> List[Drawing]:
    zone = zone_of(result)
    if len(zone.names) == 1:
        return [("safe_zone", lambda: margins_along(zone).figure)]
    found: List[Drawing] = []
    for quantity in ("margin",) if zone.probability is None else ("margin", "probability"):
        name = "safe_zone" if quantity == "margin" else "safe_probability"
        if len(zone.names) == 2:
            found.append((name, functools.partial(_plane, zone, quantity)))
        else:
            found.append((name, functools.partial(safe_zones, zone, quantity=quantity)))
    return found


def _plane(zone: Zone, quantity: str) -> Figure:
    return safe_zone(zone, quantity=quantity).figure


def _of_rom(result: Dict[str, Any]) -> List[Drawing]:
    name = "limits" if all(motion.get("band") is None for motion in result["motions"]) else "limit_bands"
    found: List[Drawing] = [(name, lambda: limits(result).figure)]
    if any(motion.get("clock_hour") is not None for motion in result["motions"]):
        found.append(("clock_face", lambda: clock_face(result).figure))
    grid = result.get("grid")
    if grid is not None and np.isfinite(grid.lower_deg).any():
        for view in VIEWS:
            movement = {"positive": grid.varied[0], "negative": grid.varied[1]}.get(view, view)
            found.append((f"map_{movement}", functools.partial(_map, result, view)))
            if view != "free_range" and min(grid.lower_deg.shape) > 1 and ligaments_of(grid, view):
                found.append((f"map_{movement}_ends", functools.partial(_ends, result, view)))
    return found


def _map(result: Dict[str, Any], view: View) -> Figure:
    return motion_map(result, view).figure


def _ends(result: Dict[str, Any], side: Literal["positive", "negative"]) -> Figure:
    return map_ends(result, side).figure


def _of_motion(folder: Path, frames: Optional[Sequence[int]], projection: Projection) -> List[Drawing]:
    table = files.read_curves(folder / "curves.csv")
    found: List[Drawing] = []
    if not any(has(table, quantity) for quantity in QUANTITIES):
        raise files.ReadError(f"{folder / 'curves.csv'}: no columns of contact that could be drawn")
    found.append(("curves", lambda: panels(table)))
    if (folder / "cycle.csv").exists():
        cycle = files.read_curves(folder / "cycle.csv")
        found.append(("cycle", lambda: panels(cycle)))
    maps = _maps(folder)
    if frames and not maps:
        raise files.ReadError(
            f"{folder}: no map_mobile_*.vtp with values in it: condyle motion writes them with --maps")
    if maps:
        found.append(_surfaces(folder, maps, frames, projection))
    return found


def _maps(folder: Path) -> Dict[int, Path]:
    """The surfaces that cast, by frame."""
    for body in ("fixed", "mobile"):
        paths = sorted(folder.glob(f"map_{body}_[0-9]*.vtp"))
        if paths and (body == "fixed" or (folder / "map_fixed.vtp").exists()):
            return {int(path.stem.rpartition("_")[2]): path for path in paths}
    return {}


def _chosen(folder: Path, maps: Dict[int, Path], frames: Optional[Sequence[int]]) -> List[int]:
    known = sorted(maps)
    if not frames:
        return sorted({known[0], known[len(known) // 2], known[-1]})
    for frame in frames:
        if frame not in maps:
            raise files.ReadError(f"{folder}: no map of frame {frame}: there are {known[0]} to {known[-1]}")
    return list(frames)


def _surfaces(folder: Path, maps: Dict[int, Path], frames: Optional[Sequence[int]], projection: Projection) -> Drawing:
    chosen = _chosen(folder, maps, frames)
    surfaces = [files.read_surface(maps[frame]) for frame in chosen]
    name = next((name for name in ("pressure_mpa", "depth_mm") if name in surfaces[0].values), None)
    if name is None:
        raise files.ReadError(f"{maps[chosen[0]]}: no cell array pressure_mpa or depth_mm")
    first = files.read_surface(maps[min(maps)])
    answer = files.read_json(folder / "motion.json")
    provenance = answer.get("provenance")
    in_joint_frame = isinstance(provenance, dict) and provenance.get("frame") == "joint"
    side = answer.get("side") if in_joint_frame else None
    return f"{name.rpartition('_')[0]}_map", functools.partial(_side_by_side, surfaces, first, name, side, projection)


def _side_by_side(surfaces: Sequence[files.Surface], first: files.Surface, name: str, side: Optional[str],
                  projection: Projection) -> Figure:
    """All frames laid out as the first of the motion, so that places compare, on one scale."""
    anywhere = np.max([surface.values[name] for surface in surfaces], axis=0) > 0
    weights = np.where(anywhere, 1.0, 0.0) if anywhere.any() else np.ones(len(anywhere))
    flat = laid_flat(projection, first.vertices, first.triangles, weights)
    highest = max(float(surface.values[name].max()) for surface in surfaces)
    points = flat.points_mm[first.triangles[flat.facing | anywhere]].reshape(-1, 2)
    width, height = np.ptp(points, axis=0)
    each_mm = (style.DOUBLE_COLUMN_MM - 32) / len(surfaces)
    with style.print_style():
        figure, all_axes = plt.subplots(1, len(surfaces), sharex=True, sharey=True, squeeze=False, layout="constrained",
                                        figsize=style.size_mm(style.DOUBLE_COLUMN_MM,
                                                              13 + min(each_mm * height / width, 120)))
        for i, (ax, surface) in enumerate(zip(all_axes.flat, surfaces)):
            pressure_map(surface.vertices, surface.triangles, surface.values[name], ax=ax, highest=highest or 1.0, side=side,
                         colour_bar=False, flattened=flat)
            ax.text(0.02, 0.98, "abcdefghijklmnopqrstuvwxyz"[i % 26], transform=ax.transAxes, fontweight="bold",
                    va="top")
            if i:
                ax.set_ylabel("")
        if highest:
            add_scale(all_axes, highest, quantity_label(name))
    return figure
