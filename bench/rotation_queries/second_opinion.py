#!/usr/bin/env python3
"""The same answers by other means: second_opinion.py QUERIES.csv [PARTS]

Nothing here is shared with truth.py but the reader: no polynomial, no root.

- A whole turn: the circles about the axis on which the points of each feature run, as heights and squared radii,
  which are rational.
- Any motion: halved again and again. On each part every turning point runs within the triangle of three points, by
  products of quaternions (the control points of its arc as a rational Bezier curve), and a plane with both features
  strictly on different sides says that they do not meet there. They do for certain if a volume changes its sign over
  a part and all else is strictly inside, or if they do at one of its ends. All is exact; what only touches between
  such ends is left open, after 200 parts if no other number is given.

Prints the queries that either contradicts, and how many each decides.
"""

import sys
from collections import deque
from fractions import Fraction
from typing import Iterable, Optional

from query import VERTEX_FACE, Query, cross, dot, minus, pieces_of_motion, read_queries, whole_numbers

# ---------------------------------------------------------------------------------------------------------- whole turns


def is_whole_turn(query: Query) -> bool:
    return query.start[0] == query.end[0] == 0 and query.start[1] > 0 > query.end[1]


def squared_radii_meet(first: Iterable[Fraction], second: Iterable[Fraction]) -> bool:
    first, second = list(first), list(second)
    return min(first) <= max(second) and min(second) <= max(first)


class Profile:
    """Heights along the axis, and positions across it, of whole numbers."""

    def __init__(self, query: Query) -> None:
        points, axis, _ = whole_numbers(query)
        self.square = dot(axis, axis)
        # Heights and positions times the axis' length, or times its square.
        self.points = [(Fraction(dot(axis, p)), tuple(Fraction(x) for x in cross(axis, p))) for p in points]

    def slice(self, p, q, height: Fraction):
        """Where the line from p to q, not level, has this height: across the axis."""
        share = (height - p[0]) / (q[0] - p[0])
        return tuple(x + share * (y - x) for x, y in zip(p[1], q[1]))

    @staticmethod
    def squared_radii(p, q) -> list:
        """Least and largest squared distance from the axis between two places of one height."""
        u = minus(q, p)
        out = [dot(p, p), dot(q, q)]
        if any(u):
            nearest = -dot(p, u) / dot(u, u)
            if 0 < nearest < 1:
                out.append(dot(p, p) + nearest * dot(p, u))
        return out

    def edges_meet(self, a, b, c, d) -> bool:
        low, high = max(min(a[0], b[0]), min(c[0], d[0])), min(max(a[0], b[0]), max(c[0], d[0]))
        if low > high:
            return False
        if a[0] == b[0] or c[0] == d[0]:
            # At one height: all radii of an edge that is level, one of another.
            return squared_radii_meet(self.radii_at(a, b, low), self.radii_at(c, d, low))

        # Radii are the same where a difference of two parabolas is 0.
        def difference(height: Fraction) -> Fraction:
            first, second = self.slice(a, b, height), self.slice(c, d, height)
            return dot(first, first) - dot(second, second)

        at_low, at_high = difference(low), difference(high)
        if at_low * at_high <= 0:
            return True
        middle = (low + high) / 2
        half = (high - low) / 2
        bend = (at_low + at_high) / 2 - difference(middle)  # of half^2
        slope = (at_high - at_low) / 2
        if bend == 0 or abs(slope) >= 2 * abs(bend):
            return False
        turning = middle - slope / (2 * bend) * half
        return difference(turning) * at_low <= 0

    def radii_at(self, p, q, height: Fraction) -> list:
        if p[0] == q[0]:
            return self.squared_radii(p[1], q[1])
        at = self.slice(p, q, height)
        return [dot(at, at)]

    def vertex_meets_face(self, v, *face) -> bool:
        height = v[0]
        ends = []
        for i in range(3):
            p, q = face[i], face[(i + 1) % 3]
            if p[0] == height:
                ends.append(p[1])
            if (p[0] - height) * (q[0] - height) < 0:
                ends.append(self.slice(p, q, height))
        if not ends:
            return False
        radii = [r for p in ends for q in ends for r in self.squared_radii(p, q)]
        if all(p[0] == height for p in face) and self.holds_axis(ends):
            radii.append(Fraction(0))
        return squared_radii_meet([dot(v[1], v[1])], radii)

    @staticmethod
    def holds_axis(corners) -> bool:
        """Whether a level triangle has the axis inside."""
        sides = [cross(corners[i], corners[(i + 1) % 3]) for i in range(3)]
        return all(dot(s, t) >= 0 for s in sides for t in sides) and any(any(s) for s in sides)


