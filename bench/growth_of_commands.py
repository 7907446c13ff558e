#!/usr/bin/python3
"""How the time of each command grows with meshes four times as large, of shapes that are hard in one way each.

Usage: growth_of_commands.py CONDYLE [--most RATIO] [--shapes NAME,...] [--commands WORD,...] [--triangles N]

A shape of N and one of 4 N triangles meets a ball of as many. Prints a row for each shape and command: processor time of both and how many
times the second takes longer, without what `condyle --version` takes. Exit code 1 if one takes over RATIO times as long (default 5, with a
quarter of a second or more to show for it) or does not end within two minutes: a square would take 16 times as long.
"""
import argparse
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

LONGEST_S, WORTH_SAYING_S = 120, 0.25
BOX = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
SIDES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])


def merged(pieces):
    """One mesh of several: vertices and triangles."""
    before = np.cumsum([0] + [len(vertices) for vertices, _ in pieces])
    return np.concatenate([v for v, _ in pieces]), np.concatenate([t + n for (_, t), n in zip(pieces, before)])


def ring(count, radius, height):
    turned = np.arange(count) * 2 * np.pi / count
    return np.stack([radius * np.cos(turned), radius * np.sin(turned), np.full(count, height)], axis=1)


def fan(around, apex, turned_over=False):
    """Triangles from a vertex to a ring of others, by their numbers."""
    triangles = np.stack([np.full(len(around), apex), around, np.roll(around, -1)], axis=1)
    return triangles[:, ::-1] if turned_over else triangles


