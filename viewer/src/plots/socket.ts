import type { Surface } from "../core/protocol";
import { html } from "../dom";

const size_px = 360;

/// The socket of a hip seen from the side of the body, superior up and anterior to the right on either side, as the clock face is: what lies within
/// `radius_mm` of the joint centre. `lateral` is 1 for a right hip, -1 for a left one.
export function socketPicture({ vertices, triangles }: Surface, radius_mm: number, lateral: 1 | -1): string {
  const canvas = html("canvas", { width: size_px, height: size_px }), context = canvas.getContext("2d")!, half = size_px / 2;
  const corner = (t: number, k: number) => [0, 1, 2].map((axis) => vertices[3 * triangles[t + k]! + axis]!) as [number, number, number];
  const seen: { at: [number, number, number][]; depth: number }[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const at = [corner(t, 0), corner(t, 1), corner(t, 2)];
    if (at.some(([x, y]) => Math.hypot(x, y) < radius_mm)) seen.push({ at, depth: lateral * (at[0]![2] + at[1]![2] + at[2]![2]) });
  }
  // What is nearer is painted over what is behind it.
  for (const { at } of seen.sort((a, b) => a.depth - b.depth)) {
    const [a, b, c] = at as unknown as [number[], number[], number[]], [u, v] = [b.map((value, k) => value - a[k]!), c.map((value, k) => value - a[k]!)];
    const normal = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
    const facing = Math.abs(normal[2]!) / (Math.hypot(...normal) || 1), grey = Math.round(120 + 110 * facing);
    context.fillStyle = context.strokeStyle = `rgb(${grey} ${grey - 6} ${grey - 18})`;
    context.beginPath();
    for (const [x, y] of at) context.lineTo(half + (half * x) / radius_mm, half - (half * y) / radius_mm);
    context.closePath();
    context.fill();
    context.stroke();
  }
  return canvas.toDataURL();
}
