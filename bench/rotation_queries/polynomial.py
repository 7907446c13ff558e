"""Polynomials with whole coefficients, lowest power first, their roots from 0 to 1, and signs of others there: exactly.

A root is one of a square-free polynomial between two neighbours of a grid k / 2^e, or a point of such a grid itself.
Roots are isolated by Sturm's theorem.
"""

from math import gcd
from typing import List

Polynomial = List[int]


def trimmed(a: Polynomial) -> Polynomial:
    while a and a[-1] == 0:
        a.pop()
    return a


def plus(a: Polynomial, b: Polynomial) -> Polynomial:
    short, long = sorted((a, b), key=len)
    total = list(long)
    for i, x in enumerate(short):
        total[i] += x
    return trimmed(total)


def times(a: Polynomial, b: Polynomial) -> Polynomial:
    if not a or not b:
        return []
    product = [0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            product[i + j] += x * y
    return trimmed(product)


def scaled(a: Polynomial, factor: int) -> Polynomial:
    return [factor * x for x in a] if factor else []


def less(a: Polynomial, b: Polynomial) -> Polynomial:
    return plus(a, [-x for x in b])


def primitive(a: Polynomial) -> Polynomial:
    """Without the common divisor of its coefficients; signs stay."""
    common = gcd(*a) if a else 1
    return [x // common for x in a]


def derivative(a: Polynomial) -> Polynomial:
    return [i * x for i, x in enumerate(a)][1:]


def remainder(a: Polynomial, b: Polynomial) -> Polynomial:
    """Of a positive multiple of `a` by `b`, without the common divisor of its coefficients."""
    a = list(a)
    size, negative = abs(b[-1]), b[-1] < 0
    while len(a) >= len(b):
        factor, shift = a[-1], len(a) - len(b)
        a = [size * x for x in a]
        if negative:
            factor = -factor
        for i, x in enumerate(b):
            a[i + shift] -= factor * x
        trimmed(a)
    return primitive(a)


def common_divisor(a: Polynomial, b: Polynomial) -> Polynomial:
    a, b = primitive(a), primitive(b)
    while b:
        a, b = b, remainder(a, b)
    return a


def quotient(a: Polynomial, b: Polynomial) -> Polynomial:
    """Of a nonzero multiple of `a` by a `b` that divides it."""
    a, out = list(a), [0] * (len(a) - len(b) + 1)
    while a:
        shift = len(a) - len(b)
        if shift < 0:
            raise ArithmeticError("the second polynomial does not divide the first one")
        factor, lead = a[-1], b[-1]
        a, out = [lead * x for x in a], [lead * x for x in out]
        out[shift] += factor
        for i, x in enumerate(b):
            a[i + shift] -= factor * x
        trimmed(a)
    return primitive(out)


def sign(x: int) -> int:
    return (x > 0) - (x < 0)


def value_at(a: Polynomial, k: int, e: int) -> int:
    """a(k / 2^e) times a power of two."""
    value = 0
    for i, x in enumerate(reversed(a)):
        value = value * k + (x << (e * i))
    return value


def sturm_chain(a: Polynomial) -> List[Polynomial]:
    chain = [a, primitive(derivative(a))]
    while len(chain[-1]) > 1:
        rest = remainder(chain[-2], chain[-1])
        if not rest:
            break
        chain.append([-x for x in rest])
    return [p for p in chain if p]


def variations(chain: List[Polynomial], k: int, e: int) -> int:
    signs = [s for s in (sign(value_at(p, k, e)) for p in chain) if s]
    return sum(s != t for s, t in zip(signs, signs[1:]))


class Root:
    """A root of a square-free polynomial in (k / 2^e, (k + 1) / 2^e), or k / 2^e itself if the polynomial is None."""

    def __init__(self, polynomial, k: int, e: int) -> None:
        self.polynomial, self.k, self.e = polynomial, k, e
        if polynomial is not None:
            self.left = sign(value_at(polynomial, k, e))

    def halve(self) -> None:
        k, e = 2 * self.k + 1, self.e + 1
        middle = sign(value_at(self.polynomial, k, e))
        if middle == 0:
            self.polynomial = None
        self.k, self.e = (k if middle in (0, self.left) else k - 1), e

    def sign_of(self, other: Polynomial) -> int:
        """Sign of another polynomial at the root."""
        if not other:
            return 0
        compared = False
        for step in range(100000):
            if self.polynomial is None:
                return sign(value_at(other, self.k, self.e))
            # Between two positive numbers the terms of either sign are monotone: bounds without a root between.
            up = [max(x, 0) for x in other]
            down = [max(-x, 0) for x in other]
            at, next_to = (self.k, self.e), (self.k + 1, self.e)
            if value_at(up, *at) > value_at(down, *next_to):
                return 1
            if value_at(down, *at) > value_at(up, *next_to):
                return -1
            if step >= 24 and not compared:
                compared = True
                common = common_divisor(self.polynomial, other)
                if len(common) > 1 and sign(value_at(common, *at)) != sign(value_at(common, *next_to)):
                    return 0
            self.halve()
        raise ArithmeticError("a sign was not decided")


def roots_in_unit_interval(a: Polynomial) -> List[Root]:
    """All roots in [0, 1] of a polynomial that is not zero."""
    roots: List[Root] = []
    if len(a) < 2:
        return roots
    if len(a) > 2:
        a = quotient(a, common_divisor(a, derivative(a)))
    a = primitive(a)

    def take_out(k: int, e: int) -> None:
        nonlocal a
        roots.append(Root(None, k, e))
        a = quotient(a, [-k, 1 << e])

    for end in (0, 1):
        if value_at(a, end, 0) == 0:
            take_out(end, 0)
    open_intervals = [(0, 0)]
    chain = sturm_chain(a)
    while open_intervals:
        k, e = open_intervals.pop()
        count = variations(chain, k, e) - variations(chain, k + 1, e) if len(a) > 1 else 0
        if count == 1:
            roots.append(Root(a, k, e))
        elif count > 1:
            middle = (2 * k + 1, e + 1)
            if value_at(a, *middle) == 0:
                # Without this root the polynomial is another one: those found so far are roots of either.
                take_out(*middle)
                chain = sturm_chain(a)
            open_intervals += [(2 * k, e + 1), middle]
    return roots
