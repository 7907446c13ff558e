import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, type Plane } from "three";
import type { Surface, Values } from "../core/protocol";
import { BodyMaterial } from "./body_material";

const plain = 0, bearing = 1, meeting = 2;

/// One bone of the scene. Its vertices have the numbers they have everywhere.
export class SceneBody {
  readonly mesh: Mesh<BufferGeometry, BodyMaterial>;
  values: Values | null = null;
  private readonly shown: BufferAttribute;
  private readonly mark: BufferAttribute;
  private readonly tint: BufferAttribute;
  private readonly bearingVertices = new Set<number>();
  private meetingVertices: number[] = [];
  private bearingIsShown = false;
  private meetingIsShown = true;

  constructor(readonly surface: Surface, bone: string) {
    const count = surface.vertices.length / 3;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(surface.vertices), 3));
    geometry.setIndex(new BufferAttribute(surface.triangles, 1));
    this.shown = dynamic(count);
    this.mark = dynamic(count);
    this.tint = dynamic(count);
    geometry.setAttribute("shown", this.shown);
    geometry.setAttribute("mark", this.mark);
    geometry.setAttribute("tint", this.tint);
    geometry.computeVertexNormals();
    this.mesh = new Mesh(geometry, new BodyMaterial(bone));
  }

  /// Null: no colours.
  show(values: Values | null): void {
    this.values = values;
    if (values) {
      this.shown.array.set(values.mm);
      this.mark.array.set(values.marks);
    } else {
      this.mark.array.fill(0);
    }
    this.shown.needsUpdate = this.mark.needsUpdate = true;
  }

  /// Corners of these triangles are in contact.
  showMeeting(triangles: readonly number[]): void {
    for (const v of this.meetingVertices) this.tint.setX(v, this.tintWithoutContact(v));
    this.meetingVertices = triangles.flatMap((t) => Array.from(this.surface.triangles.subarray(3 * t, 3 * t + 3)));
    if (this.meetingIsShown) for (const v of this.meetingVertices) this.tint.setX(v, meeting);
    this.tint.needsUpdate = true;
  }

  /// Per triangle 1 where it is bearing.
  setBearing(triangles: Uint8Array): void {
    triangles.forEach((is, t) => {
      if (is) this.surface.triangles.subarray(3 * t, 3 * t + 3).forEach((v) => this.bearingVertices.add(v));
    });
    this.tintAll();
  }

  set showsBearing(on: boolean) {
    this.bearingIsShown = on;
    this.tintAll();
  }

  set showsMeeting(on: boolean) {
    this.meetingIsShown = on;
    this.tintAll();
  }

  setClipping(planes: Plane[]): void {
    this.mesh.material.clippingPlanes = planes;
  }

  /// What a vertex shows, in mm.
  valueOf(vertex: number): { mm: number; isBound: boolean } | null {
    const mark = this.values?.marks[vertex] ?? 0;
    return mark === 0 ? null : { mm: this.values!.mm[vertex]!, isBound: mark === 2 };
  }

  private tintAll(): void {
    for (let v = 0; v < this.tint.count; ++v) this.tint.setX(v, this.tintWithoutContact(v));
    if (this.meetingIsShown) for (const v of this.meetingVertices) this.tint.setX(v, meeting);
    this.tint.needsUpdate = true;
  }

  private tintWithoutContact(vertex: number): number {
    return this.bearingIsShown && this.bearingVertices.has(vertex) ? bearing : plain;
  }
}

function dynamic(count: number): BufferAttribute {
  const attribute = new BufferAttribute(new Float32Array(count), 1);
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}
