"""Two cartilage layers of another program's finite elements, pressed together; JointContact says where they touch.

GetFEM (Debian's python3-getfem) assembles elasticity; Condyle knows nothing of tissue. Each layer is a spherical shell bonded
to rigid bone, one on the ball and one in the socket. In each round

    solve    both layers under the forces of the last round
    update   both surfaces: triangles between samples of the elements' curved faces
    ask      which samples of the ball are inside the socket, how deep, and through which triangle they leave
    press    pressure grows by the mean depth about a node and falls by its gap; both bodies carry it (Uzawa's iteration)

until pressure stays as it is. Two questions have an answer on paper: a ball too large for its socket, which Lame's shells give
exactly, and a ball moved aside in a socket that fits, which thin layers give. Run with a folder it draws both.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

try:
    import getfem
except ImportError:
    print("finite_element_contact: skipped: python3-getfem is not installed")
    sys.exit(77)
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

import condyle

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

YOUNG_MPA, POISSON = 12.0, 0.42
SHEAR_MPA = YOUNG_MPA / (2 * (1 + POISSON))
LAME_MPA = YOUNG_MPA * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
RADIUS_MM, THICKNESS_MM = 22.0, 2.0
BALL_BONE_MM, SOCKET_BONE_MM = RADIUS_MM - THICKNESS_MM, RADIUS_MM + THICKNESS_MM
OVERLAP_MM, ASIDE_MM = 0.6, 0.4
ELEMENTS, SAMPLES = 6, 6  # along an edge of the cube that is blown up to a sphere; along an edge of an element, even
SKIN_MM = 0.5  # the ball is asked so much larger, so that gaps up to this are known as depths are
STILL = 1e-3  # of the largest pressure
MOST_ROUNDS, WORST_ERROR = 100, 0.03


def sphere() -> tuple[Array, Numbers]:
    """Directions of nodes, and the nine nodes of each quadratic face."""
    line = 2 * ELEMENTS + 1
    grid = np.tan(np.linspace(-np.pi / 4, np.pi / 4, line))
    side = np.stack([*np.meshgrid(grid, grid, indexing="ij"), np.ones((line, line))], -1).reshape(-1, 3)
    sides = [np.roll(one, turn, axis=1) for turn in range(3) for one in (side, side[:, [1, 0, 2]] * [1, 1, -1])]
    corner = np.arange(line**2).reshape(line, line)[:-1:2, :-1:2].reshape(-1, 1)
    nine = corner + np.array([i * line + j for j in range(3) for i in range(3)])
    points, number = np.unique(np.round(np.concatenate(sides), 9) + 0.0, axis=0, return_inverse=True)
    faces = np.concatenate([number[nine + n * line**2] for n in range(6)])
    return points / np.linalg.norm(points, axis=1)[:, None], faces


def sampled(nodes: Array, faces: Numbers) -> tuple[csc_matrix, Array, Numbers]:
    """The share of each node in each sample of the faces, the area of samples by Simpson's rule, triangles between them."""
    t = np.linspace(0, 1, SAMPLES + 1)
    shape = np.stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)], 1)
    slope = np.stack([4 * t - 3, 4 - 8 * t, 4 * t - 1], 1)
    shares, *slopes = (np.einsum("ai,bj->abji", one, other).reshape(-1, 9)
                       for one, other in ((shape, shape), (slope, shape), (shape, slope)))
    places, *tangents = (np.einsum("sn,fnx->fsx", by, nodes[faces]).reshape(-1, 3) for by in (shares, *slopes))
    simpson = np.where(np.arange(SAMPLES + 1) % 2, 4, 2) / (3 * SAMPLES)
    simpson[[0, -1]] /= 2
    areas = np.tile(np.outer(simpson, simpson).ravel(), len(faces)) * np.linalg.norm(np.cross(*tangents), axis=1)

    _, first, number = np.unique(np.round(places, 7) + 0.0, axis=0, return_index=True, return_inverse=True)
    face, sample = np.divmod(first, len(shares))
    placed = np.repeat(np.arange(len(first)), 9), faces[face].ravel()
    weights = csc_matrix((shares[sample].ravel(), placed), (len(first), len(nodes)))
    a = np.arange((SAMPLES + 1) ** 2).reshape(SAMPLES + 1, -1)[:-1, :-1].ravel()
    b, c, d = a + SAMPLES + 1, a + SAMPLES + 2, a + 1
    corners = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    triangles = number.reshape(len(faces), -1)[:, corners].reshape(-1, 3)
    return weights, np.bincount(number, areas), triangles


