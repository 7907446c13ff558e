#!/usr/bin/env python3
"""Holds the rotation queries to closed forms and each other, and the library's events to them.

Usage: rotation_queries_test.py SOURCE PROGRAM FOLDER

PROGRAM is condyle-answer-rotations. All queries are asked by make rotation-queries.
"""

import hashlib
import itertools
import math
import subprocess
import sys
import unittest
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

SOURCE, PROGRAM, FOLDER = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
QUERIES = SOURCE / "bench" / "rotation_queries"
sys.dont_write_bytecode = True
sys.path.insert(0, str(QUERIES))

import check  # noqa: E402
import generate  # noqa: E402
from polynomial import roots_in_unit_interval, times  # noqa: E402
from query import EDGE_EDGE, VERTEX_FACE, Query, cross, minus, read_queries, rows_of  # noqa: E402
from second_opinion import contact_in_whole_turn, opinion  # noqa: E402
from truth import contact  # noqa: E402

DEGENERATE = FOLDER / "degenerate.csv"

# Of the first 500 random queries, which are the first rows of random.csv.
FIRST_500 = "8787c7b8bd08c8512ea852174a01cb6a85fbed6e8294e090989985ea59a51f06"



def setUpModule():
    FOLDER.mkdir(parents=True, exist_ok=True)
    generate.write(generate.degenerate_file(), str(DEGENERATE))


FLAT = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
# A wall in the plane y = x, from radius 1 to 3 and around height 0: a vertex on the x axis meets it at 45 degrees,
# tan(t / 2) = sqrt 2 - 1, between 12 / 29 and 5 / 12.
WALL = [(1, 1, -9), (1, 1, 9), (3, 3, 0)]


def vectors(*points):
    return tuple(tuple(Fraction(x) for x in p) for p in points)


def about_z(type_, points, end, start=(0, 1)):
    return Query(type_, vectors(*points), *vectors((0, 0, 0), (0, 0, 1)), start, end)


