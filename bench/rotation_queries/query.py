"""Queries of continuous collision detection under rotation: what one is, and how it stands in a file (README.md).

Everything is a whole number or a rational one, so that nothing here rounds.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Iterable, Iterator, Sequence, TextIO, Tuple

Vector = Tuple[Fraction, Fraction, Fraction]
# Half of an angle in [0, 2 pi] by a positive multiple of its sine and cosine: (0, 1) is no turn, (1, 0) half a turn,
# (0, -1) a whole one.
HalfAngle = Tuple[int, int]

VERTEX_FACE, EDGE_EDGE = 0, 1
ROWS, COLUMNS = 8, 7


@dataclass(frozen=True)
class Query:
    """The first feature turns about the axis from the start to the end; the second one rests. Do they share a point?

    Vertex and face: the vertex, then the face's corners. Two edges: the ends of the one that turns, then of the other.
    """

    type: int
    points: Tuple[Vector, Vector, Vector, Vector]  # at angle 0
    centre: Vector  # a point of the axis
    axis: Vector  # of length 1
    start: HalfAngle
    end: HalfAngle
    kind: int = 0  # 0: random; else its number in KINDS
    answer: int = -1  # -1: not known yet

    def check(self) -> None:
        """Raises ValueError for what is not a query."""
        if self.type not in (VERTEX_FACE, EDGE_EDGE):
            raise ValueError(f"the type is {self.type}, neither 0 nor 1")
        if sum(x * x for x in self.axis) != 1:
            raise ValueError("the axis has not the length 1")
        for s, c in (self.start, self.end):
            if s < 0 or (s == 0 and c == 0):
                raise ValueError(f"{s},{c} is no half of an angle from 0 to a whole turn")
        (s0, c0), (s1, c1) = self.start, self.end
        # Of two different directions of the upper half plane the one further to the right comes first.
        if s0 * c1 - c0 * s1 > 0 or (s0 == s1 == 0 and c0 < 0 < c1):
            raise ValueError("the motion ends before it starts")


# What is degenerate in a query of degenerate.csv, by number from 1.
KINDS = (
    "random",
    "touching at the start",
    "grazing",
    "through the axis",
    "parallel",
    "coplanar",
    "contained",
    "whole turn",
    "end at contact",
)


def read_queries(lines: Iterable[str], name: str = "") -> Iterator[Query]:
    """The queries of a file; ValueError names the first row that is none."""
    rows = []
    for number, line in enumerate(lines, 1):
        where = f"{name}:{number}"
        try:
            row = [int(field) for field in line.split(",")]
        except ValueError:
            raise ValueError(f"{where}: not whole numbers with commas between: {line.strip()!r}") from None
        if len(row) != COLUMNS:
            raise ValueError(f"{where}: {len(row)} numbers, not {COLUMNS}")
        if row[6] not in (0, 1) or (rows and row[6] != rows[0][6]):
            raise ValueError(f"{where}: the answer is 0 or 1, the same in all rows of a query")
        if len(rows) != 6 and 0 in (row[1], row[3], row[5]):
            raise ValueError(f"{where}: a denominator is 0")
        rows.append(row)
        if len(rows) < ROWS:
            continue
        vectors = [(Fraction(r[0], r[1]), Fraction(r[2], r[3]), Fraction(r[4], r[5])) for r in rows[:6]]
        angles, what = rows[6], rows[7]
        start, end = (angles[0], angles[1]), (angles[2], angles[3])
        query = Query(what[0], tuple(vectors[:4]), vectors[4], vectors[5], start, end, what[2], row[6])
        try:
            query.check()
        except ValueError as error:
            raise ValueError(f"{where}: {error}") from None
        yield query
        rows = []
    if rows:
        raise ValueError(f"{name}: ends within a query")


def rows_of(query: Query) -> str:
    """The query as it stands in a file."""
    vectors = (*query.points, query.centre, query.axis)
    parts = [[part for x in p for part in (x.numerator, x.denominator)] for p in vectors]
    rows = [*parts, [*query.start, *query.end, 0, 1], [query.type, 1, query.kind, 1, 0, 1]]
    return "".join(",".join(str(number) for number in [*row, query.answer]) + "\n" for row in rows)


def write_queries(queries: Iterable[Query], file: TextIO) -> None:
    for query in queries:
        file.write(rows_of(query))


# Vectors and rotations that every program of this folder needs.


def minus(a: Sequence, b: Sequence) -> tuple:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Sequence, b: Sequence):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Sequence, b: Sequence) -> tuple:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def whole_numbers(query: Query) -> Tuple[list, tuple, int]:
    """The four points seen from the centre, times one whole number, and the axis as whole numbers with its length."""
    points = [minus(p, query.centre) for p in query.points]
    scale = math.lcm(*(x.denominator for p in points for x in p))
    length = math.lcm(*(x.denominator for x in query.axis))
    return (
        [tuple(int(x * scale) for x in p) for p in points],
        tuple(int(x * length) for x in query.axis),
        length,
    )


def pieces_of_motion(query: Query) -> list:
    """The motion in at most two pieces, none of more than half a turn: pairs of half angles."""
    start, end = query.start, query.end
    return [(start, (1, 0)), ((1, 0), end)] if start[1] > 0 > end[1] else [(start, end)]
