#!/usr/bin/env python3
"""Holds the documents to what a reader needs of them. Usage: pages.py SOURCE_FOLDER

- a page of docs/ has at most 200 lines, and README.md at most 300 words before the first answer of a command;
- a link to a heading leads to one;
- a page that a comment of the sources cites is there;
- every function of docs/cpp.md stands in its example, which the tests compile and run;
- docs/commands.md names every command.
"""
import re
import sys
from pathlib import Path

MOST_LINES, MOST_WORDS = 200, 300
SOURCES = ("include", "src", "cli", "python", "tests", "bench", "examples", "workflow")


def without_code(page: str) -> str:
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", page, flags=re.S | re.M))


def anchors_of(page: str) -> "set[str]":
    headings = re.findall(r"^#+ (.*)", re.sub(r"^```.*?^```", "", page, flags=re.S | re.M), re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", each).lower()).replace(" ", "-") for each in headings}


def main(source: Path) -> int:
    wrong = []
    docs = sorted((source / "docs").rglob("*.md"))
    pages = [source / "README.md", source / "CONTRIBUTING.md", *docs, *sorted((source / "bench/tables").glob("*.md"))]
    texts = {page.resolve(): page.read_text(encoding="utf-8") for page in pages}
    wrong += [f"{page.relative_to(source)}: {lines} lines, {MOST_LINES} are the most" for page in docs
              if (lines := texts[page.resolve()].count("\n")) > MOST_LINES]
    before = re.sub(r"\]\([^)]*\)", "]", texts[(source / "README.md").resolve()].partition("```text")[0])
    if len(before.split()) > MOST_WORDS:
        wrong.append(f"README.md: {len(before.split())} words before the first answer, {MOST_WORDS} are the most")
    for page in pages:
        for target, anchor in re.findall(r"\]\(([^)#\s:]*)#([^)\s]+)\)", without_code(texts[page.resolve()])):
            to = (page.parent / target).resolve() if target else page.resolve()
            if to in texts and anchor not in anchors_of(texts[to]):
                wrong.append(f"{page.relative_to(source)}: no heading #{anchor} in {to.relative_to(source.resolve())}")
    example = (source / "examples/joint_of_arrays.cpp").read_text(encoding="utf-8")
    wrong += [f"docs/cpp.md: not in its example: {function.partition(chr(10))[0]}"
              for block in re.findall(r"^```cpp\n(.*?)^```", texts[(source / "docs/cpp.md").resolve()], re.S | re.M)
              for function in block.split("\n\n") if function.strip() not in example]
    named = texts[(source / "docs/commands.md").resolve()]
    wrong += [f"docs/commands.md: condyle {command} answers no question"
              for command in re.findall(r"\badd_(\w+)\(", (source / "cli/commands.hpp").read_text(encoding="utf-8"))
              if not re.search(rf"`condyle {command}\b", named)]
    for folder in SOURCES:
        for file in sorted((source / folder).rglob("*")):
            if file.suffix in (".hpp", ".cpp", ".py", ".cmake") and file.is_file():
                for cited in re.findall(r"\bdocs/[\w/-]+\.md\b", file.read_text(encoding="utf-8")):
                    if not (source / cited).is_file():
                        wrong.append(f"{file.relative_to(source)}: there is no page {cited}")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
