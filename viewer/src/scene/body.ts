import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Mesh, MeshLambertMaterial, type Plane } from "three";
import type { Surface, Values } from "../core/protocol";
import { BodyMaterial, shadowMaterial } from "./body_material";

/// Marks of vertices, as the components of an attribute.
const marked = { bearing: 0, contact: 1, zone: 2 } as const;
export type Marked = keyof typeof marked;

/// A mesh of a body that consists of several.
export interface Part {
  name: string;
  first_vertex: number;
  vertices: number;
  first_triangle: number;
  triangles: number;
  contact: "ends" | "bearing" | "soft";
}

/// A surface of its own, in the frame of a body.
export interface Ghost {
  vertices: ArrayLike<number>;
  triangles: ArrayLike<number>;
  colour?: string;
}

const ghostColour = "#7fa8c9", ghostOpacity = 0.35;

/// One bone of the scene. Its vertices keep the numbers of the file.
export class SceneBody {
  readonly mesh: Mesh<BufferGeometry, BodyMaterial>;
  values: Values | null = null;
  surface: Surface;
  /// Draws nothing but depths, before a transparent body: only the surface nearest to the viewer stays visible, like glass.
  private readonly veil: Mesh<BufferGeometry, BodyMaterial>;
  private readonly ghosts = new Map<string, Mesh>();
  /// Numbers of each vertex that change, by the names that the material has for them.
  private readonly attributes;
  private readonly markedVertices: Record<Marked, number[]> = { bearing: [], contact: [], zone: [] };
  private readonly showsMarked: Record<Marked, boolean> = { bearing: false, contact: true, zone: true };