class Truth(unittest.TestCase):
    def test_vertex_meets_a_wall_where_the_tangent_says(self):
        for vertex, meets in (((2, 0, 0), True), ((4, 0, 0), True), ((5, 0, 0), False), ((1, 0, 0), False)):
            points = [vertex, *WALL]
            self.assertEqual(contact(about_z(VERTEX_FACE, points, (5, 12))), meets)
            self.assertFalse(contact(about_z(VERTEX_FACE, points, (12, 29))))
            self.assertFalse(contact(about_z(VERTEX_FACE, points, (1, 1), start=(5, 12))))

    def test_contact_at_either_end_of_the_motion_counts(self):
        points = [(2, 0, 0), (0, 1, -9), (0, 1, 9), (0, 3, 0)]  # at a quarter turn, tan(t / 2) = 1
        self.assertTrue(contact(about_z(VERTEX_FACE, points, (1, 1))))
        self.assertTrue(contact(about_z(VERTEX_FACE, points, (0, -1), start=(1, 1))))
        self.assertTrue(contact(about_z(VERTEX_FACE, points, (1, 1), start=(1, 1))))
        for bits in (1, 50, 500):
            self.assertFalse(contact(about_z(VERTEX_FACE, points, generate.hair_before((1, 1), bits))))
            self.assertFalse(contact(about_z(VERTEX_FACE, points, (0, -1), start=generate.hair_after((1, 1), bits))))

    def test_half_a_turn_is_an_angle_like_others(self):
        points = [(2, 0, 0), (-1, 0, -9), (-1, 0, 9), (-3, 0, 0)]
        self.assertTrue(contact(about_z(VERTEX_FACE, points, (1, 0))))
        self.assertTrue(contact(about_z(VERTEX_FACE, points, (0, -1), start=(1, 0))))
        self.assertFalse(contact(about_z(VERTEX_FACE, points, (10**30, 1))))
        self.assertFalse(contact(about_z(VERTEX_FACE, points, (0, -1), start=(10**30, -1))))

    def test_grazing_is_a_double_root(self):
        for off, meets in ((0, True), (Fraction(1, 10**40), False), (Fraction(-1, 10**9), True)):
            x = 2 + off
            points = [(0, -2, 0), (x, -1, -1), (x, 1, -1), (x, 0, 1)]  # a quarter turn from the plane x = 2
            self.assertEqual(contact(about_z(VERTEX_FACE, points, (0, -1))), meets)
            self.assertEqual(contact_in_whole_turn(about_z(VERTEX_FACE, points, (0, -1))), meets)

    def test_polynomials_that_are_zero_throughout(self):
        face = [(1, -1, 0), (3, -1, 0), (2, 2, 0)]
        self.assertTrue(contact(about_z(VERTEX_FACE, [(2, 0, 0), *face], (0, 1))), "inside, no turn")
        self.assertTrue(contact(about_z(VERTEX_FACE, [(0, -2, 0), *face], (1, 1))), "in the plane")
        self.assertFalse(contact(about_z(VERTEX_FACE, [(0, -2, 1), *face], (0, -1))), "above the plane")
        self.assertFalse(contact(about_z(VERTEX_FACE, [(0, -4, 0), *face], (0, -1))), "outside of all corners")
        upright = [(1, 0, 0), (1, 0, 2)]
        for low, high, meets in ((1, 3, True), (2, 3, True), (3, 4, False)):
            other = [(0, 1, low), (0, 1, high)]
            self.assertEqual(contact(about_z(EDGE_EDGE, upright + other, (1, 1))), meets, "parallel to the axis")
            self.assertFalse(contact(about_z(EDGE_EDGE, upright + other, (9, 10))))
        on_axis = [(0, 0, 0), (0, 0, 2)]
        for low, high, meets in ((1, 3, True), (2, 3, True), (3, 4, False)):
            both = about_z(EDGE_EDGE, on_axis + [(0, 0, low), (0, 0, high)], (1, 1))
            self.assertEqual(contact(both), meets, "both on the axis")
        through = [(-1, 0, 1), (1, 0, 1), (0, -1, 1), (0, 1, 1)]
        self.assertTrue(contact(about_z(EDGE_EDGE, through, (0, 1))), "both through one point of the axis")

    def test_rulings_of_one_hyperboloid_meet_while_their_crossing_is_on_both(self):
        # At the angle t they cross at the height tan(t / 2).
        for low, high in ((Fraction(5, 12), Fraction(1, 2)), (Fraction(2), Fraction(3))):
            points = [(1, 4, -4), (1, -4, 4), (1, low, low), (1, high, high)]
            at_low, at_high = (low.numerator, low.denominator), (high.numerator, high.denominator)
            self.assertTrue(contact(about_z(EDGE_EDGE, points, at_low)))
            self.assertFalse(contact(about_z(EDGE_EDGE, points, generate.hair_before(at_low, 50))))
            self.assertTrue(contact(about_z(EDGE_EDGE, points, (0, -1), start=at_high)))
            self.assertFalse(contact(about_z(EDGE_EDGE, points, (0, -1), start=generate.hair_after(at_high, 50))))
            self.assertTrue(contact_in_whole_turn(about_z(EDGE_EDGE, points, (0, -1))))
            short = [(1, 4, -4), (1, 0, 0), *points[2:]]
            self.assertFalse(contact(about_z(EDGE_EDGE, short, (0, -1))))
            self.assertFalse(contact_in_whole_turn(about_z(EDGE_EDGE, short, (0, -1))))

    def test_features_without_extent_are_points_and_edges(self):
        self.assertTrue(contact(about_z(EDGE_EDGE, [(2, 0, 0), (2, 0, 0), (0, 1, 0), (0, 3, 0)], (1, 1))))
        self.assertFalse(contact(about_z(EDGE_EDGE, [(2, 0, 0), (2, 0, 0), (0, 3, 0), (0, 4, 0)], (1, 1))))
        self.assertTrue(contact(about_z(EDGE_EDGE, [(2, 0, 0), (2, 0, 0), (0, 2, 0), (0, 2, 0)], (1, 1))))
        self.assertFalse(contact(about_z(EDGE_EDGE, [(2, 0, 0), (2, 0, 0), (0, 2, 1), (0, 2, 1)], (0, -1))))
        self.assertTrue(contact(about_z(VERTEX_FACE, [(2, 0, 0), (0, 1, 0), (0, 2, 0), (0, 4, 0)], (1, 1))))

    def test_lattices_agree_with_halving_and_with_radii(self):
        random = generate.SplitMix64(7)
        decided = 0
        for number in range(300):
            points = [generate.lattice(random, 2) for _ in range(4)]
            flat = not any(cross(minus(points[2], points[1]), minus(points[3], points[1])))
            if points[0] == points[1] or points[2] == points[3] or flat:
                continue
            whole = about_z(number % 2, points, (0, -1))
            self.assertEqual(contact(whole), contact_in_whole_turn(whole), rows_of(whole))
            part = about_z(number % 2, points, (random.between(0, 5), random.between(1, 5)))
            second = opinion(part, 60)
            decided += second is not None
            self.assertIn(second, (None, contact(part)), rows_of(part))
        self.assertGreater(decided, 150)

    def test_both_features_may_be_exchanged_if_the_axis_is_reversed(self):
        for number in range(1, 100, 2):
            query = generate.random_query(5, number)
            a, b, c, d = query.points
            other = replace(query, points=(c, d, a, b), axis=tuple(-x for x in query.axis))
            self.assertEqual(contact(query), contact(other))

    def test_roots_are_all_found_once(self):
        for roots in itertools.combinations([(0, 1), (1, 1), (1, 2), (1, 3), (2, 7), (300, 1001), (301, 1001)], 3):
            polynomial = [1]
            for up, over in roots:
                polynomial = times(polynomial, [-up, over])
            found = roots_in_unit_interval(times(polynomial, polynomial))
            self.assertEqual(len(found), 3)
            for up, over in roots:
                self.assertEqual(sorted(root.sign_of([-up, over]) == 0 for root in found), [False, False, True])


