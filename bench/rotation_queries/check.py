#!/usr/bin/env python3
"""Counts what a tool missed and what it invented: check.py QUERIES.csv ANSWERS.txt [ANGLE]

ANSWERS.txt has a line per query, 1 for contact and 0 for none. Queries about an axis of the coordinates, which
doubles hold, are counted apart from those about other axes. With an ANGLE in radians, false alarms are counted apart
if there is contact once the motion begins and ends by that much earlier and later: of a tool that states such an
error.

Ends with 1 if anything was missed.
"""

import sys
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from itertools import zip_longest
from typing import Iterable, Tuple

from query import KINDS, Query, read_queries
from truth import contact

MISSED, INVENTED, NEARLY, TOTAL = "missed", "false alarms", "false alarms next to an end", "queries"


def is_about_coordinate(query: Query) -> bool:
    return sum(x == 0 for x in query.axis) == 2


def longer(query: Query, angle: Fraction) -> Query:
    """The same motion, begun earlier and ended later by a little less than the angle, within a whole turn."""
    # tan(angle / 2) is more than angle / 2: the rational angle / 2 in its place turns a little less.
    up, over = (angle / 2).numerator, (angle / 2).denominator
    (s0, c0), (s1, c1) = query.start, query.end
    start = (s0 * over - c0 * up, c0 * over + s0 * up)
    end = (s1 * over + c1 * up, c1 * over - s1 * up)
    return replace(query, start=start if start[0] > 0 else (0, 1), end=end if end[0] > 0 else (0, -1))


def count(queries: Iterable[Query], answers: Iterable[str], angle: float = 0.0) -> Counter:
    """By what happened, about a coordinate's axis or not, and kind."""
    counts: Counter = Counter()
    for number, (query, answer) in enumerate(zip_longest(queries, answers)):
        if query is None or answer is None or answer.strip() not in ("0", "1"):
            what = "none" if answer is None else "no query" if query is None else repr(answer)
            raise ValueError(f"answer {number + 1}: {what}")
        group: Tuple[bool, int] = (is_about_coordinate(query), query.kind)
        counts[(TOTAL, *group)] += 1
        if query.answer == 1 and answer.strip() == "0":
            counts[(MISSED, *group)] += 1
        if query.answer == 0 and answer.strip() == "1":
            near = angle > 0 and contact(longer(query, Fraction(angle)))
            counts[(NEARLY if near else INVENTED, *group)] += 1
    return counts


def main(queries_path: str, answers_path: str, angle: float) -> int:
    with open(queries_path, encoding="ascii") as queries, open(answers_path, encoding="ascii") as answers:
        counts = count(read_queries(queries, queries_path), answers, angle)
    names = [TOTAL, MISSED, INVENTED, *([NEARLY] if angle else [])]
    for about_coordinate in (True, False):
        for kind, title in enumerate(KINDS):
            if counts[(TOTAL, about_coordinate, kind)]:
                shown = ", ".join(f"{counts[(name, about_coordinate, kind)]} {name}" for name in names)
                print(f"{'coordinate axis' if about_coordinate else 'oblique axis'}, {title}: {shown}")
    return 1 if any(name == MISSED and number for (name, *_), number in counts.items()) else 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) == 4 else 0.0))
