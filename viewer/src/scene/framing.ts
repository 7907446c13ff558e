import { Matrix4, Vector3 } from "three";

/// The scene is as high as this many radii of the joint's sphere: the sphere is two fifths of it.
export const radiiOfScene = 5;
/// A narrow scene shows at least this much of its width: the joint's sphere and a quarter more.
const radiiOfWidth = 2.5;

/// Height of the scene about a joint of this radius.
export function heightOfJoint(radius_mm: number, aspect: number): number {
  return radius_mm * Math.max(radiiOfScene, radiiOfWidth / aspect);
}

const cell_mm = 8, nearEnough_mm = 6, sampled = 4000;

/// Radius about the centre within which the bones lie next to each other: for a joint without a known sphere. Nine tenths of the
/// vertices of the mobile body that are near the fixed body are nearer to the centre. Null if the bodies are apart.
export function radiusOfNeighbours(fixed: ArrayLike<number>, mobile: ArrayLike<number>, pose: Matrix4): number | null {
  const cells = new Map<string, number[]>();
  const key = (x: number, y: number, z: number) => `${Math.floor(x / cell_mm)},${Math.floor(y / cell_mm)},${Math.floor(z / cell_mm)}`;
  for (let v = 0; v < fixed.length; v += 3) {
    const name = key(fixed[v]!, fixed[v + 1]!, fixed[v + 2]!);
    const there = cells.get(name);
    if (there) there.push(v);
    else cells.set(name, [v]);
  }
  const step = 3 * Math.max(1, Math.floor(mobile.length / 3 / sampled));
  const near: number[] = [];
  const p = new Vector3();
  for (let v = 0; v < mobile.length; v += step) {
    p.set(mobile[v]!, mobile[v + 1]!, mobile[v + 2]!).applyMatrix4(pose);
    if (hasNeighbour(p, fixed, cells, key)) near.push(p.length());
  }
  if (near.length === 0) return null;
  near.sort((a, b) => a - b);
  return near[Math.floor(0.9 * (near.length - 1))]!;
}

function hasNeighbour(
  p: Vector3, fixed: ArrayLike<number>, cells: Map<string, number[]>, key: (x: number, y: number, z: number) => string): boolean {
  const around = [-cell_mm, 0, cell_mm];
  return around.some((x) => around.some((y) => around.some((z) =>
    cells.get(key(p.x + x, p.y + y, p.z + z))?.some((v) =>
      Math.hypot(fixed[v]! - p.x, fixed[v + 1]! - p.y, fixed[v + 2]! - p.z) < nearEnough_mm))));
}
