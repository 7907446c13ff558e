import type { Surface } from "./protocol";

/// So far from a vertex other bone takes light away: across a socket.
const reach_mm = 50;
/// The grid in which rays are followed has cells of this edge, and at most so many.
const cell_mm = 1.25, mostCells = 8e6;
/// Rays start so many cells above the surface, beyond its own.
const above = 1.8;
/// Directions of a sphere; the half above a vertex is some 64.
const rays = 128;
/// Triangles or vertices between two chances for an answer.
const chunk = 200;

/// How open a surface is at each vertex, 0 to 255: the share of light from above it that its own bone lets through, by rays in a grid of cells
/// that the surface touches. Yields often, so that answers come in between.
export function* openness({ vertices, triangles }: Surface): Generator<void, Uint8Array> {
  const grid = new Grid(vertices), count = vertices.length / 3, normals = new Float32Array(3 * count);
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [0, 1, 2].map((k) => 3 * triangles[t + k]!) as [number, number, number];
    grid.fill(vertices, corners);
    const normal = normalOf(vertices, corners);
    for (const corner of corners) for (let k = 0; k < 3; ++k) normals[corner + k]! += normal[k]!;
    if (t % (3 * chunk) === 0) yield;
  }
  const sphere = directions(), open = new Float32Array(count);
  for (let v = 0; v < count; ++v) {
    open[v] = grid.openAt(vertices, normals, 3 * v, sphere);
    if (v % chunk === 0) yield;
  }
  return smoothed(open, triangles);
}

class Grid {
  private readonly low = [Infinity, Infinity, Infinity];
  private readonly size: number[];
  private readonly cell: number;
  private readonly perMm: number;
  private readonly cells: Uint8Array;

  constructor(vertices: Float64Array) {
    const high = [-Infinity, -Infinity, -Infinity];
    vertices.forEach((x, i) => {
      this.low[i % 3] = Math.min(this.low[i % 3]!, x);
      high[i % 3] = Math.max(high[i % 3]!, x);
    });
    const volume = high.reduce((product, top, k) => product * (top - this.low[k]!), 1);
    this.cell = Math.max(cell_mm, Math.cbrt(volume / mostCells));
    this.perMm = 1 / this.cell;
    this.size = high.map((top, k) => Math.floor((top - this.low[k]!) / this.cell) + 1);
    this.cells = new Uint8Array(this.size[0]! * this.size[1]! * this.size[2]!);
  }

  /// Marks the cells of points of a triangle that are less than a cell apart.
  fill(vertices: Float64Array, [a, b, c]: readonly [number, number, number]): void {
    const point = (i: number, j: number, steps: number, k: number) =>
      vertices[a + k]! + ((vertices[b + k]! - vertices[a + k]!) * i + (vertices[c + k]! - vertices[a + k]!) * j) / steps;
    const edge = (p: number, q: number) => Math.hypot(...[0, 1, 2].map((k) => vertices[p + k]! - vertices[q + k]!));
    const steps = Math.max(1, Math.ceil(Math.max(edge(a, b), edge(b, c), edge(c, a)) / (0.7 * this.cell)));
    for (let i = 0; i <= steps; ++i)
      for (let j = 0; i + j <= steps; ++j) this.cells[this.place(point(i, j, steps, 0), point(i, j, steps, 1), point(i, j, steps, 2))] = 1;
  }

  /// Share of the light that reaches a vertex; a hit counts less the farther it is.
  openAt(vertices: Float64Array, normals: Float32Array, at: number, sphere: Float32Array): number {
    const { cell } = this, long = Math.hypot(normals[at]!, normals[at + 1]!, normals[at + 2]!) || 1;
    const nx = normals[at]! / long, ny = normals[at + 1]! / long, nz = normals[at + 2]! / long;
    const x = vertices[at]! + above * cell * nx, y = vertices[at + 1]! + above * cell * ny, z = vertices[at + 2]! + above * cell * nz;
    let light = 0, most = 0;
    for (let d = 0; d < sphere.length; d += 3) {
      const dx = sphere[d]!, dy = sphere[d + 1]!, dz = sphere[d + 2]!, share = nx * dx + ny * dy + nz * dz;
      if (share <= 0.05) continue;
      let along = 0;
      while (along < reach_mm && !this.cells[this.place(x + along * dx, y + along * dy, z + along * dz)]) along += cell + 0.08 * along;
      most += share;
      light += share * Math.min(1, along / reach_mm) ** 2;
    }
    return most > 0 ? light / most : 1;
  }

  /// -1 outside.
  private place(x: number, y: number, z: number): number {
    const { low, size, perMm } = this;
    const i = Math.floor((x - low[0]!) * perMm), j = Math.floor((y - low[1]!) * perMm), k = Math.floor((z - low[2]!) * perMm);
    return i < 0 || j < 0 || k < 0 || i >= size[0]! || j >= size[1]! || k >= size[2]! ? -1 : (k * size[1]! + j) * size[0]! + i;
  }
}

/// A spiral from pole to pole.
function directions(): Float32Array {
  return Float32Array.from({ length: 3 * rays }, (_, i) => {
    const n = Math.floor(i / 3), z = 1 - (2 * n + 1) / rays, turn = n * Math.PI * (3 - Math.sqrt(5));
    return [Math.sqrt(1 - z * z) * Math.cos(turn), Math.sqrt(1 - z * z) * Math.sin(turn), z][i % 3]!;
  });
}

function normalOf(p: Float64Array, [a, b, c]: readonly [number, number, number]): [number, number, number] {
  const [ux, uy, uz, vx, vy, vz] = [0, 1, 2].map((k) => p[b + k]! - p[a + k]!).concat([0, 1, 2].map((k) => p[c + k]! - p[a + k]!)) as
    [number, number, number, number, number, number];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}

/// The mean of each vertex and its neighbours: a grid is coarser than a surface.
function smoothed(open: Float32Array, triangles: Uint32Array): Uint8Array {
  const sum = Float32Array.from(open), weight = new Float32Array(open.length).fill(1);
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) {
      const v = triangles[t + k]!, next = triangles[t + ((k + 1) % 3)]!;
      sum[v]! += open[next]!;
      weight[v]! += 1;
    }
  return Uint8Array.from(sum, (total, v) => Math.round((255 * total) / weight[v]!));
}