def ball(count, radius=24.0):
    """Rings of a ball, of about so many triangles."""
    rows = max(3, int(np.sqrt(count / 4)))
    columns = max(3, count // (2 * rows))
    heights = np.cos(np.arange(1, rows) * np.pi / rows)
    vertices = [ring(columns, radius * np.sqrt(1 - h * h), radius * h) for h in heights]
    rows_of = [np.arange(columns) + row * columns for row in range(rows - 1)]
    top, bottom = (rows - 1) * columns, (rows - 1) * columns + 1
    triangles = [fan(rows_of[0], top), fan(rows_of[-1], bottom, True)]
    for upper, lower in zip(rows_of, rows_of[1:]):
        triangles += [np.stack([upper, lower, np.roll(upper, -1)], axis=1),
                      np.stack([np.roll(upper, -1), lower, np.roll(lower, -1)], axis=1)]
    return np.concatenate(vertices + [np.array([(0, 0, radius), (0, 0, -radius)])]), np.concatenate(triangles)


def cone(count):
    """A vertex in half of all triangles."""
    around = np.arange(count // 2)
    vertices = np.concatenate([ring(len(around), 20, -15), [(0, 0, 15), (0, 0, -15)]])
    return vertices, np.concatenate([fan(around, len(around)), fan(around, len(around) + 1, True)])


def coincident(count):
    """Boxes in rows, eight in each place: pairs that coincide, which are counted, are as many times as many as triangles."""
    vertices, triangles = pieces(count // 8)
    return merged([(vertices, triangles)] * 8)


def pieces(count):
    """Boxes in rows, apart from each other."""
    side = int(np.ceil((count / 12) ** (1 / 3)))
    places = np.array([(x, y, z) for x in range(side) for y in range(side) for z in range(side)])[:count // 12]
    return merged([((BOX * 0.7 + place) * 40 / side - 20, SIDES) for place in places])


def slivers(count):
    """A pillar of triangles as long as it, and as narrow as they are many."""
    around = np.arange(count // 4)
    n = len(around)
    vertices = np.concatenate([ring(n, 12, -30), ring(n, 12, 30), [(0, 0, -30), (0, 0, 30)]])
    sides = [np.stack([around, np.roll(around, -1), around + n], axis=1),
             np.stack([np.roll(around, -1), np.roll(around, -1) + n, around + n], axis=1)]
    return vertices, np.concatenate(sides + [fan(around, 2 * n, True), fan(around + n, 2 * n + 1)])


def nests(count):
    """Balls in balls, each turned inside out against the last."""
    each = 192
    shells = count // each
    nested = [ball(each, 25 * (k + 1) / shells) for k in range(shells)]
    return merged([(v, t[:, ::-1] if k % 2 else t) for k, (v, t) in enumerate(reversed(nested))])


def comb(count):
    """Narrow boxes side by side, in contact along their faces."""
    teeth = count // 12
    return merged([(BOX * (40 / teeth, 30, 30) + (40 * k / teeth - 20, -15, -15), SIDES) for k in range(teeth)])


def plate(count):
    """A flat box whose upper face has all triangles in one plane."""
    side = int(np.sqrt(count / 4))
    grid = np.array([(40 * x / side - 20, 40 * y / side - 20, z) for z in (-5, 5) for x in range(side + 1) for y in range(side + 1)])
    at = np.arange(side * (side + 1)).reshape(side, side + 1)[:, :-1].ravel()
    lower = np.concatenate([np.stack([at, at + 1, at + side + 2], axis=1), np.stack([at, at + side + 2, at + side + 1], axis=1)])
    upper = lower[:, ::-1] + (side + 1) ** 2
    rim = np.concatenate([np.arange(side + 1), np.arange(1, side + 1) * (side + 1) + side,
                          side * (side + 1) + np.arange(side - 1, -1, -1), np.arange(side - 1, 0, -1) * (side + 1)])
    over = rim + (side + 1) ** 2
    walls = np.concatenate([np.stack([rim, over, np.roll(rim, -1)], axis=1), np.stack([np.roll(rim, -1), over, np.roll(over, -1)], axis=1)])
    return grid, np.concatenate([lower, upper, walls])


def rough(count):
    """A ball whose vertices go in and out at random."""
    vertices, triangles = ball(count)
    return vertices * (1 + 0.1 * np.random.default_rng(1).standard_normal((len(vertices), 1))), triangles


SHAPES = {each.__name__: each for each in (ball, cone, coincident, pieces, slivers, nests, comb, plate, rough)}
COMMANDS = ["inspect shape.ply", "touch shape.ply ball.ply", "touch shape.ply ball.ply --measures", "touch ball.ply shape.ply --measures",
            "turn shape.ply ball.ply --axis 0 0 1 --centre 60 0 0", "slide shape.ply ball.ply --along 1 0 0",
            "depth joint.toml --pose x=8", "depth joint.toml --pose x=8 --method tangential --about '0 0 1 60 0 0'",
            "depth joint.toml --pose x=8 --method normal", "depth turned.toml --pose x=8", "load joint.toml --pose x=8 --e 12 --nu 0.4 --thickness 2",
            "rom joint.toml --translation x=31 --motion flexion", "frame joint.toml", "motion joint.toml --motion moves.csv"]
JOINT = """condyle = 1
name = "grown"
kind = "free"
side = "right"
joint = "knee"
units = "mm"
[fixed]
mesh = "{fixed}.ply"
[mobile]
mesh = "{mobile}.ply"
[frame]
centre = [0, 0, 0]
anterior = [1, 0, 0]
superior = [0, 1, 0]
"""


def write(path: Path, vertices, triangles):
    with path.open("wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\n"
                   f"property double z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        file.write(np.ascontiguousarray(vertices, "<f8").tobytes())
        faces = np.zeros(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
        faces["count"], faces["corners"] = 3, triangles
        file.write(faces.tobytes())


def scene(folder: Path, shape, count):
    folder.mkdir()
    vertices, triangles = SHAPES[shape](count)
    write(folder / "shape.ply", vertices + (0.123, 0.234, 0.345), triangles)  # no joint centre lies on a surface
    vertices, triangles = ball(count)
    write(folder / "ball.ply", vertices + (20, 0.3, 0.7), triangles)
    (folder / "joint.toml").write_text(JOINT.format(fixed="shape", mobile="ball"))
    (folder / "turned.toml").write_text(JOINT.format(fixed="ball", mobile="shape"))
    (folder / "moves.csv").write_text("time,x_mm\n" + "".join(f"{t},{t}\n" for t in range(5)))
    return folder


def processor_s(command, folder: Path):
    """And the exit code; None where it did not end."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        code = subprocess.run(command, shell=True, cwd=folder, capture_output=True, timeout=LONGEST_S).returncode
    except subprocess.TimeoutExpired:
        return LONGEST_S, None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("condyle", type=Path)
    parser.add_argument("--most", type=float, default=5)
    parser.add_argument("--triangles", type=int, default=10_000)
    parser.add_argument("--shapes", default=",".join(SHAPES))
    parser.add_argument("--commands", default="")
    given = parser.parse_args()
    words = [word for word in given.commands.split(",") if word]
    worse = 0
    with tempfile.TemporaryDirectory() as made:
        start_s, _ = processor_s(f"{given.condyle.resolve()} --version", Path(made))
        for shape in given.shapes.split(","):
            small, large = (scene(Path(made) / f"{shape}{n}", shape, n) for n in (given.triangles, 4 * given.triangles))
            for command in COMMANDS:
                if words and not any(word in command for word in words):
                    continue
                (first_s, code), (second_s, second_code) = (processor_s(f"{given.condyle.resolve()} {command}", at) for at in (small, large))
                ratio = (second_s - start_s) / max(first_s - start_s, 1e-3)
                is_worse = second_code is None or (code == second_code and ratio > given.most and second_s - start_s > WORTH_SAYING_S)
                worse += is_worse
                codes = "" if code == second_code == 0 else f"  exit codes {code}, {second_code}"
                print(f"{shape:10}  {command:72}  {first_s:7.3f} s  {second_s:7.3f} s  {ratio:5.1f}{' !' if is_worse else ''}{codes}", flush=True)
    sys.exit(f"{worse} over {given.most}" if worse else 0)


main()
