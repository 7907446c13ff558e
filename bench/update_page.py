#!/usr/bin/env python3
"""Writes the tables of a run of condyle-bench into pages of bench/tables: update_page.py RUN.json PAGE.md...

A page has places for tables of the run, and for what the run must be read with:

    <!-- begin machine -->
    ...                          replaced
    <!-- end machine -->

The rest of a page is left alone. All tables of all pages are of one run: a place the run has no table for is
an error, and so is a run of a part (--filter, --quick) or one whose answers disagree. One of --summary has the
tables of beside-others.md. The place `runs` gets the stored runs of bench/runs.json.
"""

import json
import re
import sys
from pathlib import Path


def markdown(titles, rows, numeric):
    lines = [titles, ["--:" if right else "---" for right in numeric], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def machine_table(run):
    rows = [[name, words] for name, words in run["machine"].items()]
    return markdown(["", "this run"], rows, [False, False])


def result_table(table):
    first = table["rows"][0]
    numeric = [not isinstance(first[column["key"]], str) for column in table["columns"]]
    titles = [column["title"] for column in table["columns"]]
    return f"**{table['title']}**\n\n" + markdown(titles, table["shown"], numeric)


def runs_table(runs):
    """The main ratios of each stored run, the last one first; what a run did not ask is a dash."""
    names = list(dict.fromkeys(name for run in runs for name in run["ratios"]))
    titles = ["date", "commit", "processor", "load", *(", ".join(name.split("/", 2)) for name in names)]
    rows = []
    for run in reversed(runs):
        ratios = [f"{run['ratios'][name]:.3g}" if name in run["ratios"] else "-" for name in names]
        rows.append([run["date"], run["commit"], run["processor"], run["load"].partition(" (")[0], *ratios])
    return markdown(titles, rows, [False] * 4 + [True] * len(names))


def main(run_path, page_paths):
    with open(run_path, encoding="utf-8") as file:
        run = json.load(file)
    if run["disagreements"]:
        sys.exit("update_page.py: answers disagree: " + "; ".join(run["disagreements"]))
    if "unfinished" in run["machine"]:
        sys.exit("update_page.py: the run was broken off before its end")
    if run["machine"]["run"] not in ("full", "summary"):
        sys.exit(f"update_page.py: the run is '{run['machine']['run']}', not 'full' or 'summary'")
    content = {table["name"]: result_table(table) for table in run["tables"]}
    content["machine"] = machine_table(run)
    content["runs"] = runs_table(json.loads(Path(__file__).with_name("runs.json").read_text(encoding="utf-8")))
    content["skipped"] = "\n".join(f"- {line}" for line in run["skipped"]) or "Nothing was left out."

    def place(match):
        name = match.group(1)
        if name not in content:
            sys.exit(f"update_page.py: the run has no table '{name}': are its scenes there?")
        return f"<!-- begin {name} -->\n{content[name]}\n<!-- end {name} -->"

    pages = {}
    for path in page_paths:
        with open(path, encoding="utf-8") as file:
            pages[path] = re.sub(r"<!-- begin (\w+) -->.*?<!-- end \1 -->", place, file.read(), flags=re.DOTALL)
    for path, page in pages.items():
        with open(path, "w", encoding="utf-8") as file:
            file.write(page)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