def contact_in_whole_turn(query: Query) -> bool:
    profile = Profile(query)
    meet = profile.vertex_meets_face if query.type == VERTEX_FACE else profile.edges_meet
    return meet(*profile.points)


# ----------------------------------------------------------------------------------------------------------- any motion


def product(p: tuple, q: tuple) -> tuple:
    """Of two quaternions."""
    a, b = p[1:], q[1:]
    v = cross(a, b)
    return (p[0] * q[0] - dot(a, b), *(p[0] * b[i] + q[0] * a[i] + v[i] for i in range(3)))


def point_on_triangle(p: tuple, corners: tuple) -> bool:
    a, b, c = corners
    normal = cross(minus(b, a), minus(c, a))
    sides = [dot(cross(minus(corners[(i + 1) % 3], corners[i]), minus(p, corners[i])), normal) for i in range(3)]
    return dot(normal, minus(p, a)) == 0 and min(sides) >= 0


def segments_touch(a: tuple, b: tuple, c: tuple, d: tuple) -> bool:
    """For whole numbers, and edges of any length but zero."""
    u, w, gap = minus(b, a), minus(d, c), minus(c, a)
    normal = cross(u, w)
    if not any(normal):
        first, second = dot(gap, u), dot(minus(d, a), u)
        return not any(cross(gap, u)) and min(first, second) <= dot(u, u) and max(first, second) >= 0
    square = dot(normal, normal)
    on_first, on_second = dot(cross(gap, w), normal), dot(cross(gap, u), normal)
    return dot(gap, normal) == 0 and 0 <= on_first <= square and 0 <= on_second <= square


