#!/usr/bin/env python3
"""Exact answers to rotation queries, by signs of polynomials at roots of polynomials: truth.py QUERIES.csv

On a piece of the motion of at most half a turn let (s, c) go straight from one half angle to the next one as w goes
from 0 to 1; then tan(t / 2) = s / c, and

    (s^2 + c^2) R(t) x = (c^2 - s^2) x + 2 s^2 n (n . x) + 2 s c (n x x)        n: the axis, of length 1

is a polynomial in w of degree 2 with rational coefficients, and so are all conditions of contact, of degree 6 at
most. Nothing grows without bound at half a turn, where tan(t / 2) does. Contact holds on a closed set of w. If one
condition is F(w) = 0 and F is not zero throughout, contact is looked for at the roots of F; if it is, at the ends of
the piece and at the roots of all others, where a closed set that they bound must have an end.

Prints the queries whose answer in the file is another one, and ends with 1 if there are any.
"""

import sys
from itertools import combinations
from typing import Callable, List

from polynomial import Root, common_divisor, less, plus, roots_in_unit_interval, scaled, times
from query import VERTEX_FACE, Query, cross, dot, minus, pieces_of_motion, read_queries, whole_numbers


def contact(query: Query) -> bool:
    """Whether the two features have a point in common at some angle of the motion."""
    return any(Piece(query, start, end).holds_contact() for start, end in pieces_of_motion(query))


def dots(a: list, b: list) -> list:
    """Scalar product of two vectors of polynomials."""
    return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]))


def crosses(a: list, b: list) -> list:
    return [less(times(a[i], b[j]), times(a[j], b[i])) for i, j in ((1, 2), (2, 0), (0, 1))]


class Piece:
    """A piece of the motion; polynomials are in w from 0 to 1."""

    def __init__(self, query: Query, start: tuple, end: tuple) -> None:
        self.type = query.type
        self.points, self.axis, self.length = whole_numbers(query)
        s, c = [start[0], end[0] - start[0]], [start[1], end[1] - start[1]]
        s, c = ([x for x in p] if p[1] else p[:1] if p[0] else [] for p in (s, c))
        ss, cc, sc = times(s, s), times(c, c), times(s, c)
        square = self.length * self.length
        self.cosine = scaled(less(cc, ss), square)
        self.sine = scaled(sc, 2 * self.length)
        self.along = scaled(ss, 2)
        self.weight = scaled(plus(ss, cc), square)  # positive everywhere

    def turned(self, x: tuple) -> list:
        """R(w) x, times the weight."""
        height, across = dot(self.axis, x), cross(self.axis, x)
        return [
            plus(plus(scaled(self.cosine, v), scaled(self.along, n * height)), scaled(self.sine, a))
            for v, n, a in zip(x, self.axis, across)
        ]

    def moved(self, x: tuple) -> list:
        """The point of the turning feature that is x at angle 0, times the weight."""
        return self.turned(x)

    def resting(self, x: tuple) -> list:
        """A point or a vector that stays, with the same weight."""
        return [scaled(self.weight, x[i]) for i in range(3)]

    def holds_contact(self) -> bool:
        a, b, c, d = self.points
        if self.type != VERTEX_FACE:
            return self.edges_meet(a, b, c, d)
        if any(cross(minus(c, b), minus(d, b))):
            return self.vertex_meets_face(a, b, c, d)
        # A face without an area is its edges.
        return any(self.edges_meet(a, a, p, q) for p, q in combinations((b, c, d), 2))

    def vertex_meets_face(self, vertex: tuple, *face: tuple) -> bool:
        x = self.moved(vertex)
        normal = cross(minus(face[1], face[0]), minus(face[2], face[0]))

        def over(direction: tuple, origin: tuple) -> list:
            arm = [less(p, q) for p, q in zip(x, self.resting(origin))]
            return plus(plus(scaled(arm[0], direction[0]), scaled(arm[1], direction[1])), scaled(arm[2], direction[2]))

        height = over(normal, face[0])
        sides = [over(cross(normal, minus(face[(i + 1) % 3], face[i])), face[i]) for i in range(3)]
        return self.somewhere(height, sides, lambda at: at(height) == 0 and all(at(side) >= 0 for side in sides))

    def edges_meet(self, a: tuple, b: tuple, c: tuple, d: tuple) -> bool:
        """Points of the lines: R a + l R u and c + m w. With N = R u x w and g = c - R a, lines that are not parallel
        meet if g . N = 0, at l = (g x w) . N / N . N and m = (g x R u) . N / N . N."""
        u, w = minus(b, a), minus(d, c)
        if not any(u) and not any(w):
            gap = [less(p, q) for p, q in zip(self.moved(a), self.resting(c))]
            return self.vanish_together(gap, [], lambda at: True)
        turned_u = self.turned(u)
        gap = [less(p, q) for p, q in zip(self.resting(c), self.moved(a))]
        normal = crosses(turned_u, self.resting(w))
        if any(u):
            # Lines are parallel: do they coincide, and do the edges overlap on them? Along R u from R a.
            aside = crosses(gap, turned_u)
            first = dots(gap, turned_u)
            second = plus(first, dots(self.resting(w), turned_u))
            size = scaled(times(self.weight, self.weight), dot(u, u))
        else:
            aside = crosses(gap, self.resting(w))
            first = [-x for x in dots(gap, self.resting(w))]
            second, size = first, scaled(times(self.weight, self.weight), dot(w, w))
        beyond = [less(first, size), less(second, size)]

        def overlap(at: Callable) -> bool:
            if any(at(p) for p in aside):
                return False
            return not (at(first) < 0 and at(second) < 0) and not (at(beyond[0]) > 0 and at(beyond[1]) > 0)

        if not any(normal):
            return self.vanish_together(aside, [first, second, *beyond], overlap)
        square = dots(normal, normal)
        share = dots(crosses(gap, self.resting(w)), normal)
        other = dots(crosses(gap, turned_u), normal)
        within = [share, less(square, share), other, less(square, other)]

        def meet(at: Callable) -> bool:
            if at(dots(gap, normal)) != 0:
                return False
            if at(square) == 0:
                return overlap(at)
            return all(at(p) >= 0 for p in within)

        return self.somewhere(dots(gap, normal), [*within, *normal], meet)

    def vanish_together(self, zeros: list, others: list, holds: Callable) -> bool:
        """Somewhere all `zeros` are zero, and the rest holds."""
        common: list = []
        for p in zeros:
            common = common_divisor(common, p) if common else p
        return self.somewhere(common, others, lambda at: all(at(p) == 0 for p in zeros) and holds(at))

    @staticmethod
    def somewhere(zero: list, others: list, holds: Callable) -> bool:
        """Whether `holds` is true for some w, which it cannot be unless `zero` is 0 there; `others` bound it."""
        ends = [Root(None, 0, 0), Root(None, 1, 0)]
        if zero:
            places: List[Root] = roots_in_unit_interval(zero)
        else:
            places = ends + [root for p in others if p for root in roots_in_unit_interval(p)]
        return any(holds(place.sign_of) for place in places)


def main(path: str) -> int:
    wrong = total = 0
    with open(path, encoding="ascii") as file:
        for number, query in enumerate(read_queries(file, path)):
            total += 1
            if contact(query) != (query.answer == 1):
                wrong += 1
                print(f"query {number}: the file says {query.answer}")
    print(f"{total} queries, {wrong} answers differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
