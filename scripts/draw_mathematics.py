#!/usr/bin/python3
"""Draws the figures of docs/mathematics: PYTHONPATH=build/release/python scripts/draw_mathematics.py

Small bodies, a socket, a head on its neck and a block, are asked of the library's own tables: depths and arcs by the Python module, the
lists of cells by build/release/example_table_cells.
"""
import subprocess
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import condyle  # noqa: E402
import condyle.plot as figures  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.tri  # noqa: E402
import numpy as np  # noqa: E402
from condyle.plot import style  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
CELLS_PER_SIDE, PROFILE_CELLS = 8, 100
BELOW = -1e-6  # mm: sections run beside the vertices of a plane, on the side that tables take
NECK_DEG = 76  # turned so far about Z the neck is in the rim
FIXED, MOBILE, DEPTH, LISTED, SWEPT = style.LIGHT_GREY, "#cfe3f1", style.VERMILION, "#f8dfa6", "#eda373"


def turned_solid(profile, around, turn_deg=0.0):
    """The closed mesh that points (distance from Y, place along Y), the first and last on Y, sweep about Y; then turned about Z."""
    profile, turns = np.asarray(profile, float), 2 * np.pi * np.arange(around) / around
    rings = [np.column_stack([r * np.cos(turns), np.full(around, y), r * np.sin(turns)]) for r, y in profile[1:-1]]
    vertices = np.vstack([[[0, profile[0, 1], 0]], *rings, [[0, profile[-1, 1], 0]]])
    at = 1 + np.arange(len(rings) * around).reshape(len(rings), around)
    nexts = np.roll(at, -1, axis=1)
    pole, end = np.zeros(around, int), np.full(around, len(vertices) - 1)
    faces = [np.column_stack([pole, at[0], nexts[0]]), np.column_stack([end, nexts[-1], at[-1]])]
    for here, there in zip(range(len(rings) - 1), range(1, len(rings))):
        faces += [np.column_stack([at[here], at[there], nexts[there]]), np.column_stack([at[here], nexts[there], nexts[here]])]
    faces = np.vstack(faces)
    if np.einsum("ij,ij->", vertices[faces[:, 0]], np.cross(vertices[faces[:, 1]], vertices[faces[:, 2]])) < 0:
        faces = faces[:, ::-1]
    c, s = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
    return condyle.TriMesh(vertices @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), faces)


def on_arc(radius, first_deg, last_deg, count):
    """Of a meridian, angles from -Y."""
    angles = np.radians(np.linspace(first_deg, last_deg, count))
    return np.column_stack([radius * np.sin(angles), -radius * np.cos(angles)])


def block():
    """Off the axis, and tilted."""
    corners = np.array([[x, y, z] for z in (-15, 15) for y in (9, 30) for x in (-18, 18)], float)
    faces = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]
    c, s = np.cos(np.radians(25)), np.sin(np.radians(25))
    return condyle.TriMesh(corners @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]]), faces)


BLOCK = block()
SOCKET = turned_solid(np.vstack([on_arc(31, 180, 92, 8), on_arc(25, 92, 180, 8)]), 24)
HEAD = turned_solid(np.vstack([on_arc(24, 180, 30, 9), [[12, -25.5], [12, -32], [12, -39], [13, -46], [0, -46]]]), 24, -NECK_DEG)


def section(mesh, z):
    """(K, 2, 2) segments in which triangles meet a height."""
    segments = []
    for corners in np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]:
        ends = [p + (z - p[2]) / (q[2] - p[2]) * (q - p) for p, q in zip(corners, np.roll(corners, -1, axis=0)) if (p[2] < z) != (q[2] < z)]
        if ends:
            segments.append(np.array(ends)[:, :2])
    return np.array(segments)


def fill_section(ax, mesh, z, colour, name, at):
    """One loop, its segments sorted by following their ends."""
    segments = list(section(mesh, z))
    loop = list(segments.pop(0))
    while segments:
        gaps = [min(np.linalg.norm(s - loop[-1], axis=1)) for s in segments]
        p, q = segments.pop(int(np.argmin(gaps)))
        loop.append(q if np.linalg.norm(p - loop[-1]) < np.linalg.norm(q - loop[-1]) else p)
    ax.fill(*np.array(loop).T, facecolor=colour, edgecolor=style.GREY, linewidth=0.8)
    ax.text(*at, name, ha="center", va="center")


