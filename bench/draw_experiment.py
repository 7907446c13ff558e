#!/usr/bin/python3
"""Draws the experiment: draw_experiment.py EXPERIMENT.csv|RUN.json FOLDER, with PYTHONPATH=build/release/python.

EXPERIMENT.csv is what condyle-bench --csv writes, RUN.json what --json does. As far as there are outcomes for them,
FOLDER gets

    cost_QUESTION.svg       cost of a pose against the size of the sample bones, with the fitted exponents
    accuracy_QUESTION.svg   share of wrong answers against cost, real bones; none where nobody is wrong
    beside_others.svg       of RUN.json: times Condyle's time, of the fastest other method and of the fastest without a
                            wrong answer
"""
import csv
import json
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import condyle.plot as figures  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

GROWTH_FAMILY, ACCURACY_SCENE = "sample bones", "libhip_2"
# Per question: what is wrong, what could be, and the words for the axis.
WRONG = {
    "touch": (("touch_missed", "touch_invented"), "poses", "wrong answers per pose"),
    "pairs": (("pairs_missed", "pairs_invented"), "pairs", "missed and invented pairs per true pair"),
    "inside": (("false_inside", "false_outside"), "vertices_inside", "wrong vertices per vertex truly inside"),
}


def fitted_exponent(sizes, costs):
    """Of cost ~ size^b, by least squares through the logarithms; none of fewer than three."""
    return np.polyfit(np.log(sizes), np.log(costs), 1)[0] if len(sizes) > 2 else None


def by_method(rows):
    methods = {}
    for row in rows:
        methods.setdefault(row["method"], []).append(row)
    return methods.values()


def cost_series(rows):
    for own in by_method(row for row in rows if row["scene_family"] == GROWTH_FAMILY):
        sizes, costs = ([float(row[key]) for row in own] for key in ("fixed_triangles", "query_ms"))
        exponent = fitted_exponent(sizes, costs)
        label = own[0]["method_title"] + (f"  ({exponent:.2f})" if exponent is not None else "")
        yield figures.Series(label, own[0]["method_family"], sizes, costs)


def accuracy_series(rows, question):
    wrong, all_of, _ = WRONG[question]
    for own in by_method(row for row in rows if row["scene"] == ACCURACY_SCENE):
        shares = [sum(float(row[key]) for key in wrong) / max(float(row[all_of]), 1) for row in own]
        yield figures.Series(own[0]["method_title"], own[0]["method_family"], [float(row["query_ms"]) for row in own],
                             shares)


def draw_ratios(path, folder):
    with open(path, encoding="utf-8") as file:
        rows = next(table["rows"] for table in json.load(file)["tables"] if table["name"] == "beside_others")
    _, ax = plt.subplots(figsize=(8, 0.8 + 0.6 * len(rows)), layout="constrained")
    kinds = (("fastest", "the fastest other", "#9aa5b1"), ("right", "the fastest without a wrong answer", "#2a6f97"))
    ratios = [1]
    for offset, (key, label, colour) in zip((-0.2, 0.2), kinds):
        there = [(i + offset, row) for i, row in enumerate(rows) if not isinstance(row[f"{key}_ratio"], str)]
        widths = [row[f"{key}_ratio"] - 1 for _, row in there]
        bars = ax.barh([y for y, _ in there], widths, 0.36, left=1, color=colour, label=label)
        names = [f"{row[f'{key}_ratio']:.3g}  {re.split('[ ,]', row[key])[0]}" for _, row in there]
        ax.bar_label(bars, names, padding=3, fontsize=8)
        ratios += [row[f"{key}_ratio"] for _, row in there]
    ax.axvline(1, color="black", linewidth=0.8)
    # Room for the names beside the longest bars, to either side.
    ax.set(xscale="log", xlim=(min(ratios) / 8, max(ratios) * 8), xlabel="times Condyle's time")
    ax.set_yticks(range(len(rows)), [row["question"].partition(":")[0] for row in rows])
    ax.invert_yaxis()
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False, fontsize=8)
    target = Path(folder) / "beside_others.svg"
    figures.save(ax, target)
    plt.close("all")
    print(target)


def main(path, folder):
    if Path(path).suffix == ".json":
        return draw_ratios(path, folder)
    with open(path, encoding="utf-8") as file:
        outcomes = [row for row in csv.DictReader(file) if row["deformed"] == "no"]
    for question in WRONG:
        rows = [row for row in outcomes if row["question"] == question]
        drawn = {"cost": (list(cost_series(rows)), "triangles of the fixed body", "time per pose, one thread (ms)",
                          None),
                 "accuracy": (list(accuracy_series(rows, question)), "time per pose, one thread (ms)",
                              WRONG[question][2], "none")}
        for name, (series, x_label, y_label, zero_label) in drawn.items():
            if not any(y > 0 for one in series for y in one.y):
                continue
            ax = figures.many_methods(series, x_label=x_label, y_label=y_label, zero_label=zero_label)
            target = Path(folder) / f"{name}_{question}.svg"
            figures.save(ax, target)
            plt.close("all")
            print(target)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
