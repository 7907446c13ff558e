"""A deformable cartilage pressed into a rigid one: tables answer what touches, and follow the tissue as it deforms.

The femoral cartilage is a tissue of springs, held on its bony side; the acetabular one is rigid. The femur is moved
into the socket in small steps. In each round of a step

    tissue   springs along edges and to the places at rest are relaxed, position by position (Mueller et al. 2007)
    query    which tissue vertices are inside the socket, how deep: these are moved out along their rays
    update   the tissue's own direction table follows its surface
    query    which socket vertices are inside the tissue: the triangles they left through are moved back

and the last three again until nothing is deeper than a hundredth of a millimetre. A step ends where a round moves no
vertex by more than a micrometre. Run with a folder it draws what happened there.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import condyle

Array = NDArray[np.float64]

DEEPEST_MM = 0.01
STILL_MM = 1e-3
EDGE_STIFFNESS = 0.3  # the share of its excess length that an edge loses in a sweep
FOUNDATION_STIFFNESS = 0.05  # the share of its way to rest that a vertex goes in a sweep: the depth of the tissue
SWEEPS = 4


class Tissue:
    """Vertices with springs along edges and to where they are at rest; held ones do not move."""

    def __init__(self, mesh: condyle.TriMesh, is_held: NDArray[np.bool_]) -> None:
        sides = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
        self.first, self.second = np.unique(np.sort(sides, axis=1), axis=0).T
        self.rest: Array = np.array(mesh.vertices)
        self.at: Array = np.array(mesh.vertices, order="F")  # column by column, which tables read in place
        self.is_held = is_held
        self.lengths: Array = np.linalg.norm(self.rest[self.second] - self.rest[self.first], axis=1)
        self.edges: Array = np.bincount(np.concatenate([self.first, self.second]), minlength=len(self.rest)) + 0.0

    def relax(self) -> None:
        """Each vertex moves by the mean of what its edges ask for, and towards its place at rest."""
        for _ in range(SWEEPS):
            along = self.at[self.second] - self.at[self.first]
            length = np.linalg.norm(along, axis=1)
            half = (0.5 * (length - self.lengths) / length)[:, None] * along
            move = np.zeros(self.at.shape)
            for axis in range(3):
                move[:, axis] = np.bincount(self.first, half[:, axis], len(move))
                move[:, axis] -= np.bincount(self.second, half[:, axis], len(move))
            move *= (EDGE_STIFFNESS / self.edges)[:, None]
            move += FOUNDATION_STIFFNESS * (self.rest - self.at)
            move[self.is_held] = 0
            self.at += move

    def energy(self) -> float:
        """Energy of all springs, with stiffnesses of 1 N/mm per share: N mm up to a factor of the tissue."""
        stretch = np.linalg.norm(self.at[self.second] - self.at[self.first], axis=1) - self.lengths
        shift = self.at - self.rest
        return float(EDGE_STIFFNESS * (stretch**2).sum() + FOUNDATION_STIFFNESS * (shift**2).sum()) / 2


@dataclass
class History:
    """Progress by round, and the time of each part of the work."""

    depth_before_mm: list[float] = field(default_factory=list)  # when contact is looked for first
    depth_left_mm: list[float] = field(default_factory=list)
    moved_mm: list[float] = field(default_factory=list)
    energy: list[float] = field(default_factory=list)
    step_ends: list[int] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=lambda: {"tissue": 0.0, "query": 0.0, "update": 0.0})


class Coupling:
    """A tissue, a rigid socket, and a direction table of each."""

    def __init__(self, scenario: int = 5) -> None:
        layers = condyle.sample_cartilages(scenario=scenario)
        radius = np.linalg.norm(layers.femoral.vertices, axis=1)
        self.mesh = layers.femoral
        self.tissue = Tissue(layers.femoral, radius < (radius.min() + radius.max()) / 2)
        self.socket_vertices: Array = np.array(layers.acetabular.vertices)
        self.socket_table = condyle.RadialTable(layers.acetabular)
        self.tissue_table = condyle.RadialTable(layers.femoral)
        self.place: Array = np.zeros(3)  # of the femur in the socket's frame, mm
        self.history = History()

    def _timed(self, part: str, start: float) -> float:
        now = time.perf_counter()
        self.history.seconds[part] += now - start
        return now

    def separate(self) -> float:
        """Moves the tissue out of the socket and the socket out of the tissue, once; the depth there was before."""
        tissue, start = self.tissue, time.perf_counter()
        found = self.socket_table.query(np.asfortranarray(tissue.at + self.place))
        inside = (found.state == condyle.INSIDE) & ~tissue.is_held
        ray = tissue.at[inside] + self.place
        ray /= np.linalg.norm(ray, axis=1)[:, None]
        tissue.at[inside] += found.gap_mm[inside, None] * ray  # gaps inside are negative: towards the centre
        deepest = float(-found.gap_mm[inside].min(initial=0))
        start = self._timed("query", start)

        self.tissue_table.update(tissue.at)
        start = self._timed("update", start)

        # Seen from the head's centre a socket vertex inside the tissue has gone through its outer surface.
        asked = self.socket_vertices - self.place
        found = self.tissue_table.query(np.asfortranarray(asked))
        inside = found.state == condyle.INSIDE
        corners = self.mesh.triangles[found.triangle[inside]]
        ray = asked[inside] / np.linalg.norm(asked[inside], axis=1)[:, None]
        back = np.zeros(tissue.at.shape)
        for corner in corners.T:  # each corner by the deepest vertex that left through one of its triangles
            push = found.gap_mm[inside, None] * ray
            deeper = np.linalg.norm(push, axis=1) > np.linalg.norm(back[corner], axis=1)
            back[corner[deeper]] = push[deeper]
        back[tissue.is_held] = 0
        tissue.at += back
        deepest = max(deepest, float(-found.gap_mm[inside].min(initial=0)))
        self._timed("query", start)
        return deepest

    def step(self, by_mm: Array, most_rounds: int = 200) -> None:
        """Moves the femur and lets the tissue come to rest."""
        self.place = self.place + by_mm
        for _ in range(most_rounds):
            before, start = self.tissue.at.copy(), time.perf_counter()
            self.tissue.relax()
            self._timed("tissue", start)
            depths = [self.separate()]
            while depths[-1] > DEEPEST_MM and len(depths) < 50:
                depths.append(self.separate())
            history = self.history
            history.depth_before_mm.append(depths[0])
            history.depth_left_mm.append(depths[-1])
            history.moved_mm.append(float(np.linalg.norm(self.tissue.at - before, axis=1).max()))
            history.energy.append(self.tissue.energy())
            if history.moved_mm[-1] <= STILL_MM:
                break
        history.step_ends.append(len(history.energy))


def press(steps: int = 5, travel_mm: float = 0.5, scenario: int = 5) -> Coupling:
    """Moves the femur upwards into the socket."""
    coupling = Coupling(scenario)
    for _ in range(steps):
        coupling.step(np.array([0, travel_mm / steps, 0]))
    return coupling


def draw(coupling: Coupling, folder: Path) -> None:
    """Energy and convergence, where the time goes, and how far the surface has given way."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    history, tissue = coupling.history, coupling.tissue
    rounds = np.arange(1, len(history.energy) + 1)
    figure, (above, below) = pyplot.subplots(2, 1, sharex=True, figsize=(6.5, 4.6), layout="constrained")
    above.plot(rounds, history.energy, color="#0072b2")
    above.set_ylabel("energy of the springs")
    smallest_shown = 1e-5
    below.semilogy(rounds, np.maximum(history.moved_mm, smallest_shown), color="#009e73",
                   label="largest way of a vertex")
    below.semilogy(rounds, np.maximum(history.depth_left_mm, smallest_shown), color="#d55e00", label="depth left")
    below.axhline(DEEPEST_MM, color="0.6", lw=0.8, ls="--")
    below.set(xlabel="round", ylabel="mm", ylim=(smallest_shown, 1))
    below.legend(frameon=False, loc="lower center")
    for axes in (above, below):
        for end in history.step_ends[:-1]:
            axes.axvline(end + 0.5, color="0.85", lw=0.8, zorder=0)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(folder / "deformable_cartilage_convergence.png", dpi=150)

    figure, axes = pyplot.subplots(figsize=(5, 4.2), layout="constrained")
    outer = ~tissue.is_held
    indentation = np.linalg.norm(tissue.rest, axis=1) - np.linalg.norm(tissue.at, axis=1)
    # Seen along the load, from above: the equidistant azimuthal map of the sphere.
    direction = tissue.rest / np.linalg.norm(tissue.rest, axis=1)[:, None]
    polar, round_about = np.degrees(np.arccos(direction[:, 1])), np.arctan2(direction[:, 0], direction[:, 2])
    x, y = polar * np.cos(round_about), polar * np.sin(round_about)
    shown = outer[coupling.mesh.triangles].all(axis=1)
    drawn = axes.tripcolor(x, y, coupling.mesh.triangles[shown], indentation, cmap="cividis", shading="gouraud", vmin=0)
    figure.colorbar(drawn, label="indentation, mm")
    axes.set(aspect="equal", xlabel="degrees from the load, to the right", ylabel="degrees from the load, forwards")
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(folder / "deformable_cartilage_indentation.png", dpi=150)


def main() -> None:
    coupling = press()
    history = coupling.history
    rounds = len(history.energy)
    print(f"{len(coupling.mesh.vertices)} tissue vertices, {len(history.step_ends)} steps, {rounds} rounds")
    print(f"penetration left: {max(history.depth_left_mm[end - 1] for end in history.step_ends):.4f} mm")
    split = ", ".join(f"{part} {1e3 * seconds / rounds:.2f} ms" for part, seconds in history.seconds.items())
    print(f"time per round: {split}")
    if len(sys.argv) > 1:
        draw(coupling, Path(sys.argv[1]))


if __name__ == "__main__":
    main()