def plane_axes(ax, title, x, y):
    ax.set(xlim=x, ylim=y, aspect="equal", title=title)
    ax.axis("off")


def label(ax, text, at, of=None, **look):
    arrow = dict(arrowstyle="-", linewidth=0.5, shrinkA=1, shrinkB=2)
    ax.annotate(text, at if of is None else of, xytext=at, arrowprops=None if of is None else arrow, path_effects=style.white_border(), **look)


def circle(ax, radius, first=0.0, last=2 * np.pi, **look):
    angles = np.linspace(first, last, 200)
    ax.plot(radius * np.cos(angles), radius * np.sin(angles), **look)


def unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def draw_depths():
    """Both kinds of penetration of one vertex of the neck, in the plane across the axis."""
    vertices = np.asarray(HEAD.vertices)
    rays, arcs = condyle.RadialTable(SOCKET).query(vertices), condyle.RingTable(SOCKET, [0, 0, 0], [0, 0, 1]).query(vertices)
    inside = np.flatnonzero((rays.state == 2) & (np.abs(vertices[:, 2]) < 1e-9))
    v = inside[np.argmax(arcs.depth_mm[inside])]
    place, radius = vertices[v][:2], np.linalg.norm(vertices[v][:2])
    figure, both = plt.subplots(1, 2, figsize=figures.size_mm(160, 74), layout="constrained")
    for ax, title in zip(both, ("radial: along the ray from the centre C", "tangential: along the circle about the axis")):
        fill_section(ax, HEAD, BELOW, MOBILE, "mobile body", (4, -12))
        fill_section(ax, SOCKET, BELOW, FIXED, "fixed body", (31, 26))
        plane_axes(ax, title, (-56, 39), (-31, 33))
        ax.plot(0, 0, "o", color="black")
        ax.plot(*place, "o", color=DEPTH, zorder=5)
        label(ax, "v", place + (1.5, -3.0))
    a, b, c = np.asarray(SOCKET.vertices)[np.asarray(SOCKET.triangles)[rays.triangle[v]]]
    ends = [place * (1 + sign * rays.depth_mm[v] / radius) for sign in (1, -1)]
    crossing = min(ends, key=lambda end: abs(np.cross(b - a, c - a) @ (np.append(end, 0) - a)))
    both[0].plot([0, place[0] * 1.4], [0, place[1] * 1.4], "--", color=style.BLUE, linewidth=0.9)
    both[0].plot([place[0], crossing[0]], [place[1], crossing[1]], color=DEPTH, linewidth=3)
    label(both[0], "C", (1.5, -1))
    label(both[0], f"radial depth\n{rays.depth_mm[v]:.1f} mm", (-56, 19), (place + crossing) / 2)
    start = np.arctan2(place[1], place[0])
    end = start - np.radians(arcs.gap_deg[v]) * arcs.rotation_sense[v]
    circle(both[1], radius, linestyle="--", color=style.BLUE, linewidth=0.9)
    circle(both[1], radius, start, end, color=DEPTH, linewidth=3)
    label(both[1], "axis", (1.5, -1))
    label(both[1], f"tangential depth\n{-arcs.gap_deg[v]:.1f}°, {arcs.depth_mm[v]:.1f} mm", (-56, 19), radius * unit((start + end) / 2))
    return figure


def cells_of(mesh):
    """What example_table_cells prints: the profile's grid, and of each table the triangles of each cell."""
    with tempfile.TemporaryDirectory() as folder:
        condyle.write_mesh(Path(folder) / "mesh.ply", mesh)
        lines = subprocess.run([ROOT / "build/release/example_table_cells", Path(folder) / "mesh.ply", str(CELLS_PER_SIDE), str(PROFILE_CELLS)],
                               check=True, capture_output=True, text=True).stdout.split()[1:]
    grid, lists = None, {"ring": {}, "cartesian": {}, "cube": {}}
    for table, *values in (line.split(",") for line in lines):
        if table == "grid":
            grid = [float(value) for value in values]
        else:
            lists[table].setdefault(int(values[0]), []).append(int(values[1]))
    return grid, lists


