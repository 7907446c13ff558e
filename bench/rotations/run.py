#!/usr/bin/env python3
"""Misses, false alarms and times over all rotation queries: run.py PROGRAM FOLDER

PROGRAM is condyle-answer-rotations. The random queries are made in FOLDER, unless they are there already; either file
must have the digest that bench/rotation_queries/digests.txt says. Writes FOLDER/run.json, which bench/update_page.py
takes. Ends with 1 if the library's events miss anything, or invent anything that is not next to an end of the motion.
"""

import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Iterator

QUERIES = Path(__file__).resolve().parent.parent / "rotation_queries"
sys.path.insert(0, str(QUERIES))

import check  # noqa: E402
import generate  # noqa: E402
import second_opinion  # noqa: E402
from query import KINDS, read_queries  # noqa: E402

COUNT, OPINIONS = 100_000, 10_000
# Bound of the error of the library's limits, in radians.
ERROR = 4e-12
METHODS = {
    "Condyle, contact events": "events",
    "Condyle, search over flat triangles": "search",
    "chords of 1°": "chords=1",
    "chords of 0.1°": "chords=0.1",
    "samples at 1°": "samples=1",
    "samples at 0.1°": "samples=0.1",
}
GROUPS = {"coordinate axis": True, "oblique axis": False}


