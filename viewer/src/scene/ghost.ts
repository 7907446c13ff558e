import { type Camera, MathUtils, OrthographicCamera, Vector3 } from "three";

/// Bone far from the joint that hides it, or that comes at the viewer, is a ghost: mostly holes, with its outline. In radii of the joint's sphere:
/// bone nearer to its centre is never a ghost, farther it is where it stands between viewer and joint, or within a share of the viewer's distance.
const solid = 2.5, ghostly = 3.2, before = [1.5, 2.2] as const, close = [0.35, 0.7] as const;
const most = 0.88;

export const ghostShader = `
  uniform float ghostRadius;
  bool isGhost(vec3 p, vec2 at, float facing) {
    vec3 centre = viewMatrix[3].xyz, from = (p - centre) / ghostRadius;
    float far = length(from);
    if (far < ${solid.toFixed(1)}) return false;
    float away = length(centre), depth = isOrthographic ? away : -p.z;
    vec3 seen = isOrthographic ? vec3(from.xy, 0.0) : (p * (centre.z / p.z) - centre) / ghostRadius;
    float hides = from.z > 0.0 ? 1.0 - smoothstep(${before[0].toFixed(1)}, ${before[1].toFixed(1)}, length(seen)) : 0.0;
    float isClose = 1.0 - smoothstep(${close[0].toFixed(2)}, ${close[1].toFixed(2)}, depth / away);
    float share = smoothstep(${solid.toFixed(1)}, ${ghostly.toFixed(1)}, far) * max(hides, isClose);
    float grain = fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
    return share * ${most.toFixed(2)} * smoothstep(0.1, 0.3, facing) > grain || (share > 0.3 && !gl_FrontFacing);
  }`;

/// Whether a point of a bone, in F, is more holes than bone.
export function isGhost(point: Vector3, camera: Camera, radius_mm: number): boolean {
  const isParallel = camera instanceof OrthographicCamera, centre = new Vector3().applyMatrix4(camera.matrixWorldInverse);
  const p = point.clone().applyMatrix4(camera.matrixWorldInverse), from = p.clone().sub(centre).divideScalar(radius_mm);
  const nearness = isParallel ? 1 : p.z / centre.z;
  const seen = isParallel ? Math.hypot(from.x, from.y) : p.divideScalar(nearness).distanceTo(centre) / radius_mm;
  const hides = from.z > 0 ? 1 - MathUtils.smoothstep(seen, ...before) : 0, isClose = 1 - MathUtils.smoothstep(nearness, ...close);
  return MathUtils.smoothstep(from.length(), solid, ghostly) * Math.max(hides, isClose) > 0.5;
}
