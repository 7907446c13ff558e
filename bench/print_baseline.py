#!/usr/bin/env python3
"""Prints the stored ratios as tables: print_baseline.py [BASELINE.json] [WORD...]

Each ratio says how many times longer another method takes than Condyle, at the same poses of one scene; of whole commands, how
many times longer `condyle inspect` takes. WORDs choose tables by their titles, such as `inside` or `touch libhip`. Times, answers
that were wrong, and goals are of one run and machine: bench/tables has those.
"""

import json
import sys
from pathlib import Path

QUESTIONS = {"inside": "Which vertices are inside, and how deep", "pairs": "All pairs of triangles",
             "touch": "Do the bodies touch", "command": "Whole commands"}


def family_of(scene):
    """Scenes of one family stand side by side: sample_1 to sample_4 are bones, sample_5 to sample_8 cartilages."""
    name, _, number = scene.rpartition("_")
    if name == "sample":
        return "sample bones" if int(number) < 5 else "sample cartilages"
    if name == "libhip" and number.isdigit():
        return "libhip bones"
    return "balls" if scene.startswith("ball_") else "cartilages" if "cartilage" in scene else "whole hips"


def tables_of(ratios):
    """{(question, family): {row: {scene: ratio}}}, in the order of the file."""
    tables = {}
    for name, ratio in ratios.items():
        question, scene, row = name.split("/", 2)
        tables.setdefault((question, family_of(scene)), {}).setdefault(row, {})[scene] = ratio
    return tables


def digits(ratio):
    return f"{ratio:.0f}" if ratio >= 100 else f"{ratio:.3g}"


def markdown(question, family, rows):
    scenes = sorted({scene for ratios in rows.values() for scene in ratios})
    lines = [f"**{QUESTIONS.get(question, question)} ({question}): {family}**", "", "| | " + " | ".join(scenes) + " |",
             "| --- |" + " --: |" * len(scenes)]
    for row, ratios in rows.items():
        lines.append(f"| {row} | " + " | ".join(digits(ratios[scene]) if scene in ratios else "-" for scene in scenes) + " |")
    return "\n".join(lines)


def main(arguments):
    is_file = arguments and arguments[0].endswith(".json")
    path = Path(arguments.pop(0)) if is_file else Path(__file__).with_name("baseline.json")
    ratios = json.loads(path.read_text(encoding="utf-8"))
    shown = [markdown(*key, rows) for key, rows in tables_of(ratios).items()
             if all(word in f"{key[0]} {' '.join(key)} {' '.join(s for r in rows.values() for s in r)}" for word in arguments)]
    if not shown:
        sys.exit(f"print_baseline.py: {path} has no table of {' '.join(arguments)}")
    print("\n\n".join(shown))


if __name__ == "__main__":
    main(sys.argv[1:])
