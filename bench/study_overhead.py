#!/usr/bin/env python3
"""What `condyle study` costs a joint beyond the library's calls, and how it grows: processor time, on one core.

    PYTHONPATH=build/release/python taskset -c 0 bench/study_overhead.py build/release/condyle COHORT

COHORT is a folder of `condyle sample cohort --meshes` with 100 hips or more. The library's calls are to read the joint,
to check it and to compute all limits. Growth is over tables that name the same eight hips of the lowest resolution again
and again.
"""
import csv
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import condyle

ROUNDS = 3


def cpu_seconds_of(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def seconds_and_mb_of(command):
    """Processor time and the most memory that a run held."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def print_growth(command):
    print("\n| rows | processor time, s | ms a row | peak memory, MB | tables, kB a row |\n|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        for k in range(8):
            subprocess.run([command, "sample", "hip", "--hip-bone-triangles", "1600", "--femur-triangles", "600",
                            "--neck-shaft-angle", str(120 + 2 * k), "--out", f"{folder}/{k}"], check=True,
                           capture_output=True)
        for rows in (100, 1000, 10_000):
            table = Path(folder) / "table.csv"
            table.write_text("id,joint\n" + "".join(f"{i},{i % 8}/hip.toml\n" for i in range(rows)))
            out = Path(folder) / f"out{rows}"
            seconds, megabytes = seconds_and_mb_of([command, "study", table, "--out", out])
            size = sum(file.stat().st_size for file in out.iterdir())
            print(f"| {rows} | {seconds:.1f} | {1e3 * seconds / rows:.1f} | {megabytes:.0f} | {size / rows / 1e3:.1f} |",
                  flush=True)


def library_seconds(joints):
    start = time.process_time()
    for path in joints:
        joint = condyle.read_joint(path)
        joint.notes
        joint.range_of_motion().limits  # noqa: B018
    return time.process_time() - start


def main():
    command, cohort = sys.argv[1], Path(sys.argv[2])
    with open(cohort / "cohort.csv", encoding="utf-8") as file:
        joints = [str((cohort / row["joint"]).resolve()) for row in csv.DictReader(file)]
    print("| joints | study, ms a joint | library's calls, ms a joint | more, ms a joint |\n|--:|--:|--:|--:|")
    for n in (10, 100):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "table.csv"
            table.write_text("id,joint\n" + "".join(f"{i},{path}\n" for i, path in enumerate(joints[:n])))
            ours, theirs = [], []
            for number in range(ROUNDS):
                ours.append(1e3 * cpu_seconds_of([command, "--threads", "1", "study", table, "--out",
                                                  os.path.join(folder, str(number))]) / n)
                theirs.append(1e3 * library_seconds(joints[:n]) / n)
        study, library = statistics.median(ours), statistics.median(theirs)
        print(f"| {n} | {study:.1f} | {library:.1f} | {study - library:.1f} |")
    print_growth(command)


if __name__ == "__main__":
    main()