class Files(unittest.TestCase):
    def test_degenerate_queries_are_a_thousand_and_have_their_digest(self):
        data = DEGENERATE.read_bytes()
        digests = (QUERIES / "digests.txt").read_text(encoding="ascii")
        self.assertIn(f"{hashlib.sha256(data).hexdigest()} degenerate.csv", digests)
        self.assertEqual(len(list(read_queries(data.decode("ascii").splitlines()))), 1000)

    def test_first_random_queries_have_their_digest(self):
        rows = generate.random_rows((generate.SEED, 0, 500))
        self.assertEqual(hashlib.sha256(rows.encode("ascii")).hexdigest(), FIRST_500)

    def test_rows_that_are_no_query_are_named(self):
        good = rows_of(replace(about_z(VERTEX_FACE, [(2, 0, 0), *WALL], (1, 1)), answer=1)).splitlines()
        list(read_queries(good))
        for row, text, message in (
            (0, "2,0,0,1,0,1,1", "f:1: a denominator is 0"),
            (1, "1,1,1,1,-9,1,0", "f:2: the answer is 0 or 1, the same in all rows of a query"),
            (2, "1,1,1,1,9", "f:3: 5 numbers, not 7"),
            (3, "a,1,3,1,0,1,1", "f:4: not whole numbers with commas between: 'a,1,3,1,0,1,1'"),
            (5, "0,1,0,1,2,1,1", "f:8: the axis has not the length 1"),
            (5, "0,1,0,1,0,1,1", "f:8: the axis has not the length 1"),
            (6, "1,1,0,1,0,1,1", "f:8: the motion ends before it starts"),
            (6, "0,1,-1,1,0,1,1", "f:8: -1,1 is no half of an angle from 0 to a whole turn"),
            (7, "2,1,0,1,0,1,1", "f:8: the type is 2, neither 0 nor 1"),
        ):
            with self.assertRaises(ValueError) as raised:
                list(read_queries([*good[:row], text, *good[row + 1 :]], "f"))
            self.assertEqual(str(raised.exception), message)
        with self.assertRaisesRegex(ValueError, "f: ends within a query"):
            list(read_queries(good[:-1], "f"))

    def test_checker_counts_what_is_missed_and_invented(self):
        queries = list(itertools.islice(generate.degenerate_queries(each=4), 8))
        answers = [str(query.answer) for query in queries]
        self.assertFalse(any(name != check.TOTAL for name, *_ in check.count(queries, answers)))
        flipped = check.count(queries, [str(1 - query.answer) for query in queries])
        expected = sum(query.answer for query in queries)
        self.assertEqual(sum(number for (name, *_), number in flipped.items() if name == check.MISSED), expected)
        self.assertEqual(sum(number for (name, *_), number in flipped.items() if name == check.INVENTED), 8 - expected)
        with self.assertRaises(ValueError):
            check.count(queries, answers[:-1])


