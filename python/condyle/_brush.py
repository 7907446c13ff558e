"""Resection by hand: strokes of a brush on a bone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Generic, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import UsageError
from ._limits import MotionLimit, motion_limit_of
from ._mesh import TriMesh
from ._motion import Motions
from ._native import Joint as NativeJoint
from ._resection import OfJoint, kept_vertices
from ._words import BearingRule, Body, BrushAction, count, number, word


@dataclass(frozen=True)
class BrushStroke:
    """A path of the brush over a bone's surface.

    Attributes
    ----------
    along : int or sequence of int
        Vertices of the bone's mesh.
    radius_mm : float
        The whole depth reaches half as far from the path, on the surface before; from there it falls smoothly to nothing. At most 30.
    depth_mm : float
        Below the surface before any stroke, at most 20. Not read by "restore".
    action : "lower" or "restore"
        "restore" puts back what strokes before took.
    """

    along: Union[int, Sequence[int]]
    radius_mm: float = 6
    depth_mm: float = 2
    action: BrushAction = "lower"

    def _tuple(self, mesh: TriMesh) -> tuple[bool, list[int], float, float]:
        given = [self.along] if np.ndim(self.along) == 0 else list(self.along)  # type: ignore[arg-type]
        along = [count(vertex, "along", 0, len(mesh.vertices) - 1) for vertex in given]
        merged = along if mesh.vertex_map is None else [int(mesh.vertex_map[vertex]) for vertex in along]
        return (word(self.action, "action", BrushAction) == "restore", merged, number(self.radius_mm, "radius_mm"),
                number(self.depth_mm, "depth_mm"))


class StrokeOutcome(NamedTuple):
    """Counts of one stroke: vertices that it moved, vertices in its reach that must stay, and those less deep than requested because the
    surface would turn over or run through itself."""

    moved: int
    kept: int
    limited: int


@dataclass(frozen=True, eq=False)
class Brushed(Generic[OfJoint]):
    """A joint after strokes of a brush, made by :meth:`Joint.brushed`.

    Attributes
    ----------
    joint : Joint
        Without the bone: ask it as any other.
    mesh : TriMesh
        The brushed bone, with the triangles that it had.
    depth_mm : (V,) float64
        How far each of its vertices lies below the surface before.
    volume_mm3, deepest_mm : float
    strokes : tuple of StrokeOutcome
    before, after : tuple of MotionLimit
        Exact limits of all motions of the joint, bone only. The role of each triangle in contact stays as before.
    """

    joint: OfJoint
    mesh: TriMesh
    depth_mm: NDArray[np.float64]
    volume_mm3: float
    deepest_mm: float
    strokes: tuple[StrokeOutcome, ...]
    before: tuple[MotionLimit, ...]
    after: tuple[MotionLimit, ...]

    def __repr__(self) -> str:
        return f"Brushed({len(self.strokes)} strokes; {self.volume_mm3:.1f} mm3, {self.deepest_mm:.2f} mm deep)"


def brushed(joint: OfJoint, of_native: Callable[[NativeJoint], OfJoint], strokes: Sequence[BrushStroke], body: Body,
            keep: Optional[ArrayLike], bearing: BearingRule, bearing_margin_mm: Optional[float]) -> Brushed[OfJoint]:
    of_fixed = word(body, "body", Body) == "fixed"
    mesh = joint.fixed if of_fixed else joint.mobile
    for each in strokes:
        if not isinstance(each, BrushStroke):
            raise UsageError(f"strokes: a BrushStroke is needed, not {type(each).__name__}")
    known = Motions(joint._native)
    options = {
        "of_fixed": of_fixed, "keep": kept_vertices(keep, mesh, "keep"), "count_bearing": word(bearing, "bearing", BearingRule) == "count",
        "bearing_margin_mm": None if bearing_margin_mm is None else number(bearing_margin_mm, "bearing_margin_mm")}
    found: dict[str, Any] = _native.brushed(
        joint._asked, [known.tuple_of(each) for each in known.known], [each._tuple(mesh) for each in strokes], options)
    without = of_native(found["joint"])
    return Brushed(
        without, without.fixed if of_fixed else without.mobile, found["depth_mm"], found["volume_mm3"], found["deepest_mm"],
        tuple(StrokeOutcome(*each) for each in found["strokes"]),
        tuple(motion_limit_of(each, known, joint) for each in found["before"]),
        tuple(motion_limit_of(each, known, without) for each in found["after"]))