def digest_of(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def expected_digests() -> "dict[str, str]":
    lines = (QUERIES / "digests.txt").read_text(encoding="ascii").splitlines()
    return {name: digest for digest, name in (line.split() for line in lines)}


def made(path: Path, pieces: Iterator[str]) -> Path:
    if not path.exists() or digest_of(path) != expected_digests()[path.name]:
        print(f"making {path}", flush=True)
        generate.write(pieces, str(path))
    return path


def answers_of(program: str, method: str, queries: Path, folder: Path) -> "tuple[Path, float]":
    done = subprocess.run([program, method, str(queries)], capture_output=True, text=True, check=True)
    path = folder / f"{queries.stem}.{method.replace('=', '_')}.txt"
    path.write_text(done.stdout, encoding="ascii")
    return path, float(done.stderr.split()[0])


def counts_of(queries: Path, answers: Path) -> "check.Counter":
    with open(queries, encoding="ascii") as rows, open(answers, encoding="ascii") as lines:
        return check.count(read_queries(rows, str(queries)), lines, ERROR)


def total(counts: "check.Counter", what: str, group: bool, kinds=range(len(KINDS))) -> int:
    return sum(counts[(what, group, kind)] for kind in kinds)


def table(name: str, title: str, columns: list, rows: list) -> dict:
    """As bench/table.cpp writes one."""
    keyed = [dict(zip((key for key, _ in columns), row)) for row in rows]
    shown = [[str(cell) if isinstance(cell, (int, str)) else f"{cell:.3g}" for cell in row] for row in rows]
    return {
        "name": name,
        "title": title,
        "columns": [{"key": key, "title": heading} for key, heading in columns],
        "rows": keyed,
        "shown": shown,
    }


def methods_table(name: str, title: str, results: dict) -> dict:
    columns = [("method", "method"), ("us", "µs a query")]
    for group in GROUPS:
        columns += [(f"{group}: {what}", f"{group}: {what}") for what in ("queries", "missed", "false alarms")]
    columns.append(("next_to_an_end", "and next to an end"))
    rows = []
    for method, (counts, microseconds) in results.items():
        row = [method, microseconds]
        for group in GROUPS.values():
            row += [total(counts, what, group) for what in (check.TOTAL, check.MISSED, check.INVENTED)]
        rows.append([*row, sum(total(counts, check.NEARLY, group) for group in GROUPS.values())])
    return table(name, title, columns, rows)


def kinds_table(results: dict, queries: Path) -> dict:
    columns = [("kind", "kind"), ("queries", "queries"), ("contacts", "contacts")]
    columns += [(method, method) for method in results]
    contacts = {}
    with open(queries, encoding="ascii") as file:
        for query in read_queries(file):
            if check.is_about_coordinate(query):
                contacts[query.kind] = contacts.get(query.kind, 0) + query.answer
    rows = []
    for kind, title in list(enumerate(KINDS))[1:]:
        first = next(iter(results.values()))[0]
        row = [title, first[(check.TOTAL, True, kind)], contacts[kind]]
        for counts, _ in results.values():
            invented = counts[(check.INVENTED, True, kind)] + counts[(check.NEARLY, True, kind)]
            row.append(f"{counts[(check.MISSED, True, kind)]} / {invented}")
        rows.append(row)
    title = "Degenerate queries about axes of the coordinates: missed / false alarms"
    return table("rotation_kinds", title, columns, rows)


def opinions_table(paths: list) -> dict:
    columns = [("file", "file"), ("asked", "asked"), ("halving", "decided by halving")]
    columns += [("radii", "whole turns, by radii"), ("neither", "by neither"), ("contradicted", "contradicted")]
    rows = []
    for path in paths:
        asked = halved = radii = neither = contradicted = 0
        with open(path, encoding="ascii") as file:
            for query in read_queries(file, str(path)):
                if asked == OPINIONS:
                    break
                asked += 1
                answers = [second_opinion.opinion(query)]
                halved += answers[0] is not None
                if second_opinion.is_whole_turn(query):
                    radii += 1
                    answers.append(second_opinion.contact_in_whole_turn(query))
                neither += all(answer is None for answer in answers)
                contradicted += any(answer is not None and answer != (query.answer == 1) for answer in answers)
        rows.append([path.stem, asked, halved, radii, neither, contradicted])
    return table("rotation_truth", "The second opinion on the answers in the files", columns, rows)


def cpu_info(name: str) -> str:
    found = re.search(rf"^{name}\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
    return found.group(1) if found else "unknown"


def machine(load_before: float) -> dict:
    describe = ["git", "-C", str(QUERIES), "describe", "--always", "--dirty", "--abbrev=12"]
    commit = subprocess.run(describe, capture_output=True, text=True, check=False)
    return {
        "processor": f"{cpu_info('model name')} (family {cpu_info('cpu family')}, model {cpu_info('model')})",
        "threads": str(os.cpu_count()),
        "commit": commit.stdout.strip() or "unknown",
        "date": time.strftime("%Y-%m-%d %H:%M UTC", datetime.datetime.now(datetime.timezone.utc).timetuple()),
        "run": "full",
        "load": f"{load_before:.1f} before, {os.getloadavg()[0]:.1f} after",
    }


def main(program: str, folder: Path) -> int:
    load = os.getloadavg()[0]
    disagreements = []
    files = {"random": made(folder / "random.csv", generate.random_file(COUNT)),
             "degenerate": made(folder / "degenerate.csv", generate.degenerate_file())}
    for path in files.values():
        if digest_of(path) != expected_digests()[path.name]:
            disagreements.append(f"{path} is not the file of digests.txt")
    tables, results = [], {}
    for name, path in files.items():
        results[name] = {}
        for title, method in METHODS.items():
            answers, microseconds = answers_of(program, method, path, folder)
            results[name][title] = (counts_of(path, answers), microseconds)
        tables.append(methods_table(f"rotation_{name}", f"{name.capitalize()} queries", results[name]))
        # The search has the neighbours that degenerate contact is left to in meshes, not in flat triangles.
        for title in list(METHODS)[: 2 if name == "random" else 1]:
            counts = results[name][title][0]
            if total(counts, check.MISSED, True) + total(counts, check.INVENTED, True):
                disagreements.append(f"{title} misses or invents contact in {name} queries")
    tables.append(kinds_table(results["degenerate"], files["degenerate"]))
    tables.append(opinions_table(list(files.values())))
    disagreements += [f"contradicted: {row}" for row in tables[-1]["rows"] if row["contradicted"]]
    run = {"machine": machine(load), "tables": tables, "skipped": [], "disagreements": disagreements}
    (folder / "run.json").write_text(json.dumps(run, indent=1), encoding="utf-8")
    for line in disagreements:
        print(line, file=sys.stderr)
    return 1 if disagreements else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2])))
