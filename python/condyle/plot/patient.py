"""What is drawn of a patient's folder, as `condyle hip` leaves it: figures of each side, a sheet of each, one figure of both."""
from __future__ import annotations

import functools
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

from matplotlib.figure import Figure

from . import files
from .both_sides import both_sides
from .case_sheet import sheet
from .folder import Drawing, found_in
from .pressure_surface import Projection

_SHEET = {"limits": "rom.json", "measures": "measures.json", "plan": "resection.json"}
"""Folders of a side that its sheet is made of, by the file that is in each when it is whole."""


def sides_of(folder: Path) -> List[str]:
    """The sides of a patient whose limits are in a folder; none if it is of something else."""
    return [side for side in ("left", "right") if (folder / side / "limits" / "rom.json").exists()]


def figures_of(folder: Path, frames: Optional[Sequence[int]] = None, projection: Projection = "plane") -> List[Drawing]:
    """Figures of each side, by names below the patient's folder, and of both if there are two. Files are read here.

    Raises ReadError if a file is bad, or of the other side.
    """
    limits = {side: _limits(folder / side / "limits", side) for side in sides_of(folder)}
    found = [(f"{side}/{part}/{name}", draw) for side in limits for part in ("limits", "measures") if (folder / side / part).is_dir()
             for name, draw in found_in(folder / side / part, frames, projection)]
    return found + [("both", functools.partial(_both, limits))] * (len(limits) == 2)


def sheets_of(folder: Path, heading: Mapping[str, str]) -> List[Tuple[str, Callable[[], List[Figure]]]]:
    """Pages of each side, from what is there of its limits, measures and plan; `heading` has the case, date and note of `sheet`."""
    sheets: List[Tuple[str, Callable[[], List[Figure]]]] = []
    for side in sides_of(folder):
        parts = [folder / side / part for part, name in _SHEET.items() if (folder / side / part / name).exists()]
        sheets.append((f"{side}/sheet", functools.partial(sheet, parts, **heading)))
    return sheets


def _limits(folder: Path, side: str) -> Dict[str, Any]:
    result = files.read_rom(folder)
    if result.get("side") not in (None, side):
        raise files.ReadError(f"{folder / 'rom.json'}: of the {result['side']} side, in the folder of the {side} one")
    return result


def _both(limits: Mapping[str, Dict[str, Any]]) -> Figure:
    return both_sides(**limits).figure
