"""Reads what `condyle rom`, `motion`, `depth`, `measure` and `sweep` write with `--out`, for figures.

Every reader raises `ReadError` with one line that names file and place.
"""
from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Tuple, Union, get_args

import numpy as np
from numpy.typing import NDArray

from .._csv_text import plain_field
from .._errors import FileError
from .._words import LimitReason
from .motion_grid import MotionGrid

Array = NDArray[np.float64]
PathLike = Union[str, Path]


#: Of a map, as the command refuses more.
MOST_POINTS = 10_000_000


class ReadError(FileError, ValueError):
    """A file that cannot be read, or does not say what a figure needs; the message is one line."""


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise ReadError(f"{path}: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise ReadError(f"{path}: not a text file") from None


def read_json(path: PathLike) -> Dict[str, Any]:
    """The object of a JSON file that some command wrote."""
    path = Path(path)
    try:
        value = json.loads(_text(path))
    except json.JSONDecodeError as error:
        raise ReadError(f"{path}: line {error.lineno}: not JSON: {error.msg}") from None
    except RecursionError:
        raise ReadError(f"{path}: not a result of condyle: its lists are nested too deep") from None
    if not isinstance(value, dict) or "condyle" not in value:
        raise ReadError(f"{path}: not a result of condyle: it has no key 'condyle'")
    return value


def in_folder(path: PathLike, name: str) -> Path:
    """The file of this name in a folder; the file itself where one is given."""
    path = Path(path)
    return path / name if path.is_dir() else path


def _fields(line: str) -> List[str]:
    return [plain_field(field) for field in next(csv.reader([line]))]


def _rows(path: Path, fewest: int = 1) -> Tuple[List[str], List[Tuple[int, List[str]]]]:
    """Names of columns, and the rows with the numbers of their lines; comments are passed over."""
    lines = [(i, line) for i, line in enumerate(_text(path).splitlines(), 1) if line.strip()
             and not line.startswith("#")]
    if len(lines) < 1 + fewest:
        raise ReadError(f"{path}: no rows")
    names = _fields(lines[0][1])
    rows = []
    for i, line in lines[1:]:
        fields = _fields(line)
        if len(fields) != len(names):
            raise ReadError(f"{path}: line {i}: {len(fields)} fields, not {len(names)}")
        rows.append((i, fields))
    return names, rows


def _number(path: Path, line: int, name: str, field: str) -> float:
    try:
        return float(field) if field else math.nan
    except ValueError:
        raise ReadError(f"{path}: line {line}: column '{name}': '{field}' is not a number") from None


def read_curves(path: PathLike) -> Dict[str, Array]:
    """The columns of `curves.csv`, `regions.csv` or `cycle.csv` by name, each as long as there are rows; NaN for a gap.

    The first column is what the curves run along: `time_s`, `frame` or `cycle_percent`.
    """
    path = Path(path)
    names, rows = _rows(path)
    values = np.array([[_number(path, i, name, field) for name, field in zip(names, fields)] for i, fields in rows])
    return {name: values[:, k] for k, name in enumerate(names)}


def read_sto(path: PathLike) -> Dict[str, Array]:
    """The columns of an OpenSim table (`.sto`, `.mot`) by their names, `time` first."""
    path = Path(path)
    lines = _text(path).splitlines()
    starts = [i for i, line in enumerate(lines) if line.strip() == "endheader"]
    if not starts or len(lines) < starts[0] + 3:
        raise ReadError(f"{path}: no 'endheader' with names and rows below it")
    names = lines[starts[0] + 1].split()
    rows = []
    for i in range(starts[0] + 2, len(lines)):
        fields = lines[i].split()
        if not fields:
            continue
        if len(fields) != len(names):
            raise ReadError(f"{path}: line {i + 1}: {len(fields)} fields, not {len(names)}")
        rows.append([_number(path, i + 1, name, field) for name, field in zip(names, fields)])
    values = np.array(rows)
    return {name: values[:, k] for k, name in enumerate(names)}


def read_rom(folder: PathLike) -> Dict[str, Any]:
    """`rom.json` of a folder, or a file by its name; with a map, `"grid"` holds it as a `MotionGrid`."""
    path = in_folder(folder, "rom.json")
    result = read_json(path)
    motions = result.get("motions")
    if not isinstance(motions, list) or not motions:
        raise ReadError(f"{path}: no motions")
    for i, motion in enumerate(motions):
        _check_motion(f"{path}: motion {i}", motion)
    if "map" in result:
        result["grid"] = _read_grid(path.parent, result["map"], path)
    return result


def read_sweep(folder: PathLike) -> Dict[str, Any]:
    """`sweep.json`, `designs.csv` and `safe.csv` of a folder, or beside a file by its name, as `safe_zone` draws them."""
    path = in_folder(folder, "sweep.json")
    folder = path.parent
    answer = read_json(path)
    try:
        axes = {each["name"]: each["first"] + each["step"] * np.arange(each["count"]) for each in answer["parameters"]}
        units = {each["name"]: each["unit"] for each in answer["parameters"]}
        reach = {each["name"]: float(each["reach_deg"]) for each in answer["targets"]}
        here = {name: float(answer["here"]["values"][name]) for name in axes}
        best = answer["best"] and {name: float(answer["best"]["values"][name]) for name in axes}
        share, has_probability = answer["share"]["of"], answer["band"] is not None
    except (KeyError, TypeError, ValueError):
        raise ReadError(f"{path}: not what condyle sweep writes") from None
    if share != 1:
        raise ReadError(f"{folder}: is a share of a sweep: condyle merge puts shares together")
    shape = tuple(len(axis) for axis in axes.values())
    table = _columns_of(folder / "designs.csv", ["margin_deg", *(f"{name}_limit_deg" for name in reach)] + ["probability"] * has_probability)
    if len(table["margin_deg"]) != math.prod(shape):
        raise ReadError(f"{folder / 'designs.csv'}: {len(table['margin_deg'])} designs, not {math.prod(shape)}")
    limits = np.stack([table[f"{name}_limit_deg"] for name in reach], axis=-1)
    return {"axes": axes, "units": units, "targets": list(reach), "over_deg": (limits - np.array(list(reach.values()))).reshape(*shape, -1),
            "margin_deg": table["margin_deg"].reshape(shape),
            "probability": table["probability"].reshape(shape) if has_probability else None,
            "intervals": _safe_intervals(folder / "safe.csv", list(axes)), "here": here, "best": best}


def _columns_of(path: Path, wanted: List[str]) -> Dict[str, Array]:
    names, rows = _rows(path)
    for name in wanted:
        if name not in names:
            raise ReadError(f"{path}: no column '{name}'")
    return {name: np.array([_number(path, i, name, fields[names.index(name)]) for i, fields in rows]) for name in wanted}


def _safe_intervals(path: Path, parameters: List[str]) -> List[Tuple[Any, ...]]:
    *others, last = parameters
    names, rows = _rows(path, 0)
    if names != [*others, f"{last}_low", f"{last}_high", "low_target", "high_target"]:
        raise ReadError(f"{path}: other columns than sweep.json says")
    intervals = []
    for i, fields in rows:
        numbers = [_number(path, i, name, field) for name, field in zip(names, fields[:-2])]
        intervals.append((tuple(numbers[:-2]), *numbers[-2:], fields[-2] or None, fields[-1] or None))
    return intervals


def _check_motion(where: str, motion: Any) -> None:
    """That all which figures read of a motion is of its type."""
    for key in ("name", "limit_deg", "reason"):
        if not isinstance(motion, dict) or key not in motion:
            raise ReadError(f"{where} has no '{key}'")
    if not isinstance(motion["name"], str):
        raise ReadError(f"{where}: 'name' is not a text")
    if motion["reason"] not in get_args(LimitReason):
        raise ReadError(f"{where}: 'reason' is none of {', '.join(get_args(LimitReason))}")
    _check_number(where, motion, "limit_deg")
    for key in ("bearing_contact_deg", "normal_range_deg", "clock_hour", "range_deg"):
        if motion.get(key) is not None:
            _check_number(where, motion, key)
    living = motion.get("living")
    if living is not None and (not isinstance(living, dict) or living.get("expected_deg") is not None):
        _check_number(f"{where}: living", living, "expected_deg")
    caveats = motion.get("caveats", [])
    if not isinstance(caveats, list) or not all(isinstance(each, dict) and isinstance(each.get("code"), str)
                                                for each in caveats):
        raise ReadError(f"{where}: 'caveats' is not a list of objects with a code")
    band = motion.get("band")
    if band is not None:
        for key in ("p5_deg", "median_deg", "p95_deg"):
            _check_number(f"{where}: band", band, key)
        if band.get("share_without_contact") is not None:
            _check_number(f"{where}: band", band, "share_without_contact")


def _check_number(where: str, of: Any, key: str) -> None:
    value = of.get(key) if isinstance(of, dict) else None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ReadError(f"{where}: '{key}' is not a number")


def read_measures(folder: PathLike) -> Dict[str, Any]:
    """`measures.json` of a folder, or a file by its name, as :class:`condyle.HipMeasures` names it: `"measures"` by their keys, and the
    arrays `neck_hour`, `alpha_deg`, `alpha_at_1mm_deg`, `offset_mm`, `rim_hour`, `cover_deg` and `centre_edge_deg`, NaN for measures that
    could not be computed."""
    path = in_folder(folder, "measures.json")
    answer = read_json(path)
    measures = answer.get("measures")
    if not isinstance(measures, list) or not all(isinstance(each, dict) and isinstance(each.get("key"), str)
                                                 for each in measures):
        raise ReadError(f"{path}: 'measures' is not a list of objects with a key")
    for each in measures:
        where = f"{path}: measure '{each['key']}'"
        if each.get("value") is not None:
            _check_number(where, each, "value")
        for span in ("normal", "patients"):
            if each.get(span) is not None:
                for end in ("low", "high"):
                    _check_number(f"{where}: {span}", each[span], end)
    result: Dict[str, Any] = {"measures": {each["key"]: each for each in measures},
                              "pelvis_frame": answer.get("pelvis_frame", "")}
    for around, names in _AROUND.items():
        for name in names:
            result[name] = _around(path, answer, around, names[name])
    return result


#: Lists of measures.json, and what their keys are called in Python.
_AROUND = {
    "around_neck": {"neck_hour": "hour", "alpha_deg": "alpha_deg", "alpha_at_1mm_deg": "alpha_at_1mm_deg",
                    "offset_mm": "offset_mm"},
    "rim": {"rim_hour": "hour", "cover_deg": "cover_deg", "centre_edge_deg": "centre_edge_deg"},
}


def _around(path: Path, answer: Dict[str, Any], around: str, key: str) -> Array:
    entries = answer.get(around)
    if not isinstance(entries, list):
        raise ReadError(f"{path}: '{around}' is not a list")
    values = []
    for i, entry in enumerate(entries):
        if isinstance(entry, dict) and key in entry and entry[key] is None and key != "hour":
            values.append(math.nan)
            continue
        _check_number(f"{path}: {around} {i}", entry, key)
        values.append(float(entry[key]))
    return np.array(values, dtype=np.float64)


class _Interval(NamedTuple):
    low: float
    high: float
    low_open: bool
    high_open: bool
    holds_start: bool
    low_ligament: str
    high_ligament: str


def _read_grid(folder: Path, summary: Dict[str, Any], path: Path) -> MotionGrid:
    """The map of `rom.json`'s `map` and `map_intervals.csv`."""
    try:
        columns, rows = (_axis_values(f"{path}: map: {key}", summary[key]) for key in ("columns", "rows"))
        column, row = ((str(axis["translation" if _unit_of(axis) == "mm" else "angle"]), str(axis["opposite"]))
                       for axis in (summary["columns"], summary["rows"]))
        varied = (str(summary["vary"]), str(summary["vary_opposite"]))
        unit = "mm" if "start_mm" in summary else "deg"
        _check_number(f"{path}: map", summary, f"start_{unit}")
        start = float(summary[f"start_{unit}"])
    except (KeyError, TypeError) as error:
        raise ReadError(f"{path}: map: no {error}") from None
    intervals = _read_intervals(folder / "map_intervals.csv", columns, rows)
    return _grid_of(intervals, column, row, varied, columns, rows, start)._replace(
        units=(_unit_of(summary["columns"]), _unit_of(summary["rows"]), unit))


def _unit_of(axis: Dict[str, Any]) -> str:
    return "mm" if "translation" in axis else "deg"


def _axis_values(where: str, axis: Dict[str, Any]) -> Array:
    first, step, last = (f"{key}_{_unit_of(axis)}" for key in ("first", "step", "last"))
    for key in ("count", first, step, last):
        _check_number(where, axis, key)
    count = axis["count"]
    if not isinstance(count, int) or not 0 < count <= MOST_POINTS:
        raise ReadError(f"{where}: 'count' is not in 1 to {MOST_POINTS}")
    values = axis[first] + axis[step] * np.arange(count)
    if count > 1:
        values[-1] = axis[last]
    return np.asarray(values, dtype=np.float64)


def _read_intervals(path: Path, columns: Array, rows: Array) -> Dict[Tuple[int, int], List[_Interval]]:
    """Free intervals of each grid point (row, column); none of a point that is free nowhere."""
    names, lines = _rows(path, fewest=0)  # none where the joint is free nowhere
    needed = ("low_reason", "high_reason", "holds_start")
    for name in needed:
        if name not in names:
            raise ReadError(f"{path}: no column '{name}'")
    low_reason, high_reason, holds_start = (names.index(name) for name in needed)
    # Earlier versions wrote no names.
    ligaments = [names.index(name) if name in names else None for name in ("low_ligament", "high_ligament")]
    found: Dict[Tuple[int, int], List[_Interval]] = {}
    for i, fields in lines:
        at_column, at_row, low, high = (_number(path, i, names[k], fields[k]) for k in range(4))
        point = _index(path, i, names[1], rows, at_row), _index(path, i, names[0], columns, at_column)
        found.setdefault(point, []).append(
            _Interval(low, high, fields[low_reason] == "end_of_range", fields[high_reason] == "end_of_range",
                      fields[holds_start] == "1", *("" if k is None else fields[k] for k in ligaments)))
    return found


def _index(path: Path, line: int, name: str, values: Array, value: float) -> int:
    nearest = int(np.argmin(np.abs(values - value)))
    if not abs(values[nearest] - value) <= 1e-6:  # degrees or mm; NaN is refused too
        raise ReadError(f"{path}: line {line}: column '{name}': {value:g} is not a value of the grid in rom.json")
    return nearest


def _distance(interval: _Interval, start: float) -> float:
    return max(interval.low - start, start - interval.high, 0.0)


def _grid_of(intervals: Dict[Tuple[int, int], List[_Interval]], column: Tuple[str, str], row: Tuple[str, str],
             varied: Tuple[str, str], columns: Array, rows: Array, start: float) -> MotionGrid:
    shape = (len(rows), len(columns))
    lower, upper = np.full(shape, np.nan), np.full(shape, np.nan)
    lower_open, upper_open, free_at_start = (np.zeros(shape, dtype=bool) for _ in range(3))
    count = np.zeros(shape, dtype=np.int64)
    longest = max((len(name) for of_point in intervals.values() for each in of_point
                   for name in (each.low_ligament, each.high_ligament)), default=0)
    lower_ligament, upper_ligament = (np.zeros(shape, dtype=f"<U{max(longest, 1)}") for _ in range(2))
    for point, of_point in intervals.items():
        held = [interval for interval in of_point if interval.holds_start]
        drawn = held[0] if held else min(of_point, key=lambda interval: _distance(interval, start))
        lower[point], upper[point] = drawn.low, drawn.high
        lower_open[point], upper_open[point] = drawn.low_open, drawn.high_open
        lower_ligament[point], upper_ligament[point] = drawn.low_ligament, drawn.high_ligament
        free_at_start[point], count[point] = bool(held), len(of_point)
    return MotionGrid(column, row, varied, columns, rows, start, lower, upper, lower_open, upper_open, free_at_start,
                      count, lower_ligament, upper_ligament)


class Surface(NamedTuple):
    """A triangle mesh with values: `vertices` (V, 3) in mm, `triangles` (T, 3), `values` by name, each (T,)."""

    vertices: Array
    triangles: NDArray[np.int64]
    values: Dict[str, Array]


def read_surface(path: PathLike) -> Surface:
    """Mesh and cell arrays of a `.vtp` file, as `condyle motion --maps` writes them.

    Needs VTK's Python module (Debian's python3-vtk9); ImportError says so where it is missing.
    """
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkLogger
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    except ImportError:
        raise ImportError(
            "reading .vtp files needs VTK's Python module: install python3-vtk9 (Debian) or vtk") from None
    path = Path(path)
    if not path.is_file():
        raise ReadError(f"{path}: No such file or directory")
    complaints: List[str] = []
    reader = vtkXMLPolyDataReader()
    reader.AddObserver("ErrorEvent", _first_line(complaints))
    reader.SetFileName(str(path))
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # what is wrong is said below, in one line
    try:
        reader.Update()
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)
    data = reader.GetOutput()
    if complaints or reader.GetErrorCode() != 0 or data.GetNumberOfPoints() == 0 or data.GetNumberOfPolys() == 0:
        raise ReadError(f"{path}: not a VTP file with triangles")
    polys = data.GetPolys()
    if polys.GetMaxCellSize() != 3 or polys.GetNumberOfConnectivityIds() != 3 * polys.GetNumberOfCells():
        raise ReadError(f"{path}: not all cells are triangles")
    of_cells = data.GetCellData()
    values = {of_cells.GetArrayName(k): np.array(vtk_to_numpy(of_cells.GetArray(k)), dtype=np.float64)
              for k in range(of_cells.GetNumberOfArrays()) if of_cells.GetArray(k) is not None}
    return Surface(np.array(vtk_to_numpy(data.GetPoints().GetData()), dtype=np.float64),
                   np.array(vtk_to_numpy(polys.GetConnectivityArray()), dtype=np.int64).reshape(-1, 3), values)


def _first_line(complaints: List[str]) -> Callable[..., None]:
    """Takes VTK's complaints, which it would print."""

    def note(_object: Any, _event: str, text: Optional[str] = None) -> None:
        complaints.append((text or "").splitlines()[0] if text else "")

    note.CallDataType = "string0"  # type: ignore[attr-defined]
    return note
