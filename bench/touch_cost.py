#!/usr/bin/python3
"""What `condyle touch` and `slide` of two balls cost beside reading the files: the table of docs/touch.md.

Usage: touch_cost.py CONDYLE

Two balls of radius 24 mm and 131,072 triangles each, as binary STL and PLY, apart by 12 mm or 1.5 mm in each other. "Reading" is a slide along no
direction, which is refused after both files are read. Prints the median of 25 runs in turn, in ms of processor time and on the wall.
"""
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROUNDS, HALVINGS, RADIUS_MM = 25, 7, 24
CENTRES_MM = {"one": (0, 0, 0), "near": (46.5, 1.3, 0.7), "far": (60, 1.3, 0.7)}


def ball():
    """An octahedron whose triangles are cut into four so many times, on a sphere of radius 1: vertices and triangles."""
    vertices = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
    triangles = np.array([(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])
    for _ in range(HALVINGS):
        edges = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        unique, places = np.unique(edges, axis=0, return_inverse=True)
        middles = vertices[unique].sum(axis=1)
        a, b, c = triangles.T
        ab, bc, ca = len(vertices) + places.reshape(3, -1)
        vertices = np.concatenate([vertices, middles / np.linalg.norm(middles, axis=1)[:, None]])
        triangles = np.concatenate([np.stack(corners, axis=1) for corners in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return vertices, triangles


def write(folder: Path, name: str, vertices, triangles):
    header = f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n" \
             f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    faces = np.zeros(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    (folder / f"{name}.ply").write_bytes(b"ply\nformat binary_little_endian 1.0\n" + header.encode() +
                                         vertices.astype("<f4").tobytes() + faces.tobytes())
    facets = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["corners"] = vertices[triangles]
    (folder / f"{name}.stl").write_bytes(b" " * 80 + np.uint32(len(triangles)).tobytes() + facets.tobytes())


def took_ms(command):
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (1e3 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime), 1e3 * (time.monotonic() - started))


def main(condyle: str):
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        vertices, triangles = ball()
        rotation, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
        rotation *= np.sign(np.linalg.det(rotation))
        for name, centre in CENTRES_MM.items():
            write(folder, name, (vertices if name == "one" else vertices @ rotation.T) * RADIUS_MM + centre, triangles)
        for form in ("stl", "ply"):
            one, near, far = (str(folder / f"{name}.{form}") for name in CENTRES_MM)
            commands = {"reading": ["slide", one, far, "--along", "0", "0", "0"], "touch, apart": ["touch", one, far],
                        "touch, in contact": ["touch", one, near], "touch --measures": ["touch", one, near, "--measures"],
                        "slide": ["slide", one, far, "--along", "1", "0", "0"]}
            runs = {name: [] for name in commands}
            for _ in range(ROUNDS):
                for name, words in commands.items():
                    runs[name].append(took_ms([condyle, *words]))
            of_processors, on_wall = zip(*(map(statistics.median, zip(*each)) for each in runs.values()))
            for name, processor_ms, wall_ms in zip(commands, of_processors, on_wall):
                print(f"{form}: {name}: {processor_ms:.0f} ms, {processor_ms / of_processors[0]:.2f} times reading; "
                      f"{wall_ms:.0f} ms on the wall, {wall_ms / on_wall[0]:.2f} times")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
