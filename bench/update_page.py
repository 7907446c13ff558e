#!/usr/bin/env python3
"""Writes the tables of a run of condyle-bench into a page: update_page.py RUN.json PAGE.md

The page has a place for each table of the run, and for what the run must be read with:

    <!-- begin machine -->
    ...                          replaced
    <!-- end machine -->

The rest of the page is left alone. All tables of a page are of one run: a place the run has no table for is
an error, and so is a run of a part (--filter, --quick) or one whose answers disagree.
"""

import json
import re
import sys


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


def main(run_path, page_path):
    with open(run_path, encoding="utf-8") as file:
        run = json.load(file)
    if run["disagreements"]:
        sys.exit("update_page.py: answers disagree: " + "; ".join(run["disagreements"]))
    if run["machine"]["run"] != "full":
        sys.exit(f"update_page.py: the run is '{run['machine']['run']}', not 'full'")
    content = {table["name"]: result_table(table) for table in run["tables"]}
    content["machine"] = machine_table(run)

    def place(match):
        name = match.group(1)
        if name not in content:
            sys.exit(f"update_page.py: the run has no table '{name}': are its scenes there?")
        return f"<!-- begin {name} -->\n{content[name]}\n<!-- end {name} -->"

    with open(page_path, encoding="utf-8") as file:
        page = file.read()
    page = re.sub(r"<!-- begin (\w+) -->.*?<!-- end \1 -->", place, page, flags=re.DOTALL)
    with open(page_path, "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
