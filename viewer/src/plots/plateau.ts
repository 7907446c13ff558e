import { html, named } from "../dom";
import type { JointArrays, Surface, Values } from "../core/protocol";
import type { ReportText, StoredSurface } from "../report";
import { colourScale } from "../scene/colour_scale";
import type { BodyName } from "../scene/body_names";
import { words } from "../words";

const size_px = 640, margin_px = 10;

/// The bearing surface of a tibia, flat: from above, its front up and its right to the right, coloured as the scene is.
export class Plateau {
  readonly element: HTMLElement;
  private readonly canvas = html("canvas", { width: size_px, height: size_px, role: "img" });
  private readonly caption = html("figcaption", {});
  private readonly triangles: Uint32Array;
  private readonly places: Float64Array;

  constructor(readonly body: BodyName, surface: Surface, stored: StoredSurface, private readonly name: string) {
    this.triangles = surface.triangles.subarray(3 * stored.first_triangle, 3 * (stored.first_triangle + stored.triangles));
    const { vertices } = surface, { first_vertex: first, vertices: count } = stored;
    // Right (Z) to the right, front (X) up.
    const bounds = { z: [Infinity, -Infinity], x: [Infinity, -Infinity] } as Record<"z" | "x", [number, number]>;
    for (let v = first; v < first + count; ++v)
      for (const [axis, value] of [["x", vertices[3 * v]!], ["z", vertices[3 * v + 2]!]] as const)
        bounds[axis] = [Math.min(bounds[axis][0], value), Math.max(bounds[axis][1], value)];
    const wide = bounds.z[1] - bounds.z[0], high = bounds.x[1] - bounds.x[0];
    const scale = (size_px - 2 * margin_px) / Math.max(wide, high, 1e-9);
    this.canvas.height = Math.ceil(scale * high) + 2 * margin_px;
    this.places = new Float64Array(2 * (first + count));
    for (let v = first; v < first + count; ++v) {
      this.places[2 * v] = margin_px + scale * (vertices[3 * v + 2]! - bounds.z[0] + (size_px - 2 * margin_px) / scale / 2 - wide / 2);
      this.places[2 * v + 1] = margin_px + scale * (bounds.x[1] - vertices[3 * v]!);
    }
    this.element = html("figure", { class: "plateau" }, html("div", { class: "picture" }, this.canvas), this.caption);
  }

  show(values: Values | null, quantity: Parameters<typeof colourScale>[0], end: number): void {
    const context = this.canvas.getContext("2d")!, scale = colourScale(quantity, end), { places } = this;
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    for (let t = 0; t < this.triangles.length; t += 3) {
      const corners = [this.triangles[t]!, this.triangles[t + 1]!, this.triangles[t + 2]!];
      const has = values !== null && corners.every((corner) => values.marks[corner] !== 0);
      const amount = has ? corners.reduce((sum, corner) => sum + values.shown[corner]!, 0) / 3 : 0;
      context.fillStyle = has && amount !== 0 && !(scale.plainAbove && amount > scale.high) ? scale.colour(amount) : "#c9cfd6";
      context.strokeStyle = context.fillStyle;
      context.beginPath();
      corners.forEach((corner, i) => (i ? context.lineTo(places[2 * corner]!, places[2 * corner + 1]!) : context.moveTo(places[2 * corner]!, places[2 * corner + 1]!)));
      context.closePath();
      context.fill();
      context.stroke();
    }
    const caption = words.plateau(this.name, `${words.quantity[quantity]}, ${words.unit[quantity]}`);
    this.caption.textContent = caption;
    this.canvas.setAttribute("aria-label", caption);
  }
}

/// The surface of a tibia that carries load; null for a joint without one.
export function plateauOf({ layers, joint }: ReportText, arrays: JointArrays): Plateau | null {
  if (!layers || joint.anatomy !== "knee") return null;
  const height = (body: BodyName) => {
    const { vertices } = arrays[body];
    let sum = 0;
    for (let i = 1; i < vertices.length; i += 3) sum += vertices[i]!;
    return sum / vertices.length;
  };
  const body: BodyName = height("fixed") < height("mobile") ? "fixed" : "mobile";
  return new Plateau(body, arrays[body], layers[body], named(joint[body]));
}
