import {
  BufferAttribute, BufferGeometry, DoubleSide, Line, LineBasicMaterial, LineLoop, LineSegments, Mesh, MeshBasicMaterial, type Object3D, Points,
  PointsMaterial, Quaternion, type Scene, SphereGeometry, Vector3,
} from "three";
import type { LigamentShown } from "../core/protocol";
import type { SceneBody } from "./body";
import type { BodyName } from "./body_names";
import { contactColour } from "./colour_scale";
import type { Marks } from "./measure_marks";

const brushColour = "#00b050";
/// As `condyle picture` draws them.
const ligamentColours = { slack: "#6e6e6e", taut: "#009e73", at_end: "#d55e00", unknown: "#cc79a7" };

/// Where a brush is: a circle about a point of a surface, in the frame of its body.
export interface Ring {
  body: BodyName;
  point: readonly [number, number, number];
  normal: readonly [number, number, number];
  radius_mm: number;
}

/// Objects drawn besides the surfaces of the bones: the contact point, a distance, marks of measures, removed bone, the ring of a brush.
export class Annotations {
  private readonly contactPoint: Mesh;
  private readonly ring: LineLoop;
  private measure: Line | null = null;
  private marks: Object3D[] = [];
  private ligaments: Mesh<BufferGeometry, MeshBasicMaterial>[] = [];
  private readonly removed: Record<BodyName, Mesh | null> = { fixed: null, mobile: null };

  constructor(private readonly scene: Scene, private readonly bodies: Record<BodyName, SceneBody>, private readonly changed: () => void) {
    this.contactPoint = new Mesh(new SphereGeometry(1, 24, 16), new MeshBasicMaterial({ color: contactColour, depthTest: false, transparent: true }));
    this.contactPoint.renderOrder = 9;
    this.contactPoint.visible = false;
    this.ring = brushRing();
    scene.add(this.contactPoint);
  }

  /// A ball about a point in F.
  showContactPoint(point: readonly [number, number, number] | null, radius_mm = 0): void {
    this.contactPoint.visible = point !== null;
    if (point) this.contactPoint.position.set(...point);
    this.contactPoint.scale.setScalar(radius_mm);
  }

  showDistance(ends: [Vector3, Vector3] | null): void {
    if (this.measure) this.scene.remove(this.measure);
    this.measure = ends
      ? new Line(new BufferGeometry().setFromPoints(ends), new LineBasicMaterial({ color: "#c2185b", depthTest: false })) : null;
    if (this.measure) this.scene.add(this.measure);
    this.changed();
  }

  /// Tubes of ligaments, in F.
  showLigaments(ligaments: readonly LigamentShown[]): void {
    for (const tube of this.ligaments) {
      tube.removeFromParent();
      tube.geometry.dispose();
      tube.material.dispose();
    }
    this.ligaments = ligaments.map(({ is, vertices, triangles }) => {
      const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(vertices), 3));
      geometry.setIndex(triangles.flat());
      return new Mesh(geometry, new MeshBasicMaterial({ color: ligamentColours[is] }));
    });
    if (this.ligaments.length) this.scene.add(...this.ligaments);
    this.changed();
  }

  /// Lines and points that move with their bodies; null: none.
  showMarks(marks: readonly Marks[] | null): void {
    for (const mark of this.marks) mark.removeFromParent();
    const geometry = (xyz: readonly number[]) => new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(xyz), 3));
    this.marks = (marks ?? []).flatMap(({ body, colour, lines, points }) => {
      // Axes lie inside their bones.
      const drawn = [
        new LineSegments(geometry(lines), new LineBasicMaterial({ color: colour, depthTest: false })),
        new Points(geometry(points), new PointsMaterial({ color: colour, size: 3 })),
      ];
      for (const each of drawn) each.renderOrder = 6;
      this.bodies[body].mesh.add(...drawn);
      return drawn;
    });
    this.changed();
  }

  /// The surface that a body had before some of its vertices were lowered, over them, in a colour that no scale has; null: none.
  showRemoved(body: BodyName, removed: { vertices: Uint32Array; before: Float64Array } | null): void {
    this.removed[body]?.removeFromParent();
    const mesh = removed && this.bodies[body].surfaceBefore(removed.vertices, removed.before);
    const drawn = mesh && new Mesh(mesh, new MeshBasicMaterial({ color: "#1b9e77", transparent: true, opacity: 0.6, side: DoubleSide }));
    if (drawn) drawn.renderOrder = 5;
    if (drawn) this.bodies[body].mesh.add(drawn);
    this.removed[body] = drawn;
    this.changed();
  }

  /// Null: no ring.
  showRing(ring: Ring | null): void {
    this.ring.removeFromParent();
    this.changed();
    if (!ring) return;
    this.bodies[ring.body].mesh.add(this.ring);
    this.ring.position.set(...ring.point);
    this.ring.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...ring.normal).normalize()));
    this.ring.scale.setScalar(ring.radius_mm);
  }
}

/// A circle of radius 1 about Z.
function brushRing(): LineLoop {
  const steps = 64;
  const circle = Array.from({ length: steps }, (_, k) => {
    const turn = (2 * Math.PI * k) / steps;
    return new Vector3(Math.cos(turn), Math.sin(turn), 0);
  });
  const ring = new LineLoop(new BufferGeometry().setFromPoints(circle), new LineBasicMaterial({ color: brushColour, depthTest: false, transparent: true }));
  ring.renderOrder = 10;
  return ring;
}