def draw_rings():
    """A triangle seen along the axis, and the cells of the profile in whose lists it is."""
    (rho_min, z_min, rho_cell, z_cell, columns, rows), lists = cells_of(BLOCK)
    corners = np.asarray(BLOCK.vertices)[np.asarray(BLOCK.triangles)]
    chosen = 5
    shares = np.array([(i, j) for i in range(81) for j in range(81 - i)]) / 80
    swept = np.column_stack([shares, 1 - shares.sum(axis=1)]) @ corners[chosen]
    rho = np.hypot(swept[:, 0], swept[:, 1])
    figure, (left, right) = plt.subplots(1, 2, figsize=figures.size_mm(160, 80), layout="constrained")
    plane_axes(left, "a block, seen along the axis", (-29, 29), (-29, 35))
    for triangle in corners:
        left.fill(*triangle[:, :2].T, facecolor="none", edgecolor=style.GREY, linewidth=0.7)
    left.fill(*corners[chosen][:, :2].T, facecolor=SWEPT, zorder=3)
    for radius in (rho.min(), rho.max()):
        circle(left, radius, linestyle="--", color=style.BLUE, linewidth=0.9)
    left.plot(0, 0, "o", color="black")
    label(left, "axis", (1.5, -1.5))
    left.text(-16.5, 4.5, "the triangle", zorder=4)
    label(left, "the triangle's least and greatest distance ρ", (-28, -28), color=style.BLUE)
    right.set(aspect="equal", title="the profile: cells in whose lists it is", xlabel="distance from the axis, ρ (mm)", ylabel="height, z (mm)")
    for cell in range(int(columns * rows)):
        corner, own = (rho_min + cell % columns * rho_cell, z_min + cell // columns * z_cell), lists["ring"].get(cell, [])
        right.add_patch(plt.Rectangle(corner, rho_cell, z_cell, facecolor=LISTED if chosen in own else "white", edgecolor="none", zorder=0))
        right.add_patch(plt.Rectangle(corner, rho_cell, z_cell, facecolor="none", edgecolor=style.GREY, linewidth=0.5))
        right.text(corner[0] + rho_cell / 2, corner[1] + z_cell / 2, len(own), ha="center", va="center", fontsize=6, zorder=4)
    fine = matplotlib.tri.Triangulation(*shares.T).triangles
    right.tripcolor(rho, swept[:, 2], fine, np.ones(len(fine)), cmap=matplotlib.colors.ListedColormap([SWEPT]), zorder=0.5)
    right.set(xlim=(0, rho_min + columns * rho_cell + 0.5), ylim=(z_min - 0.5, z_min + rows * z_cell + 0.5))
    return figure


def draw_arc():
    """The circle of a point in the block, with both ends of its arc."""
    point = np.array([-6.0, 18.0, 2.0])
    arcs = condyle.RingTable(BLOCK, [0, 0, 0], [0, 0, 1]).occupied_arcs([point])
    own = next(i for i, (begin, end) in enumerate(arcs.of(0)) if begin <= 360 <= end)
    radius, start = np.hypot(*point[:2]), np.arctan2(point[1], point[0])
    figure, ax = plt.subplots(figsize=figures.size_mm(120, 88), layout="constrained")
    fill_section(ax, BLOCK, point[2], FIXED, "solid", (8, 25))
    circle(ax, radius, linestyle="--", color=style.BLUE, linewidth=0.9)
    for turned, triangle, name, words in ((arcs.end_deg[own] - 360, arcs.leaves[own], "x", "n · t > 0 at x:\nthe circle leaves"),
                                         (arcs.begin_deg[own] - 360, arcs.enters[own], "x′", "n · t < 0 at x′:\nit enters")):
        at = start + np.radians(turned)
        place, tangent = radius * unit(at), unit(at + np.pi / 2)
        a, b, c = np.asarray(BLOCK.vertices)[np.asarray(BLOCK.triangles)[triangle]]
        normal = np.cross(b - a, c - a)[:2]
        ax.plot(*place, "o", color="black", zorder=5)
        for vector, letter, colour in ((tangent, "t", style.BLUE), (normal / np.linalg.norm(normal), "n", style.GREEN)):
            ax.annotate("", place + 8 * vector, xytext=place, arrowprops=dict(arrowstyle="-|>", color=colour, linewidth=1.4, shrinkA=0, shrinkB=0))
            label(ax, letter, place + 9.7 * vector, color=colour, fontsize=10, ha="center", va="center")
        label(ax, name, place + 3 * unit(at + np.pi), fontsize=10, ha="center", va="center")
        label(ax, words, (-45, -8) if name == "x" else (22, -8))
    leaves = start + np.radians(arcs.end_deg[own] - 360)
    circle(ax, radius, start, leaves, color=DEPTH, linewidth=3)
    ax.plot(*point[:2], "o", color=DEPTH, zorder=6)
    label(ax, "v", point[:2] + (0.6, -3.2), fontsize=10)
    label(ax, f"a = {arcs.end_deg[own] - 360:.1f}°", (-40, 22), radius * unit((start + leaves) / 2), color=DEPTH, fontsize=10)
    ax.plot(0, 0, "o", color="black")
    label(ax, "the axis", (1.5, -1))
    plane_axes(ax, "", (-46, 44), (-21, 33))
    return figure


def draw_maps():
    """A direction's cell and its list on the paper's map and on the cube, of the same surface."""
    lists, corners = cells_of(HEAD)[1], np.asarray(HEAD.vertices)[np.asarray(HEAD.triangles)]
    d, n = np.array([0.47, -0.32, 0.82]), CELLS_PER_SIDE
    figure, both = plt.subplots(1, 2, figsize=figures.size_mm(160, 90), layout="constrained")
    for ax, name, kind, of, square in ((both[0], "the paper's map: hemisphere z ≥ 0", "cartesian", "R", 0), (both[1], "the cube: face +z", "cube", "z", 2)):
        def place(p):
            p = np.atleast_2d(p)
            front = p[:, 2:] >= (0 if kind == "cartesian" else 0.3 * np.linalg.norm(p, axis=1, keepdims=True))
            return np.where(front, p[:, :2] / (np.linalg.norm(p, axis=1, keepdims=True) if kind == "cartesian" else np.maximum(p[:, 2:], 1e-9)), np.nan)

        def cell_at(spot):
            column, row = np.minimum((np.asarray(spot) + 1) * n // 2, n - 1).astype(int)
            return (square * n + row) * n + column, (-1 + 2 * column / n, -1 + 2 * row / n)

        cell, corner = cell_at(place(d)[0])
        ax.set(aspect="equal", xlim=(-1.03, 1.03), ylim=(-1.03, 1.03), title=f"{name}\nthe cell of × has a list of {len(lists[kind][cell])}", xlabel=f"x / {of}", ylabel=f"y / {of}",
               xticks=(-1, 0, 1), yticks=(-1, 0, 1))
        steps = np.linspace(0, 1, 20)[:, None]
        for number, triangle in enumerate(corners):
            outline = place(np.vstack([p + steps * (q - p) for p, q in zip(triangle, np.roll(triangle, -1, axis=0))]))
            ax.plot(*outline.T, color=style.GREY, linewidth=0.5, zorder=2)
            if number in lists[kind][cell]:
                ax.fill(*outline.T, facecolor=LISTED, zorder=1)
        for line in np.linspace(-1, 1, n + 1):
            half = np.sqrt(1 - line**2) if kind == "cartesian" else 1
            for xy in (([line, line], [-half, half]), ([-half, half], [line, line])):
                ax.plot(*xy, color=style.BLUE, linewidth=0.5, zorder=3)
        if kind == "cartesian":
            circle(ax, 1, color=style.BLUE, linewidth=0.8)
            rim, at = cell_at((-0.99, -0.1))
            ax.add_patch(plt.Rectangle(at, 2 / n, 2 / n, facecolor="none", edgecolor="black", linewidth=1.2, zorder=5))
            label(ax, f"this one:\na list of {len(lists[kind][rim])}", (-0.99, -0.98), (at[0] + 1 / n, at[1]), zorder=7)
        ax.add_patch(plt.Rectangle(corner, 2 / n, 2 / n, facecolor="none", edgecolor=DEPTH, linewidth=2, zorder=5))
        ax.plot(*place(d)[0], "x", color="black", markersize=6, zorder=6)
    return figure


def main():
    for name, draw in (("two_depths", draw_depths), ("rings", draw_rings), ("arc_test", draw_arc), ("direction_maps", draw_maps)):
        with figures.print_style():
            figures.save(draw(), ROOT / f"docs/images/mathematics/{name}.png", dpi=150)
        print(f"docs/images/mathematics/{name}.png")


if __name__ == "__main__":
    main()