class Layer:
    """Quadratic elements between bone, where nothing moves, and the surface that touches."""

    def __init__(self, bone_mm: float, surface_mm: float) -> None:
        directions, faces = sphere()
        count = len(directions)
        nodes = np.concatenate([radius * directions for radius in np.linspace(bone_mm, surface_mm, 3)])
        bricks = np.hstack([faces, faces + count, faces + 2 * count])
        mesh = getfem.Mesh("empty", 3)
        mesh.add_convex(getfem.GeoTrans("GT_QK(3,2)"), nodes[bricks].transpose(2, 1, 0))
        displacement, constant = getfem.MeshFem(mesh, 3), getfem.MeshFem(mesh, 1)
        displacement.set_fem(getfem.Fem("FEM_QK(3,2)"))
        constant.set_fem(getfem.Fem("FEM_QK(3,0)"))
        integral = getfem.MeshIm(mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(3,4)"))
        moduli = (np.full(constant.nbdof(), modulus) for modulus in (LAME_MPA, SHEAR_MPA))
        matrix = getfem.asm_linear_elasticity(integral, displacement, constant, *moduli)
        starts, rows = matrix.csc_ind()
        # Unknowns in the order of the nodes, without those on the bone, which come first.
        unknown = np.argsort(cKDTree(nodes).query(displacement.basic_dof_nodes()[:, ::3].T)[1])[count:]
        unknown = (3 * unknown[:, None] + np.arange(3)).ravel()
        stiffness = csc_matrix((matrix.csc_val(), rows, starts))[unknown][:, unknown]
        self.factors = splu(stiffness, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        self.nodes = nodes[-count:]
        self.weights, self.area, self.triangles = sampled(self.nodes, faces)
        self.rest: Array = self.weights @ self.nodes
        # Radial displacement of the surface under 1 MPa, by Lame: A r + B / r^2, which is 0 at the bone.
        cubes = (bone_mm / surface_mm) ** 3
        self.compliance = abs(surface_mm * (1 - cubes)) / (3 * LAME_MPA + 2 * SHEAR_MPA + 4 * SHEAR_MPA * cubes)

    def under(self, forces: Array) -> Array:
        """Where the samples of the surface are when these forces act on them."""
        load = np.zeros((2 * len(self.nodes), 3))
        load[len(self.nodes):] = self.weights.T @ forces
        moved = self.factors.solve(load.ravel()).reshape(-1, 3)[len(self.nodes):]
        return np.asarray(self.rest + self.weights @ moved)


class Pressed(NamedTuple):
    """What is so when the layers have come to rest."""

    pressure: Array  # at the ball's nodes, MPa
    depth: Array  # about them, mm
    force: Array  # from each of the ball's samples on the socket, N
    ball_at: Array  # samples, in the ball's frame
    rounds: int
    seconds: float


def press(ball: Layer, socket: Layer, pose: Array) -> Pressed:
    """Both layers at rest, the ball's bone held at a pose in the socket's."""
    start, turn = time.perf_counter(), pose[:3, :3]
    back = 1.5 * socket.rest  # of the bone that the layer is bonded to
    walls = np.concatenate([socket.triangles[:, ::-1], socket.triangles + len(back)])
    contact = condyle.JointContact((np.concatenate([socket.rest, back]), walls), (ball.rest, ball.triangles))
    step = (LAME_MPA + 2 * SHEAR_MPA) / (2 * THICKNESS_MM)  # stiffness of both layers where they are thin, MPa per mm
    ray = ball.rest @ turn.T + pose[:3, 3]
    ray /= np.linalg.norm(ray, axis=1)[:, None]
    pressure, force, on_socket = np.zeros(len(ball.nodes)), np.zeros(ball.rest.shape), np.zeros(socket.rest.shape)
    for count in range(1, MOST_ROUNDS + 1):
        ball_at, socket_at = ball.under(-force @ turn), socket.under(on_socket)
        larger = 1 + SKIN_MM / np.linalg.norm(ball_at, axis=1)
        contact.update("mobile", ball_at * larger[:, None])
        contact.update("fixed", np.concatenate([socket_at, back]))
        inside = contact.penetration(pose, bodies="mobile").mobile

        depths = np.full(len(ball.rest), -SKIN_MM)
        depths[inside.vertex] += inside.depth_mm
        depth = ball.weights.T @ (ball.area * depths) / (ball.weights.T @ ball.area)
        before, pressure = pressure, np.maximum(pressure + step * depth, 0)
        if np.abs(pressure - before).max() <= STILL * pressure.max():
            return Pressed(pressure, depth, force, ball_at, count, time.perf_counter() - start)

        # A sample presses along its ray on the corners of the triangle that it leaves through, by its place in there.
        pressed, corners = ray[inside.vertex], socket.triangles[inside.triangle]
        pressed *= (ball.area * (ball.weights @ pressure))[inside.vertex, None]
        share = np.linalg.solve(socket_at[corners].transpose(0, 2, 1), ray[inside.vertex, :, None])
        force, on_socket = np.zeros(ball.rest.shape), np.zeros(socket.rest.shape)
        force[inside.vertex] = pressed
        np.add.at(on_socket, corners, share / share.sum(axis=1)[:, None] * pressed[:, None])
    sys.exit(f"finite_element_contact: pressure still changes after {MOST_ROUNDS} rounds")


def draw(angle: Array, answers: list[tuple[str, Array, Array]], file: Path) -> None:
    """Pressure at the ball's nodes over the angle from the load, and on paper."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.5, 3.6), layout="constrained")
    axes, order = figure.subplots(), np.argsort(angle)
    for (_, found, on_paper), colour in zip(answers, ("#0072b2", "#d55e00")):
        axes.plot(angle, found, ".", ms=2, color=colour)
        axes.plot(angle[order], on_paper[order], color="black", lw=1)
    axes.set(xlabel="degrees from the direction that the ball is moved in", ylabel="pressure, MPa", xlim=(0, 180), ylim=0)
    axes.legend([*axes.lines[::2], axes.lines[1]], [*(title for title, *_ in answers), "on paper"], frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(file, dpi=150)


def main() -> None:
    aside = np.array([1.0, 2.0, 2.0]) / 3
    turn, shift = np.eye(4), np.eye(4)
    turn[:2, :2] = [[np.cos(0.35), -np.sin(0.35)], [np.sin(0.35), np.cos(0.35)]]  # 20 degrees: no node meets a node
    shift[:3] = np.column_stack([turn[:3, :3], ASIDE_MM * aside])

    ball_mm, socket_mm = RADIUS_MM + OVERLAP_MM / 2, RADIUS_MM - OVERLAP_MM / 2
    ball, socket = Layer(BALL_BONE_MM, ball_mm), Layer(SOCKET_BONE_MM, socket_mm)
    tight = press(ball, socket, turn)
    # The same force acts on the smaller surface of the socket.
    lame = OVERLAP_MM / (ball.compliance + socket.compliance * (ball_mm / socket_mm) ** 2)
    mean = np.linalg.norm(tight.force, axis=1).sum() / (4 * np.pi * ball_mm**2)
    inwards = ball_mm - np.average(np.linalg.norm(tight.ball_at, axis=1), weights=ball.area), lame * ball.compliance

    ball, socket = Layer(BALL_BONE_MM, RADIUS_MM), Layer(SOCKET_BONE_MM, RADIUS_MM)
    loaded = press(ball, socket, shift)
    most = ASIDE_MM / (ball.compliance + socket.compliance)  # where the layers overlap by all that the ball is moved
    cosine = ball.nodes @ turn[:3, :3].T @ aside / RADIUS_MM

    print(f"{len(ball.nodes)} nodes and {len(ball.rest)} samples on each surface")
    for title, found in (("too large", tight), ("aside", loaded)):
        print(f"{title}: {found.rounds} rounds in {found.seconds:.1f} s, {found.depth.max():.4f} mm of mean depth left at most")
    compared = (("too large: mean pressure, MPa", mean, lame),
                ("too large: the ball's surface goes in by, mm", *inwards),
                ("aside: force, N", loaded.force.sum(axis=0) @ aside, 2 / 3 * np.pi * RADIUS_MM**2 * most))
    for title, here, on_paper in compared:
        print(f"{title}: {here:.4g}, on paper {on_paper:.4g}, {100 * abs(here / on_paper - 1):.2f} % apart")
    if len(sys.argv) > 1:
        draw(np.degrees(np.arccos(np.clip(cosine, -1, 1))),
             [(f"ball {OVERLAP_MM} mm too large", tight.pressure, np.full(len(cosine), lame)),
              (f"ball that fits, moved {ASIDE_MM} mm aside", loaded.pressure, most * np.maximum(cosine, 0))],
             Path(sys.argv[1]) / "finite_element_contact.png")
    if any(abs(here / on_paper - 1) > WORST_ERROR for _, here, on_paper in compared):
        sys.exit(f"finite_element_contact: more than {100 * WORST_ERROR:.0f} % apart")


if __name__ == "__main__":
    main()
