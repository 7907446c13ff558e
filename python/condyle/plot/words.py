"""Names of motions, angles and ticks as a reader wants them."""
from __future__ import annotations

import math
from typing import Any, Optional

MINUS = "\N{MINUS SIGN}"
OPPOSITE = {
    "flexion": "extension", "adduction": "abduction", "internal_rotation": "external_rotation",
    "dorsiflexion": "plantarflexion", "inversion": "eversion", "varus": "valgus", "pronation": "supination",
    "plane_of_elevation": "posterior_plane_of_elevation", "elevation": "lowering",
}
"""The negative movement of each clinical angle by the name of its positive one."""
_SHORT = {"fadir": "FADIR", "faber": "FABER"}


AS_DEFINED_HERE = "FADIR, FABER: as defined here"
"""A figure's footnote on the two tests, whose angles are not standardised."""


SOFT_TISSUE_MARK = "†"
SOFT_TISSUE_ENDS = f"{SOFT_TISSUE_MARK} soft tissue usually ends it first"
"""A figure's footnote on motions with the caveat `soft_tissue_ends`."""


def scope_clause(result: Any) -> str:
    """The bodies in contact, the first clause of a result's `scope`; empty if it has none."""
    return str(of(result, "scope") or "").partition(";")[0]


def is_as_defined_here(name: str) -> bool:
    """Whether a motion is one of these."""
    return name in _SHORT


def spaced(name: str) -> str:
    """Blanks for underscores: "internal rotation" of "internal_rotation"."""
    return name.replace("_", " ")


def capitalised(text: str) -> str:
    """The first letter as a capital, the others as they are."""
    return text[:1].upper() + text[1:]


def in_sentence(name: str) -> str:
    """ "internal rotation at 90° flexion" of "internal_rotation_at_90_flexion"; FADIR and FABER in capitals."""
    return _SHORT.get(name) or spaced(name.replace("_at_90_flexion", "_at_90°_flexion"))


def motion_name(name: str) -> str:
    """The same with its first letter as a capital."""
    return capitalised(in_sentence(name))


def cut(text: str, longest: int) -> str:
    """A text of at most so many letters; an ellipsis stands for the rest."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def in_two_lines(text: str, longest: int = 20) -> str:
    """A text longer than this broken at the blank nearest to its middle; lines are cut where they are far longer still."""
    blanks = [i for i, letter in enumerate(text) if letter == " "]
    if len(text) <= longest or not blanks:
        return cut(text, longest)
    at = min(blanks, key=lambda i: abs(2 * i + 1 - len(text)))
    return "\n".join(cut(line, longest + longest // 4) for line in (text[:at], text[at + 1 :]))


def number(value: float) -> str:
    """As short as it can be, with a true minus sign; no minus before zero."""
    return f"{value + 0.0:g}".replace("-", MINUS)


def step_of_ticks(span: float, steps: int) -> float:
    """The distance between ticks for at most this many steps over a span of degrees, at least 1: 1, 2, 5, 10, then
    15, 20, 30, 45, 60 and multiples of 90, as people divide angles."""
    for step in (1, 2, 5, 10, 15, 20, 30, 45, 60):
        if step * steps >= span:
            return float(step)
    return 90.0 * math.ceil(span / (90 * steps))


SYMBOLS = {"deg": "°", "mm": "mm"}
"""Of the units of a map's coordinates."""


def angle_axis(positive: str, negative: str, low: float, high: float, *, symbol: str = "°") -> str:
    """Label of an axis of a clinical angle: "flexion (°)", and with its opposite where the axis has both; of a translation "x (mm)"."""
    if symbol != "°":
        return f"{spaced(positive)} ({symbol})"
    if low < 0 < high:
        return f"{spaced(positive)} (+) / {spaced(negative)} ({MINUS}) (°)"
    if high <= 0 and low < 0:
        return f"{spaced(positive)} (°, negative: {spaced(negative)})"
    return f"{spaced(positive)} (°)"


def of(source: Any, name: str, default: Optional[Any] = None) -> Any:
    """The entry of a result by this name: a key of a mapping, or an attribute of an object; else the default."""
    if isinstance(source, dict):
        return source.get(name, default)
    return getattr(source, name, default)
