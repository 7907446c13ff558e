#!/usr/bin/env python3
"""What Python adds to the library: medians over repetitions, printed as the table of docs/python.md.

    PYTHONPATH=build/release/python bench/python_overhead.py build/release/python_reference

The C++ loop asks one pose after the other on one core; many poses in one call are computed on all cores. With
`taskset -c 0` before it both have one.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import condyle


def median_seconds(act, repetitions):
    times = []
    for _ in range(repetitions):
        start = time.perf_counter()
        act()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main():
    reference = sys.argv[1]
    bones = condyle.sample_hip()
    joint = condyle.Joint(bones.hip_bone, bones.femur)
    random = np.random.default_rng(14)
    poses = joint.pose(flexion_deg=random.uniform(-30, 150, 1000), adduction_deg=random.uniform(-60, 50, 1000),
                       internal_rotation_deg=random.uniform(-80, 80, 1000))
    apart = joint.pose()
    joint.penetration(poses[:2])
    with tempfile.TemporaryDirectory() as folder:
        for name, mesh in (("hip_bone.ply", bones.hip_bone), ("femur.ply", bones.femur)):
            condyle.write_mesh(Path(folder) / name, mesh)
        (Path(folder) / "hip.toml").write_text(
            'condyle = 1\nname = "hip"\nkind = "ball"\nside = "right"\nunits = "mm"\n'
            '[fixed]\nmesh = "hip_bone.ply"\n[mobile]\nmesh = "femur.ply"\n'
            '[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n')
        poses.tofile(Path(folder) / "poses")
        cpp = json.loads(subprocess.run([reference, "--times", Path(folder) / "hip.toml", Path(folder) / "poses"],
                                        check=True, capture_output=True).stdout)
    many = median_seconds(lambda: joint.penetration(poses), 15)
    one = median_seconds(lambda: joint.penetration(apart), 5000)
    rows = [("1000 poses in one call", cpp["poses_s"] * 1e3, many * 1e3, "ms"),
            ("the same, the C++ loop keeping its answers", cpp["kept_s"] * 1e3, many * 1e3, "ms"),
            ("one pose, bodies apart", cpp["apart_s"] * 1e6, one * 1e6, "us")]
    print("| | C++ | Python |\n|---|---|---|")
    for what, theirs, ours, unit in rows:
        print(f"| {what} | {theirs:.1f} {unit} | {ours:.1f} {unit} |")
    vertices = np.array(bones.femur.vertices, order="F")
    table = condyle.RadialTable(bones.femur)
    table.update(vertices)
    print(f"| update of {len(vertices)} vertices, `RadialTable.update` | | "
          f"{1e6 * median_seconds(lambda: table.update(vertices), 500):.0f} us |")


if __name__ == "__main__":
    main()