class Halving:
    def __init__(self, query: Query) -> None:
        self.type = query.type
        self.points, self.axis, self.length = whole_numbers(query)

    def turn(self, first: tuple, second: tuple, backwards: bool) -> list:
        """Matrix and weight of the control point between two half angles; of a rotation where they are the same."""

        def quaternion(half: tuple) -> tuple:
            s = -half[0] if backwards else half[0]
            return (half[1] * self.length, *(s * x for x in self.axis))

        p, q = quaternion(first), quaternion(second)
        columns = []
        for unit in ((0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)):
            one = product(product(p, unit), (q[0], -q[1], -q[2], -q[3]))
            other = product(product(q, unit), (p[0], -p[1], -p[2], -p[3]))
            columns.append([x + y for x, y in zip(one[1:], other[1:])])
        return [list(zip(*columns)), 2 * dot(p[1:], q[1:]) + 2 * p[0] * q[0]]

    def controls(self, x: tuple, part: tuple, backwards: bool = False) -> list:
        """Control points of x on the part, each with its weight, none negative, of parts of at most half a turn."""
        first, last = part
        out = []
        for pair in ((first, first), (first, last), (last, last)):
            matrix, weight = self.turn(*pair, backwards)
            out.append((tuple(dot(row, x) for row in matrix), weight))
        return out

    @staticmethod
    def beyond(axis: tuple, controls: list, resting: Iterable[tuple]) -> bool:
        """Strictly more along the axis than every point that rests."""
        most = max(dot(axis, p) for p in resting)
        return all(dot(axis, p) > most * weight for p, weight in controls)

    def apart(self, axes: Iterable[tuple], controls: list, resting: list) -> bool:
        for axis in axes:
            if any(axis):
                opposite = tuple(-x for x in axis)
                if self.beyond(axis, controls, resting) or self.beyond(opposite, controls, resting):
                    return True
        return False

    def decide(self, part: tuple) -> Optional[bool]:
        return self.decide_face(part) if self.type == VERTEX_FACE else self.decide_edges(part)

    def decide_face(self, part: tuple) -> Optional[bool]:
        vertex, *face = self.points
        x = self.controls(vertex, part)
        normal = cross(minus(face[1], face[0]), minus(face[2], face[0]))
        outwards = [cross(minus(face[(i + 1) % 3], face[i]), normal) for i in range(3)]
        if self.apart([normal, *outwards, (1, 0, 0), (0, 1, 0), (0, 0, 1)], x, face):
            return False
        ends = [dot(normal, p) - dot(normal, face[0]) * weight for p, weight in (x[0], x[2])]
        if ends[0] * ends[1] < 0 and all(
            dot(out, p) < dot(out, corner) * weight for out, corner in zip(outwards, face) for p, weight in x
        ):
            return True
        return None

    def decide_edges(self, part: tuple) -> Optional[bool]:
        a, b, c, d = self.points
        ends_a, ends_b = self.controls(a, part), self.controls(b, part)
        first_a, first_b = ends_a[0], ends_b[0]
        w = minus(d, c)
        turned_u = minus(first_b[0], first_a[0])
        across = cross(turned_u, w)
        gap = minus(tuple(first_a[1] * x for x in c), first_a[0])
        beside = minus(tuple(x * dot(w, w) for x in gap), tuple(x * dot(gap, w) for x in w))
        axes = [across, cross(across, w), cross(across, turned_u), w, turned_u, beside, (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        if self.apart(axes, ends_a + ends_b, [c, d]):
            return False
        volumes = []
        for p, q in ((ends_a[0], ends_b[0]), (ends_a[2], ends_b[2])):
            from_c = minus(p[0], tuple(p[1] * x for x in c))
            volumes.append(dot(cross(minus(q[0], p[0]), w), from_c))
        if volumes[0] * volumes[1] >= 0:
            return None
        # The ends of each edge on different sides of a plane through the other one, all the way.
        if not self.on_different_sides(cross(w, across), c, ends_a, ends_b):
            return None
        back_across = self.turned_back(across, part[0])
        back_c, back_d = self.controls(c, part, True), self.controls(d, part, True)
        return True if self.on_different_sides(cross(minus(b, a), back_across), a, back_c, back_d) else None

    def touch_at(self, half: tuple) -> bool:
        """Contact at one angle."""
        matrix, weight = self.turn(half, half, False)
        moving = 1 if self.type == VERTEX_FACE else 2
        p, q, r, s = (
            tuple(dot(row, x) for row in matrix) if i < moving else tuple(weight * v for v in x)
            for i, x in enumerate(self.points)
        )
        if self.type == VERTEX_FACE:
            return point_on_triangle(p, (q, r, s))
        return segments_touch(p, q, r, s)

    def turned_back(self, x: tuple, half: tuple) -> tuple:
        matrix, _ = self.turn(half, half, True)
        return tuple(dot(row, x) for row in matrix)

    @staticmethod
    def on_different_sides(normal: tuple, origin: tuple, first: list, second: list) -> bool:
        level = dot(normal, origin)
        heights = [[dot(normal, p) - level * w for p, w in points] for points in (first, second)]
        sides = [{(h > 0) - (h < 0) for h in some} for some in heights]
        return sides in ([{1}, {-1}], [{-1}, {1}])

    def opinion(self, parts: list, most_parts: int) -> Optional[bool]:
        """True for contact, False for none, None if it is not certain after so many parts."""
        parts = deque(parts)
        for _ in range(most_parts):
            if not parts:
                return False
            first, last = parts.popleft()
            decision = self.decide((first, last))
            if decision:
                return True
            if decision is None:
                if self.touch_at(first) or self.touch_at(last):
                    return True
                if first == last:
                    return False
                middle = self.middle(first, last)
                if middle is None:
                    return None
                parts += [(first, middle), (middle, last)]
        return None if parts else False

    @staticmethod
    def middle(first: tuple, last: tuple) -> Optional[tuple]:
        """A half angle between the two, in numbers of 80 bits; None if they are too near each other for that."""
        bits = 80
        # Both with about the same length: else it is not near the middle.
        lengths = [max(abs(first[0]), abs(first[1])), max(abs(last[0]), abs(last[1]))]
        s, c = (first[i] * lengths[1] + last[i] * lengths[0] for i in (0, 1))
        size = max(abs(s), abs(c)) >> bits
        if size:
            s, c = s // size, c // size
        is_between = first[0] * c < s * first[1] and s * last[1] < last[0] * c
        return (s, c) if is_between else None


def opinion(query: Query, most_parts: int = 200) -> Optional[bool]:
    return Halving(query).opinion(pieces_of_motion(query), most_parts)


def main(path: str, most_parts: int) -> int:
    total = wrong = decided = turns = neither = 0
    with open(path, encoding="ascii") as file:
        for number, query in enumerate(read_queries(file, path)):
            total += 1
            answers = [opinion(query, most_parts)]
            decided += answers[0] is not None
            if is_whole_turn(query):
                turns += 1
                answers.append(contact_in_whole_turn(query))
            neither += all(answer is None for answer in answers)
            if any(answer is not None and answer != (query.answer == 1) for answer in answers):
                wrong += 1
                print(f"query {number}: the file says {query.answer}, by halving {answers[0]}, by radii {answers[1:]}")
    print(f"{total} queries: {decided} decided by halving, {turns} whole turns by their radii, {neither} by neither")
    print(f"{wrong} contradicted")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) == 3 else 200))
