#!/usr/bin/env python3
"""Makes the queries and answers them: generate.py random COUNT OUT.csv [SEED] or generate.py degenerate OUT.csv [SEED]

The same numbers come out on every machine and with every Python from 3.9: random numbers are SplitMix64's, all else
is whole numbers. A degenerate query whose answer follows from how it was made must get that answer from truth.py, and
none may be contradicted by second_opinion.py; else nothing is written.
"""

import hashlib
import itertools
import sys
from dataclasses import replace
from fractions import Fraction
from multiprocessing import Pool, cpu_count
from typing import Iterator, List, Optional, Tuple

from query import EDGE_EDGE, KINDS, VERTEX_FACE, Query, cross, dot, minus, rows_of
from second_opinion import contact_in_whole_turn, is_whole_turn, opinion
from truth import contact

SEED = 63
NO_TURN, HALF_TURN, WHOLE_TURN = (0, 1), (1, 0), (0, -1)


class SplitMix64:
    """Steele, Lea and Flood, OOPSLA 2014."""

    def __init__(self, seed: int) -> None:
        self.state = seed % 2**64

    def word(self) -> int:
        self.state = (self.state + 0x9E3779B97F4A7C15) % 2**64
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) % 2**64
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) % 2**64
        return z ^ (z >> 31)

    def between(self, low: int, high: int) -> int:
        """Both ends included."""
        return low + (self.word() * (high - low + 1) >> 64)

    def one_of(self, choices):
        return choices[self.between(0, len(choices) - 1)]


def earlier(first: tuple, second: tuple) -> bool:
    return first[0] * second[1] < second[0] * first[1] or (first[0] == 0 < first[1] and second[0] == 0 > second[1])


# --------------------------------------------------------------------------------------------------------------- random

GRID = 2**20  # coordinates are multiples of 1 / GRID between -1 and 1


def unit_axis(random: SplitMix64) -> tuple:
    """Where a rotation by a quaternion of small whole numbers takes the z axis."""
    while True:
        w, x, y, z = (random.between(-7, 7) for _ in range(4))
        square = w * w + x * x + y * y + z * z
        if square:
            tip = (2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z)
            return tuple(Fraction(v, square) for v in tip)


def any_point(random: SplitMix64, size: int = GRID) -> tuple:
    return tuple(Fraction(random.between(-size, size), GRID) for _ in range(3))


def turned_back(x: tuple, centre: tuple, axis: tuple, angle: tuple) -> tuple:
    """Where x comes from if it turned by the angle."""
    s, c = -angle[0], angle[1]
    arm = minus(x, centre)
    across, height, square = cross(axis, arm), dot(axis, arm), s * s + c * c
    return tuple(
        o + ((c * c - s * s) * v + 2 * s * s * n * height + 2 * s * c * a) / square
        for o, v, n, a in zip(centre, arm, axis, across)
    )