  /// In a body of several meshes, soft ones and implants have a colour of their own.
  constructor(
    surface: Surface, private readonly bone: string, private readonly cartilage: string, private readonly parts: readonly Part[],
    private readonly changed: () => void) {
    this.surface = surface;
    const count = surface.vertices.length / 3;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(surface.vertices), 3));
    geometry.setIndex(new BufferAttribute(surface.triangles, 1));
    this.attributes = { shown: dynamic(count), mark: dynamic(count), cover: dynamic(count), tints: dynamic(count, 3), hidden: dynamic(count) };
    const isCartilage = new BufferAttribute(new Float32Array(count), 1);
    for (const { first_vertex, vertices } of parts.filter(({ contact }) => contact !== "ends"))
      isCartilage.array.fill(1, first_vertex, first_vertex + vertices);
    const openness = new BufferAttribute(new Uint8Array(count).fill(255), 1, true);
    for (const [name, attribute] of Object.entries({ ...this.attributes, isCartilage, openness })) geometry.setAttribute(name, attribute);
    geometry.computeVertexNormals();
    this.mesh = new Mesh(geometry, new BodyMaterial(bone, cartilage));
    this.mesh.receiveShadow = true;
    this.mesh.customDepthMaterial = shadowMaterial();
    this.veil = new Mesh(geometry, new BodyMaterial(bone, cartilage));
    this.veil.material.colorWrite = false;
    // Transparent bodies are drawn in this order.
    this.veil.material.transparent = true;
    this.veil.visible = false;
    this.mesh.add(this.veil);
  }

  /// Other positions of the same vertices. Earlier arrays stay unchanged.
  replaceVertices(vertices: ArrayLike<number>): void {
    this.surface = { vertices: Float64Array.from(vertices), triangles: this.surface.triangles };
    const { geometry } = this.mesh, position = geometry.getAttribute("position") as BufferAttribute;
    position.array.set(this.surface.vertices);
    position.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
    geometry.boundingBox = null;
    this.changed();
  }

  /// Another state of this body by its name, transparent, in the same place; null: none.
  setGhost(name: string, ghost: Ghost | null): void {
    const shown = this.ghosts.get(name);
    shown?.removeFromParent();
    shown?.geometry.dispose();
    this.ghosts.delete(name);
    this.changed();
    if (!ghost) return;
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(ghost.vertices), 3));
    geometry.setIndex(new BufferAttribute(new Uint32Array(ghost.triangles), 1));
    geometry.computeVertexNormals();
    const mesh = new Mesh(geometry, new MeshLambertMaterial({
      color: ghost.colour ?? ghostColour, transparent: true, opacity: ghostOpacity, side: DoubleSide, depthWrite: false, clippingPlanes: this.mesh.material.clippingPlanes,
      // Where both surfaces coincide to some tenth of a millimetre, this body is drawn.
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 20,
    }));
    mesh.renderOrder = 5;
    this.mesh.add(mesh);
    this.ghosts.set(name, mesh);
  }

  /// Transparent bodies are drawn after what is behind them; `isVeiled` shows only the nearest surface of this one.
  setOpacity(opacity: number, isGlass: boolean, isVeiled: boolean): void {
    this.mesh.material.setOpacity(opacity, isGlass);
    // Glass throws no shadow.
    this.mesh.castShadow = opacity === 1 && !isGlass;
    this.veil.visible = isVeiled;
    this.veil.renderOrder = 1;
    this.mesh.renderOrder = opacity < 1 || isGlass ? 2 : 0;
  }

  /// As BodyMaterial.setMeasures().
  setMeasures(radius_mm: number, pixel: number): void {
    for (const { material } of [this.mesh, this.veil]) material.setMeasures(radius_mm, pixel);
  }

  /// How open the surface is at each vertex, 0 to 255: less light falls into hollows.
  setOpenness(openness: Uint8Array): void {
    const attribute = this.mesh.geometry.getAttribute("openness") as BufferAttribute;
    attribute.array.set(openness);
    attribute.needsUpdate = true;
    this.changed();
  }

  /// Null: no colours.
  show(values: Values | null): void {
    const { shown, mark, cover } = this.attributes;
    this.values = values;
    if (values) {
      shown.array.set(values.shown);
      mark.array.set(values.marks);
      this.coverBy(values.marks);
    } else {
      mark.array.fill(0);
    }
    shown.needsUpdate = mark.needsUpdate = cover.needsUpdate = true;
  }

  /// Marks the corners of these triangles only.
  setMarked(as: Marked, triangles: Iterable<number>): void {
    const before = this.markedVertices[as];
    const now: number[] = [];
    for (const t of triangles) now.push(...this.surface.triangles.subarray(3 * t, 3 * t + 3));
    this.markedVertices[as] = now;
    if (!this.showsMarked[as]) return;
    this.tint(as, before, 0);
    this.tint(as, now, 1);
  }

  showMarked(as: Marked, on: boolean): void {
    this.showsMarked[as] = on;
    this.tint(as, this.markedVertices[as], on ? 1 : 0);
  }

  setPartVisible({ first_vertex, vertices }: Part, visible: boolean): void {
    const { hidden } = this.attributes;
    hidden.array.fill(visible ? 0 : 1, first_vertex, first_vertex + vertices);
    hidden.needsUpdate = true;
    this.changed();
  }

  /// The triangles around these vertices, with the vertices where they were.
  surfaceBefore(vertices: Uint32Array, before: Float64Array): BufferGeometry {
    const positions = new Float32Array(this.surface.vertices), moved = new Uint8Array(positions.length / 3);
    vertices.forEach((vertex, i) => {
      positions.set(before.subarray(3 * i, 3 * i + 3), 3 * vertex);
      moved[vertex] = 1;
    });
    const { triangles } = this.surface;
    const corners: number[] = [];
    for (let t = 0; t < triangles.length; t += 3) {
      const of = [triangles[t]!, triangles[t + 1]!, triangles[t + 2]!];
      if (of.some((corner) => moved[corner])) corners.push(...of);
    }
    return new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3)).setIndex(corners);
  }

  hasGhost(name: string): boolean {
    return this.ghosts.has(name);
  }

  isHidden(vertex: number): boolean {
    return this.attributes.hidden.getX(vertex) === 1;
  }

  isMarked(as: Marked, vertex: number): boolean {
    return this.showsMarked[as] && this.attributes.tints.getComponent(vertex, marked[as]) > 0.5;
  }

  /// CSS colour of a vertex without a value.
  plainColour(vertex: number): string {
    const isOf = ({ first_vertex, vertices, contact }: Part) => contact !== "ends" && vertex >= first_vertex && vertex < first_vertex + vertices;
    return this.parts.some(isOf) ? this.cartilage : this.bone;
  }

  setClipping(planes: Plane[]): void {
    this.mesh.material.clippingPlanes = this.veil.material.clippingPlanes = planes;
    for (const ghost of this.ghosts.values()) (ghost.material as MeshLambertMaterial).clippingPlanes = planes;
  }

  /// Value shown at a vertex.
  valueOf(vertex: number): { amount: number; isBound: boolean } | null {
    const mark = this.values?.marks[vertex] ?? 0;
    return mark === 0 ? null : { amount: this.values!.shown[vertex]!, isBound: mark === 2 };
  }

  /// Share of the corners of the triangles around each vertex that have a value.
  private coverBy(marks: Uint8Array): void {
    const { triangles } = this.surface, share = this.attributes.cover.array, corners = new Uint16Array(share.length);
    share.fill(0);
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [triangles[t]!, triangles[t + 1]!, triangles[t + 2]!];
      const count = (marks[a]! > 0 ? 1 : 0) + (marks[b]! > 0 ? 1 : 0) + (marks[c]! > 0 ? 1 : 0);
      for (const corner of [a, b, c]) {
        share[corner]! += count;
        corners[corner]! += 3;
      }
    }
    for (let v = 0; v < share.length; ++v) share[v]! /= corners[v] || 1;
  }

  private tint(as: Marked, vertices: readonly number[], share: number): void {
    const { tints } = this.attributes;
    for (const v of vertices) tints.setComponent(v, marked[as], share);
    tints.needsUpdate = true;
  }
}

function dynamic(count: number, components = 1): BufferAttribute {
  const attribute = new BufferAttribute(new Float32Array(components * count), components);
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}
