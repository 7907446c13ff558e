import { Raycaster, Vector2, type Camera, type Intersection } from "three";
import type { SceneBody } from "./body";
import type { BodyName } from "./body_names";
import { isGhost } from "./ghost";

/// The vertex under the pointer.
export interface Picked {
  body: BodyName;
  vertex: number;
}

/// The point of a surface under the pointer, in the frame of its body; the vertex is the triangle's nearest corner.
export interface PickedPoint extends Picked {
  triangle: number;
  point: [number, number, number];
  normal: [number, number, number];
}

/// Points of bones under points of the page, as a camera sees them on the canvas.
export class Picker {
  private readonly rays = new Raycaster();

  constructor(
    private readonly canvas: HTMLCanvasElement, private readonly bodies: Record<BodyName, SceneBody>, private readonly radius_mm: () => number) {}

  /// The point of a bone under a point of the page, in that body's frame; null if no bone is there.
  pick(event: { clientX: number; clientY: number }, camera: Camera): PickedPoint | null {
    const found = this.hitUnder(event, camera);
    if (!found) return null;
    const { body, hit } = found;
    const point = hit.point.clone().applyMatrix4(this.bodies[body].mesh.matrixWorld.clone().invert());
    return { body, vertex: nearestCorner(hit), triangle: hit.faceIndex!, point: point.toArray(), normal: hit.face!.normal.toArray() };
  }

  private hitUnder(event: { clientX: number; clientY: number }, camera: Camera): { body: BodyName; hit: Intersection } | null {
    const box = this.canvas.getBoundingClientRect();
    this.rays.setFromCamera(new Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2), camera);
    for (const hit of this.rays.intersectObjects([this.bodies.fixed.mesh, this.bodies.mobile.mesh].filter((m) => m.visible), false)) {
      const body: BodyName = hit.object === this.bodies.fixed.mesh ? "fixed" : "mobile";
      const planes = this.bodies[body].mesh.material.clippingPlanes ?? [];
      if (isGhost(hit.point, camera, this.radius_mm())) continue;
      if (planes.every((plane) => plane.distanceToPoint(hit.point) >= 0) && !this.bodies[body].isHidden(nearestCorner(hit))) return { body, hit };
    }
    return null;
  }
}

function nearestCorner({ face, barycoord }: Intersection): number {
  const corners = [face!.a, face!.b, face!.c], weights = barycoord!.toArray();
  return corners[weights.indexOf(Math.max(...weights))]!;
}
