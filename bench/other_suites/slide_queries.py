#!/usr/bin/env python3
"""Asks condyle.slide the rigid queries of Wang et al. 2021 and counts misses and false alarms: slide_queries.py FOLDER

FOLDER is a copy of github.com/Continuous-Collision-Detection/Sample-Queries; sample_queries.py says which of its queries
are rigid, and answers them exactly. The module condyle is needed.

The library slides triangles, where a query has a vertex or edges: each becomes a corner or a side of two triangles, one
above and one below the plane in which the features meet, the face's own or the one along both edges. As one feature
passes through that plane, its triangle above it has nothing but the feature itself in common with what is not above:

    above      /|       contact of the triangle above and the other feature's below      ________
              / |       contact of the triangle below and the other feature's above              ________
    ---------v------    the features meet where both are in contact, and nowhere if there is a gap
             |/  below

Ends with 1 for a miss, and for a false alarm that is more than rounding.
"""

import math
import sys
from fractions import Fraction
from pathlib import Path
from typing import Sequence, Tuple

import numpy as np

import condyle
from sample_queries import Translation, rigid_queries

from query import VERTEX_FACE, cross, dot, minus  # of bench/rotation_queries, which sample_queries finds

# Of the length of a motion, which is a square root.
ROUNDING = 4e-16
# A contact that is missed by less than this share of a feature cannot be distinguished from one in double precision.
GROWN = Fraction(1, 2**48)


def unit(v: Sequence[Fraction]) -> np.ndarray:
    largest = max(abs(x) for x in v)
    scaled = np.array([float(x / largest) for x in v])
    return scaled / np.linalg.norm(scaled)


def any_across(v: Sequence[Fraction]) -> tuple:
    """Some vector at a right angle to this one."""
    least = min(range(3), key=lambda i: abs(v[i]))
    return cross(v, tuple(Fraction(i == least) for i in range(3)))


def normal_of(type_: int, points: list, way: tuple) -> tuple:
    """Of the plane in which the features can meet. Parallel edges meet in every plane along them: here one that they cross."""
    a, b, c, d = points
    if type_ == VERTEX_FACE:
        return cross(minus(c, b), minus(d, b))
    u, w = minus(b, a), minus(d, c)
    normal = cross(u, w)
    if not any(normal):
        normal = cross(cross(u, way), u)
    return normal if any(normal) else any_across(u)


def triangle_on(feature: list, normal: np.ndarray, size: float) -> Tuple[np.ndarray, list]:
    """A triangle with this vertex or edge, and all else of it on the side of the normal."""
    corners = np.array([[float(x) for x in p] for p in feature])
    beside = unit(any_across([Fraction(x) for x in normal])) if len(feature) == 1 else np.zeros(3)
    more = [corners.mean(axis=0) + size * (normal + sense * beside) for sense in (1, -1)]
    return np.vstack([corners, more])[:3], [[0, 1, 2]]


def contact_along(fixed, mobile, along: np.ndarray) -> Tuple[float, float]:
    """Where two triangles meet: convex, they do on one interval or never."""
    free = condyle.slide(fixed, mobile, along).free
    return (free[0].high_mm, free[1].low_mm) if len(free) == 2 else (math.inf, -math.inf)


def meet(type_: int, points: list, way: tuple) -> bool:
    """Whether the library finds contact of the features on the way, which is not longer than nothing if they rest."""
    normal = unit(normal_of(type_, points, way))
    size = max(float(abs(x)) for p in points for x in minus(p, points[-1])) or 1.0
    first, rest = points[:1 if type_ == VERTEX_FACE else 2], points[1 if type_ == VERTEX_FACE else 2:]
    along = unit(way) if any(way) else normal
    length = math.sqrt(dot(way, way)) * (1 + ROUNDING)
    low, high = 0.0, length
    for sense in (1, -1):
        moves = triangle_on(first, sense * normal, size)
        rests = triangle_on(rest, -sense * normal, size)
        begin, end = contact_along(rests, moves, along)
        low, high = max(low, begin), min(high, end)
    return low <= high


def meet_if_longer(type_: int, points: list, way: tuple) -> bool:
    """The exact answer for edges and faces that are larger by a few roundings, about their middles."""
    first = 1 if type_ == VERTEX_FACE else 2
    larger = []
    for feature in (points[:first], points[first:]):
        middle = tuple(sum(x) / len(feature) for x in zip(*feature))
        larger += [tuple(x + GROWN * (x - m) for x, m in zip(p, middle)) for p in feature]
    return Translation(type_, larger, way).holds_contact()


def main(folder: Path) -> int:
    asked = misses = false_alarms = explained = 0
    for query in rigid_queries(folder):
        if not query:
            continue
        name, type_, points, way, _ = query
        expected, found = Translation(type_, points, way).holds_contact(), meet(type_, points, way)
        asked += 1
        if found == expected:
            continue
        misses += expected
        false_alarms += found
        is_explained = found and meet_if_longer(type_, points, way)
        explained += is_explained
        if not is_explained:
            print(f"{name}: {'a miss' if expected else 'a false alarm'}")
    if not asked:
        sys.exit(f"slide_queries.py: no queries in {folder}")
    print(f"{asked} rigid queries: {misses} misses, {false_alarms} false alarms, of which {explained} are contacts")
    print("once edges and faces are longer by 2^-48 of their size")
    return 1 if misses or false_alarms > explained else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1])))
