#!/usr/bin/env python3
"""Compiles one source by emscripten, around a fault of clang 14 with vectors.

Usage: frozen_lanes.py COMPILER ARGUMENT..., as CMake launches a compiler

Clang 14 loads a number and puts it into a vector by one instruction, v128.load64_splat, which it may place after what
writes to the same address later (WebAssemblyISelLowering.cpp, LOAD_SPLAT has no chain): the vector then holds what was
written. A number that is frozen (https://llvm.org/docs/LangRef.html#freeze-instruction) is loaded by itself, in its
place.
"""
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

LANE = re.compile(r"(\s*%\S+ = insertelement <\d+ x (.+)> .*, )\2 (%\S+)(, i\d+ .*)", re.S)
CODE_GENERATION = re.compile(r"-[Omf](?!file-prefix-map)")


def frozen(lines: Iterable[str]) -> Iterator[str]:
    for number, line in enumerate(lines):
        if lane := LANE.fullmatch(line):
            before, kind, value, after = lane.groups()
            yield f"  %frozen.{number} = freeze {kind} {value}\n"
            line = f"{before}{kind} %frozen.{number}{after}"
        # What is defined for sure is thawed.
        yield line.replace(" noundef", "")


def main() -> int:
    command = sys.argv[1:]
    output = command.index("-o") + 1
    made = Path(command[output])
    text, result = made.with_suffix(".ll"), made.with_suffix(".frozen.ll")
    to_text = [*command[:output], str(text), *command[output + 1:], "-S", "-emit-llvm"]
    # Optimised already, but for the instructions that are chosen.
    to_object = [command[0], *filter(CODE_GENERATION.match, command), "-Xclang", "-disable-llvm-passes",
                 "-c", str(result), "-o", str(made)]
    try:
        if code := subprocess.run(to_text).returncode:
            return code
        with open(text, encoding="utf-8") as lines, open(result, "w", encoding="utf-8") as changed:
            changed.writelines(frozen(lines))
        return subprocess.run(to_object).returncode
    finally:
        text.unlink(missing_ok=True)
        result.unlink(missing_ok=True)


if __name__ == "__main__":
    sys.exit(main())
