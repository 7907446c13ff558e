#!/usr/bin/env python3
"""Counts and checks the queries of Wang et al. 2021 that a rigid motion answers: sample_queries.py FOLDER [OUT.csv]

FOLDER is a copy of github.com/Continuous-Collision-Detection/Sample-Queries. A query is rigid if the points of each
of its features run along one vector, so that one feature translates past the other; in the rest a feature deforms,
which is out of scope here. The answers of the rigid ones are held against exact ones. OUT.csv gets them, five rows
each: the four points at the start, and the way of the first feature seen from the second one; seven whole numbers a
row as in the originals.

Ends with 1 if an answer differs.
"""

import math
import sys
from fractions import Fraction
from pathlib import Path
from typing import Iterator, List, Optional, Tuple

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "rotation_queries"))

from query import EDGE_EDGE, VERTEX_FACE, Query, minus  # noqa: E402
from truth import Piece  # noqa: E402

ROWS = 8


class Translation(Piece):
    """As a rotation that turns nothing, about no matter what axis, and a way from 0 to 1 of it."""

    def __init__(self, type_: int, points: list, way: tuple) -> None:
        scale = math.lcm(*(x.denominator for p in [*points, way] for x in p))
        whole = [tuple(Fraction(x * scale) for x in p) for p in [*points, way]]
        nowhere, up = (Fraction(0),) * 3, (Fraction(0), Fraction(0), Fraction(1))
        super().__init__(Query(type_, tuple(whole[:4]), nowhere, up, (0, 1), (0, 1)), (0, 1), (0, 1))
        self.way = [int(x) for x in whole[4]]

    def moved(self, x: tuple) -> list:
        return [[p, w] if w else [p] if p else [] for p, w in zip(x, self.way)]


def queries_of(path: Path) -> Iterator[Tuple[List[tuple], int]]:
    """The eight points of each query, and its answer."""
    rows = []
    for number, line in enumerate(path.read_text(encoding="ascii").splitlines(), 1):
        row = [int(field) for field in line.split(",")]
        if len(row) != 7:
            raise ValueError(f"{path}:{number}: {len(row)} numbers, not 7")
        rows.append(row)
        if len(rows) == ROWS:
            yield [tuple(Fraction(r[2 * i], r[2 * i + 1]) for i in range(3)) for r in rows], rows[0][6]
            rows = []
    if rows:
        raise ValueError(f"{path}: ends within a query")


def rigid_queries(folder: Path) -> Iterator[Optional[tuple]]:
    """Of each query that is rigid its name, type, points at the start, the way of the first feature seen from the second
    one, and the file's answer; of each other one nothing.
    """
    for path in sorted(folder.glob("*/*/*.csv")):
        type_ = EDGE_EDGE if path.parent.name == "edge-edge" else VERTEX_FACE
        first = 2 if type_ == EDGE_EDGE else 1
        for number, (points, answer) in enumerate(queries_of(path)):
            ways = [minus(points[i + 4], points[i]) for i in range(4)]
            if len(set(ways[:first])) > 1 or len(set(ways[first:])) > 1:
                yield None
            else:
                name = f"{path.relative_to(folder)}, query {number}"
                yield name, type_, points[:4], minus(ways[0], ways[first]), answer == 1


def main(folder: Path, out: "Path | None") -> int:
    total = rest = translations = contacts = differ = 0
    written: List[str] = []
    for query in rigid_queries(folder):
        total += 1
        if not query:
            continue
        name, type_, points, way, answer = query
        if any(way):
            translations += 1
        else:
            rest += 1
        meets = Translation(type_, points, way).holds_contact()
        contacts += meets
        if meets != answer:
            differ += 1
            print(f"{name}: the file says {int(answer)}")
        for p in (*points, way):
            row = [part for x in p for part in (x.numerator, x.denominator)]
            written.append(",".join(map(str, [*row, int(meets)])))
    if not total:
        sys.exit(f"sample_queries.py: no queries in {folder}")
    print(f"{total} queries: {translations} translations, {rest} at rest, {total - translations - rest} that deform")
    print(f"{contacts} of the rigid ones in contact, {differ} answers differ")
    if out:
        out.write_text("\n".join(written) + "\n", encoding="ascii")
    return 1 if differ else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) == 3 else None))
