"""Arguments as people give them, checked once where they enter."""

from __future__ import annotations

import math
import os
from typing import Any, SupportsFloat, Union

from ._errors import UsageError

Path = Union[str, "os.PathLike[str]"]


def path_of(given: Any, name: str = "path") -> str:
    """The path as text; open files and file numbers are none."""
    if not isinstance(given, (str, os.PathLike)):
        raise UsageError(f"{name}: a path is needed, not {type(given).__name__}")
    path = os.fspath(given)
    if not isinstance(path, str):
        raise UsageError(f"{name}: a path of text is needed, not {type(path).__name__}")
    if "\0" in path:
        raise UsageError(f"{name}: a path has no character 0")
    try:
        path.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raise UsageError(f"{name}: a path that cannot be written in UTF-8") from None
    return path


def number(given: SupportsFloat, name: str, low: float = -math.inf, high: float = math.inf) -> float:
    """A finite number from low to high."""
    try:
        if isinstance(given, (str, bytes)):
            raise TypeError
        value = float(given)
    except (TypeError, ValueError, OverflowError):
        raise UsageError(f"{name}: a number is needed, not {type(given).__name__}") from None
    if not math.isfinite(value):
        raise UsageError(f"{name}: a finite number is needed, not {value}")
    if value < low:
        raise UsageError(f"{name}: {value:g} is below {low:g}")
    if value > high:
        raise UsageError(f"{name}: {value:g} is above {high:g}")
    return value


def count(given: Any, name: str, low: int = 0, high: int = 2**31 - 1) -> int:
    """A whole number from low to high."""
    if isinstance(given, bool) or not hasattr(given, "__index__"):
        raise UsageError(f"{name}: a whole number is needed, not {type(given).__name__}")
    try:
        value = given.__index__()
    except TypeError:
        raise UsageError(f"{name}: a whole number is needed, not {type(given).__name__}") from None
    if not low <= value <= high:
        raise UsageError(f"{name}: {value} is not in {low} to {high}")
    return int(value)


def word(given: Any, name: str, known: tuple[str, ...]) -> str:
    """One of the words there are."""
    if not isinstance(given, str) or given not in known:
        said = repr(given) if isinstance(given, str) and len(given) < 60 else type(given).__name__
        raise UsageError(f"{name}: there are {', '.join(known[:-1])} and {known[-1]}, not {said}")
    return given