def random_query(seed: int, number: int) -> Query:
    """Vertices and faces have even numbers. Axes are those of the coordinates in half of the queries, and the centre is
    the origin in a quarter. In half of the queries the moving feature comes from near the resting one: many meet."""
    random = SplitMix64(seed * 2**32 + number)
    for _ in range(4):
        random.word()
    kind = VERTEX_FACE if number % 2 == 0 else EDGE_EDGE
    if random.between(0, 1):
        axis = [Fraction(0)] * 3
        axis[random.between(0, 2)] = Fraction(random.one_of((-1, 1)))
        axis = tuple(axis)
    else:
        axis = unit_axis(random)
    centre = (Fraction(0),) * 3 if random.between(0, 3) == 0 else any_point(random, GRID // 2)
    points = [any_point(random) for _ in range(4)]
    end = WHOLE_TURN if random.between(0, 9) == 0 else (random.between(1, 1000), random.between(-1000, 1000))
    start = NO_TURN
    if random.between(0, 3) == 0:
        start = (random.between(1, 1000), random.between(-1000, 1000))
        if not earlier(start, end):
            start, end = end, start
    if random.between(0, 1):
        angle = (random.between(1, 1000), random.between(-1000, 1000))
        near = points[random.between(4 - (3 if kind == VERTEX_FACE else 2), 3)]
        aim = tuple((3 * x + y) / 4 for x, y in zip(near, points[2]))
        back = turned_back(aim, centre, axis, angle)
        moved = tuple(x + y / 8 for x, y in zip(back, points[0]))
        points[0] = tuple(Fraction(int(x * GRID), GRID) for x in moved)
    return Query(kind, tuple(points), centre, axis, start, end)


def answered(query: Query) -> Query:
    query.check()
    return replace(query, answer=int(contact(query)))


def random_rows(block: Tuple[int, int, int]) -> str:
    seed, first, last = block
    return "".join(rows_of(answered(random_query(seed, number))) for number in range(first, last))


def random_file(count: int, seed: int = SEED, processes: Optional[int] = None) -> Iterator[str]:
    """The rows, in pieces."""
    size = 500
    blocks = [(seed, first, min(first + size, count)) for first in range(0, count, size)]
    if len(blocks) == 1:
        yield random_rows(blocks[0])
        return
    with Pool(processes or cpu_count()) as pool:
        yield from pool.imap(random_rows, blocks)


# ----------------------------------------------------------------------------------------------------------- degenerate
#
# Made in whole numbers about the z axis through the origin, then carried elsewhere by a rotation with rational entries,
# multiplied by their denominator, and shifted: whole numbers or eighths in the end, which doubles hold.

Made = Tuple[int, list, tuple, tuple, Optional[int]]  # type, points, start, end, and the answer if it is clear

TURNS = [(1, 2), (1, 3), (2, 3), (1, 1), (3, 1), (1, -2), (3, -1), (1, 0)]  # half angles of 27 to 108 degrees


def turn(x: tuple, angle: tuple) -> tuple:
    """R x about z times s^2 + c^2."""
    s, c = angle
    cosine, sine = c * c - s * s, 2 * s * c
    return (cosine * x[0] - sine * x[1], sine * x[0] + cosine * x[1], (s * s + c * c) * x[2])


def before(points: list, angle: tuple, moving: int) -> list:
    """Points as they stand at `angle`, of which the first ones turn: as they stand at 0, all times s^2 + c^2."""
    size = angle[0] ** 2 + angle[1] ** 2
    return [turn(p, (-angle[0], angle[1])) if i < moving else tuple(size * x for x in p) for i, p in enumerate(points)]


def on(origin: tuple, *terms: tuple) -> tuple:
    """The origin plus multiples of directions."""
    return tuple(o + sum(k * v[i] for k, v in terms) for i, o in enumerate(origin))


def lattice(random: SplitMix64, size: int = 3) -> tuple:
    return tuple(random.between(-size, size) for _ in range(3))


def later(random: SplitMix64, angle: tuple) -> tuple:
    while True:
        end = random.one_of([*TURNS, (1, -3), (2, -9), WHOLE_TURN])
        if earlier(angle, end):
            return end


def hair_before(angle: tuple, bits: int) -> tuple:
    return (angle[0] << bits, (angle[1] << bits) + 1)


def hair_after(angle: tuple, bits: int) -> tuple:
    return (angle[0] << bits, (angle[1] << bits) - 1)


# Corners of a face in a plane, as (along, up) from a point: the point is inside, on an edge, at a corner, outside.
INSIDE = [(-2, -1), (2, -1), (1, 3)]
AROUND = {
    "inside": INSIDE,
    "edge": [(-2, 0), (2, 0), (1, 3)],
    "corner": [(0, 0), (2, 1), (2, 3)],
    "outside": [(1, 1), (4, 1), (2, 3)],
}
# Ends of an edge from a point on its line.
ALONG = {"inside": (-2, 3), "corner": (0, 2), "outside": (1, 3)}


def face_around(random: SplitMix64, point: tuple, u: tuple, v: tuple) -> Tuple[list, int]:
    where = random.one_of(sorted(AROUND))
    return [on(point, (i, u), (j, v)) for i, j in AROUND[where]], int(where != "outside")


def edge_along(random: SplitMix64, point: tuple, u: tuple) -> Tuple[list, int]:
    where = random.one_of(sorted(ALONG))
    return [on(point, (k, u)) for k in ALONG[where]], int(where != "outside")


def two_directions(random: SplitMix64) -> tuple:
    while True:
        u, v = lattice(random), lattice(random)
        if any(cross(u, v)):
            return u, v


def touching_at_start(random: SplitMix64, type_: int) -> Made:
    start = NO_TURN if random.between(0, 1) else random.one_of(TURNS)
    end = start if random.between(0, 7) == 0 else later(random, start)
    point = tuple(3 * x for x in lattice(random))
    u, v = two_directions(random)
    if type_ == VERTEX_FACE:
        face, meets = face_around(random, point, u, v)
        if random.between(0, 3) == 0:
            # Off the face by a small step.
            point, meets = on(tuple(1024 * x for x in point), (random.one_of((-1, 1)), cross(u, v))), None
            face = [tuple(1024 * x for x in p) for p in face]
        points = before([point, *face], start, 1)
    else:
        first, meets_first = edge_along(random, point, u)
        second, meets_second = edge_along(random, point, v)
        meets = meets_first and meets_second
        points = before([*first, *second], start, 2)
    return type_, points, start, end, meets or None


def grazing(random: SplitMix64, type_: int) -> Made:
    """The circle of a point touches a plane in its tangent."""
    a, b = random.one_of([(1, 0), (3, 4), (-4, 3), (5, -12)])
    size = random.between(1, 3)
    tangent, up = (-b, a, 0), (random.between(-2, 2), random.between(-2, 2), 1)
    point = (size * a, size * b, random.between(-2, 2))
    angle = random.one_of(TURNS)
    which = random.between(0, 3)
    end = angle if which == 0 else hair_before(angle, 20) if which == 1 else later(random, angle)
    if type_ == VERTEX_FACE:
        face, meets = face_around(random, point, tangent, up)
        hair = random.between(-1, 1)
        if hair:
            # The plane a hair away from the circle, or into it.
            fine = [tuple((x << 16) for x in p) for p in [point, *face]]
            point, face = fine[0], [on(p, (hair, (a, b, 0))) for p in fine[1:]]
            meets = 0 if hair > 0 else None
        points = before([point, *face], angle, 1)
        if hair < 0 or which == 1:
            meets = 0 if hair > 0 else None
    else:
        first, meets_first = edge_along(random, point, up)
        while True:
            k, m = random.between(-2, 2), random.between(-2, 2)
            if k:
                break
        second, meets_second = edge_along(random, point, on((0, 0, 0), (k, tangent), (m, up)))
        meets = 1 if meets_first and meets_second and which != 1 else None
        points = before([*first, *second], angle, 2)
    return type_, points, NO_TURN, end, meets


def through_axis(random: SplitMix64, type_: int) -> Made:
    point = (0, 0, random.between(-2, 2))
    end = later(random, NO_TURN)
    u, v = two_directions(random)
    if type_ == VERTEX_FACE:
        face, meets = face_around(random, point, u, v)
        return type_, [point, *face], NO_TURN, end, meets
    if random.between(0, 2) == 0:
        u = (0, 0, 1)  # along the axis
    other = point if random.between(0, 2) else on(point, (1, (0, 0, 1)))
    first, meets_first = edge_along(random, point, u)
    second, meets_second = edge_along(random, other, v)
    return type_, [*first, *second], NO_TURN, end, 1 if other == point and meets_first and meets_second else None


def parallel(random: SplitMix64, type_: int) -> Made:
    angle = random.one_of(TURNS)
    end = angle if random.between(0, 2) == 0 else later(random, angle)
    point = tuple(2 * x for x in lattice(random))
    while True:
        u = (0, 0, 1) if random.between(0, 1) else lattice(random)
        if any(u):
            break
    if type_ == VERTEX_FACE:
        if random.between(0, 1):
            # A face across the axis, above or below.
            face = [on(point, (i, (1, 0, 0)), (j, (0, 1, 0)), (1, (0, 0, 1))) for i, j in INSIDE]
            return type_, before([point, *face], angle, 1), NO_TURN, end, 0
        # A face along the axis.
        face, meets = face_around(random, point, (0, 0, 1), (random.one_of((-1, 1)), random.between(-2, 2), 0))
        return type_, before([point, *face], angle, 1), NO_TURN, end, meets or None
    ends = random.one_of([(0, 2, 1, 3), (0, 2, 2, 4), (0, 3, 1, 2), (0, 2, 3, 4), (0, 2, 0, 2)])
    first, second = [[on(point, (k, u)) for k in pair] for pair in (ends[:2], ends[2:])]
    return type_, before([*first, *second], angle, 2), NO_TURN, end, None if ends[1] < ends[2] else 1


def coplanar(random: SplitMix64, type_: int) -> Made:
    """In one plane all the way."""
    end = later(random, NO_TURN)
    which = random.between(0, 2) if type_ == EDGE_EDGE else 0
    if which == 0:
        while True:
            points = [(random.between(-4, 4), random.between(-4, 4), 1) for _ in range(4)]
            flat = [minus(points[2], points[1]), minus(points[3], points[1])] if type_ == VERTEX_FACE else None
            if any(cross(*flat)) if flat else points[0] != points[1] and points[2] != points[3]:
                return type_, points, NO_TURN, end, None
    if which == 1:
        # Mirrored rulings of one hyperboloid.
        radius, slope = random.between(1, 3), random.between(1, 3)
        ends = [random.between(-4, 0), random.between(1, 4), random.between(-4, 0), random.between(1, 4)]
        points = [(radius, (slope if i < 2 else -slope) * z, z) for i, z in enumerate(ends)]
        return type_, before(points, random.one_of(TURNS), 2), NO_TURN, end, None
    # Lines through one point of the axis.
    u, v = two_directions(random)
    ends = [random.between(-3, 3) for _ in range(2)]
    points = [on((0, 0, 1), (k, w)) for k, w in ((ends[0], u), (ends[0] + 2, u), (ends[1], v), (ends[1] + 2, v))]
    return type_, points, NO_TURN, end, None


def contained(random: SplitMix64, type_: int) -> Made:
    end = later(random, NO_TURN)
    if type_ == VERTEX_FACE:
        size = random.between(1, 4)
        face = [(-3 * size, -2 * size, 0), (3 * size, -2 * size, 0), (0, 4 * size, 0)]
        inner, far = (random.between(-1, 1) * size, random.one_of((-1, 1)) * size, 0), 6 * size
        if random.between(0, 1):
            # The whole circle is inside: the nearest edge is 12 / sqrt(45) sizes away, 1.78.
            return type_, [inner, *face], NO_TURN, end, 1
        # The face is inside of the circle.
        return type_, [(far, random.between(-1, 1), 0), *face], NO_TURN, end, 0
    u = random.one_of([(0, 0, 1), (1, 2, 0), (2, -1, 1), (3, 1, 2)])
    point = (0, 0, 0) if u == (0, 0, 1) else tuple(2 * x for x in lattice(random))
    inner = [on(point, (k, u)) for k in random.one_of([(1, 2), (0, 2), (1, 4), (0, 4)])]
    outer = [point, on(point, (4, u))]
    return type_, [*inner, *outer] if random.between(0, 1) else [*outer, *inner], NO_TURN, end, 1


def whole_turn(random: SplitMix64, type_: int) -> Made:
    point = tuple(2 * x for x in lattice(random))
    u, v = two_directions(random)
    which = random.between(0, 3)
    if which < 2:
        # A lattice, all the way round.
        while True:
            points = [lattice(random) for _ in range(4)]
            flat = cross(minus(points[2], points[1]), minus(points[3], points[1]))
            if any(flat) if type_ == VERTEX_FACE else points[0] != points[1] and points[2] != points[3]:
                return type_, points, NO_TURN, WHOLE_TURN, None
    # Contact at half a turn, to which the motion leads, or nearly, or at which it starts.
    start, end = random.one_of(
        [(NO_TURN, HALF_TURN), (NO_TURN, (2**20, 1)), (HALF_TURN, WHOLE_TURN), ((2**20, -1), WHOLE_TURN)]
    )
    if type_ == VERTEX_FACE:
        face, meets = face_around(random, point, u, v)
        points = before([point, *face], HALF_TURN, 1)
    else:
        first, meets_first = edge_along(random, point, u)
        second, meets_second = edge_along(random, point, v)
        meets = meets_first and meets_second
        points = before([*first, *second], HALF_TURN, 2)
    return type_, points, start, end, 1 if meets and HALF_TURN in (start, end) else None


def end_at_contact(random: SplitMix64, type_: int) -> Made:
    angle = random.one_of(TURNS)
    bits = random.one_of([10, 20, 30, 40, 60])
    which = random.between(0, 3)
    start, end = [
        (NO_TURN, angle),
        (NO_TURN, hair_before(angle, bits)),
        (NO_TURN, hair_after(angle, bits)),
        (hair_after(angle, bits), WHOLE_TURN),
    ][which]
    point = tuple(3 * x for x in lattice(random))
    u, v = two_directions(random)
    if type_ == VERTEX_FACE:
        face, meets = face_around(random, point, u, v)
        points = before([point, *face], angle, 1)
    else:
        first, meets_first = edge_along(random, point, u)
        second, meets_second = edge_along(random, point, v)
        meets = meets_first and meets_second
        points = before([*first, *second], angle, 2)
    return type_, points, start, end, 1 if meets and which in (0, 2) else None


MAKERS = [touching_at_start, grazing, through_axis, parallel, coplanar, contained, whole_turn, end_at_contact]


def signed_permutations() -> List[tuple]:
    out = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            rows = [tuple(signs[i] if j == order[i] else 0 for j in range(3)) for i in range(3)]
            if dot(rows[0], cross(rows[1], rows[2])) == 1:
                out.append((1, rows))
    return out


def oblique_rotations() -> List[tuple]:
    """Denominator, and whole-number rows."""
    out = []
    for w, x, y, z in ((1, 1, 1, 0), (1, 1, 0, -1), (2, 1, 1, 1), (1, 2, -1, 1), (2, 2, 1, 0)):
        n = w * w + x * x + y * y + z * z
        rows = [
            (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
        ]
        out.append((n, rows))
    return out


def carried(random: SplitMix64, made: Made, number: int, kind: int) -> Query:
    """Every fourth about an axis along none of the coordinates."""
    type_, points, start, end, _ = made
    size, rows = random.one_of(oblique_rotations() if number % 4 == 3 else signed_permutations())
    centre = tuple(Fraction(random.between(-8, 8), 4) for _ in range(3))
    unit = Fraction(1, random.one_of((1, 2, 8)))
    moved = tuple(tuple(o + unit * dot(row, p) for o, row in zip(centre, rows)) for p in points)
    return Query(type_, moved, centre, tuple(Fraction(row[2], size) for row in rows), start, end, kind)


def degenerate_queries(seed: int = SEED, each: int = 125) -> Iterator[Query]:
    """So many of each kind, vertices with faces and edges in turn. ArithmeticError if any two answers differ."""
    for kind, make in enumerate(MAKERS, 1):
        for number in range(each):
            random = SplitMix64((seed + 1000 * kind) * 2**32 + number)
            made = make(random, (number // 2) % 2)
            query = answered(carried(random, made, number, kind))
            others = [made[4], opinion(query)]
            if is_whole_turn(query):
                others.append(contact_in_whole_turn(query))
            if any(other is not None and int(other) != query.answer for other in others):
                raise ArithmeticError(f"{KINDS[kind]} {number}: {query.answer}, as made, by halving, by radii {others}")
            yield query


def degenerate_file(seed: int = SEED) -> Iterator[str]:
    """All of them, before any is written."""
    yield "".join(rows_of(query) for query in degenerate_queries(seed))


def write(pieces: Iterator[str], path: str) -> str:
    digest = hashlib.sha256()
    with open(path, "w", encoding="ascii", newline="\n") as file:
        for piece in pieces:
            file.write(piece)
            digest.update(piece.encode("ascii"))
    return digest.hexdigest()


def main(arguments: List[str]) -> None:
    if len(arguments) in (3, 4) and arguments[0] == "random":
        pieces = random_file(int(arguments[1]), int(arguments[3]) if len(arguments) == 4 else SEED)
        print(write(pieces, arguments[2]), arguments[2])
    elif len(arguments) in (2, 3) and arguments[0] == "degenerate":
        print(write(degenerate_file(int(arguments[2]) if len(arguments) == 3 else SEED), arguments[1]), arguments[1])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
