import { Matrix4, Vector3 } from "three";

/// A body: vertices in its own frame, its pose.
export interface Standing {
  vertices: ArrayLike<number>;
  normals: ArrayLike<number>;
  pose: Matrix4;
}

/// The joint's sphere is hidden if bone is before most of five lines of sight through it. Bone nearer than the first bound, in its radii, is its own
/// head or socket; bone farther than the second is a ghost.
const hiddenLines = 3, hidingRadii = [1.3, 3] as const, lineAside = 0.55;
const steps_deg = [15, 30, 45, 60, 75, 90];

/// From where the joint's sphere about the origin is seen, turned as little as possible about the axis of a motion, else upright; null if it is seen
/// from here, or from nowhere there.
export function directionPast(towards: Vector3, axis: Vector3, radius_mm: number, bodies: readonly Standing[]): Vector3 | null {
  const range = hidingRadii.map((radii) => radii * radius_mm) as [number, number];
  const isHidden = (direction: Vector3) => {
    const across = new Vector3().crossVectors(direction, axis).setLength(lineAside * radius_mm), along = axis.clone().projectOnPlane(direction);
    along.setLength(lineAside * radius_mm);
    const points = [new Vector3(), across, across.clone().negate(), along, along.clone().negate()];
    return points.filter((point) => bodies.some((body) => areBlocked([direction], point, body, range)[0])).length >= hiddenLines;
  };
  if (!isHidden(towards)) return null;
  const turned = [axis, new Vector3(0, 1, 0)].flatMap((about) => steps_deg.flatMap((deg) => [deg, -deg]).map((deg) =>
    towards.clone().applyAxisAngle(about, (deg * Math.PI) / 180)));
  return turned.find((direction) => !isHidden(direction)) ?? null;
}

const patch_mm = 6, tube_mm = 3, beginning_mm = 4;
const turns = 24, tilts_deg = [15, 30, 50];
/// Penalties of a view: blocked by the solid bone; blocked by the glass; nearly from above or below, where the up direction is
/// ill-defined.
const blocked = 3, throughGlass = 0.4, upright = 0.6;

/// The direction from which a contact is viewed: along the surface in contact and a little from above it, from the side
/// where the joint is open, past the solid bone and rather not through the glass.
export function directionOnto(point: Vector3, solid: Standing, glass: Standing): Vector3 {
  const outwards = point.lengthSq() > 1e-6 ? point.clone().normalize() : new Vector3(1, 0, 0);
  const normal = normalAt(point, solid) ?? outwards;
  const across = new Vector3().crossVectors(normal, Math.abs(normal.y) < 0.9 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0)).normalize();
  const along = new Vector3().crossVectors(normal, across);
  const candidates = tilts_deg.flatMap((tilt_deg) => Array.from({ length: turns }, (_, k) => {
    const tilt = (tilt_deg * Math.PI) / 180, turn = (2 * Math.PI * k) / turns;
    return new Vector3().addScaledVector(across, Math.cos(tilt) * Math.cos(turn)).addScaledVector(along, Math.cos(tilt) * Math.sin(turn))
      .addScaledVector(normal, Math.sin(tilt));
  }));
  const inSolid = areBlocked(candidates, point, solid), inGlass = areBlocked(candidates, point, glass);
  let best = candidates[0]!, most = -Infinity;
  candidates.forEach((candidate, i) => {
    const steep = Math.max(0, Math.abs(candidate.y) - 0.85) / 0.15;
    const score = outwards.dot(candidate) - (inSolid[i] ? blocked : 0) - (inGlass[i] ? throughGlass : 0) - upright * steep;
    if (score > most + 1e-9) [best, most] = [candidate, score];
  });
  return best;
}

/// Mean of the normals around a point; null if no vertex is near.
function normalAt(point: Vector3, { vertices, normals, pose }: Standing): Vector3 | null {
  const local = point.clone().applyMatrix4(pose.clone().invert()), sum = new Vector3();
  for (let v = 0; v < vertices.length; v += 3) {
    const apart = Math.hypot(vertices[v]! - local.x, vertices[v + 1]! - local.y, vertices[v + 2]! - local.z);
    if (apart < patch_mm) sum.add(new Vector3(normals[v]!, normals[v + 1]!, normals[v + 2]!).multiplyScalar(1 - apart / patch_mm));
  }
  return sum.lengthSq() > 1e-12 ? sum.transformDirection(pose) : null;
}

/// Whether vertices lie in a tube from the point along each direction, so far from the point.
function areBlocked(
  directions: readonly Vector3[], point: Vector3, { vertices, pose }: Standing,
  [least, most]: readonly [number, number] = [beginning_mm, Infinity]): boolean[] {
  const back = pose.clone().invert(), local = point.clone().applyMatrix4(back);
  const d = directions.map((direction) => direction.clone().transformDirection(back).toArray());
  const found = directions.map(() => false);
  for (let v = 0; v < vertices.length; v += 3) {
    const x = vertices[v]! - local.x, y = vertices[v + 1]! - local.y, z = vertices[v + 2]! - local.z, far2 = x * x + y * y + z * z;
    for (let i = 0; i < d.length; ++i) {
      const [dx, dy, dz] = d[i]!, t = x * dx + y * dy + z * dz;
      if (t > least && t < most && far2 - t * t < tube_mm * tube_mm) found[i] = true;
    }
  }
  return found;
}
