#!/usr/bin/env python3
"""The cases of tests/slow_cases.txt, which `make test` leaves out and `make test-all` runs.

slow_cases.py check RESULTS   after a run: names cases that took long and are not on the list; exit code 1 if one took very long
slow_cases.py list RESULTS    prints the list that those results would give
slow_cases.py names BUILD     names cases on the list that no test program of a build folder has; exit code 1 if there are any

RESULTS is the folder of the files that GoogleTest and pytest wrote. Only differences between cases of one run are judged: a slow machine
makes all of them slower.
"""

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
LIST = SOURCE / "tests" / "slow_cases.txt"

# A case is slow that takes a second where the quick ones take this much together, in seconds: the first line of the list has it.
QUICK_TOTAL = re.compile(r"# Quick cases take (\d+) s altogether")
# Runs beside other work differ, and one case in thousands waits for a disk: what takes so many seconds, on a machine as quick as the list's, is named,
# and what takes so many makes the run fail.
NAMED, REFUSED = 3.0, 10.0


def case_of(result: Path, case: ElementTree.Element) -> str:
    """As the list has it: the program, and the case as its --gtest_filter or pytest names it."""
    suite, name = case.get("classname", ""), case.get("name", "")
    program = result.stem.split(".")[0]
    if not suite.startswith("tests."):
        return f"{program} {suite}.{name}"
    words = suite.split(".")
    files = [count for count in range(len(words), 0, -1) if (SOURCE / ("/".join(words[:count]) + ".py")).is_file()]
    if not files:
        return f"{program} {suite}.{name}"
    inner = "".join(word + "::" for word in words[files[0] :])
    return f"{program} {'/'.join(words[: files[0]])}.py::{inner}{name}"


def seconds_of_cases(results: Path) -> dict[str, float]:
    seconds: dict[str, float] = {}
    for result in sorted(results.glob("*.xml")):
        for case in ElementTree.parse(result).getroot().iter("testcase"):
            seconds[case_of(result, case)] = float(case.get("time") or 0)
    return seconds


def listed() -> list[str]:
    """Those that `make test` runs too, because nothing quicker protects what they do, have a + before them."""
    return [line.removeprefix("+ ") for line in LIST.read_text().splitlines() if line and not line.startswith("#")]


def check(results: Path) -> int:
    known, seconds = set(listed()), seconds_of_cases(results)
    usual = QUICK_TOTAL.search(LIST.read_text())
    assert usual, f"{LIST}: its first lines say how long the quick cases take"
    # The suite of workflow/ waits for schedulers and is slow as a whole, by its label.
    quick = {case: took for case, took in seconds.items() if case not in known and not case.startswith("workflow ")}
    # The total without its longest, which may be the fault that is looked for.
    slowness = max(1.0, sum(took for took in quick.values() if took < NAMED) / float(usual[1]))
    found = {case: took / slowness for case, took in quick.items() if took > NAMED * slowness}
    for case, took in sorted(found.items(), key=lambda item: -item[1]):
        print(f"{case} took {took:.1f} s and is not in tests/slow_cases.txt: make it quicker, or list it", file=sys.stderr)
    left = sum(case not in seconds for case in known)
    if left:
        print(f"{left} slow cases were left out: make test-all runs them")
    return 1 if any(took > REFUSED for took in found.values()) else 0


def print_list(results: Path) -> int:
    seconds = seconds_of_cases(results)
    slow = sorted(case for case, took in seconds.items() if took > 1)
    quick = sum(took for took in seconds.values() if took <= 1)
    print("# Cases that take over a second. `make test` leaves them out, `make test-all` runs them: scripts/slow_cases.py.")
    print(f"# Quick cases take {quick:.0f} s altogether.")
    print("# A + before a case: nothing quicker protects what it does, or it makes what its suite shares, and make test runs it too.")
    kept = {line[2:] for line in LIST.read_text().splitlines() if line.startswith("+ ")} if LIST.exists() else set()
    print("\n".join(("+ " if case in kept else "") + case for case in slow))
    return 0


def names(build: Path) -> int:
    """pytest itself refuses a listed case that it does not have."""
    wrong = 0
    for program in sorted({line.split(" ", 1)[0] for line in listed()} - {"python"}):
        path = next(build.rglob(f"test_{program}"), None)
        text = subprocess.run([path, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout if path else ""
        suite, known = "", set()
        for line in text.splitlines():
            name = line.split("#")[0].rstrip()
            if name.startswith(" "):
                known.add(suite + name.strip())
            else:
                suite = name
        # Which instruction sets there are is the processor's and Highway's: one of them stands for all.
        known |= {case.rsplit("/", 1)[0] for case in known if case.startswith("EveryInstructionSet/")}
        for line in listed():
            case = line.split(" ", 1)[1]
            if line.split(" ", 1)[0] == program and case not in known and case.rsplit("/", 1)[0] not in known:
                print(f"tests/slow_cases.txt: no case is called {line}", file=sys.stderr)
                wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    tasks = {"check": check, "list": print_list, "names": names}
    if len(sys.argv) != 3 or sys.argv[1] not in tasks:
        sys.exit(__doc__)
    sys.exit(tasks[sys.argv[1]](Path(sys.argv[2])))