class Answers(unittest.TestCase):
    """Of the program."""

    def counts(self, method, path):
        done = subprocess.run([PROGRAM, method, str(path)], capture_output=True, text=True, check=True)
        with open(path, encoding="ascii") as rows:
            return check.count(read_queries(rows), done.stdout.splitlines(), 4e-12)

    def of(self, counts, what, about_coordinate):
        return sum(number for (name, about, _), number in counts.items() if name == what and about == about_coordinate)

    def test_events_miss_and_invent_nothing(self):
        path = FOLDER / "random.csv"
        generate.write(iter([generate.random_rows((generate.SEED, 500, 2000))]), str(path))
        for queries in (path, DEGENERATE):
            counts = self.counts("events", queries)
            self.assertGreater(self.of(counts, check.TOTAL, True), 700)
            self.assertEqual(self.of(counts, check.MISSED, True), 0)
            self.assertEqual(self.of(counts, check.INVENTED, True), 0)
            self.assertEqual(self.of(counts, check.INVENTED, False), 0)
        # Placing rounds what is degenerate about other axes, and only that.
        for method in ("events", "search"):
            counts = self.counts(method, path)
            for about_coordinate in (False, True):
                self.assertEqual(self.of(counts, check.MISSED, about_coordinate), 0)
                self.assertEqual(self.of(counts, check.INVENTED, about_coordinate), 0)

    def test_events_have_the_exact_answer_for_points_as_placed(self):
        # About oblique axes, where placing rounds: degenerate queries are others then, and those are answered exactly.
        path = DEGENERATE
        lines = {}
        for method in ("placed", "events"):
            done = subprocess.run([PROGRAM, method, str(path)], capture_output=True, text=True, check=True)
            lines[method] = done.stdout.splitlines()
        with open(path, encoding="ascii") as file:
            queries = list(read_queries(file))
        asked = others = 0
        for query, line, answer in zip(queries, lines["placed"], lines["events"]):
            if check.is_about_coordinate(query):
                continue
            numbers = [Fraction(float.fromhex(word)) for word in line.split()]
            points = [tuple(numbers[3 * i : 3 * i + 3]) for i in range(4)]
            (s0, c0), (s1, c1) = query.start, query.end
            placed = about_z(query.type, points, (s1 * c0 - c1 * s0, c1 * c0 + s1 * s0))
            asked += 1
            others += contact(placed) != (query.answer == 1)
            if answer == "0":
                self.assertFalse(contact(placed), rows_of(query))
            else:
                self.assertTrue(contact(check.longer(placed, Fraction(4e-12))), rows_of(query))
        self.assertEqual(asked, 248)
        self.assertGreater(others, 40)

    def test_chords_miss_nothing_and_samples_do(self):
        queries = DEGENERATE
        chords, samples = self.counts("chords=3", queries), self.counts("samples=3", queries)
        self.assertEqual(self.of(chords, check.MISSED, True), 0)
        self.assertGreater(self.of(chords, check.INVENTED, True), 0)
        self.assertGreater(self.of(samples, check.MISSED, True), 0)

    def test_angles_of_the_ipc_toolkit_are_closed_forms(self):
        # Shares of the motion at which its test says that they meet, to a hundredth of the motion.
        shares = [1 / 2, 1 / 4, 1 / 2, 30 / 360, 1 / 2, 1 / 2, 1 / 2]
        turns = [math.pi, 2 * math.pi, math.pi, 2 * math.pi, math.pi, math.pi, math.pi]
        path = SOURCE / "bench" / "other_suites" / "ipc_toolkit.csv"
        with open(path, encoding="ascii") as file:
            self.assertTrue(all(contact(query) for query in read_queries(file)))
        done = subprocess.run([PROGRAM, "angles", str(path)], capture_output=True, text=True, check=True)
        angles = [float(line) for line in done.stdout.split()]
        self.assertEqual(len(angles), 7)
        closed = [math.pi / 2, math.pi / 2, math.pi / 2, math.asin(1 / 2), *[math.pi / 2] * 3]
        for angle, expected, share, turn in zip(angles, closed, shares, turns):
            self.assertAlmostEqual(angle, expected, delta=1e-12)
            self.assertAlmostEqual(angle / turn, share, delta=1e-2)

    def test_translations_of_other_queries_are_counted_and_checked(self):
        # One of each: at rest, a translation, one that deforms.
        rows = {
            "vertex-face": [[(0, 0, 1), *FLAT, (0, 0, 1), *FLAT], [(0, 0, 1), *FLAT, (0, 0, -1), *FLAT]],
            "edge-edge": [[(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0, 0), (1, 2, 0), (0, 1, 0), (1, 1, 0)]],
        }
        for name, queries in rows.items():
            folder = FOLDER / "suite" / "scene" / name
            folder.mkdir(parents=True, exist_ok=True)
            lines = [f"{x},1,{y},1,{z},1,{int(points[4] != points[0])}" for points in queries for x, y, z in points]
            (folder / "data.csv").write_text("\n".join(lines) + "\n", encoding="ascii")
        program, out = SOURCE / "bench" / "other_suites" / "sample_queries.py", FOLDER / "translations.csv"
        command = [sys.executable, "-B", program, FOLDER / "suite"]
        done = subprocess.run([*command, out], capture_output=True, text=True, check=False)
        self.assertEqual(done.stdout.splitlines()[0], "3 queries: 1 translations, 1 at rest, 1 that deform")
        self.assertEqual(done.stdout.splitlines()[1], "1 of the rigid ones in contact, 0 answers differ")
        self.assertEqual(out.read_text(encoding="ascii").splitlines()[9], "0,1,0,1,-2,1,1")
        data = FOLDER / "suite" / "scene" / "vertex-face" / "data.csv"
        data.write_text(data.read_text(encoding="ascii").replace("1,1\n", "1,0\n"), encoding="ascii")
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.splitlines()[0], "scene/vertex-face/data.csv, query 1: the file says 0")

    def test_bad_words_and_files_get_one_line(self):
        bad = FOLDER / "bad.csv"
        FOLDER.mkdir(parents=True, exist_ok=True)
        bad.write_text("1,1,1,1,1,1,0\nx\n", encoding="ascii")
        short = FOLDER / "short.csv"
        short.write_text("1,1,1,1,1,1,0\n", encoding="ascii")
        for words, code in (
            (["events"], 2),
            (["guesses", str(bad)], 2),
            (["chords=-1", str(bad)], 2),
            (["chords=1x", str(bad)], 2),
            (["events", str(bad)], 3),
            (["events", str(short)], 3),
            (["events", str(FOLDER / "none.csv")], 3),
        ):
            done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, code)
            self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
